//! Metal.

use super::facets::{FacetSampling, Facets, Ndf};
use super::out_of_range;
use crate::components::Rgb;
use crate::diagnostics::{nearest, suggest};
use crate::lobes::Lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf::{self, Bsdf, metals};

/// Which Fresnel term a metal uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum MetalFresnel {
    /// Fresnel's equations with a complex index.
    #[default]
    Exact,
    /// The classic assignment's approximation for air against metal.
    Approximate,
}

/// Metal, rough or polished: microfacets with a complex index of refraction.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Conductor {
    /// Symbol or name of a measured metal, in any case; copper where neither it nor an index is given.
    pub metal: Option<String>,
    /// Real part of the index of refraction, by channel; with `k`, instead of `metal`.
    pub eta: Option<Rgb>,
    /// Imaginary part, by channel.
    pub k: Option<Rgb>,
    /// Microfacet roughness α, 0 (a mirror) to 1; 0.1 where no roughness is given.
    pub alpha: Option<f32>,
    /// α along the brush marks' local x; with `alpha_y`, instead of `alpha`.
    pub alpha_x: Option<f32>,
    /// α across.
    pub alpha_y: Option<f32>,
    /// Turns the direction of x about the normal, degrees.
    pub rotation_deg: f32,
    /// Distribution of the facets.
    pub ndf: Ndf,
    /// Fresnel term.
    pub fresnel: MetalFresnel,
    /// How directions are sampled.
    pub sampling: FacetSampling,
    /// Gives back the light that a facet throws onto another, which a single reflection loses.
    pub compensate: bool,
}

impl Conductor {
    /// Complex index, by channel.
    fn index(&self) -> Result<(Rgb, Rgb), String> {
        let (eta, k) = match (&self.metal, self.eta, self.k) {
            (metal, None, None) => {
                let name = metal.as_deref().unwrap_or("Cu");
                let metal = metals::find(name).ok_or_else(|| unknown_metal(name))?;
                return Ok((Rgb(metal.eta.to_array()), Rgb(metal.k.to_array())));
            }
            (Some(_), _, _) => {
                let what = "a named metal has its index and cannot stand beside `eta` and `k`; set \
                            the ones that you do not mean to None";
                return Err(out_of_range("metal", what));
            }
            (None, Some(eta), Some(k)) => (eta, k),
            (None, Some(_), None) => return Err(out_of_range("eta", "needs `k` beside it")),
            (None, None, Some(_)) => return Err(out_of_range("k", "needs `eta` beside it")),
        };
        if !eta.within(f32::MIN_POSITIVE, f32::MAX) {
            return Err(out_of_range("eta", "each channel must be above 0"));
        }
        if !k.within(0.0, f32::MAX) {
            return Err(out_of_range("k", "each channel must be at least 0"));
        }
        Ok((eta, k))
    }
}

fn unknown_metal(name: &str) -> String {
    let lower = name.to_lowercase();
    let names = metals::METALS.iter().map(|m| m.name);
    let hint = match nearest(&lower, names) {
        Some(best) => format!("did you mean `{best}`?"),
        None => suggest(name, metals::METALS.iter().map(|m| m.symbol)),
    };
    out_of_range("metal", &format!("there is no metal `{name}`; {hint}"))
}

impl Lobe for Conductor {
    fn bsdf(&self) -> Result<Bsdf, String> {
        let (eta, k) = self.index()?;
        let facets = Facets {
            ndf: self.ndf,
            alpha: self.alpha,
            alpha_x: self.alpha_x,
            alpha_y: self.alpha_y,
            rotation_deg: self.rotation_deg,
            sampling: self.sampling,
        };
        let fresnel = match self.fresnel {
            MetalFresnel::Exact => bsdf::ConductorFresnel::Exact,
            MetalFresnel::Approximate => bsdf::ConductorFresnel::Approximate,
        };
        let metal = bsdf::Conductor::new(eta.to_vec(), k.to_vec(), fresnel, facets.surface()?);
        Ok(Bsdf::Conductor(if self.compensate {
            metal.compensated()
        } else {
            metal
        }))
    }
}
