//! Files of half precision: rounded to the nearest inside the format's range; saturated above and flushed
//! below it, and counted in both cases.

use crate::{Point, Sweep};
use sr_film::to_half;

/// Half precision has 11 significant bits for magnitudes from 2⁻¹⁴ up to 65504, and multiples of 2⁻²⁴ below.
const RANGE: [f64; 2] = [1.0 / 16384.0, 65504.0];

/// Values on both sides of every power of ten, and at the ends of the format.
fn values() -> Vec<f32> {
    let ends = [
        65504.0,
        65519.0,
        65520.0,
        1.0 / 16384.0,
        5.97e-8,
        2.99e-8,
        2.98e-8,
    ];
    let decades = (-10..=7).flat_map(|k| [1.0, 3.33].map(|m| m * 10f32.powi(k)));
    let mut all: Vec<f32> = ends.into_iter().chain(decades).collect();
    all.sort_by(f32::total_cmp);
    all
}

pub(super) fn half_precision() -> Sweep {
    let points = values().into_iter().map(|value| {
        let stored = to_half(value);
        let [wide, narrow] = [f64::from(value), f64::from(stored.value.to_f32())];
        let relative = ((narrow - wide) / wide).abs();
        // What is out of range and not said to be is wrong by any measure.
        let lost = wide > RANGE[1] || narrow == 0.0;
        let told = stored.saturated || stored.vanished;
        let error = if lost == told {
            relative
        } else {
            f64::INFINITY
        };
        Point::new(wide, error, format!("{value:e} is stored as {narrow:e}"))
    });
    Sweep {
        name: "half_precision".into(),
        about: "A value in a file of half precision is the nearest one; what is too large becomes 65504, what is too \
                small 0, and both are counted."
            .into(),
        parameter: "value".into(),
        error: "relative error in the file".into(),
        // 11 significant bits, rounded to nearest.
        bound: 1.0 / 2048.0,
        holds: RANGE,
        points: points.collect(),
    }
}
