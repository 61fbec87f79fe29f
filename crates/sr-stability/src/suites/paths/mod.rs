//! Paths: however long they are, what they bring is what it should be. The pictures of the suite are experiments
//! in `configs/stability/paths`.

mod glass;

use crate::{Effort, Kernels, Point, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    vec![mis_weights::<K>(), glass::shells(effort)]
}

/// Densities from subnormal to nearly infinite, against others of any size.
fn mis_weights<K: Kernels>() -> Sweep {
    let decades = || (-44..=38).map(|k| 10f32.powi(k));
    let points = decades().map(|a| {
        let of_pair = |b: f32| {
            let sum = f64::from(K::mis_weight(a, b)) + f64::from(K::mis_weight(b, a));
            ((sum - 1.0).abs(), b)
        };
        let pairs = decades().map(of_pair);
        let (error, b) = pairs.fold((0.0, a), |worst, pair| {
            // NaN counts as the worst.
            if pair.0 <= worst.0 { worst } else { pair }
        });
        Point::new(a.into(), error, format!("against a density of {b:e}"))
    });
    Sweep {
        name: "mis_weights".into(),
        about: "The weights of two techniques with densities a and b sum to 1.".into(),
        parameter: "density".into(),
        error: "distance of the sum from 1".into(),
        // Each weight takes four roundings and is at most 1.
        bound: 4.0 * f64::from(f32::EPSILON),
        holds: [1e-44, 1e38],
        points: points.collect(),
    }
}
