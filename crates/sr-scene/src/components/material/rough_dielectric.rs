//! Frosted glass.

use super::facets::{FacetSampling, Facets, Ndf};
use super::{positive, unit_interval};
use crate::components::Rgb;
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf};

/// Frosted glass: reflection and refraction at microfacets.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct RoughDielectric {
    /// Index of refraction, inside over outside.
    pub ior: f32,
    /// Tint of each reflection, 0 to 1.
    pub reflectance: Rgb,
    /// Tint of each crossing, 0 to 1.
    pub transmittance: Rgb,
    /// Microfacet roughness α, 0 (clear) to 1; 0.1 where no roughness is given.
    pub alpha: Option<f32>,
    /// α along the brush marks' local x; with `alpha_y`, instead of `alpha`.
    pub alpha_x: Option<f32>,
    /// α across.
    pub alpha_y: Option<f32>,
    /// Turns the direction of x about the normal, degrees.
    pub rotation_deg: f32,
    /// Distribution of the facets.
    pub ndf: Ndf,
    /// How directions are sampled.
    pub sampling: FacetSampling,
    /// Gives back the light that a facet throws onto another, which a single scattering loses.
    pub compensate: bool,
}

impl Default for RoughDielectric {
    fn default() -> Self {
        Self {
            ior: 1.5,
            reflectance: Rgb::splat(1.0),
            transmittance: Rgb::splat(1.0),
            alpha: None,
            alpha_x: None,
            alpha_y: None,
            rotation_deg: 0.0,
            ndf: Ndf::default(),
            sampling: FacetSampling::default(),
            compensate: false,
        }
    }
}

impl Lobe for RoughDielectric {
    fn bsdf(&self) -> Result<Bsdf, String> {
        unit_interval("reflectance", self.reflectance)?;
        unit_interval("transmittance", self.transmittance)?;
        positive("ior", self.ior)?;
        let facets = Facets {
            ndf: self.ndf,
            alpha: self.alpha,
            alpha_x: self.alpha_x,
            alpha_y: self.alpha_y,
            rotation_deg: self.rotation_deg,
            sampling: self.sampling,
        };
        let (r, t) = (self.reflectance.to_vec(), self.transmittance.to_vec());
        let glass = bsdf::RoughDielectric::new(self.ior, r, t, facets.surface()?);
        Ok(Bsdf::RoughDielectric(if self.compensate {
            glass.compensated()
        } else {
            glass
        }))
    }
}
