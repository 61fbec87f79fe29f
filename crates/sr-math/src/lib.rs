//! Mathematics that the kernels share, and nothing that knows about scenes.
//!
//! Formulas whose stability is in question are generic over [`Real`], so that the `f64`
//! instance is the oracle of the `f32` one that renders. Vectors that stay inside generic code
//! are plain arrays; everything else is `glam`.

mod bounds;
pub mod color;
pub mod distribution;
mod frame;
pub mod hash;
mod ray_origin;
mod real;
pub mod vec3;
pub mod warp;

pub use bounds::Bounds3;
pub use frame::{Frame, orthonormal_basis, to_world};
pub use ray_origin::{gamma, gamma_of, offset_ray_origin};
pub use real::Real;
