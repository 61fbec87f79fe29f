//! ꟻLIP: how much of a difference one sees when two pictures are flipped on the same display.
//!
//! [`ldr_flip`] is the metric of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and
//! Fairchild 2020, "ꟻLIP: A Difference Evaluator for Alternating Images". Pictures are seen through
//! the eye's contrast sensitivity, their colours are compared in a perceptually uniform space, and
//! the difference counts more where edges or points differ. [`hdr_flip`] is that of Andersson,
//! Nilsson, Shirley and Akenine-Möller 2021, "Visualizing Errors in Rendered High Dynamic Range
//! Images": the largest LDR-ꟻLIP of a pixel over exposures from where nothing is overexposed to
//! where half of the picture is.
//!
//! An error of a pixel lies in [0, 1]; the metric of a picture is the mean. It depends on the
//! distance to the display, as pixels per degree. Computed in `f32`, as the published
//! implementation does, with which it agrees within 2·10⁻⁵ (tested).

mod colour;
mod filter;
mod hdr;
mod ldr;
#[cfg(test)]
mod tests;

pub use hdr::{HdrFlip, hdr_flip};
pub use ldr::ldr_flip;

/// Pixels per degree of the papers' display: 0.7 m away, 0.7 m and 3840 pixels wide, which is
/// 0.7 · 3840/0.7 · π/180.
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// Pixels per degree that ꟻLIP is computed for: below, a pixel is wider than all that the filters
/// resolve; above, they are wider than is useful.
pub const PPD_RANGE: std::ops::RangeInclusive<f64> = 1.0..=1000.0;
