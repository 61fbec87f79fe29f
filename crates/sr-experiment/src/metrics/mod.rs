//! Error metrics between a picture x and a reference r.
//!
//! Pointwise metrics are means over the pixels and the three channels of linear Rec. 709, in double
//! precision ([`mse`], [`relmse`], [`relmse_trimmed`], [`mape`], [`smape`], [`mean_error`]);
//! [`compare`] gives all of them. A pixel that is not finite in either picture is left out of every
//! metric, and counted. ꟻLIP ([`ldr_flip`], [`hdr_flip`]) is what a person would see.
//!
//! All measure the reference's own noise along with the picture's: a metric near that noise says
//! nothing about the picture. [`debiased`] subtracts it, or refuses to.

mod comparison;
mod debias;
mod flip;
mod map;
mod pairs;
mod pointwise;

pub use comparison::{Comparison, compare};
pub use debias::{Debiased, NOISE_LIMIT, debiased};
pub use flip::{HdrFlip, PIXELS_PER_DEGREE, PPD_RANGE, hdr_flip, ldr_flip};
pub use map::{ErrorMap, PixelError, Scale, error_map};
pub use pairs::CompareError;
pub use pointwise::{
    RELATIVE_OFFSET, TRIMMED_PART, mape, mean_error, mse, relmse, relmse_trimmed, smape,
};
