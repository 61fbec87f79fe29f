//! Whether pictures differ by more than noise: from the reference, and from one another.

use super::Interval;
use crate::folder::Folder;
use crate::metrics::mse;
use crate::plan::Plan;
use crate::reference::{Reference, variance_of};
use crate::run::Outcome;
use crate::same::{Answer, Evidence, Settings, Side, Verdict, same};
use crate::stats::{efficiency, mean_variance};
use glam::Vec3;
use serde::Serialize;
use sr_film::{Image, RELMSE_OFFSET, read_image, write_png};
use sr_stats::{family_p_value, sidak};

/// Probability that anything in a group is called different by chance.
const FALSE_ALARM: f64 = 0.01;

/// A contender against the reference.
#[derive(Clone, Debug, Serialize)]
pub struct Bias {
    /// Whether its expected picture is the reference's.
    pub answer: Answer,
    /// Probability of what was found, or worse, without bias.
    pub p_value: f64,
    /// Part of a picture's MSE that is squared bias; about 0, also below, without bias.
    pub share: Option<f64>,
    /// How much brighter than the reference it is, as a fraction of it.
    pub brightness: f64,
    /// Half the width of the 95 % interval of that.
    pub brightness_half_width: f64,
    /// A picture of where, relative to the folder.
    pub map: Option<String>,
    /// In words.
    pub text: String,
}

/// Two contenders.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// One, by number.
    pub a: usize,
    /// The other.
    pub b: usize,
    /// Whether their expected pictures are the same.
    pub answer: Answer,
    /// Probability of what was found, or worse, if they are not.
    pub p_value: f64,
    /// A picture of where, relative to the folder.
    pub map: Option<String>,
    /// In words.
    pub text: String,
}

/// All seeds of a point.
pub(super) struct Pictures {
    seeds: Vec<Image>,
    mean: Image,
    /// Of the mean; `None` when it is not known of all.
    variance: Option<Image>,
    /// The mean variance of each, relative to what they should be as in relMSE.
    relative: Vec<f64>,
}

impl Pictures {
    /// Reads them back: they may be many, and are in memory one point at a time but for their means.
    pub fn read(
        plan: &Plan,
        outcome: &Outcome,
        point: usize,
        folder: &Folder,
    ) -> Result<Self, String> {
        let truth = outcome.reference(point).map(|r| &r.image);
        let done = outcome.done.iter();
        let of_point = done.filter(|d| plan.runs[d.run].point == point);
        let paths: Vec<_> = of_point
            .map(|d| folder.run(&plan.runs[d.run].id, ".exr"))
            .collect();
        let seeds: Result<Vec<Image>, _> = paths.iter().map(read_image).collect();
        let mut seeds = seeds.map_err(|e| e.to_string())?;
        let variances: Option<Vec<Image>> = paths.iter().map(|p| variance_of(p)).collect();
        let mean = average(&seeds, seeds.len()).ok_or("there is no picture")?;
        let truth = truth.unwrap_or(&mean);
        let relative = variances.iter().flatten().map(|v| relative(v, truth));
        let relative = relative.collect();
        let variance = variances.and_then(|v| average(&v, v.len() * v.len()));
        let known = |v: &Image| mean_variance(v).is_some();
        let variance = variance.filter(known);
        if variance.is_some() {
            // They have said what they have to say.
            seeds = Vec::new();
        }
        Ok(Self {
            seeds,
            mean,
            variance,
            relative,
        })
    }

    fn evidence(&self) -> Evidence<'_> {
        match &self.variance {
            Some(variance) => Evidence::Variance(Side {
                image: &self.mean,
                variance_of_mean: variance,
            }),
            None => Evidence::Seeds(&self.seeds),
        }
    }

    /// 1 / (variance · seconds), with the seconds of each.
    pub fn efficiency(&self, seconds: &[f64]) -> Option<Interval> {
        let runs = self.relative.iter().copied().zip(seconds.iter().copied());
        efficiency(&runs.collect::<Vec<_>>()).ok().map(Into::into)
    }

    /// Against the reference, as one of `questions` that share a false-alarm rate.
    pub fn bias(
        &self,
        reference: &Reference,
        questions: usize,
        error: Option<f64>,
        map: Map<'_>,
    ) -> Result<Bias, String> {
        let variance = reference.variance.as_ref();
        let variance = variance.ok_or("the reference's own noise is not known")?;
        let truth = Evidence::Variance(Side {
            image: &reference.image,
            variance_of_mean: variance,
        });
        let verdict = ask(self.evidence(), truth, questions)?;
        let own = mean_variance(variance);
        let noise = self.variance.as_ref().and_then(mean_variance);
        let squared = mse(&self.mean, &reference.image).map_err(|e| e.to_string())?;
        let share = |error: f64| Some((squared - own? - noise?) / error);
        let [difference, half_width, light] = brightness(&verdict);
        Ok(Bias {
            answer: verdict.answer,
            p_value: p_value(&verdict),
            share: error.and_then(share),
            brightness: difference / light,
            brightness_half_width: half_width / light,
            map: map.write(&verdict),
            text: verdict.describe(),
        })
    }

    /// Against another contender.
    pub fn pair(
        &self,
        other: &Self,
        [a, b]: [usize; 2],
        questions: usize,
        map: Map<'_>,
    ) -> Result<Pair, String> {
        let verdict = ask(self.evidence(), other.evidence(), questions)?;
        Ok(Pair {
            a,
            b,
            answer: verdict.answer,
            p_value: p_value(&verdict),
            map: map.write(&verdict),
            text: verdict.describe(),
        })
    }
}

/// Mean of variance / (truth² + [`RELMSE_OFFSET`]): the relMSE of an unbiased picture.
fn relative(variance: &Image, truth: &Image) -> f64 {
    let both = variance.pixels.iter().zip(&truth.pixels);
    let pixel = both.map(|(v, r)| {
        let (v, r) = (v.as_dvec3(), r.as_dvec3());
        (v / (r * r + RELMSE_OFFSET)).element_sum()
    });
    pixel.sum::<f64>() / (3.0 * truth.pixels.len() as f64)
}

fn ask(a: Evidence<'_>, b: Evidence<'_>, questions: usize) -> Result<Verdict, String> {
    let settings = Settings {
        false_alarm: sidak(FALSE_ALARM, questions),
        ..Settings::default()
    };
    same(a, b, &settings).map_err(|e| e.to_string())
}

/// Of all three questions together.
fn p_value(verdict: &Verdict) -> f64 {
    let all = [&verdict.tiles, &verdict.distribution, &verdict.mean];
    let smallest = all.into_iter().map(|q| q.p_value).fold(1.0, f64::min);
    family_p_value(smallest, all.len())
}

/// Difference, half its width, and what it is a difference of, summed over the channels.
fn brightness(verdict: &Verdict) -> [f64; 3] {
    let channels = verdict.mean_difference.iter();
    channels.fold([0.0; 3], |[d, h, l], m| {
        [d + m.difference, h + m.half_width, l + m.b]
    })
}

/// Where a map of differences goes.
pub(super) struct Map<'a> {
    pub folder: &'a Folder,
    pub name: String,
}

impl Map<'_> {
    /// Of what differs, or may, alone. A map that cannot be written is missing; no figure is.
    fn write(&self, verdict: &Verdict) -> Option<String> {
        if verdict.answer == Answer::Same {
            return None;
        }
        let path = self.folder.difference(&self.name).ok()?;
        write_png(&path, &verdict.picture()).ok()?;
        Some(self.folder.relative(&path))
    }
}

/// Sum over pictures, divided; `None` without pictures or with ones of different size.
fn average(images: &[Image], divisor: usize) -> Option<Image> {
    let first = images.first()?;
    let size = |i: &Image| (i.width, i.height);
    if images.iter().any(|i| size(i) != size(first)) {
        return None;
    }
    let pixel = |at: usize| {
        let sum: glam::DVec3 = images.iter().map(|i| i.pixels[at].as_dvec3()).sum();
        (sum / divisor as f64).as_vec3()
    };
    Some(Image {
        width: first.width,
        height: first.height,
        pixels: (0..first.pixels.len()).map(pixel).collect::<Vec<Vec3>>(),
    })
}
