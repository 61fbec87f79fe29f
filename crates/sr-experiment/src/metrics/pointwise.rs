//! Metrics that are means over the pixels.

use super::pairs::{CompareError, channels, mean, mean_over, pairs};
use glam::DVec3;
use sr_film::{Image, RELMSE_OFFSET};

/// What is added to the denominators of [`mape`] and [`smape`], 0.01, so that black pixels of the
/// reference do not divide by zero (Vogels et al. 2018).
pub const RELATIVE_OFFSET: f64 = 0.01;

/// Part of the pixels that [`relmse_trimmed`] leaves out.
pub const TRIMMED_PART: f64 = 1e-3;

/// Mean squared error, mean((x − r)²). Unbiased noise makes it the mean variance; it falls like
/// 1/samples. Bright regions decide it.
///
/// # Errors
/// As [`compare`](crate::compare), for this and the other metrics.
pub fn mse(image: &Image, reference: &Image) -> Result<f64, CompareError> {
    mean_over(image, reference, squared)
}

/// Relative mean squared error, mean((x − r)² / (r² + 0.01)) with [`RELMSE_OFFSET`]: the usual
/// headline, in which dark and bright regions weigh alike (Rousselle, Knaus, Zwicker 2011).
///
/// # Errors
/// As [`compare`](crate::compare).
pub fn relmse(image: &Image, reference: &Image) -> Result<f64, CompareError> {
    mean_over(image, reference, squared_relative)
}

/// [`relmse`] over all pixels but the 0.1 % ([`TRIMMED_PART`], rounded down) of the largest error:
/// far below `relmse` when fireflies make up the error. It says nothing about them, so it must be
/// called trimmed wherever it is shown; and it is biased towards methods with heavy tails.
///
/// # Errors
/// As [`compare`](crate::compare).
pub fn relmse_trimmed(image: &Image, reference: &Image) -> Result<f64, CompareError> {
    let mut errors: Vec<f64> = pairs(image, reference)?
        .map(|(_, x, r)| channels(squared_relative(x, r)))
        .collect();
    errors.sort_unstable_by(f64::total_cmp);
    let kept = errors.len() - (errors.len() as f64 * TRIMMED_PART) as usize;
    mean(errors[..kept].iter().copied())
}

/// Mean absolute percentage error as a fraction, mean(|x − r| / (|r| + 0.01)) with
/// [`RELATIVE_OFFSET`]: a few bright outliers matter less than to [`relmse`].
///
/// # Errors
/// As [`compare`](crate::compare).
pub fn mape(image: &Image, reference: &Image) -> Result<f64, CompareError> {
    mean_over(image, reference, |x, r| {
        (x - r).abs() / (r.abs() + RELATIVE_OFFSET)
    })
}

/// Symmetric mean absolute percentage error as a fraction, mean(|x − r| / (|x| + |r| + 0.01)) with
/// [`RELATIVE_OFFSET`] (Vogels, Rousselle, McWilliams, Röthlin, Harvill, Adler, Meyer, Novák 2018,
/// "Denoising with Kernel Prediction and Asymmetric Loss Functions"): between 0 and 1 whatever the
/// outlier.
///
/// # Errors
/// As [`compare`](crate::compare).
pub fn smape(image: &Image, reference: &Image) -> Result<f64, CompareError> {
    mean_over(image, reference, |x, r| {
        (x - r).abs() / (x.abs() + r.abs() + RELATIVE_OFFSET)
    })
}

/// Signed error of each channel, mean(x − r): noise cancels in it, too much or too little light
/// stays. It falls to 0 for an unbiased picture, and only its interval says how fast
/// ([`same`](crate::same::same) gives one).
///
/// # Errors
/// As [`compare`](crate::compare).
pub fn mean_error(image: &Image, reference: &Image) -> Result<DVec3, CompareError> {
    let channel = |c: usize| mean(pairs(image, reference)?.map(|(_, x, r)| x[c] - r[c]));
    Ok(DVec3::new(channel(0)?, channel(1)?, channel(2)?))
}

pub(super) fn squared(x: DVec3, r: DVec3) -> DVec3 {
    (x - r) * (x - r)
}

pub(super) fn squared_relative(x: DVec3, r: DVec3) -> DVec3 {
    squared(x, r) / (r * r + RELMSE_OFFSET)
}
