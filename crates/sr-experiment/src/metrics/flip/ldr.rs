//! LDR-ꟻLIP.

use super::super::map::ErrorMap;
use super::super::pairs::{CompareError, check_sizes};
use super::colour::{Colours, hyab, luminance};
use super::filter::{Features, Filters, Plane};
use glam::Vec3;
use sr_film::Image;

/// Exponents of the colour and the feature difference, and the knee of the map of colour
/// differences onto [0, 1].
const COLOUR_EXPONENT: f32 = 0.7;
const FEATURE_EXPONENT: f32 = 0.5;
const KNEE_AT: f32 = 0.4;
const KNEE_TO: f32 = 0.95;

/// LDR-ꟻLIP of two pictures for a display, at `ppd` pixels per degree
/// ([`PIXELS_PER_DEGREE`](super::PIXELS_PER_DEGREE) unless one knows better).
///
/// Values are linear, which files for displays are once their sRGB curve is undone, as
/// [`read_image`](sr_film::read_image) does. What lies outside of [0, 1] is clipped. A pixel that
/// is not finite in either picture is NaN in the map, and its surroundings are judged as if both
/// pictures were black there.
///
/// # Errors
/// Pictures of different size.
///
/// # Panics
/// When `ppd` lies outside of [`PPD_RANGE`](super::PPD_RANGE).
pub fn ldr_flip(image: &Image, reference: &Image, ppd: f64) -> Result<ErrorMap, CompareError> {
    check_sizes(image, reference)?;
    let eye = Eye::new(ppd);
    let shown = |i: &Image| i.pixels.iter().map(|&p| to_display(p)).collect::<Vec<_>>();
    let (mut test, mut wanted) = (shown(image), shown(reference));
    let mut map = ErrorMap {
        width: image.width,
        height: image.height,
        values: Vec::new(),
    };
    let left_out = blank_unknown(image, reference, &mut test, &mut wanted);
    map.values = eye.differences((image.width, image.height), &test, &wanted);
    for i in left_out {
        map.values[i] = f32::NAN;
    }
    Ok(map)
}

/// Clips to what a display shows.
pub(super) fn to_display(rgb: Vec3) -> Vec3 {
    rgb.clamp(Vec3::ZERO, Vec3::ONE)
}

/// Makes both pictures black where either is not finite; says where.
pub(super) fn blank_unknown(
    image: &Image,
    reference: &Image,
    test: &mut [Vec3],
    wanted: &mut [Vec3],
) -> Vec<usize> {
    let both = image.pixels.iter().zip(&reference.pixels);
    let unknown = both
        .enumerate()
        .filter(|(_, (x, r))| !(x.is_finite() && r.is_finite()));
    let unknown: Vec<usize> = unknown.map(|(i, _)| i).collect();
    for &i in &unknown {
        (test[i], wanted[i]) = (Vec3::ZERO, Vec3::ZERO);
    }
    unknown
}

/// What does not depend on the pictures.
pub(super) struct Eye {
    pub colours: Colours,
    filters: Filters,
    /// The colour difference that counts as the largest: between green and blue.
    largest: f32,
}

impl Eye {
    pub fn new(ppd: f64) -> Self {
        assert!(super::PPD_RANGE.contains(&ppd), "{ppd} pixels per degree");
        let colours = Colours::new();
        let [green, blue] = [Vec3::Y, Vec3::Z].map(|rgb| colours.hunt_lab(rgb));
        Self {
            colours,
            filters: Filters::new(ppd),
            largest: hyab(green, blue).powf(COLOUR_EXPONENT),
        }
    }

    /// The differences of all pixels, of pictures of values in [0, 1].
    pub fn differences(&self, size: (u32, u32), test: &[Vec3], reference: &[Vec3]) -> Vec<f32> {
        if test.is_empty() {
            return Vec::new();
        }
        let (test, reference) = (self.look(size, test), self.look(size, reference));
        (0..test.lab.len())
            .map(|i| {
                let colour = self.colour_difference(test.lab[i], reference.lab[i]);
                let feature = feature_difference(&test.features, &reference.features, i);
                // Where features differ, colours count more.
                colour.powf(1.0 - feature)
            })
            .collect()
    }

    /// HyAB, compressed by its exponent and redistributed so that large differences share the last
    /// 5 %.
    fn colour_difference(&self, a: Vec3, b: Vec3) -> f32 {
        let difference = hyab(a, b).powf(COLOUR_EXPONENT);
        let knee = KNEE_AT * self.largest;
        if difference < knee {
            KNEE_TO / knee * difference
        } else {
            KNEE_TO + (difference - knee) / (self.largest - knee) * (1.0 - KNEE_TO)
        }
    }

    fn look(&self, (width, height): (u32, u32), pixels: &[Vec3]) -> Look {
        let opponent: Vec<Vec3> = pixels.iter().map(|&p| self.colours.ycxcz(p)).collect();
        let plane = |value: &dyn Fn(&Vec3) -> f32| Plane {
            width: width as usize,
            height: height as usize,
            values: opponent.iter().map(value).collect(),
        };
        let [a, b, c] = [plane(&|p| p.x), plane(&|p| p.y), plane(&|p| p.z)];
        let features = self.filters.features(&plane(&|p| luminance(p.x)));
        let [a, b, c] = self.filters.seen([&a, &b, &c]);
        let seen = a.values.iter().zip(&b.values).zip(&c.values);
        let lab = seen
            .map(|((&a, &b), &c)| {
                let rgb = to_display(self.colours.rgb(Vec3::new(a, b, c)));
                self.colours.hunt_lab(rgb)
            })
            .collect();
        Look { lab, features }
    }
}

/// A picture as it is seen.
struct Look {
    lab: Vec<Vec3>,
    features: Features,
}

/// The larger of what edges and points differ by, emphasised by its exponent.
fn feature_difference(a: &Features, b: &Features, i: usize) -> f32 {
    let edge = (a.edges[i] - b.edges[i]).abs();
    let point = (a.points[i] - b.points[i]).abs();
    // Rounding may carry the length of a largest gradient past √2.
    (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2)
        .powf(FEATURE_EXPONENT)
        .min(1.0)
}
