//! Smooth surfaces: mirrors and glass.

use super::{positive, unit_interval};
use crate::components::Rgb;
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf};

/// Ideal specular reflection.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Mirror {
    /// Reflectance at every angle, 0 to 1.
    pub reflectance: Rgb,
}

impl Default for Mirror {
    fn default() -> Self {
        Self {
            reflectance: Rgb::splat(1.0),
        }
    }
}

impl Lobe for Mirror {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        Ok(Bsdf::Mirror(bsdf::Mirror {
            reflectance: self.reflectance.to_vec(),
        }))
    }
}

/// Ideal refraction without reflection; black at total internal reflection.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Refraction {
    /// Transmittance of one crossing, 0 to 1.
    pub transmittance: Rgb,
    /// Index of refraction, inside over outside.
    pub ior: f32,
}

impl Default for Refraction {
    fn default() -> Self {
        Self {
            transmittance: Rgb::splat(1.0),
            ior: 1.5,
        }
    }
}

impl Lobe for Refraction {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("transmittance", self.transmittance)?;
        positive("ior", self.ior)?;
        Ok(Bsdf::Refraction(bsdf::Refraction {
            transmittance: self.transmittance.to_vec(),
            ior: self.ior,
        }))
    }
}

/// Which Fresnel term a dielectric uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Fresnel {
    /// Fresnel's equations.
    #[default]
    Exact,
    /// Schlick's approximation, as in the classic assignment.
    Schlick,
}

/// Smooth glass: reflection and refraction by Fresnel's equations.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Dielectric {
    /// Index of refraction, inside over outside.
    pub ior: f32,
    /// Tint of each reflection, 0 to 1.
    pub reflectance: Rgb,
    /// Tint of each crossing, 0 to 1.
    pub transmittance: Rgb,
    /// Fresnel term.
    pub fresnel: Fresnel,
}

impl Default for Dielectric {
    fn default() -> Self {
        Self {
            ior: 1.5,
            reflectance: Rgb::splat(1.0),
            transmittance: Rgb::splat(1.0),
            fresnel: Fresnel::Exact,
        }
    }
}

impl Lobe for Dielectric {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        unit_interval("transmittance", self.transmittance)?;
        positive("ior", self.ior)?;
        Ok(Bsdf::Dielectric(bsdf::Dielectric {
            ior: self.ior,
            reflectance: self.reflectance.to_vec(),
            transmittance: self.transmittance.to_vec(),
            fresnel: match self.fresnel {
                Fresnel::Exact => bsdf::FresnelKind::Exact,
                Fresnel::Schlick => bsdf::FresnelKind::Schlick,
            },
        }))
    }
}

/// A thin pane: glass with both interfaces in one surface, so light passes without bending.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct ThinDielectric {
    /// Index of refraction of the pane.
    pub ior: f32,
    /// Tint of reflection, 0 to 1.
    pub reflectance: Rgb,
    /// Tint of transmission, 0 to 1.
    pub transmittance: Rgb,
}

impl Default for ThinDielectric {
    fn default() -> Self {
        Self {
            ior: 1.5,
            reflectance: Rgb::splat(1.0),
            transmittance: Rgb::splat(1.0),
        }
    }
}

impl Lobe for ThinDielectric {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        unit_interval("transmittance", self.transmittance)?;
        positive("ior", self.ior)?;
        Ok(Bsdf::ThinDielectric(bsdf::ThinDielectric {
            ior: self.ior,
            reflectance: self.reflectance.to_vec(),
            transmittance: self.transmittance.to_vec(),
        }))
    }
}
