//! A smooth interface between two dielectrics.

use crate::fresnel::{fresnel_dielectric, normal_reflectance, schlick};
use crate::local::{has_side, mirror, specular, strength};
use crate::{BsdfSample, LobeFlags, TransportMode, refract};
use glam::Vec3;

/// Which reflectance a [`Dielectric`] has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FresnelKind {
    /// Fresnel's equations for unpolarised light.
    #[default]
    Exact,
    /// Schlick's approximation, as in the classic assignment. The cosine is that of the less dense
    /// side, from inside too: so it is reciprocal and reaches 1 at the critical angle.
    Schlick,
}

/// Smooth glass: reflects and refracts. +Z is outside.
///
/// One of the two is chosen with a probability in proportion to its Fresnel weight times the largest
/// component of its tint, so that no weight exceeds 1 (in importance mode, and in radiance mode before
/// the factor (η_i/η_t)²). With white tints the probability of reflection is the reflectance, and both
/// weights are 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index of refraction inside relative to outside, positive.
    pub ior: f32,
    /// Tint of every reflection, on either side; 1 is physical.
    pub reflectance: Vec3,
    /// Tint of every passage.
    pub transmittance: Vec3,
    /// Exact or approximate reflectance.
    pub fresnel: FresnelKind,
}

impl Dielectric {
    pub(crate) const FLAGS: LobeFlags = LobeFlags::REFLECTION
        .with(LobeFlags::TRANSMISSION)
        .with(LobeFlags::DELTA);

    pub(crate) fn sample(&self, wo: Vec3, uc: f32, mode: TransportMode) -> Option<BsdfSample> {
        let eta = relative_ior(wo, self.ior)?;
        let passage = refracted(wo, eta);
        let f = passage.map_or(1.0, |p| self.reflectance_at(wo.z.abs(), p.wi.z.abs(), eta));
        let (reflect, transmit) = choose((f, self.reflectance), (1.0 - f, self.transmittance));
        if uc < reflect {
            reflected(wo, self.reflectance * (f / reflect), reflect)
        } else {
            passage?.sample(self.transmittance * ((1.0 - f) / transmit), transmit, mode)
        }
    }

    fn reflectance_at(&self, cos_i: f32, cos_t: f32, eta: f32) -> f32 {
        match self.fresnel {
            FresnelKind::Exact => fresnel_dielectric(cos_i, eta),
            FresnelKind::Schlick => {
                let outer = if eta > 1.0 { cos_i } else { cos_t };
                schlick(outer, normal_reflectance(eta))
            }
        }
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let f = normal_reflectance(self.ior);
        f * self.reflectance + (1.0 - f) * self.transmittance
    }
}

/// η_t/η_i seen from `wo`, unless `wo` is tangent or the index makes no sense.
pub(crate) fn relative_ior(wo: Vec3, ior: f32) -> Option<f32> {
    let eta = if wo.z > 0.0 { ior } else { 1.0 / ior };
    (has_side(wo) && eta > 0.0 && eta.is_finite()).then_some(eta)
}

/// Probabilities of reflection and of transmission, by their energy and the strength of their tints.
pub(crate) fn choose(reflected: (f32, Vec3), transmitted: (f32, Vec3)) -> (f32, f32) {
    let r = reflected.0 * strength(reflected.1);
    let t = transmitted.0 * strength(transmitted.1);
    // Each by its own quotient: 1 − reflect would be inaccurate where little is transmitted.
    let scale = if r + t > 0.0 { 1.0 / (r + t) } else { 0.0 };
    (r * scale, t * scale)
}

/// The reflected sample.
pub(crate) fn reflected(wo: Vec3, weight: Vec3, pdf: f32) -> Option<BsdfSample> {
    BsdfSample {
        wi: specular(wo),
        weight,
        pdf,
        lobe: crate::Mirror::FLAGS,
        eta: 1.0,
    }
    .checked()
}

/// A direction on the other side.
#[derive(Clone, Copy)]
pub(crate) struct Passage {
    pub wi: Vec3,
    pub eta: f32,
}

impl Passage {
    /// As a sample of the weight given, which radiance mode scales by (η_i/η_t)².
    pub(crate) fn sample(self, weight: Vec3, pdf: f32, mode: TransportMode) -> Option<BsdfSample> {
        let scale = match mode {
            TransportMode::Radiance => 1.0 / (self.eta * self.eta),
            TransportMode::Importance => 1.0,
        };
        BsdfSample {
            wi: self.wi,
            weight: weight * scale,
            pdf,
            lobe: crate::Refraction::FLAGS,
            eta: self.eta,
        }
        .checked()
    }
}

/// Where `wo` refracts to; `None` at total internal reflection.
pub(crate) fn refracted(wo: Vec3, eta: f32) -> Option<Passage> {
    let below = wo.z < 0.0;
    let wi = refract(mirror(wo, below).to_array(), [0.0, 0.0, 1.0], eta)?;
    Some(Passage {
        wi: mirror(Vec3::from(wi), below),
        eta,
    })
}
