//! Rough or polished metal.

use crate::fresnel::fresnel_conductor;
use crate::local::{has_side, mirror, same_side, specular};
use crate::microfacet::{Reflected, half_vector, is_smooth, reflect};
use crate::{BsdfSample, LobeFlags, Mirror, beckmann};
use glam::{Vec2, Vec3};

/// A metal of complex index η + ik with a rough surface: Beckmann's distribution, height-correlated
/// Smith shadowing, exact Fresnel at the half vector (Cook and Torrance 1982; Walter et al. 2007).
/// Two-sided.
///
/// Light that hits a second facet is lost, as in every single-scattering model. Below
/// [`SMOOTH_ALPHA`](crate::microfacet::SMOOTH_ALPHA) the lobe is a mirror with the Fresnel term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Real part of the index, by colour, relative to the outside; not negative.
    pub eta: Vec3,
    /// Imaginary part (extinction), by colour; not negative.
    pub k: Vec3,
    /// Microfacet roughness: root mean square slope times √2, not negative.
    pub alpha: f32,
}

impl Conductor {
    pub(crate) fn flags(&self) -> LobeFlags {
        if is_smooth(self.alpha) {
            Mirror::FLAGS
        } else {
            LobeFlags::REFLECTION | LobeFlags::GLOSSY
        }
    }

    fn fresnel(&self, cos: f32) -> Vec3 {
        let at = |c: usize| fresnel_conductor(cos, self.eta[c], self.k[c]);
        Vec3::new(at(0), at(1), at(2))
    }

    /// The Fresnel term and the lobe under it, for directions of the upper side.
    fn terms(&self, wo: Vec3, wi: Vec3) -> (Vec3, Reflected<f32>) {
        let (o, i) = (wo.to_array(), wi.to_array());
        let (h, cos) = half_vector(o, i);
        let shadow = [
            beckmann::cos_lambda(o, self.alpha),
            beckmann::cos_lambda(i, self.alpha),
        ];
        let lobe = Reflected::new(beckmann::d(h, self.alpha), [wo.z, wi.z], shadow);
        (self.fresnel(cos), lobe)
    }

    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Vec3, f32) {
        match same_side(wo, wi) {
            Some((wo, wi)) if !is_smooth(self.alpha) => {
                let (f, lobe) = self.terms(wo, wi);
                (f * lobe.value, lobe.pdf)
            }
            _ => (Vec3::ZERO, 0.0),
        }
    }

    pub(crate) fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        if !has_side(wo) {
            return None;
        }
        let below = wo.z < 0.0;
        let up = mirror(wo, below);
        let (wi, weight, pdf) = if is_smooth(self.alpha) {
            (specular(up), self.fresnel(up.z), 1.0)
        } else {
            let h = beckmann::sample_vndf(up.to_array(), self.alpha, u.to_array());
            let wi = Vec3::from(reflect(up.to_array(), h));
            let (up, wi) = same_side(up, wi)?;
            let (f, lobe) = self.terms(up, wi);
            (wi, f * lobe.weight, lobe.pdf)
        };
        BsdfSample {
            wi: mirror(wi, below),
            weight,
            pdf,
            lobe: self.flags(),
            eta: 1.0,
        }
        .checked()
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        self.fresnel(1.0)
    }
}
