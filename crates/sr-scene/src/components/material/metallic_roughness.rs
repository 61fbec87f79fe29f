//! The material of glTF.

use super::{positive, unit_interval, zero_to_one};
use crate::components::Rgb;
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf};

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
