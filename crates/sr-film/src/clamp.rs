//! Clamping: samples that are brighter than a limit are scaled down to it.
//!
//! A sample whose largest component is above the limit is multiplied by limit / largest, so that its
//! hue stays (as pbrt's `maxcomponentvalue`; Pharr, Jakob, Humphreys 2023, §5.4.2). What is cut off
//! is gone: noise falls and the picture becomes too dark where light comes in few bright samples, by
//! an amount that no number of samples mends. So the film counts what it took.

use crate::block_sum::BlockSum;
use glam::{DVec3, Vec3};
use sr_math::color::LUMINANCE_WEIGHTS;

/// What a clamp has come to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClampReport {
    /// Samples and splats that were scaled down.
    pub clamped: u64,
    /// Luminance in the picture, summed over pixels.
    pub kept: f64,
    /// Luminance that the picture lacks, likewise.
    pub removed: f64,
}

impl ClampReport {
    /// Share of the picture's light that is missing, 0 to 1.
    pub fn removed_share(&self) -> f64 {
        match self.removed {
            0.0 => 0.0,
            removed => removed / (self.kept + removed),
        }
    }
}

/// Whether a clamp is one: finite and above 0.
pub(crate) fn is_limit(limit: f32) -> bool {
    limit.is_finite() && limit > 0.0
}

/// A colour that is finite and not negative, scaled down to the limit if it is above: what a film with
/// that clamp adds. In `f64` the quotient cannot underflow, and the largest component rounds to the limit itself.
#[inline]
pub fn clamped(rgb: Vec3, limit: f32) -> Vec3 {
    let largest = rgb.max_element();
    if largest <= limit {
        return rgb;
    }
    (rgb.as_dvec3() * (f64::from(limit) / f64::from(largest))).as_vec3()
}

/// Luminance, relative to the Rec. 709 primaries.
pub fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(LUMINANCE_WEIGHTS.as_dvec3())
}

/// What was cut off the samples of one pixel.
#[derive(Clone, Copy, Default)]
struct Lost {
    sum: BlockSum,
    clamped: u64,
}

/// The clamp of a tile, which counts what it takes.
pub(crate) struct ClampTile {
    limit: f32,
    pixels: Vec<Lost>,
}

impl ClampTile {
    pub fn new(limit: f32, pixels: usize) -> Self {
        Self {
            limit,
            pixels: vec![Lost::default(); pixels],
        }
    }

    pub const fn bytes_per_pixel() -> usize {
        size_of::<Lost>()
    }

    /// The sample as it is added.
    #[inline]
    pub fn limit(&self, rgb: Vec3) -> Vec3 {
        clamped(rgb, self.limit)
    }

    /// Ends the block under way of a pixel.
    pub fn fold(&mut self, pixel: usize) {
        self.pixels[pixel].sum.fold();
    }

    /// Notes that `added` has been added instead of `whole`.
    #[inline]
    pub fn note(&mut self, pixel: usize, whole: Vec3, added: Vec3) {
        if whole != added {
            let lost = &mut self.pixels[pixel];
            lost.sum.add(whole.as_dvec3() - added.as_dvec3());
            lost.clamped += 1;
        }
    }

    /// Samples of a pixel that were scaled down, and the sum of what was cut off.
    pub fn lost(&self, pixel: usize) -> (u64, DVec3) {
        let lost = &self.pixels[pixel];
        (lost.clamped, lost.sum.total())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_component_becomes_the_limit_and_the_hue_stays() {
        assert_eq!(
            clamped(Vec3::new(40.0, 10.0, 0.0), 10.0),
            Vec3::new(10.0, 2.5, 0.0)
        );
        for below in [Vec3::ZERO, Vec3::new(10.0, 9.0, 0.0)] {
            assert_eq!(clamped(below, 10.0), below);
        }
        // The ends of the range, where limit / largest is below the smallest normal `f32`.
        for limit in [f32::from_bits(1), 1.0, 3.7, f32::MAX] {
            for largest in [f32::MAX, 1e30, 1.1] {
                let rgb = clamped(Vec3::new(0.5 * largest, largest, 0.0), limit);
                assert_eq!(rgb.y, limit.min(largest), "{limit:e} {largest:e}");
                assert!(rgb.is_finite() && rgb.z == 0.0);
                // One unit in the last place, which for the least limit is all of it.
                let off = (2.0 * f64::from(rgb.x) - f64::from(rgb.y)).abs();
                let ulp = f64::from(f32::from_bits(rgb.y.to_bits() + 1)) - f64::from(rgb.y);
                assert!(!ulp.is_finite() || off <= ulp, "{limit:e} {largest:e}");
            }
        }
    }

    #[test]
    fn a_share_of_nothing_is_none() {
        assert_eq!(ClampReport::default().removed_share(), 0.0);
        let report = ClampReport {
            clamped: 1,
            kept: 3.0,
            removed: 1.0,
        };
        assert_eq!(report.removed_share(), 0.25);
    }
}
