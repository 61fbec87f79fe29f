//! What a pass is, how a render ends, and what is told of it on the way.

use bevy_ecs::prelude::*;
use sr_render::film::ErrorEstimate;
use sr_scene::bevy_ecs;
use sr_scene::settings::{AdaptiveSettings, Budget};

/// The samples of one pass: the same indices in every pixel that is
/// [active](sr_render::film::FilmTile::active_pixels).
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassSpec {
    /// Index of the first sample.
    pub first_sample: u64,
    /// How many samples a pixel gets.
    pub samples: u32,
}

/// Why rendering ended.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// All samples are taken.
    Samples,
    /// The next pass would not fit into the time.
    Seconds,
    /// The estimated error is below its target.
    TargetError,
    /// Adaptive sampling has finished every pixel.
    Converged,
    /// The front end asked for it.
    Asked,
}

impl StopReason {
    /// For messages.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Samples => "all samples taken",
            Self::Seconds => "time is up",
            Self::TargetError => "target error reached",
            Self::Converged => "every pixel reached the tolerance",
            Self::Asked => "stopped",
        }
    }
}

/// Where rendering is, told after each pass.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Samples a pixel so far; the most that any has when sampling is adaptive.
    pub samples: u64,
    /// Samples a pixel so far, on average.
    pub mean_samples: f64,
    /// Share of the pixels that go on.
    pub active: f64,
    /// Seconds of integration so far.
    pub seconds: f64,
    /// Share of the budget that is used up, 0 to 1.
    pub fraction: f64,
    /// What is nearest to its end: the part of the budget that `fraction` is of.
    pub ends_by: Option<StopReason>,
    /// Estimated error, at log points.
    pub error: Option<ErrorEstimate>,
    /// A smaller error, and how far away it is; unset before the first estimate.
    pub target: Option<TimeToError>,
}

/// How long it will take to reach an error.
///
/// By error ∝ 1/samples, which independent samples keep, and by the speed of the last passes. Under
/// low-discrepancy samplers the error falls faster, so that this is rather too long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeToError {
    /// The budget's target, or else the next power of ten below the error of now.
    pub relmse: f64,
    /// Seconds of integration from now on.
    pub seconds: f64,
}

/// Samples a pixel when a budget says nothing at all.
pub const DEFAULT_SAMPLES: u64 = 64;

/// Most samples a pixel when sampling is adaptive and a budget says nothing at all.
pub const DEFAULT_ADAPTIVE_SAMPLES: u64 = 1024;

/// Samples a pixel, at most, of a render with these settings; `None` when only time or the error ends
/// it.
pub fn most_samples(budget: &Budget, adaptive: &AdaptiveSettings) -> Option<u64> {
    if budget.samples.is_some() || budget.seconds.is_some() || budget.target_error.is_some() {
        return budget.samples;
    }
    Some(if adaptive.is_on() {
        DEFAULT_ADAPTIVE_SAMPLES
    } else {
        DEFAULT_SAMPLES
    })
}
