//! Statistical tests that samplers must pass, and what comparisons of measurements need.
//!
//! Knows nothing about rendering: counts, expectations, means, directions as `[f64; 3]`. A test
//! says beforehand which false-alarm rate it accepts ([`sidak`] shares one rate among many tests,
//! [`family_p_value`] is its inverse), runs on a fixed seed, and is then deterministic.
//!
//! Special functions come from `statrs`: it is kept by a team, is precise to a few ulp of `f64`
//! and, without its default features, small.

mod bootstrap;
mod chi2;
mod random;
mod special;
mod sphere;
mod uniform;
mod welch;

pub use bootstrap::bootstrap_std_error;
pub use chi2::{Chi2, chi2_test, family_p_value, sidak};
pub use random::SplitMix;
pub use special::{
    beta_regularized, gamma_upper_regularized, normal_cdf, normal_quantile, student_cdf,
    student_quantile,
};
pub use sphere::SphereBins;
pub use uniform::{SmallPValues, small_p_values};
pub use welch::{MeanEstimate, Welch, welch_test};
