//! What things are made of: a material is an entity with one lobe component, and [`Emission`]
//! beside it when it glows.

use super::Rgb;
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf};

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

/// A rough metal: Beckmann microfacets, complex index of refraction.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Conductor {
    /// Real part of the index of refraction, by channel.
    pub eta: Rgb,
    /// Imaginary part, by channel.
    pub k: Rgb,
    /// Microfacet roughness α, 0 (a mirror) to 1.
    pub alpha: f32,
}

impl Default for Conductor {
    /// Copper: η and k of the metal integrated against the sRGB primaries.
    fn default() -> Self {
        Self {
            eta: Rgb([0.200_438, 0.924_033, 1.102_212]),
            k: Rgb([3.912_949, 2.452_848, 2.142_188]),
            alpha: 0.1,
        }
    }
}

impl Lobe for Conductor {
    fn bsdf(&self) -> Result<Bsdf, String> {
        if !self.eta.within(f32::MIN_POSITIVE, f32::MAX) {
            return Err(out_of_range("eta", "each channel must be above 0"));
        }
        if !self.k.within(0.0, f32::MAX) {
            return Err(out_of_range("k", "each channel must be at least 0"));
        }
        zero_to_one("alpha", self.alpha)?;
        Ok(Bsdf::Conductor(bsdf::Conductor {
            eta: self.eta.to_vec(),
            k: self.k.to_vec(),
            alpha: self.alpha,
        }))
    }
}

/// The base material of glTF 2.0 (specification, appendix B), with thin transmission
/// (`KHR_materials_transmission`) and `KHR_materials_ior`.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct MetallicRoughness {
    /// Diffuse albedo of the dielectric part, f0 of the metallic part.
    pub base_color: Rgb,
    /// 0 dielectric, 1 metal, a mix between.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1; α is its square.
    pub roughness: f32,
    /// Index of refraction of the dielectric part.
    pub ior: f32,
    /// Share of the diffuse part that is transmitted instead, 0 to 1.
    pub transmission: f32,
}

impl Default for MetallicRoughness {
    fn default() -> Self {
        Self {
            base_color: Rgb::splat(1.0),
            metallic: 1.0,
            roughness: 1.0,
            ior: 1.5,
            transmission: 0.0,
        }
    }
}

impl Lobe for MetallicRoughness {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("base_color", self.base_color)?;
        zero_to_one("metallic", self.metallic)?;
        zero_to_one("roughness", self.roughness)?;
        zero_to_one("transmission", self.transmission)?;
        positive("ior", self.ior)?;
        Ok(Bsdf::MetallicRoughness(bsdf::MetallicRoughness {
            base_color: self.base_color.to_vec(),
            metallic: self.metallic,
            roughness: self.roughness,
            ior: self.ior,
            transmission: self.transmission,
        }))
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
