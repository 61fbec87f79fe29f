//! What an examination finds. docs/health.md is the contract of its JSON.

use super::route::Kind;
use crate::oracle::Oracle;
use serde::Serialize;
use sr_experiment::ErrorMap;

/// How bad something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// As it should be.
    Ok,
    /// Worth a look: the picture is right in the mean, but noisy or cut short.
    Look,
    /// Wrong.
    Broken,
}

/// The health of the estimator on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Health {
    /// By name.
    pub integrator: String,
    /// Of its random numbers.
    pub seed: u64,
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// How many pixels were looked at.
    pub pixels: u64,
    /// Distance of neighbours among them: 1 when it was all.
    pub step: u32,
    /// Samples a pixel.
    pub samples: u64,
    /// Mean luminance of those that were not refused.
    pub mean: f64,
    /// Samples that the film refuses.
    pub rejected: Rejected,
    /// The brightest samples.
    pub brightest: Brightest,
    /// How uneven the samples of pixels are.
    pub kurtosis: Kurtosis,
    /// What became of paths, where the integrator tells.
    pub paths: Option<Paths>,
    /// The same paths in `f64`, where that was asked for and can be done.
    pub oracle: Option<Oracle>,
    /// What could not be found out, and why.
    pub left_out: Vec<String>,
    /// What all this says.
    pub findings: Vec<Finding>,
    /// How long it took.
    pub seconds: f64,
    /// Kurtosis of each pixel; NaN where its samples are equal.
    #[serde(skip)]
    pub map: ErrorMap,
}

/// Samples that the film refuses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rejected {
    /// How many.
    pub count: u64,
    /// By cause, bounces and material, the most frequent first.
    pub kinds: Vec<RejectedKind>,
}

/// Rejected samples that have cause, bounces and material in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RejectedKind {
    /// How many.
    pub count: u64,
    /// Why.
    pub cause: String,
    /// Bounces of the path.
    pub bounces: u32,
    /// Material of its last surface.
    pub material: Option<String>,
    /// What went wrong first in the example, and after which vertex (0: the camera).
    pub first_defect: Option<FirstDefect>,
    /// An example, `x,y,sample`.
    pub example: String,
    /// The command that replays it.
    pub replay: Option<String>,
}

/// What went wrong first in a sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FirstDefect {
    /// What.
    pub what: String,
    /// The last surface before, counted from 1.
    pub vertex: usize,
}

/// The brightest of all samples: one of 10,000.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Brightest {
    /// How many those are.
    pub count: u64,
    /// Their part of all light.
    pub light: f64,
    /// What they have more than the other samples of their pixels, as part of all light.
    pub excess: f64,
    /// The very brightest.
    pub worst: Vec<BrightSample>,
}

/// One bright sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BrightSample {
    /// Its luminance.
    pub luminance: f64,
    /// Its part of its pixel's light.
    pub of_pixel: f64,
    /// What kind of light is brightest in it.
    pub kind: Option<Kind>,
    /// The material that matters most on the way.
    pub material: Option<String>,
    /// The way of that light.
    pub route: Option<String>,
    /// `x,y,sample`.
    pub example: String,
    /// The command that replays it.
    pub replay: Option<String>,
}

/// Kurtosis of the samples of pixels: 3 for normal noise, about the number of samples where one is unlike the
/// others. Pixels without noise have none.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Kurtosis {
    /// Pixels with noise.
    pub pixels: u64,
    /// The middle one.
    pub median: Option<f64>,
    /// What one of a hundred exceeds.
    pub percentile_99: Option<f64>,
    /// The largest.
    pub max: Option<f64>,
    /// Part of the noisy pixels whose noise is that of one sample: a kurtosis above half the number of
    /// samples.
    pub by_one_sample: f64,
    /// The most uneven pixels.
    pub worst: Vec<UnevenPixel>,
}

/// One pixel's kurtosis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnevenPixel {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Of its samples.
    pub kurtosis: f64,
    /// Its mean luminance.
    pub mean: f64,
}

/// What became of paths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Paths {
    /// How many set out.
    pub count: u64,
    /// By why they ended.
    pub ends: Vec<Ended>,
    /// The limit of bounces, where it is a setting and paths met it.
    pub max_depth: Option<u32>,
    /// Light beyond that limit, as part of all, if the light of the last bounces goes on as a geometric
    /// series. Unset where they say nothing.
    pub missing: Option<f64>,
    /// Light by bounces between camera and light.
    pub light: Vec<BounceLight>,
}

/// Paths, or branches of paths, that ended in one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ended {
    /// Why.
    pub why: &'static str,
    /// The same in words.
    pub text: &'static str,
    /// How many.
    pub count: u64,
    /// Part of all ends.
    pub share: f64,
    /// Mean throughput that they had still, shared out among all paths, each of which sets out with 1.
    pub throughput: f64,
    /// Mean number of bounces.
    pub mean_bounces: f64,
}

/// Light after so many bounces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BounceLight {
    /// 0 is light that the camera sees.
    pub bounces: usize,
    /// Part of all light.
    pub share: f64,
}

/// Something that the figures say.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// What it is about.
    pub name: &'static str,
    /// How bad it is.
    pub condition: Condition,
    /// In a sentence.
    pub text: String,
    /// What to do about it.
    pub advice: Option<String>,
}

impl Health {
    /// The worst of the findings.
    pub fn condition(&self) -> Condition {
        let all = self.findings.iter().map(|f| f.condition);
        all.max().unwrap_or(Condition::Ok)
    }
}
