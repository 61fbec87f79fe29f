//! Where pictures differ: one number a pixel, and its colours.

use super::pairs::{CompareError, channels, check_sizes};
use super::pointwise::{RELATIVE_OFFSET, squared, squared_relative};
use glam::DVec3;
use sr_film::{DisplayImage, Image};

/// Colour of pixels that were left out, which no colour map here has.
const LEFT_OUT: [u8; 3] = [0, 160, 0];

/// One number for each pixel, row-major from the top left; NaN where a picture was not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// `width · height` values.
    pub values: Vec<f32>,
}

/// An error of one pixel: the mean over its channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelError {
    /// (x − r)².
    Squared,
    /// (x − r)² / (r² + 0.01).
    SquaredRelative,
    /// (x − r) / (|r| + 0.01), signed.
    Signed,
}

/// From values to the ends of a colour map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Magma from 0 to the value given: black is 0, light yellow that and more.
    Linear(f32),
    /// Magma over the logarithm between two positive values.
    Log(f32, f32),
    /// Blue through white at 0 to red, between minus and plus the value given.
    Diverging(f32),
}

/// The error of every pixel.
///
/// # Errors
/// Pictures of different size.
pub fn error_map(
    image: &Image,
    reference: &Image,
    error: PixelError,
) -> Result<ErrorMap, CompareError> {
    check_sizes(image, reference)?;
    let of = |x: DVec3, r: DVec3| match error {
        PixelError::Squared => squared(x, r),
        PixelError::SquaredRelative => squared_relative(x, r),
        PixelError::Signed => (x - r) / (r.abs() + RELATIVE_OFFSET),
    };
    let both = image.pixels.iter().zip(&reference.pixels);
    Ok(ErrorMap {
        width: image.width,
        height: image.height,
        values: both
            .map(|(x, r)| {
                if x.is_finite() && r.is_finite() {
                    channels(of(x.as_dvec3(), r.as_dvec3())) as f32
                } else {
                    f32::NAN
                }
            })
            .collect(),
    })
}

impl ErrorMap {
    /// Mean over the pixels that were not left out; `None` if all were.
    pub fn mean(&self) -> Option<f64> {
        let known = self.values.iter().filter(|v| !v.is_nan());
        let (sum, n) = known.fold((0.0, 0u64), |(s, n), &v| (s + f64::from(v), n + 1));
        (n > 0).then(|| sum / n as f64)
    }

    /// The largest value; 0 if there is none.
    pub fn max(&self) -> f32 {
        self.values.iter().copied().fold(0.0, f32::max)
    }

    /// The map in false colours; pixels left out are green.
    pub fn false_colour(&self, scale: Scale) -> DisplayImage {
        DisplayImage {
            width: self.width,
            height: self.height,
            pixels: self.values.iter().map(|&v| scale.colour(v)).collect(),
        }
    }
}

impl Scale {
    /// The colour of a value.
    pub fn colour(self, value: f32) -> [u8; 3] {
        if value.is_nan() {
            return LEFT_OUT;
        }
        let v = f64::from(value);
        // NaN, from a scale without extent, is the lower end.
        let part = |t: f64| if t > 0.0 { t.min(1.0) } else { 0.0 };
        match self {
            Self::Linear(end) => colorous::MAGMA.eval_continuous(part(v / f64::from(end))),
            Self::Log(low, high) => {
                let (low, high) = (f64::from(low).ln(), f64::from(high).ln());
                colorous::MAGMA.eval_continuous(part((v.max(0.0).ln() - low) / (high - low)))
            }
            Self::Diverging(end) => {
                let t = v / f64::from(end);
                let t = if t.is_nan() { 0.0 } else { t.clamp(-1.0, 1.0) };
                // The map runs from red to blue.
                colorous::RED_BLUE.eval_continuous(0.5 - 0.5 * t)
            }
        }
        .as_array()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn pixels(values: &[Vec3]) -> Image {
        Image {
            width: values.len() as u32,
            height: 1,
            pixels: values.to_vec(),
        }
    }

    #[test]
    fn a_map_holds_the_error_of_each_pixel() {
        let x = pixels(&[Vec3::new(1.0, 0.5, 0.0), Vec3::splat(4.0), Vec3::NAN]);
        let r = pixels(&[Vec3::new(1.0, 0.25, 0.5), Vec3::splat(2.0), Vec3::ONE]);
        let of = |error| error_map(&x, &r, error).unwrap();
        let squared = of(PixelError::Squared);
        assert!((squared.values[0] - (0.0625 + 0.25) / 3.0).abs() < 1e-7);
        assert_eq!(squared.values[1], 4.0);
        assert!(squared.values[2].is_nan());
        assert_eq!(squared.max(), 4.0);
        assert!((squared.mean().unwrap() - (0.3125 / 3.0 + 4.0) / 2.0).abs() < 1e-7);
        let relative = of(PixelError::SquaredRelative);
        assert!((relative.values[1] - 4.0 / 4.01).abs() < 1e-6);
        let signed = of(PixelError::Signed);
        assert!((signed.values[0] - (0.25 / 0.26 - 0.5 / 0.51) / 3.0).abs() < 1e-7);
    }

    /// The ends of magma, #000004 and #fcfdbf, as published by Smith and van der Walt 2015.
    #[test]
    fn colours_run_from_black_to_light_yellow() {
        let linear = Scale::Linear(2.0);
        assert_eq!(linear.colour(0.0), [0x00, 0x00, 0x04]);
        assert_eq!(linear.colour(2.0), [0xfc, 0xfd, 0xbf]);
        assert_eq!(linear.colour(f32::INFINITY), linear.colour(2.0));
        assert_eq!(linear.colour(f32::NAN), LEFT_OUT);
        let log = Scale::Log(1e-4, 1.0);
        assert_eq!(log.colour(0.0), linear.colour(0.0));
        assert_eq!(log.colour(1e-2), linear.colour(1.0));
        let [blue, white, red] = [-1.0, 0.0, 1.0].map(|v| Scale::Diverging(1.0).colour(v));
        assert!(
            blue[2] > 2 * blue[0] && red[0] > 2 * red[2],
            "{blue:?} {red:?}"
        );
        assert!(white.iter().all(|&c| c > 230), "{white:?}");
        // No extent, no panic.
        let _ = (
            Scale::Linear(0.0).colour(0.0),
            Scale::Diverging(0.0).colour(0.0),
        );
    }
}
