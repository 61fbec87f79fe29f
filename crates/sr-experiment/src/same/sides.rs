//! What is known of one method: the means of its tiles, and how well.

use super::Settings;
use sr_film::Image;
use sr_stats::MeanEstimate;
use std::fmt;

/// A picture and the variance of its mean, per pixel and channel, as in our EXR files.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a> {
    /// The picture.
    pub image: &'a Image,
    /// Its variance.
    pub variance_of_mean: &'a Image,
}

/// Why two methods cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SameError {
    /// It takes two pictures of a method to know its noise.
    TooFewPictures(usize),
    /// Pictures differ in size.
    SizesDiffer {
        /// One size.
        a: (u32, u32),
        /// Another.
        b: (u32, u32),
    },
    /// Pixels are not finite.
    NotFinite {
        /// How many.
        count: u64,
        /// The first of them.
        first: (u32, u32),
    },
    /// The variance of pixels is not known.
    UnknownVariance {
        /// How many.
        count: u64,
        /// The first of them.
        first: (u32, u32),
    },
    /// The pictures have no pixels.
    Empty,
}

impl fmt::Display for SameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewPictures(n) => write!(
                f,
                "{n} pictures of a method do not tell its noise: it takes two with different seeds"
            ),
            Self::SizesDiffer { a, b } => {
                let ((aw, ah), (bw, bh)) = (a, b);
                write!(
                    f,
                    "one picture has {aw} × {ah} pixels, the other {bw} × {bh}"
                )
            }
            Self::NotFinite { count, first } => write!(
                f,
                "{count} pixels are not finite, the first at ({}, {}): no test can judge them",
                first.0, first.1
            ),
            Self::UnknownVariance { count, first } => write!(
                f,
                "the variance of {count} pixels is not known, the first at ({}, {}): it takes two \
                 samples (and with replicas one in each of two)",
                first.0, first.1
            ),
            Self::Empty => f.write_str("the pictures have no pixels"),
        }
    }
}

impl std::error::Error for SameError {}

/// One tile of one method.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tile {
    /// Its mean, by channel.
    pub mean: [MeanEstimate; 3],
    /// Whether few pixels, or one seed, make up its noise, by channel.
    pub heavy: [bool; 3],
}

/// What the test needs to know of one method.
pub(super) struct Known {
    pub size: (u32, u32),
    /// Row-major.
    pub tiles: Vec<Tile>,
    pub columns: u32,
    pub whole: Tile,
    /// Relative error of a pixel by rounding.
    pub rounding: f64,
    /// Whether a tile must not trust its own variance alone.
    pub guarded: bool,
}

/// Degrees of freedom of a pixel's variance that are counted on: those of two replicas. More
/// would change the quantiles of a tile's t by less than 1 %.
const PIXEL_DOF: f64 = 1.0;

/// A tile of one picture has heavy tails if its noise is as if of fewer pixels than this part of
/// them, three of 64; even ones have a third, since their variances are estimates.
const FEW_PIXELS: f64 = 0.05;

/// A tile of several has, if one seed makes up more than this part of the squares. Of six normal
/// values or more that happens to one tile in a thousand.
const ONE_SEED: f64 = 0.9;
const SEEDS_FOR_TAILS: usize = 6;

pub(super) fn from_seeds(images: &[Image], settings: &Settings) -> Result<Known, SameError> {
    let [first, _, ..] = images else {
        return Err(SameError::TooFewPictures(images.len()));
    };
    for image in images {
        check_size(image, first)?;
        check_finite(image)?;
    }
    let means: Vec<Vec<[f64; 3]>> = images.iter().map(|i| tile_means(i, settings)).collect();
    let tile = |at: usize| Tile::of_seeds(means.iter().map(|m| m[at]));
    let wholes = Settings {
        tile: u32::MAX,
        ..*settings
    };
    let whole: Vec<[f64; 3]> = images.iter().map(|i| tile_means(i, &wholes)[0]).collect();
    Ok(Known {
        size: (first.width, first.height),
        tiles: (0..means[0].len()).map(tile).collect(),
        columns: first.width.div_ceil(settings.tile),
        whole: Tile::of_seeds(whole.into_iter()),
        rounding: images.iter().map(rounding).fold(0.0, f64::max),
        guarded: false,
    })
}

pub(super) fn from_variance(side: &Side<'_>, settings: &Settings) -> Result<Known, SameError> {
    let (image, variance) = (side.image, side.variance_of_mean);
    check_size(variance, image)?;
    check_finite(image)?;
    let unknown = |p: &glam::Vec3| !(p.is_finite() && p.min_element() >= 0.0);
    if let Some((count, first)) = which(variance, unknown) {
        return Err(SameError::UnknownVariance { count, first });
    }
    let mut tiles = Vec::new();
    for_each_tile(image, settings.tile, |pixels| {
        tiles.push(Tile::of_pixels(image, variance, pixels));
    });
    Ok(Known {
        size: (image.width, image.height),
        tiles,
        columns: image.width.div_ceil(settings.tile),
        whole: Tile::of_pixels(
            image,
            variance,
            &(0..image.pixels.len()).collect::<Vec<_>>(),
        ),
        rounding: rounding(image),
        guarded: true,
    })
}

impl Tile {
    fn of_seeds(values: impl Iterator<Item = [f64; 3]> + Clone) -> Self {
        let mut tile = Self::default();
        for c in 0..3 {
            let mean = MeanEstimate::of(values.clone().map(|v| v[c]));
            let squares = values.clone().map(|v| (v[c] - mean.mean).powi(2));
            let (largest, sum) = squares.fold((0.0f64, 0.0), |(l, s), v| (l.max(v), s + v));
            let seeds = values.clone().count();
            tile.heavy[c] = seeds >= SEEDS_FOR_TAILS && largest > ONE_SEED * sum;
            tile.mean[c] = mean;
        }
        tile
    }

    /// The variance of a mean of independent pixels, with Satterthwaite's degrees of freedom. With
    /// ν of them for a pixel, v²·ν/(ν + 2) estimates the square of its true variance without bias,
    /// if its samples are normal.
    fn of_pixels(image: &Image, variance: &Image, pixels: &[usize]) -> Self {
        let n = pixels.len() as f64;
        let mut tile = Self::default();
        for c in 0..3 {
            let (mut sum, mut own, mut squares) = (0.0, 0.0, 0.0);
            for &i in pixels {
                let v = f64::from(variance.pixels[i][c]);
                sum += f64::from(image.pixels[i][c]);
                own += v;
                squares += v * v / (PIXEL_DOF + 2.0);
            }
            let dof = if own > 0.0 { own * own / squares } else { 1.0 };
            tile.heavy[c] = own > 0.0 && dof < (PIXEL_DOF + 2.0) * FEW_PIXELS * n;
            tile.mean[c] = MeanEstimate {
                mean: sum / n,
                variance: own / (n * n),
                dof,
            };
        }
        tile
    }
}

fn tile_means(image: &Image, settings: &Settings) -> Vec<[f64; 3]> {
    let mut means = Vec::new();
    for_each_tile(image, settings.tile, |pixels| {
        let sum = |c: usize| {
            pixels
                .iter()
                .map(|&i| f64::from(image.pixels[i][c]))
                .sum::<f64>()
        };
        means.push([0, 1, 2].map(|c| sum(c) / pixels.len() as f64));
    });
    means
}

/// Calls with the pixels of each tile, row by row.
fn for_each_tile(image: &Image, side: u32, mut call: impl FnMut(&[usize])) {
    let side = side.max(1) as usize;
    let (width, height) = (image.width as usize, image.height as usize);
    for y in (0..height).step_by(side) {
        for x in (0..width).step_by(side) {
            let rows = y..y.saturating_add(side).min(height);
            let columns = x..x.saturating_add(side).min(width);
            let pixels: Vec<usize> = rows
                .flat_map(|py| columns.clone().map(move |px| py * width + px))
                .collect();
            call(&pixels);
        }
    }
}

/// Half precision keeps 11 bits: a picture of which every number has so few was written in it. The
/// samples of others are `f32`, whose last operations round a few times.
fn rounding(image: &Image) -> f64 {
    let short = |v: f32| v.to_bits() & 0x1fff == 0;
    let half = |p: &glam::Vec3| short(p.x) && short(p.y) && short(p.z);
    if image.pixels.iter().all(half) {
        0.5f64.powi(11)
    } else {
        4.0 * 0.5f64.powi(24)
    }
}

fn check_size(a: &Image, b: &Image) -> Result<(), SameError> {
    if a.pixels.is_empty() || b.pixels.is_empty() {
        return Err(SameError::Empty);
    }
    let size = |i: &Image| (i.width, i.height);
    if size(a) != size(b) {
        return Err(SameError::SizesDiffer {
            a: size(a),
            b: size(b),
        });
    }
    Ok(())
}

fn check_finite(image: &Image) -> Result<(), SameError> {
    match which(image, |p| !p.is_finite()) {
        Some((count, first)) => Err(SameError::NotFinite { count, first }),
        None => Ok(()),
    }
}

/// How many pixels are bad, and the first of them.
fn which(image: &Image, bad: impl Fn(&glam::Vec3) -> bool) -> Option<(u64, (u32, u32))> {
    let mut found = image.pixels.iter().enumerate().filter(|(_, p)| bad(p));
    let first = found.next()?.0 as u32;
    let count = 1 + found.count() as u64;
    Some((count, (first % image.width, first / image.width)))
}
