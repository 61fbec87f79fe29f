//! Lights and the choice between them.
//!
//! A light holds its own geometry, relative to the camera, and knows nothing of the scene: whether
//! it is seen is for the caller to ask. Radiance is linear Rec. 709 in W/(m² sr), lengths are metres.
//!
//! [`Light::sample_li`] and [`Light::pdf_li`] make every choice from the reference point alone, so
//! that the second is the density of the first, bit for bit the same branch. Both are written once over
//! [`sr_math::Real`]: [`Light::sample_li_real`] and [`Light::pdf_li_real`] in `f64` are their oracle.

mod area;
mod directional;
mod environment;
mod environment_map;
mod image_environment;
mod light;
mod point;
mod quad;
mod sample;
mod select;
mod sphere;
mod spot;
mod triangle;

pub use directional::DirectionalLight;
pub use environment::ConstantEnvironment;
pub use environment_map::{
    BadTexels, EnvironmentMap, MapError, clamp_negative, direction_of, place_of,
};
pub use image_environment::{EnvironmentSampling, ImageEnvironment};
pub use light::Light;
pub use point::PointLight;
pub use quad::QuadLight;
pub use sample::{EmissionSample, LightSample, LightSampleOf};
pub use select::{LightSampler, LightSelection, Receiver};
pub use sphere::SphereLight;
pub use spot::SpotLight;
pub use triangle::TriangleLight;
