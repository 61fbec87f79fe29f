//! Adaptive sampling: when it is decided, and by which criterion. What is decided, and why it leaves
//! the picture unbiased, is in [`sr_render::film::adaptive`].

use crate::film::FilmResource;
use crate::pass::PassSpec;
use bevy_ecs::prelude::*;
use rayon::prelude::*;
use sr_render::film::{Criterion, VarianceEstimator};
use sr_scene::bevy_ecs;
use sr_scene::settings::{AdaptiveRule, AdaptiveSettings};
use sr_stats::{normal_quantile, student_quantile};

/// Each look is one more chance to stop by luck, so looks become rarer: the next one comes after
/// this part of the samples so far, if that is more than a batch. At worst a pixel gets that much
/// more than it needs.
const LOOKS_PER_SAMPLES: u64 = 8;

/// The sample counts at which it is decided: multiples of a batch, known beforehand, so that neither
/// the samples nor the passes they came in have a say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DecisionPoints {
    rule: AdaptiveRule,
    batch: u64,
    min_samples: u64,
}

impl DecisionPoints {
    /// `None` while adaptive sampling is off.
    pub fn new(settings: &AdaptiveSettings) -> Option<Self> {
        settings.is_on().then(|| Self {
            rule: settings.rule,
            batch: u64::from(settings.batch.max(1)),
            min_samples: u64::from(settings.min_samples),
        })
    }

    /// The first one above `samples`.
    pub fn after(&self, samples: u64) -> u64 {
        let batch = self.batch;
        if self.rule == AdaptiveRule::Course {
            return (samples / batch + 1).saturating_mul(batch);
        }
        let mut point = self.min_samples.max(1).next_multiple_of(batch);
        while point <= samples {
            let step = (point / LOOKS_PER_SAMPLES / batch).max(1) * batch;
            point = point.saturating_add(step);
        }
        point
    }

    fn contains(&self, samples: u64) -> bool {
        samples > 0 && self.after(samples - 1) == samples
    }
}

/// Run condition: pixels may get different numbers of samples.
pub(crate) fn is_adaptive(settings: Res<'_, AdaptiveSettings>) -> bool {
    settings.is_on()
}

/// Decides which pixels go on, when the pass ends at a point of decision.
pub(crate) fn decide(
    settings: Res<'_, AdaptiveSettings>,
    pass: Res<'_, PassSpec>,
    mut film: ResMut<'_, FilmResource>,
) {
    let due = DecisionPoints::new(&settings).is_some_and(|p| p.contains(pass.indices().end));
    if !due {
        return;
    }
    let estimator = film.estimator;
    let p = 0.5 + 0.5 * settings.confidence;
    let student = move |freedom| student_quantile(p, freedom);
    let normal = move |_| normal_quantile(p);
    let criterion = match settings.rule {
        // 1.96 σ/√n ≤ tolerance · μ, at 95 %.
        AdaptiveRule::Course => Criterion {
            tolerance: settings.tolerance,
            floor: 0.0,
            estimator: VarianceEstimator::Samples,
            quantile: &normal,
        },
        AdaptiveRule::Folds | AdaptiveRule::Off => Criterion {
            tolerance: settings.tolerance,
            floor: settings.floor,
            estimator,
            quantile: &student,
        },
    };
    let tiles = film.film.tiles_mut().par_iter_mut();
    tiles.for_each(|tile| tile.decide(&criterion));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(rule: AdaptiveRule, batch: u32, min_samples: u32, up_to: u64) -> Vec<u64> {
        let points = DecisionPoints::new(&AdaptiveSettings {
            rule,
            batch,
            min_samples,
            ..Default::default()
        });
        let points = points.expect("it is on");
        (1..=up_to).filter(|n| points.contains(*n)).collect()
    }

    #[test]
    fn decisions_fall_on_batches_and_become_rarer() {
        let course = points(AdaptiveRule::Course, 32, 64, 200);
        assert_eq!(course, [32, 64, 96, 128, 160, 192]);
        let folds = points(AdaptiveRule::Folds, 32, 65, 800);
        let expected = [
            96, 128, 160, 192, 224, 256, 288, 320, 352, 384, 416, 448, 480, 512, 576, 640, 704, 768,
        ];
        assert_eq!(folds, expected);
        assert_eq!(points(AdaptiveRule::Folds, 1, 0, 10).len(), 10);
        assert!(DecisionPoints::new(&AdaptiveSettings::default()).is_none());
    }

    #[test]
    fn the_next_decision_is_ahead_whatever_the_count() {
        for rule in [AdaptiveRule::Folds, AdaptiveRule::Course] {
            let points = DecisionPoints::new(&AdaptiveSettings {
                rule,
                ..Default::default()
            });
            let points = points.expect("it is on");
            for samples in [0, 1, 63, 64, 1 << 20, (1 << 40) + 1] {
                let next = points.after(samples);
                assert!(next > samples && points.contains(next), "{samples}: {next}");
            }
        }
    }
}
