//! What rough metal and rough glass have in common.

use super::{out_of_range, zero_to_one};
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::bsdf;

/// Roughness α where none is given.
const DEFAULT_ALPHA: f32 = 0.1;

/// The distribution of a rough surface's facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Ndf {
    /// Gaussian slopes, as in the classic assignment.
    #[default]
    Beckmann,
    /// Trowbridge and Reitz's, with longer tails.
    Ggx,
}

/// How directions of a rough lobe are sampled; the picture converges to the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum FacetSampling {
    /// By the facets that are seen.
    #[default]
    Visible,
    /// By all facets, as the classic assignment asks for.
    Ndf,
    /// By the cosine, as for a diffuse surface.
    Cosine,
}

/// The fields of a rough surface, as the author gave them.
pub(super) struct Facets {
    pub ndf: Ndf,
    pub alpha: Option<f32>,
    pub alpha_x: Option<f32>,
    pub alpha_y: Option<f32>,
    pub rotation_deg: f32,
    pub sampling: FacetSampling,
}

impl Facets {
    pub fn surface(&self) -> Result<bsdf::Microsurface, String> {
        let ndf = match self.ndf {
            Ndf::Beckmann => bsdf::Ndf::Beckmann,
            Ndf::Ggx => bsdf::Ndf::Ggx,
        };
        let sampling = match self.sampling {
            FacetSampling::Visible => bsdf::Sampling::Visible,
            FacetSampling::Ndf => bsdf::Sampling::Ndf,
            FacetSampling::Cosine => bsdf::Sampling::Cosine,
        };
        if !self.rotation_deg.is_finite() {
            return Err(out_of_range("rotation_deg", "must be finite"));
        }
        let surface = bsdf::Microsurface::new(ndf, self.alphas()?);
        Ok(surface
            .sampled(sampling)
            .rotated(self.rotation_deg.to_radians()))
    }

    /// Roughness along both tangents.
    fn alphas(&self) -> Result<[f32; 2], String> {
        let both = match (self.alpha, self.alpha_x, self.alpha_y) {
            (alpha, None, None) => {
                let alpha = alpha.unwrap_or(DEFAULT_ALPHA);
                zero_to_one("alpha", alpha)?;
                return Ok([alpha; 2]);
            }
            (None, Some(x), Some(y)) => [x, y],
            (Some(_), _, _) => {
                let what = "is the roughness in every direction and cannot stand beside `alpha_x` and \
                            `alpha_y`; set the ones that you do not mean to None";
                return Err(out_of_range("alpha", what));
            }
            (None, x, _) => {
                let (given, missing) = if x.is_some() {
                    ("alpha_x", "alpha_y")
                } else {
                    ("alpha_y", "alpha_x")
                };
                return Err(out_of_range(given, &format!("needs `{missing}` beside it")));
            }
        };
        zero_to_one("alpha_x", both[0])?;
        zero_to_one("alpha_y", both[1])?;
        Ok(both)
    }
}
