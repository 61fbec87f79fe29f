//! What ray queries promise, tested through the public interface.

mod agreement;
mod build_time;
mod determinism;
mod edge_cases;
mod globe;
mod icosphere;
mod spawn;
mod watertight;

use glam::Vec3;
use sr_math::hash::{mix, unit_f32};

/// A number in [0, 1) named by two words.
pub fn unit(i: u32, k: u32) -> f32 {
    unit_f32(mix(i, k))
}

/// A number in [−1, 1) named by two words.
pub fn signed(i: u32, k: u32) -> f32 {
    2.0 * unit(i, k) - 1.0
}

/// A point of the cube [−1, 1)³, from the words `k` to `k + 2`.
pub fn in_cube(i: u32, k: u32) -> Vec3 {
    Vec3::new(signed(i, k), signed(i, k + 1), signed(i, k + 2))
}

/// A direction, uniform on the sphere.
pub fn direction(i: u32, k: u32) -> Vec3 {
    let z = signed(i, k);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (std::f32::consts::TAU * unit(i, k + 1)).sin_cos();
    Vec3::new(r * cos, r * sin, z).normalize()
}
