//! Ideal specular reflection.

use crate::color::Color;
use crate::local::{has_side, specular};
use crate::{BsdfSampleOf, LobeFlags};
use glam::Vec3;
use sr_math::Real;

/// Two-sided ideal mirror, without a Fresnel term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// What a reflection keeps, by colour, in [0, 1].
    pub reflectance: Vec3,
}

impl Mirror {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::REFLECTION.with(LobeFlags::DELTA);

    pub(crate) fn sample<R: Real>(&self, wo: [R; 3]) -> Option<BsdfSampleOf<R>> {
        if !has_side(wo) {
            return None;
        }
        BsdfSampleOf {
            wi: specular(wo),
            weight: Color::lift(self.reflectance).0,
            pdf: R::ONE,
            lobe: Self::FLAGS,
            eta: R::ONE,
        }
        .checked()
    }
}
