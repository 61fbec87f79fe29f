//! Errors without the reference's own noise.
//!
//! A reference r that is independent of the picture x and unbiased has E(x − r)² = E(x − t)² + Var
//! r with t the truth: its variance is measured along, and can be subtracted. In relMSE the same is
//! done with the weights 1/(r² + 0.01) that the reference gives; that they are noisy too changes
//! the result by a relative O(Var r / (r² + 0.01)).

use super::pairs::{CompareError, channels, check_sizes, pairs, size};
use super::pointwise::{squared, squared_relative};
use glam::DVec3;
use serde::Serialize;
use sr_film::{Image, RELMSE_OFFSET};

/// Most that the reference's noise may make up of the error measured, 1/4. An error of d in the
/// noise, which is an estimate itself, becomes d/3 of the result at most.
pub const NOISE_LIMIT: f64 = 0.25;

/// What [`debiased`] finds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Debiased {
    /// [`mse`](crate::mse) less the reference's mean variance.
    pub mse: f64,
    /// [`relmse`](crate::relmse) less the reference's own.
    pub relmse: f64,
    /// Mean variance of the reference: its own MSE.
    pub reference_mse: f64,
    /// The same relative to r² + 0.01: its own relMSE.
    pub reference_relmse: f64,
}

/// MSE and relMSE against the truth, of which the reference is an estimate with the given
/// `variance` (of its mean, per pixel and channel, as in the `Variance` channels of our EXR files).
///
/// # Errors
/// As [`compare`](crate::compare); a variance of another size, or not known somewhere; a reference
/// whose noise is more than [`NOISE_LIMIT`] of either error.
pub fn debiased(
    image: &Image,
    reference: &Image,
    variance: &Image,
) -> Result<Debiased, CompareError> {
    check_sizes(image, reference)?;
    if size(variance) != size(reference) {
        return Err(CompareError::VarianceSizeDiffers {
            variance: size(variance),
            reference: size(reference),
        });
    }
    let (mut measured, mut own, mut unknown, mut n) = ([0.0; 2], [0.0; 2], 0, 0u64);
    for (i, x, r) in pairs(image, reference)? {
        let v = variance.pixels[i].as_dvec3();
        if !(v.is_finite() && v.min_element() >= 0.0) {
            unknown += 1;
            continue;
        }
        n += 1;
        measured[0] += channels(squared(x, r));
        measured[1] += channels(squared_relative(x, r));
        own[0] += channels(v);
        own[1] += channels(v / (r * r + DVec3::splat(RELMSE_OFFSET)));
    }
    if unknown > 0 {
        return Err(CompareError::UnknownVariance { pixels: unknown });
    }
    if n == 0 {
        return Err(CompareError::NothingToCompare);
    }
    for (m, o) in measured.iter().zip(&own) {
        // Nothing measured and no noise is a share of 0.
        let share = if *o == 0.0 { 0.0 } else { o / m };
        if share > NOISE_LIMIT {
            return Err(CompareError::NoisyReference { share });
        }
    }
    let n = n as f64;
    Ok(Debiased {
        mse: (measured[0] - own[0]) / n,
        relmse: (measured[1] - own[1]) / n,
        reference_mse: own[0] / n,
        reference_relmse: own[1] / n,
    })
}
