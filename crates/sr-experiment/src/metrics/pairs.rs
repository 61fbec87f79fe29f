//! Two pictures side by side: what every metric goes over.

use glam::DVec3;
use sr_film::Image;
use std::fmt;

/// Why two pictures cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompareError {
    /// They differ in size.
    SizesDiffer {
        /// Width and height of the picture.
        image: (u32, u32),
        /// Width and height of the reference.
        reference: (u32, u32),
    },
    /// No pixel is finite in both.
    NothingToCompare,
    /// The variance that is given for the reference has another size than the reference.
    VarianceSizeDiffers {
        /// Width and height of the variance.
        variance: (u32, u32),
        /// Width and height of the reference.
        reference: (u32, u32),
    },
    /// The reference's variance is not known (infinite, not a number or negative) at some pixels.
    UnknownVariance {
        /// How many of those compared.
        pixels: u64,
    },
    /// The reference's own noise is too large a part of what is measured to be subtracted.
    NoisyReference {
        /// Share of the measured error that is the reference's noise; more than
        /// [`NOISE_LIMIT`](crate::NOISE_LIMIT).
        share: f64,
    },
}

impl fmt::Display for CompareError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SizesDiffer { image, reference } => write!(
                f,
                "the image has {} × {} pixels, the reference {} × {}",
                image.0, image.1, reference.0, reference.1
            ),
            Self::NothingToCompare => f.write_str("no pixel is finite in both pictures"),
            Self::VarianceSizeDiffers {
                variance,
                reference,
            } => write!(
                f,
                "the reference's variance has {} × {} pixels, the reference {} × {}",
                variance.0, variance.1, reference.0, reference.1
            ),
            Self::UnknownVariance { pixels } => write!(
                f,
                "the reference's variance is not known at {pixels} pixels, so its noise cannot be \
                 subtracted: give it at least two samples (and replicas) a pixel"
            ),
            Self::NoisyReference { share } => {
                let limit = super::NOISE_LIMIT;
                write!(
                    f,
                    "the reference is not good enough: its own noise is {:.0} % of the error \
                     measured, at most {:.0} % can be subtracted; ",
                    100.0 * share,
                    100.0 * limit
                )?;
                // What is left, 1 − share, is the picture's: of it the noise may be L/(1 − L).
                let times = share * (1.0 - limit) / (limit * (1.0 - share));
                if *share < 1.0 && times < 1e6 {
                    write!(
                        f,
                        "render it with {:.0} times as many samples",
                        times.ceil()
                    )
                } else {
                    f.write_str("render it with far more samples")
                }
            }
        }
    }
}

impl std::error::Error for CompareError {}

/// Width and height.
pub(super) fn size(image: &Image) -> (u32, u32) {
    (image.width, image.height)
}

/// Pictures of one size, or an error that names both.
pub(super) fn check_sizes(image: &Image, reference: &Image) -> Result<(), CompareError> {
    if size(image) != size(reference) {
        return Err(CompareError::SizesDiffer {
            image: size(image),
            reference: size(reference),
        });
    }
    Ok(())
}

/// Pixels that are finite in both pictures, with their index.
pub(super) fn pairs<'a>(
    image: &'a Image,
    reference: &'a Image,
) -> Result<impl Iterator<Item = (usize, DVec3, DVec3)> + 'a, CompareError> {
    check_sizes(image, reference)?;
    let both = image.pixels.iter().zip(&reference.pixels).enumerate();
    Ok(both
        .filter(|(_, (x, r))| x.is_finite() && r.is_finite())
        .map(|(i, (x, r))| (i, x.as_dvec3(), r.as_dvec3())))
}

/// Mean of `metric` over pixels and channels.
pub(super) fn mean_over(
    image: &Image,
    reference: &Image,
    metric: impl Fn(DVec3, DVec3) -> DVec3,
) -> Result<f64, CompareError> {
    mean(pairs(image, reference)?.map(|(_, x, r)| channels(metric(x, r))))
}

/// Mean over the channels.
pub(super) fn channels(value: DVec3) -> f64 {
    value.element_sum() / 3.0
}

pub(super) fn mean(values: impl Iterator<Item = f64>) -> Result<f64, CompareError> {
    let (sum, count) = values.fold((0.0, 0u64), |(sum, n), v| (sum + v, n + 1));
    if count == 0 {
        return Err(CompareError::NothingToCompare);
    }
    Ok(sum / count as f64)
}
