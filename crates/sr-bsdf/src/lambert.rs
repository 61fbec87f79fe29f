//! Ideal diffuse reflection (Lambert 1760): f = ρ/π.

use crate::local::{has_side, mirror, same_side};
use crate::{BsdfSample, LobeFlags};
use glam::{Vec2, Vec3};
use sr_math::warp::{cosine_hemisphere, cosine_hemisphere_pdf};
use std::f32::consts::FRAC_1_PI;

/// Two-sided ideal diffuse reflection, sampled by the cosine: every weight is the reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert {
    /// Albedo ρ by colour, in [0, 1].
    pub reflectance: Vec3,
}

impl Lambert {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::REFLECTION.with(LobeFlags::DIFFUSE);

    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Vec3, f32) {
        match same_side(wo, wi) {
            Some((_, wi)) => (self.reflectance * FRAC_1_PI, cosine_hemisphere_pdf(wi.z)),
            None => (Vec3::ZERO, 0.0),
        }
    }

    pub(crate) fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        let wi = Vec3::from(cosine_hemisphere(u.to_array()));
        if !has_side(wo) || !has_side(wi) {
            return None;
        }
        BsdfSample {
            wi: mirror(wi, wo.z < 0.0),
            weight: self.reflectance,
            pdf: cosine_hemisphere_pdf(wi.z),
            lobe: Self::FLAGS,
            eta: 1.0,
        }
        .checked()
    }
}
