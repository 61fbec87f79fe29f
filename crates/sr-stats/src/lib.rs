//! Statistical tests that samplers must pass.
//!
//! Knows nothing about rendering: counts, expectations, directions as `[f64; 3]`. A test says
//! beforehand which false-alarm rate it accepts ([`sidak`] shares one rate among many tests), runs
//! on a fixed seed, and is then deterministic.
//!
//! Special functions come from `statrs`: it is kept by a team, is precise to a few ulp of `f64` and,
//! without its default features, small.

mod chi2;
mod special;
mod sphere;

pub use chi2::{Chi2, chi2_test, sidak};
pub use special::{
    beta_regularized, gamma_upper_regularized, normal_cdf, normal_quantile, student_cdf,
    student_quantile,
};
pub use sphere::SphereBins;
