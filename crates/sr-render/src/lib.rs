//! The sealed scene: flat tables with `u32` ids, and the queries that integrators ask of it.
//!
//! Knows no ECS. Everything here is plain data behind `&`, shared by all threads.

mod brush;
mod camera;
mod features;
mod lens;
mod scene;
mod surface;

pub use brush::Brush;
pub use camera::{Camera, CameraConnection, Projection};
pub use features::SceneFeatures;
pub use lens::{Aperture, Lens};
pub use scene::{
    BoundingSphere, LightId, Material, MaterialId, RenderScene, SceneTables, Shape, ShapeId,
    ShapeNormals,
};
pub use surface::{LightConnection, SurfacePoint};

pub use sr_accel as accel;
pub use sr_bsdf as bsdf;
pub use sr_film as film;
pub use sr_light as light;
pub use sr_math as math;
pub use sr_sampling as sampling;
