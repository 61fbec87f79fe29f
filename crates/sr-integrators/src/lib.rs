//! The built-in integrators. They use the seam only, so a stranger's crate can do what they do.
//!
//! `Path`, `PathBsdf` and `Direct` are one machine, the [`wave`], with different settings: the
//! paths of a tile advance together, stage by stage.

mod aov;
mod direct;
mod path;
mod path_bsdf;
pub mod wave;

pub use aov::{Aov, AovSettings, Quantity};
pub use direct::{Direct, DirectSettings, Strategy};
pub use path::{Path, PathSettings};
pub use path_bsdf::PathBsdf;

use sr_pipeline::Pipeline;

/// Plug-in with all of them.
pub fn integrators(pipeline: &mut Pipeline) {
    wave::add::<Path>(pipeline);
    wave::add::<PathBsdf>(pipeline);
    wave::add::<Direct>(pipeline);
    pipeline.add_ray_integrator::<Aov>();
}
