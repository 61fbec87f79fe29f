//! Diffuse reflection.

use super::{out_of_range, unit_interval};
use crate::components::Rgb;
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf};

/// Ideal diffuse reflection.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Lambert {
    /// Directional-hemispherical reflectance, 0 to 1.
    pub reflectance: Rgb,
}

impl Default for Lambert {
    fn default() -> Self {
        Self {
            reflectance: Rgb::splat(0.5),
        }
    }
}

impl Lobe for Lambert {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        Ok(Bsdf::Lambert(bsdf::Lambert {
            reflectance: self.reflectance.to_vec(),
        }))
    }
}

/// Rough diffuse reflection, such as of plaster: flatter than Lambert's, and brighter towards the light.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct OrenNayar {
    /// Reflectance of a facet, 0 to 1.
    pub reflectance: Rgb,
    /// Standard deviation of the facets' slope angle, degrees, 0 (Lambert) to 90.
    pub sigma_deg: f32,
}

impl Default for OrenNayar {
    fn default() -> Self {
        Self {
            reflectance: Rgb::splat(0.5),
            sigma_deg: 20.0,
        }
    }
}

impl Lobe for OrenNayar {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        if !(0.0..=90.0).contains(&self.sigma_deg) {
            return Err(out_of_range("sigma_deg", "must be between 0 and 90"));
        }
        Ok(Bsdf::OrenNayar(bsdf::OrenNayar {
            reflectance: self.reflectance.to_vec(),
            sigma: self.sigma_deg.to_radians(),
        }))
    }
}
