//! Ideal refraction without reflection.

use crate::dielectric::{refracted, relative_ior};
use crate::{BsdfSample, LobeFlags, TransportMode};
use glam::Vec3;

/// Transmission only, as the classic assignment's refraction lobe: no Fresnel term, and what would be
/// reflected totally is absorbed. +Z is outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refraction {
    /// What a passage keeps, by colour, in [0, 1].
    pub transmittance: Vec3,
    /// Index of refraction inside relative to outside, positive.
    pub ior: f32,
}

impl Refraction {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::TRANSMISSION.with(LobeFlags::DELTA);

    pub(crate) fn sample(&self, wo: Vec3, mode: TransportMode) -> Option<BsdfSample> {
        let eta = relative_ior(wo, self.ior)?;
        refracted(wo, eta)?.sample(self.transmittance, 1.0, mode)
    }
}
