//! Passes: which samples come next, and when to stop.

use crate::adapt::DecisionPoints;
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
    /// Estimated error, at log points.
    pub error: Option<ErrorEstimate>,
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

/// Passes are sized to take about this long, so that progress shows and time budgets are met.
const PASS_SECONDS: f64 = 0.5;

/// Most samples a pixel in one pass: between two passes a render can be stopped.
const MAX_PASS_SAMPLES: u64 = 64;

/// The state of the pass loop.
pub(crate) struct PassPlanner {
    budget: Budget,
    decisions: Option<DecisionPoints>,
    samples: u64,
    /// Share of the pixels that the next pass samples.
    active: f64,
    seconds: f64,
    /// Seconds of the last pass, by sample.
    sample_seconds: Option<f64>,
}

impl PassPlanner {
    pub fn new(budget: &Budget, adaptive: &AdaptiveSettings) -> Self {
        Self {
            budget: Budget {
                samples: most_samples(budget, adaptive),
                ..budget.clone()
            },
            decisions: DecisionPoints::new(adaptive),
            samples: 0,
            active: 1.0,
            seconds: 0.0,
            sample_seconds: None,
        }
    }

    /// The next pass, or why there is none.
    pub fn next(&self) -> Result<PassSpec, StopReason> {
        let mut samples = match self.sample_seconds {
            // The first pass tells how long a sample takes. Only a plain number of samples needs
            // no such knowledge.
            None if self.budget.pass_samples.is_none() || self.is_open_ended() => 2,
            None => MAX_PASS_SAMPLES,
            Some(s) => {
                let fits = (PASS_SECONDS / s.max(f64::MIN_POSITIVE)) as u64;
                let grown = self.max_pass().min(2 * self.samples.max(1));
                fits.clamp(1, grown)
            }
        };
        if let Some(limit) = self.budget.pass_samples {
            let limit = u64::from(limit.max(1)).min(MAX_PASS_SAMPLES);
            samples = if self.is_open_ended() {
                samples.min(limit)
            } else {
                limit
            };
        }
        // Log points are the powers of two, whatever the clock says: two renders of the same have
        // theirs at the same counts.
        samples = samples.min((self.samples + 1).next_power_of_two().max(2) - self.samples);
        if let Some(total) = self.budget.samples {
            let left = total.saturating_sub(self.samples);
            if left == 0 {
                return Err(StopReason::Samples);
            }
            samples = samples.min(left);
        }
        if let (Some(limit), Some(s)) = (self.budget.seconds, self.sample_seconds) {
            let fits = ((limit - self.seconds) / s.max(f64::MIN_POSITIVE)) as u64;
            if fits == 0 {
                return Err(StopReason::Seconds);
            }
            samples = samples.min(fits);
        }
        if let Some(decisions) = &self.decisions {
            samples = samples.min(decisions.after(self.samples) - self.samples);
        }
        Ok(PassSpec {
            first_sample: self.samples,
            samples: samples.min(u64::from(u32::MAX)) as u32,
        })
    }

    /// Few pixels take more samples each: a pass is as long, and its waves are as full.
    fn max_pass(&self) -> u64 {
        const MOST: f64 = 4096.0;
        (MAX_PASS_SAMPLES as f64 / self.active).min(MOST) as u64
    }

    /// Time or error may end the render between any two passes.
    fn is_open_ended(&self) -> bool {
        self.budget.seconds.is_some() || self.budget.target_error.is_some()
    }

    /// A pass is done, after which a share of `active` of the pixels goes on.
    pub fn done(&mut self, pass: PassSpec, seconds: f64, active: f64) {
        self.samples += u64::from(pass.samples);
        self.seconds += seconds;
        self.sample_seconds = Some(seconds / f64::from(pass.samples));
        self.active = active;
    }

    /// No pixel wants more samples.
    pub fn is_converged(&self) -> bool {
        self.active == 0.0
    }

    /// Share of the pixels that go on.
    pub fn active(&self) -> f64 {
        self.active
    }

    /// Samples a pixel so far.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// The film is worth a look: each doubling of the samples, and every pass when the error
    /// decides.
    pub fn at_log_point(&self, pass: PassSpec) -> bool {
        self.budget.target_error.is_some()
            || pass.first_sample.max(1).ilog2() < self.samples.max(1).ilog2()
    }

    /// The error is good enough. An estimate from very few samples is not trusted.
    pub fn reached(&self, estimate: &ErrorEstimate) -> bool {
        const FEWEST: u64 = 8;
        let target = self.budget.target_error;
        self.samples >= FEWEST && target.is_some_and(|t| estimate.relmse <= t)
    }

    /// Share of the budget used up, by whichever part of it ends first.
    pub fn fraction(&self, error: Option<&ErrorEstimate>) -> f64 {
        let samples = self
            .budget
            .samples
            .map(|n| 1.0 - self.active * (1.0 - self.samples as f64 / n.max(1) as f64));
        let seconds = self.budget.seconds.map(|s| self.seconds / s);
        // Error falls as 1/samples, so its share of the way is target over error.
        let error = self
            .budget
            .target_error
            .zip(error)
            .map(|(t, e)| t / e.relmse.max(f64::MIN_POSITIVE));
        [samples, seconds, error]
            .into_iter()
            .flatten()
            .fold(0.0, f64::max)
            .clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(budget: Budget, sample_seconds: f64) -> (u64, f64, StopReason) {
        let mut planner = PassPlanner::new(&budget, &AdaptiveSettings::default());
        loop {
            match planner.next() {
                Ok(pass) => {
                    assert_eq!(pass.first_sample, planner.samples());
                    planner.done(pass, sample_seconds * f64::from(pass.samples), 1.0);
                }
                Err(reason) => return (planner.samples(), planner.seconds, reason),
            }
        }
    }

    #[test]
    fn a_sample_budget_is_met_exactly() {
        for samples in [1, 2, 7, 64, 1000] {
            let budget = Budget {
                samples: Some(samples),
                ..Default::default()
            };
            assert_eq!(run(budget, 0.01).0, samples);
        }
        assert_eq!(run(Budget::default(), 0.01).0, DEFAULT_SAMPLES);
    }

    #[test]
    fn a_time_budget_is_not_overrun_when_samples_cost_the_same() {
        for sample_seconds in [0.001, 0.07, 0.4] {
            let budget = Budget {
                seconds: Some(3.0),
                ..Default::default()
            };
            let (_, seconds, reason) = run(budget, sample_seconds);
            assert_eq!(reason, StopReason::Seconds);
            // Never over by more than rounding, never short by a whole sample.
            assert!(seconds <= 3.0 + 1e-9 && seconds > 3.0 - sample_seconds - 1e-9);
        }
    }

    #[test]
    fn a_pass_size_neither_changes_the_samples_nor_outlasts_the_time() {
        let budget = Budget {
            samples: Some(100),
            pass_samples: Some(7),
            ..Default::default()
        };
        assert_eq!(run(budget, 0.01).0, 100);
        let budget = Budget {
            seconds: Some(1.0),
            pass_samples: Some(u32::MAX),
            ..Default::default()
        };
        assert!(run(budget, 0.1).1 <= 1.0 + 1e-9);
    }

    #[test]
    fn whichever_part_of_the_budget_is_first_ends_it() {
        let budget = Budget {
            samples: Some(10),
            seconds: Some(1000.0),
            ..Default::default()
        };
        assert_eq!(run(budget, 0.1).2, StopReason::Samples);
    }
}
