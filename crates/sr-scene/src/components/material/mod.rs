//! What things are made of: a material is an entity with one lobe component, and [`Emission`]
//! beside it when it glows.

mod conductor;
mod diffuse;
mod facets;
mod metallic_roughness;
mod rough_dielectric;
mod smooth;

pub use conductor::{Conductor, MetalFresnel};
pub use diffuse::{Lambert, OrenNayar};
pub use facets::{FacetSampling, Ndf};
pub use metallic_roughness::MetallicRoughness;
pub use rough_dielectric::RoughDielectric;
pub use smooth::{Dielectric, Fresnel, Mirror, Refraction, ThinDielectric};

use super::Rgb;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;

/// The material of a shape: the entity that carries its lobe. In RON the entity's name.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Component)]
pub struct MaterialRef(pub Entity);

/// Light that a surface gives off, beside what its lobe scatters.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Emission {
    /// Radiance, W/(m² sr).
    pub radiance: Rgb,
    /// A factor on the radiance.
    pub strength: f32,
    /// Glows on both sides; otherwise on the front only.
    pub two_sided: bool,
}

impl Default for Emission {
    fn default() -> Self {
        Self {
            radiance: Rgb::splat(1.0),
            strength: 1.0,
            two_sided: false,
        }
    }
}

fn out_of_range(field: &str, what: &str) -> String {
    format!("`{field}`: {what}")
}

fn unit_interval(field: &str, x: Rgb) -> Result<(), String> {
    if x.within(0.0, 1.0) {
        return Ok(());
    }
    Err(out_of_range(field, "each channel must be between 0 and 1"))
}

fn zero_to_one(field: &str, x: f32) -> Result<(), String> {
    if (0.0..=1.0).contains(&x) {
        return Ok(());
    }
    Err(out_of_range(field, "must be between 0 and 1"))
}

fn positive(field: &str, x: f32) -> Result<(), String> {
    if x > 0.0 && x.is_finite() {
        return Ok(());
    }
    Err(out_of_range(field, "must be above 0"))
}
