//! Against the published implementation, flip-evaluator 1.7 (PyPI), on pictures made of exact
//! numbers.
//!
//! The values were printed by `flip_evaluator.evaluate(reference, image, "LDR" or "HDR",
//! inputsRGB=False, applyMagma=False)` on the same numbers as float32. It computes in `f32` as we
//! do, in another order. The feature difference has a square root, which makes 3·10⁻⁴ of a rounding
//! of 10⁻⁷ and 10⁻⁵ of the result; agreement to 2·10⁻⁵ is twice that.

use super::*;
use crate::ErrorMap;
use glam::Vec3;
use sr_film::Image;

const SIZE: (u32, u32) = (48, 40);

/// Largest difference, see above.
const TOLERANCE: f32 = 2e-5;

/// Where single values of the maps were taken.
const PLACES: [(u32, u32); 6] = [(0, 0), (47, 39), (13, 7), (24, 20), (40, 3), (5, 33)];

fn make(at: impl Fn(i64, i64, i64) -> f32) -> Image {
    let (width, height) = SIZE;
    let pixel = |i: u32| {
        let (x, y) = (i64::from(i % width), i64::from(i / width));
        Vec3::new(at(x, y, 0), at(x, y, 1), at(x, y, 2))
    };
    Image {
        width,
        height,
        pixels: (0..width * height).map(pixel).collect(),
    }
}

/// 64 times a hatched ramp on a chequerboard.
fn ramp(x: i64, y: i64, c: i64) -> i64 {
    (7 * x + 13 * y + 29 * c) % 32 + 32 * ((x / 8 + y / 8) % 2)
}

/// Image and reference.
fn pictures() -> (Image, Image) {
    let changed = |x, y, c| {
        let noise = if (x / 12 + y / 10) % 2 == 0 {
            (11 * x + 5 * y + 17 * c) % 16 - 8
        } else {
            0
        };
        (ramp(x, y, c) + noise).clamp(0, 64) as f32 / 64.0
    };
    (make(changed), make(|x, y, c| ramp(x, y, c) as f32 / 64.0))
}

/// The same four times as bright, with highlights and fireflies.
fn bright_pictures() -> (Image, Image) {
    let (mut image, mut reference) = pictures();
    for p in image.pixels.iter_mut().chain(&mut reference.pixels) {
        *p *= 4.0;
    }
    let at = |x: u32, y: u32| (y * SIZE.0 + x) as usize;
    for y in 12..15 {
        for x in 20..23 {
            reference.pixels[at(x, y)] = Vec3::splat(60.0);
            image.pixels[at(x, y)] = Vec3::splat(45.0);
        }
    }
    reference.pixels[at(10, 30)] = Vec3::new(200.0, 0.0, 3.0);
    image.pixels[at(36, 31)] = Vec3::new(0.0, 90.0, 0.5);
    (image, reference)
}

fn check(map: &ErrorMap, mean: f64, max: f32, values: [f32; 6]) {
    let off = map.mean().unwrap() - mean;
    assert!(off.abs() < f64::from(TOLERANCE), "mean off by {off:e}");
    assert!((map.max() - max).abs() < TOLERANCE, "max {}", map.max());
    for ((x, y), value) in PLACES.into_iter().zip(values) {
        let ours = map.values[(y * SIZE.0 + x) as usize];
        assert!(
            (ours - value).abs() < TOLERANCE,
            "({x}, {y}): {ours} {value}"
        );
    }
}

#[test]
fn ldr_flip_agrees_with_the_published_implementation() {
    let (image, reference) = pictures();
    let map = ldr_flip(&image, &reference, PIXELS_PER_DEGREE).unwrap();
    let values = [
        0.285_023_9,
        0.094_179_1,
        0.036_129_2,
        0.058_734_4,
        0.002_590_0,
        0.014_405_8,
    ];
    check(&map, 0.068_777_278, 0.285_023_9, values);
}

#[test]
fn ldr_flip_agrees_at_another_distance() {
    let (image, reference) = pictures();
    let map = ldr_flip(&image, &reference, 30.0).unwrap();
    let values = [
        0.384_618_1,
        0.079_148_2,
        0.020_776_5,
        0.161_626_7,
        0.000_153_6,
        0.000_742_7,
    ];
    check(&map, 0.107_564_524, 0.467_892_5, values);
}

#[test]
fn hdr_flip_agrees_with_the_published_implementation() {
    let (image, reference) = bright_pictures();
    let flip = hdr_flip(&image, &reference, PIXELS_PER_DEGREE).unwrap();
    let values = [
        0.274_367_8,
        0.067_943_7,
        0.031_900_2,
        0.050_196_4,
        0.011_904_5,
        0.016_949_4,
    ];
    check(&flip.map, 0.081_818_476, 0.669_992_2, values);
    assert_eq!(flip.count, 5);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-5, "{a} {b}");
    close(flip.exposures.0, -4.823_593_1);
    close(flip.exposures.1, -0.034_879_8);
}

/// Black to white is 0.967 by the definition, computed in double precision, not 1: green to blue is
/// 1.
#[test]
fn the_ends_are_where_they_were_published() {
    let whole = |v| Image::filled(3, 2, Vec3::splat(v));
    let flip = |a: &Image, b: &Image| ldr_flip(a, b, PIXELS_PER_DEGREE).unwrap().mean().unwrap();
    let white = flip(&whole(1.0), &whole(0.0));
    assert!(
        (white - 0.967_379_18).abs() < f64::from(TOLERANCE),
        "{white}"
    );
    assert_eq!(flip(&whole(0.3), &whole(0.3)), 0.0);
    let (green, blue) = (Image::filled(3, 2, Vec3::Y), Image::filled(3, 2, Vec3::Z));
    assert!((flip(&green, &blue) - 1.0).abs() < 1e-6);
}

#[test]
fn the_ends_of_the_range_give_numbers() {
    let (image, reference) = pictures();
    for ppd in [*PPD_RANGE.start(), *PPD_RANGE.end()] {
        let mean = ldr_flip(&image, &reference, ppd).unwrap().mean().unwrap();
        assert!(mean > 0.0 && mean < 1.0, "{mean}");
    }
}

#[test]
fn what_is_not_finite_is_left_out_and_does_not_spread() {
    let (mut image, reference) = bright_pictures();
    let at = (9 * SIZE.0 + 9) as usize;
    image.pixels[at] = Vec3::new(f32::NAN, 1.0, f32::INFINITY);
    image.pixels[at + 1] = Vec3::splat(-3.0);
    for map in [
        hdr_flip(&image, &reference, PIXELS_PER_DEGREE).unwrap().map,
        ldr_flip(&image, &reference, PIXELS_PER_DEGREE).unwrap(),
    ] {
        assert!(map.values[at].is_nan());
        let others = map.values.iter().enumerate().filter(|(i, _)| *i != at);
        for (i, v) in others {
            assert!((0.0..=1.0).contains(v), "{i}: {v}");
        }
        assert!(map.mean().is_some());
    }
    let nothing = Image::filled(0, 0, Vec3::ZERO);
    let map = hdr_flip(&nothing, &nothing, PIXELS_PER_DEGREE).unwrap().map;
    assert_eq!(map.mean(), None);
    assert!(ldr_flip(&image, &nothing, PIXELS_PER_DEGREE).is_err());
}
