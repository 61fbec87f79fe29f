//! The verdict, in numbers, words and colours.

use crate::{ErrorMap, Scale};
use serde::Serialize;
use sr_film::DisplayImage;
use sr_stats::normal_quantile;

/// Names of the channels.
pub(super) const CHANNELS: [char; 3] = ['R', 'G', 'B'];

/// Bins of [`Verdict::p_histogram`].
pub(super) const HISTOGRAM: usize = 10;

/// Whether two methods have the same expectation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// No question gave a reason to call them different.
    Same,
    /// They are.
    Different,
    /// They look different in tiles, or on the whole, whose noise comes from a few bright samples: rare
    /// bright paths that one has met and the other has not look like that too.
    Unclear,
}

/// One of the three questions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Question {
    /// Probability of what was found, or worse, if the methods have the same expectation.
    pub p_value: f64,
    /// Whether that is no reason to call them different.
    pub passed: bool,
}

/// The difference of a channel's mean over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanDifference {
    /// `R`, `G` or `B`.
    pub channel: char,
    /// Mean of the first method.
    pub a: f64,
    /// Mean of the second.
    pub b: f64,
    /// First less second.
    pub difference: f64,
    /// Half the width of its 95 % interval.
    pub half_width: f64,
    /// Of Welch's test.
    pub p_value: f64,
}

/// A tile and the channel in which it differs most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TileDifference {
    /// Its leftmost column of pixels.
    pub x: u32,
    /// Its topmost row.
    pub y: u32,
    /// `R`, `G` or `B`.
    pub channel: char,
    /// First mean less second.
    pub difference: f64,
    /// Standard error of the difference.
    pub std_error: f64,
    /// Of Welch's test.
    pub p_value: f64,
}

/// Whether two methods have the same expectation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The answer.
    pub answer: Answer,
    /// Width of the pictures.
    pub width: u32,
    /// Height of the pictures.
    pub height: u32,
    /// Side of the tiles.
    pub tile: u32,
    /// Tiles tested, three channels each.
    pub tile_count: usize,
    /// Tiles that differ by themselves, at the level that so many tests share.
    pub different_tiles: usize,
    /// Tiles with heavy tails: few pixels, or one seed, make up their noise. Their p-values are not
    /// asked for their distribution.
    pub heavy_tiles: usize,
    /// Probability that the same is called different.
    pub false_alarm: f64,
    /// Does a tile differ?
    pub tiles: Question,
    /// Are there too many small p-values?
    pub distribution: Question,
    /// Does the mean differ?
    pub mean: Question,
    /// How many p-values lie in each tenth of [0, 1]; even if the methods are the same.
    pub p_histogram: [u64; HISTOGRAM],
    /// The tiles with the smallest p-values, whether or not they differ.
    pub worst: Vec<TileDifference>,
    /// Mean standard error of a tile's difference, relative to the mean: what a tile cannot tell.
    pub tile_error: f64,
    /// By channel.
    pub mean_difference: [MeanDifference; 3],
    /// p-value below which a single tile and channel differs.
    #[serde(skip)]
    pub(super) tile_level: f64,
    #[serde(skip)]
    pub(super) z: Vec<f32>,
    #[serde(skip)]
    pub(super) columns: u32,
}

impl Verdict {
    /// The verdict in words, as lines of text; the last has no line end.
    pub fn describe(&self) -> String {
        let percent = 100.0 * self.false_alarm;
        let answer = match self.answer {
            Answer::Same => "THE SAME, as far as their noise lets one see",
            Answer::Different => "DIFFERENT, by more than their noise explains",
            Answer::Unclear => {
                "UNCLEAR, a difference or a few bright samples that one of them has missed"
            }
        };
        let mut text = format!("{answer} (false alarms: {percent:.2} %)\n");
        text += &self.describe_tiles();
        text += &self.describe_distribution();
        text += &self.describe_mean();
        if self.heavy_tiles > 0 {
            text += &format!(
                "\nheavy tails   in {} of {} tiles a few bright samples make up the noise; judge with more samples",
                self.heavy_tiles, self.tile_count
            );
        }
        if self.answer == Answer::Same {
            text += &self.describe_power();
        }
        text
    }

    fn describe_tiles(&self) -> String {
        let side = self.tile;
        let mut text = format!(
            "tiles         {} of {} ({side} × {side} pixels) differ; chance of a smallest p-value of {}: {}",
            self.different_tiles,
            self.tile_count,
            scientific(self.worst.first().map_or(1.0, |w| w.p_value)),
            verdict(&self.tiles)
        );
        if !self.tiles.passed {
            for w in self.worst.iter().filter(|w| w.p_value < self.tile_level) {
                text += &format!(
                    "\n              at ({}, {}) {} by {:+.3e} ± {:.1e} (p {})",
                    w.x,
                    w.y,
                    w.channel,
                    w.difference,
                    w.std_error,
                    scientific(w.p_value)
                );
            }
        }
        text
    }

    fn describe_distribution(&self) -> String {
        let total = self.p_histogram.iter().sum::<u64>().max(1) as f64;
        let shares: Vec<String> = self
            .p_histogram
            .iter()
            .map(|&n| format!("{:.0}", 100.0 * n as f64 / total))
            .collect();
        format!(
            "\ndistribution  % of p-values in each tenth: {}; chance of so many small ones: {}",
            shares.join(" "),
            verdict(&self.distribution)
        )
    }

    fn describe_mean(&self) -> String {
        let mut text = format!(
            "\nmean          chance of such a difference: {}",
            verdict(&self.mean)
        );
        for m in &self.mean_difference {
            text += &format!(
                "\n              {} {:.6} − {:.6} = {:+.2e} ± {:.1e}",
                m.channel, m.a, m.b, m.difference, m.half_width
            );
            if m.b > 0.0 {
                let percent = 100.0 / m.b;
                text += &format!(
                    " ({:+.3} ± {:.3} %)",
                    m.difference * percent,
                    m.half_width * percent
                );
            }
        }
        text
    }

    /// What would have been found: differences of the threshold's and two more standard errors,
    /// which chance hides in one case of forty.
    fn describe_power(&self) -> String {
        let sigmas = 2.0 - normal_quantile(0.5 * self.tile_level);
        let bright = self.mean_difference.iter().map(|m| m.b).sum::<f64>();
        let wide = self
            .mean_difference
            .iter()
            .map(|m| m.half_width)
            .sum::<f64>();
        let mut text = String::from("\nwould show    ");
        if bright > 0.0 {
            text += &format!(
                "a difference of the mean by {:.2} %, or ",
                200.0 * wide / bright
            );
        }
        text += &format!(
            "of one tile by about {:.0} % of the mean",
            100.0 * sigmas * self.tile_error
        );
        text
    }

    /// For each pixel the z of its tile: the difference in standard errors, as if normal, of the
    /// channel that differs most; positive where the first picture is brighter.
    pub fn map(&self) -> ErrorMap {
        let side = self.tile.max(1);
        let at = |i: u32| {
            let (x, y) = (i % self.width, i / self.width);
            self.z[(y / side * self.columns + x / side) as usize]
        };
        ErrorMap {
            width: self.width,
            height: self.height,
            values: (0..self.width * self.height).map(at).collect(),
        }
    }

    /// [`Self::map`] in colours: red where the first picture is brighter, blue where it is darker,
    /// and the full colour where a tile differs by itself.
    pub fn picture(&self) -> DisplayImage {
        let threshold = -normal_quantile(0.5 * self.tile_level) as f32;
        self.map().false_colour(Scale::Diverging(threshold))
    }
}

fn verdict(question: &Question) -> String {
    let p = scientific(question.p_value);
    if question.passed {
        p
    } else {
        format!("{p} — DIFFERENT")
    }
}

/// A probability, short.
fn scientific(p: f64) -> String {
    if p >= 0.001 {
        format!("{p:.3}")
    } else {
        format!("{p:.1e}")
    }
}
