//! Sums: a mean does not drift with the number of samples, whatever they are.

mod half;
mod partition;

use crate::{Effort, Kernels, Point, Sweep};
use sr_pipeline::glam::Vec3;

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    vec![
        equal_samples::<K>(effort),
        outlier::<K>(),
        half::half_precision(),
        partition::threads(),
        partition::passes(),
    ]
}

/// The film adds in `f64` and gives the mean in `f32`: half an ulp, 2⁻²⁴ of the value, is all that may be
/// lost there. The sum of n equal samples in blocks of 64 errs by at most (64 + n/64) 2⁻⁵³, less than 2·10⁻⁹ up to
/// n = 10⁹, which the second term covers.
const MEAN_BOUND: f64 = 0.5 * f32::EPSILON as f64 + 2e-9;

/// 0.1 and 1/3 have no finite binary expansion and 0.7 rounds the other way; a sum in `f32` stops growing at 2²⁴
/// times its terms.
const VALUE: Vec3 = Vec3::new(0.1, 1.0 / 3.0, 0.7);

fn equal_samples<K: Kernels>(effort: &Effort) -> Sweep {
    let most = effort.choose(8, 9);
    let points = (0..=most).map(|k| {
        let n = 10u64.pow(k);
        let mean = K::film_mean(n, |_| VALUE);
        Point::new(n as f64, relative(mean, VALUE), format!("mean {mean}"))
    });
    Sweep {
        name: "equal_samples".into(),
        about: "The mean of n equal samples is the sample.".into(),
        parameter: "samples".into(),
        error: "relative error of the mean".into(),
        bound: MEAN_BOUND,
        holds: [1.0, 1e9],
        points: points.collect(),
    }
}

/// One bright sample among dark ones, as a caustic brings it: nothing of it may be cut off or lost.
fn outlier<K: Kernels>() -> Sweep {
    const SAMPLES: u64 = 4096;
    let points = (-30..=30).step_by(6).map(|k| {
        let bright = 10f32.powi(k);
        let mean = K::film_mean(SAMPLES, |i| match i {
            1234 => Vec3::splat(bright),
            _ => Vec3::ZERO,
        });
        let truth = Vec3::splat(bright) / SAMPLES as f32;
        Point::new(
            f64::from(bright),
            relative(mean, truth),
            format!("mean {mean}"),
        )
    });
    Sweep {
        name: "outlier".into(),
        about: "The mean of one bright sample among 4095 black ones is 1/4096 of it.".into(),
        parameter: "brightness".into(),
        error: "relative error of the mean".into(),
        bound: MEAN_BOUND,
        holds: [1e-30, 1e30],
        points: points.collect(),
    }
}

/// The largest of the three relative errors.
fn relative(a: Vec3, truth: Vec3) -> f64 {
    let (a, truth) = (a.as_dvec3(), truth.as_dvec3());
    ((a - truth) / truth).abs().max_element()
}
