//! From radiance to what a display is sent: exposure, tone map, 8-bit code values.

use crate::{Image, srgb};
use glam::{Mat3, Vec3};

/// How scene radiance (after exposure) becomes display code values in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ToneMap {
    /// Clip to [0, 1], then the sRGB curve: right wherever nothing is brighter than white.
    #[default]
    Srgb,
    /// AgX (Sobotka 2022), base look: 16.5 stops on a sigmoid, bright colours fade to white.
    /// 18 % grey becomes code 0.5.
    AgX,
    /// Khronos PBR Neutral (2024): leaves hues and base colours up to 0.8 alone, less the 4 % that
    /// a dielectric mirrors.
    PbrNeutral,
}

impl ToneMap {
    /// Code values in [0, 1] of linear Rec. 709 `rgb`. Below zero and NaN count as 0.
    pub fn apply(self, rgb: Vec3) -> Vec3 {
        // Not `clamp`, which keeps NaN.
        let positive = |v: f32| if v > 0.0 { v.min(f32::MAX) } else { 0.0 };
        let scene = rgb.to_array().map(positive).into();
        match self {
            Self::Srgb => srgb::encode_rgb(scene),
            Self::AgX => agx(scene),
            Self::PbrNeutral => srgb::encode_rgb(pbr_neutral(scene)),
        }
    }
}

/// 8-bit RGB code values for a display, row-major from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayImage {
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Vec<[u8; 3]>,
}

/// Scales by 2^`exposure`, maps, and rounds to the nearest of 256 codes.
pub fn develop(image: &Image, exposure: f32, tone_map: ToneMap) -> DisplayImage {
    let scale = exposure.exp2();
    let code = |v: f32| (v * 255.0 + 0.5) as u8;
    DisplayImage {
        width: image.width,
        height: image.height,
        pixels: image
            .pixels
            .iter()
            .map(|&rgb| tone_map.apply(rgb * scale).to_array().map(code))
            .collect(),
    }
}

/// AgX's inset, which pulls Rec. 709 primaries towards grey before the curve (columns): the matrix
/// of Wrensch 2023, "Minimal AgX Implementation". Grey stays grey within 1.4·10⁻⁴.
const AGX_INSET: Mat3 = Mat3::from_cols_array(&[
    0.842_479_06,
    0.042_328_242,
    0.042_375_655,
    0.078_433_6,
    0.878_468_64,
    0.078_433_6,
    0.079_223_745,
    0.079_166_13,
    0.879_143,
]);

/// The inverse of [`AGX_INSET`], ibid.
const AGX_OUTSET: Mat3 = Mat3::from_cols_array(&[
    1.196_879,
    -0.052_896_852,
    -0.052_971_636,
    -0.098_020_88,
    1.151_903_1,
    -0.098_043_45,
    -0.099_029_74,
    -0.098_961_18,
    1.151_073_7,
]);

/// Stops below and above 18 % grey that the curve spans.
const AGX_STOPS: (f32, f32) = (10.0, 6.5);

/// The output is made for a display of exponent 2.2 and is sent as it is.
fn agx(scene: Vec3) -> Vec3 {
    let (below, above) = AGX_STOPS;
    let grey = 0.18f32.log2();
    let stops = (AGX_INSET * scene)
        .to_array()
        .map(|v| v.log2().clamp(grey - below, grey + above));
    let curved = stops.map(|s| agx_curve((s - grey + below) / (below + above)));
    (AGX_OUTSET * Vec3::from_array(curved)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Sobotka's sigmoid on [0, 1]: through (20/33, 1/2), the place of grey, with slope 2, and through
/// both corners. With t the distance from grey, `2t / (1 + a tᵖ)^(1/p)`; p = 3 in the toe and 13/4
/// in the shoulder, and a follows from the corner at distance d: `a = 4ᵖ − d⁻ᵖ`.
fn agx_curve(x: f32) -> f32 {
    let (below, above) = AGX_STOPS;
    let pivot = below / (below + above);
    let t = x - pivot;
    let (p, d) = if t < 0.0 {
        (3.0, pivot)
    } else {
        (3.25, 1.0 - pivot)
    };
    let a = 4f32.powf(p) - d.powf(-p);
    0.5 + 2.0 * t * (1.0 + a * t.abs().powf(p)).powf(-1.0 / p)
}

/// Khronos Group 2024, "PBR Neutral Tone Mapper Specification": linear in, linear out.
fn pbr_neutral(scene: Vec3) -> Vec3 {
    // Fresnel reflectance of a dielectric of index 1.5, which lighting adds to base colours.
    const F90: f32 = 0.04;
    const START: f32 = 0.8 - F90;
    const DESATURATION: f32 = 0.15;
    let low = scene.min_element();
    // The parabola meets F90 with slope 0 at 2 F90, and sends black to black.
    let offset = if low <= 2.0 * F90 {
        low - low * low / (4.0 * F90)
    } else {
        F90
    };
    let colour = scene - offset;
    let peak = colour.max_element();
    if peak <= START {
        return colour;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (colour * (new_peak / peak)).lerp(Vec3::splat(new_peak), white)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [ToneMap; 3] = [ToneMap::Srgb, ToneMap::AgX, ToneMap::PbrNeutral];

    fn grey(v: f32) -> Vec3 {
        Vec3::splat(v)
    }

    #[test]
    fn black_is_black_and_codes_stay_in_range() {
        for map in ALL {
            assert!(map.apply(Vec3::ZERO).max_element() < 0.5 / 255.0, "{map:?}");
            for odd in [f32::NAN, f32::INFINITY, f32::MAX, -1.0, 1e-42] {
                for rgb in [grey(odd), Vec3::new(odd, 0.5, 0.0)] {
                    let code = map.apply(rgb);
                    assert!(code.is_finite(), "{map:?} of {rgb} is {code}");
                    assert!(code.min_element() >= 0.0 && code.max_element() <= 1.0);
                }
            }
        }
    }

    #[test]
    fn greys_rise_and_stay_grey() {
        for map in ALL {
            let mut last = -1.0;
            for i in 0..4000 {
                let code = map.apply(grey(2f32.powf(i as f32 / 200.0 - 14.0)));
                // The rounding of one code at most, and of the matrices for AgX.
                assert!(code.max_element() - code.min_element() < 0.25 / 255.0);
                assert!(code.y >= last, "{map:?} falls at step {i}");
                last = code.y;
            }
            assert!(last > 0.99, "{map:?} ends at {last}");
        }
    }

    /// Values that follow from the specification by hand.
    #[test]
    fn neutral_maps_the_specified_points() {
        for (scene, out) in [
            (0.0, 0.0),
            (0.04, 0.04 * 0.04 / 0.16),
            (0.18, 0.14),
            (0.8, 0.76),
            // peak 0.96: 1 − 0.24² / 0.44.
            (1.0, 0.869_090_9),
            // peak 9.96: 1 − 0.24² / 9.44.
            (10.0, 0.993_898_3),
        ] {
            let mapped = pbr_neutral(grey(scene));
            // Grey has nothing to desaturate. A few roundings of numbers below 10.
            assert!((mapped - grey(out)).abs().max_element() < 2e-6, "{scene}");
        }
    }

    #[test]
    fn neutral_keeps_base_colours_and_hue() {
        for i in 0..1000u32 {
            let u = |k| sr_math::hash::unit_f32(sr_math::hash::mix(i, k));
            let base = Vec3::new(u(0), u(1), u(2)) * (0.8 - 0.08) + 0.08;
            let mapped = pbr_neutral(base);
            assert!((mapped + 0.04 - base).abs().max_element() < 2e-7);
            // Around the white axis, hue is the ratio of differences of channels: however bright,
            // the mapped colour is a mix of the old one and white.
            let bright = base * 16.0;
            let (a, b) = (bright - bright.min_element(), pbr_neutral(bright));
            let b = b - b.min_element();
            let turn = a.cross(b).length() / (a.length() * b.length());
            // b is a difference of numbers near 1: relative rounding 2⁻²³ over its size.
            assert!(turn < 4.0 * f32::EPSILON / b.length(), "{base}: {turn}");
        }
    }

    #[test]
    fn neutral_is_continuous_at_its_seams() {
        for seam in [0.08f32, 0.8] {
            let (a, b) = (seam * (1.0 - 1e-6), seam * (1.0 + 1e-6));
            let step = pbr_neutral(grey(b)) - pbr_neutral(grey(a));
            assert!(step.min_element() >= 0.0 && step.max_element() < 4e-6);
        }
    }

    #[test]
    fn agx_sends_grey_to_one_half_and_ends_at_the_corners() {
        assert!((ToneMap::AgX.apply(grey(0.18)) - 0.5).abs().max_element() < 1e-4);
        assert!(agx_curve(0.0).abs() < 1e-6);
        assert!((agx_curve(1.0) - 1.0).abs() < 1e-6);
        let slope = (agx_curve(20.0 / 33.0 + 1e-3) - agx_curve(20.0 / 33.0 - 1e-3)) / 2e-3;
        assert!((slope - 2.0).abs() < 1e-3, "{slope}");
    }

    /// Wrensch's polynomial is a fit to Sobotka's curve with a root mean square error of 0.0019, and
    /// its printed coefficients are rounded to about 0.005. Two of 256 codes hold both; a wrong
    /// power, slope or pivot is off by more.
    #[test]
    fn agx_curve_agrees_with_the_published_fit() {
        let fit = |x: f32| {
            let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.002_32];
            coefficients.iter().fold(0.0, |sum, c| sum * x + c)
        };
        for i in 0..=4096u16 {
            let x = f32::from(i) / 4096.0;
            let off = agx_curve(x) - fit(x);
            assert!(off.abs() < 2.0 / 255.0, "{off} at {x}");
        }
    }

    #[test]
    fn agx_outset_undoes_the_inset() {
        let identity = AGX_OUTSET * AGX_INSET;
        // 15 digits are published; three products of float constants remain.
        assert!(identity.abs_diff_eq(Mat3::IDENTITY, 4.0 * f32::EPSILON));
    }

    #[test]
    fn agx_fades_bright_colours_to_white() {
        let red = ToneMap::AgX.apply(Vec3::new(1000.0, 0.0, 0.0));
        let dim = ToneMap::AgX.apply(Vec3::new(1.0, 0.0, 0.0));
        assert!(red.y > 0.8 && dim.y < 0.5 && dim.x > dim.y, "{red} {dim}");
    }

    #[test]
    fn exposure_counts_in_stops() {
        let image = Image::filled(2, 1, grey(0.25));
        let developed = develop(&image, 2.0, ToneMap::Srgb);
        assert_eq!(developed.pixels, [[255; 3]; 2]);
        let developed = develop(&image, -1.0, ToneMap::Srgb);
        // sRGB of 1/8: 1.055 · 8^(−1/2.4) − 0.055 = 0.3886, code 99.1.
        assert_eq!(developed.pixels, [[99; 3]; 2]);
    }
}
