//! HDR-ꟻLIP: LDR-ꟻLIP over a range of exposures.

use super::super::map::ErrorMap;
use super::super::pairs::{CompareError, check_sizes};
use super::ldr::{Eye, blank_unknown, to_display};
use glam::Vec3;
use sr_film::Image;

/// Numerator and denominator, from x² down, of the tone map that the paper prefers: Narkowicz's fit
/// to ACES (2016), with the factor 0.6 on x that makes its exposure that of ACES.
const NUMERATOR: [f64; 3] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0];
const DENOMINATOR: [f64; 3] = [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];

/// The tone-mapped value from which on a pixel counts as bright.
const BRIGHT: f64 = 0.85;

/// Luminance that the median is taken to have at least, 2⁻²³, so that the range of exposures ends
/// when half of the picture is black: that of the published implementation.
const DARKEST: f64 = 1.0 / 8_388_608.0;

/// HDR-ꟻLIP and the exposures that it was computed for.
#[derive(Clone, Debug, PartialEq)]
pub struct HdrFlip {
    /// The error of each pixel.
    pub map: ErrorMap,
    /// First and last exposure, in stops.
    pub exposures: (f64, f64),
    /// How many exposures there were, evenly spaced.
    pub count: u32,
}

/// HDR-ꟻLIP of two pictures of radiance, at `ppd` pixels per degree; the exposures are those that
/// the paper derives from the reference: from where its brightest pixel is mapped to 0.85 to
/// where its median is, in steps of at most one stop.
///
/// What is negative counts as 0; pixels that are not finite are treated as by
/// [`ldr_flip`](super::ldr_flip).
///
/// # Errors
/// Pictures of different size.
///
/// # Panics
/// When `ppd` lies outside of [`PPD_RANGE`](super::PPD_RANGE).
pub fn hdr_flip(image: &Image, reference: &Image, ppd: f64) -> Result<HdrFlip, CompareError> {
    check_sizes(image, reference)?;
    let eye = Eye::new(ppd);
    let positive = |i: &Image| {
        i.pixels
            .iter()
            .map(|p| p.max(Vec3::ZERO))
            .collect::<Vec<_>>()
    };
    let (mut test, mut wanted) = (positive(image), positive(reference));
    let left_out = blank_unknown(image, reference, &mut test, &mut wanted);
    let (exposures, count) = exposure_range(wanted.iter().map(|&p| eye.colours.xyz(p).y));
    let mut values = vec![0.0f32; test.len()];
    for i in 0..count {
        let part = f64::from(i) / f64::from(count - 1);
        let scale = (exposures.0 + part * (exposures.1 - exposures.0)).exp2() as f32;
        let develop = |pixels: &[Vec3]| -> Vec<Vec3> {
            pixels
                .iter()
                .map(|&p| to_display(tone_map(p * scale)))
                .collect()
        };
        let size = (image.width, image.height);
        let differences = eye.differences(size, &develop(&test), &develop(&wanted));
        for (v, d) in values.iter_mut().zip(differences) {
            *v = v.max(d);
        }
    }
    for i in left_out {
        values[i] = f32::NAN;
    }
    Ok(HdrFlip {
        map: ErrorMap {
            width: image.width,
            height: image.height,
            values,
        },
        exposures,
        count,
    })
}

/// First and last exposure and their number, from the luminances of the reference. Of an even
/// number the median is the upper of the middle two.
fn exposure_range(luminances: impl Iterator<Item = f32>) -> ((f64, f64), u32) {
    let mut luminances: Vec<f32> = luminances.collect();
    let middle = luminances.len() / 2;
    if luminances.is_empty() {
        return ((0.0, 0.0), 2);
    }
    let brightest = luminances.iter().copied().fold(0.0, f32::max);
    let (_, median, _) = luminances.select_nth_unstable_by(middle, f32::total_cmp);
    let exposure = |luminance: f32| (bright_input() / f64::from(luminance).max(DARKEST)).log2();
    let (start, stop) = (exposure(brightest), exposure(*median));
    ((start, stop), ((stop - start).ceil() as u32).max(2))
}

/// The input that [`tone_map`] takes to [`BRIGHT`]: the larger root of N(x) − t D(x) = 0.
fn bright_input() -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| NUMERATOR[i] - BRIGHT * DENOMINATOR[i]);
    let half = -0.5 * b / a;
    half + (half * half - c / a).sqrt()
}

fn tone_map(rgb: Vec3) -> Vec3 {
    let poly = |c: [f64; 3]| {
        let [a, b, c] = c.map(|v| v as f32);
        (rgb * a + Vec3::splat(b)) * rgb + Vec3::splat(c)
    };
    let mapped = poly(NUMERATOR) / poly(DENOMINATOR);
    // Squares that leave the range of floats stand for white.
    Vec3::select(mapped.is_finite_mask(), mapped, Vec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_ends_where_the_median_becomes_bright() {
        let x = bright_input() as f32;
        assert!((tone_map(Vec3::splat(x)).x - 0.85).abs() < 1e-6);
        let ((start, stop), count) = exposure_range([x / 8.0, x, x / 16.0].into_iter());
        assert!(
            start.abs() < 1e-6 && (stop - 3.0).abs() < 1e-6,
            "{start} {stop}"
        );
        assert_eq!(count, 3);
        // All of one brightness, and all black.
        assert_eq!(exposure_range([1.0, 1.0].into_iter()).1, 2);
        let ((start, stop), count) = exposure_range([0.0, 0.0].into_iter());
        assert!(start == stop && start.is_finite() && count == 2);
    }

    #[test]
    fn the_brightest_floats_are_white() {
        assert_eq!(to_display(tone_map(Vec3::splat(f32::MAX))), Vec3::ONE);
        assert_eq!(tone_map(Vec3::ZERO), Vec3::ZERO);
    }
}
