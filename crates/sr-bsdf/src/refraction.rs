//! Ideal refraction without reflection.

use crate::color::Color;
use crate::dielectric::{refracted, relative_ior};
use crate::{BsdfSampleOf, LobeFlags, TransportMode};
use glam::Vec3;
use sr_math::Real;

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

    pub(crate) fn sample<R: Real>(
        &self,
        wo: [R; 3],
        mode: TransportMode,
    ) -> Option<BsdfSampleOf<R>> {
        let eta = relative_ior(wo, self.ior)?;
        refracted(wo, eta)?.sample(Color::lift(self.transmittance), R::ONE, mode)
    }
}
