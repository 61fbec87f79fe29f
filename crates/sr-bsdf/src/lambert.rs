//! Ideal diffuse reflection (Lambert 1760): f = ρ/π.

use crate::color::Color;
use crate::local::{has_side, mirror, same_side};
use crate::{BsdfSampleOf, LobeFlags};
use glam::Vec3;
use sr_math::Real;
use sr_math::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// Two-sided ideal diffuse reflection, sampled by the cosine: every weight is the reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert {
    /// Albedo ρ by colour, in [0, 1].
    pub reflectance: Vec3,
}

impl Lambert {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::REFLECTION.with(LobeFlags::DIFFUSE);

    pub(crate) fn eval_pdf<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (Color<R>, R) {
        match same_side(wo, wi) {
            Some((_, wi)) => (
                Color::lift(self.reflectance) * R::INV_PI,
                cosine_hemisphere_pdf(wi[2]),
            ),
            None => (Color::BLACK, R::ZERO),
        }
    }

    pub(crate) fn sample<R: Real>(&self, wo: [R; 3], u: [R; 2]) -> Option<BsdfSampleOf<R>> {
        let wi = cosine_hemisphere(u);
        if !has_side(wo) || !has_side(wi) {
            return None;
        }
        BsdfSampleOf {
            wi: mirror(wi, wo[2] < R::ZERO),
            weight: Color::lift(self.reflectance).0,
            pdf: cosine_hemisphere_pdf(wi[2]),
            lobe: Self::FLAGS,
            eta: R::ONE,
        }
        .checked()
    }
}
