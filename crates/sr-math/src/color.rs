//! Linear Rec. 709 colour, held in a [`Vec3`].

use crate::{Real, vec3};
use glam::Vec3;

/// Rec. 709 luminance weights (ITU-R BT.709-6, §3.2).
pub const LUMINANCE_WEIGHTS: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Relative luminance of linear Rec. 709 `rgb`.
#[inline]
pub fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(LUMINANCE_WEIGHTS)
}

/// [`luminance`] of either type.
#[inline]
pub fn luminance_of<R: Real>(rgb: [R; 3]) -> R {
    vec3::dot(rgb, vec3::lift(LUMINANCE_WEIGHTS))
}
