//! Environment maps: what they show, and that they are sampled as they say.

#![allow(
    clippy::print_stderr,
    reason = "measured variances are worth reading when a test passes, too"
)]

#[path = "../common/mod.rs"]
mod common;
mod estimates;
mod oracle;
mod sampling;

use common::numbers;
use glam::{Mat3, Vec2, Vec3};
use oracle::Oracle;
use sr_light::{EnvironmentMap, EnvironmentSampling, ImageEnvironment, Light};
use std::sync::Arc;

fn u(i: u32) -> Vec2 {
    Vec2::new(numbers(i, 0), numbers(i, 1))
}

fn oracle(width: u32, height: u32, texel: impl Fn(u32, u32) -> Vec3) -> Oracle {
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Oracle {
        width,
        height,
        rgb: rows.map(|(x, y)| texel(x, y)).collect(),
    }
}

fn light(o: &Oracle, to_map: Mat3, sampling: EnvironmentSampling) -> Light {
    let map = EnvironmentMap::new(o.width, o.height, o.rgb.clone()).expect("a map");
    Light::ImageEnvironment(ImageEnvironment {
        map: Arc::new(map),
        to_map,
        scale: Vec3::ONE,
        sampling,
    })
}

/// Hashed colours.
fn noise(x: u32, y: u32) -> Vec3 {
    [0, 1, 2].map(|k| numbers(x + 1000 * y, 10 + k)).into()
}

/// Maps with everything that tables stumble over.
fn maps() -> Vec<(&'static str, Oracle)> {
    let grey = Vec3::splat;
    let hot = |x, y, at| grey(if (x, y) == at { 1e6 } else { 1.0 });
    vec![
        ("noise", oracle(9, 5, noise)),
        (
            "rows and columns of zeros",
            oracle(8, 7, |x, y| {
                if y == 0 || y == 3 || y == 4 || x == 2 || x == 3 {
                    Vec3::ZERO
                } else {
                    noise(x, y)
                }
            }),
        ),
        (
            "half black",
            oracle(8, 4, |_, y| grey(if y < 2 { 1.0 } else { 0.0 })),
        ),
        (
            "one blue texel",
            oracle(8, 4, |x, y| {
                if (x, y) == (5, 2) {
                    Vec3::new(0.0, 0.0, 1.0)
                } else {
                    Vec3::ZERO
                }
            }),
        ),
        ("hot texel", oracle(32, 16, |x, y| hot(x, y, (20, 5)))),
        ("hot pole and seam", oracle(16, 8, |x, y| hot(x, y, (0, 0)))),
        (
            "hot nadir and seam",
            oracle(16, 8, |x, y| hot(x, y, (15, 7))),
        ),
        ("one texel", oracle(1, 1, noise)),
        ("two columns", oracle(2, 1, noise)),
        ("two rows", oracle(1, 2, noise)),
    ]
}

/// Turned about a slanted axis and mirrored.
fn turned() -> Mat3 {
    let mirror = Mat3::from_diagonal(Vec3::new(-1.0, 1.0, 1.0));
    mirror * Mat3::from_axis_angle(Vec3::new(0.48, 0.6, -0.64), 2.1)
}
