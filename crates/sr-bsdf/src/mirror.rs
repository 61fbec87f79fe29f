//! Ideal specular reflection.

use crate::local::{has_side, specular};
use crate::{BsdfSample, LobeFlags};
use glam::Vec3;

/// Two-sided ideal mirror, without a Fresnel term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// What a reflection keeps, by colour, in [0, 1].
    pub reflectance: Vec3,
}

impl Mirror {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::REFLECTION.with(LobeFlags::DELTA);

    pub(crate) fn sample(&self, wo: Vec3) -> Option<BsdfSample> {
        if !has_side(wo) {
            return None;
        }
        BsdfSample {
            wi: specular(wo),
            weight: self.reflectance,
            pdf: 1.0,
            lobe: Self::FLAGS,
            eta: 1.0,
        }
        .checked()
    }
}
