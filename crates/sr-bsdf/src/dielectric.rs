//! A smooth interface between two dielectrics.

use crate::color::Color;
use crate::fresnel::{fresnel_dielectric, normal_reflectance, schlick};
use crate::local::{has_side, mirror, specular, up};
use crate::refract::radiance_scale;
use crate::{BsdfSampleOf, LobeFlags, TransportMode, refract};
use glam::Vec3;
use sr_math::Real;

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

    pub(crate) fn sample<R: Real>(
        &self,
        wo: [R; 3],
        uc: R,
        mode: TransportMode,
    ) -> Option<BsdfSampleOf<R>> {
        let eta = relative_ior(wo, self.ior)?;
        let passage = refracted(wo, eta);
        let at = |p: Passage<R>| self.reflectance_at(wo[2].abs(), p.wi[2].abs(), eta);
        let f = passage.map_or(R::ONE, at);
        let tints = [self.reflectance, self.transmittance].map(Color::lift);
        let (reflect, transmit) = choose((f, tints[0]), (R::ONE - f, tints[1]));
        if uc < reflect {
            reflected(wo, tints[0] * (f / reflect), reflect)
        } else {
            passage?.sample(tints[1] * ((R::ONE - f) / transmit), transmit, mode)
        }
    }

    fn reflectance_at<R: Real>(&self, cos_i: R, cos_t: R, eta: R) -> R {
        match self.fresnel {
            FresnelKind::Exact => fresnel_dielectric(cos_i, eta),
            FresnelKind::Schlick => {
                let outer = if eta > R::ONE { cos_i } else { cos_t };
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
pub(crate) fn relative_ior<R: Real>(wo: [R; 3], ior: f32) -> Option<R> {
    let ior = R::from_f32(ior);
    let eta = if wo[2] > R::ZERO { ior } else { R::ONE / ior };
    (has_side(wo) && eta > R::ZERO && eta.is_finite()).then_some(eta)
}

/// Probabilities of reflection and of transmission, by their energy and the strength of their tints.
pub(crate) fn choose<R: Real>(reflected: (R, Color<R>), transmitted: (R, Color<R>)) -> (R, R) {
    let r = reflected.0 * reflected.1.strength();
    let t = transmitted.0 * transmitted.1.strength();
    // Each by its own quotient: 1 − reflect would be inaccurate where little is transmitted.
    let scale = if r + t > R::ZERO {
        R::ONE / (r + t)
    } else {
        R::ZERO
    };
    (r * scale, t * scale)
}

/// The reflected sample.
pub(crate) fn reflected<R: Real>(wo: [R; 3], weight: Color<R>, pdf: R) -> Option<BsdfSampleOf<R>> {
    BsdfSampleOf {
        wi: specular(wo),
        weight: weight.0,
        pdf,
        lobe: crate::Mirror::FLAGS,
        eta: R::ONE,
    }
    .checked()
}

/// A direction on the other side.
#[derive(Clone, Copy)]
pub(crate) struct Passage<R> {
    pub wi: [R; 3],
    pub eta: R,
}

impl<R: Real> Passage<R> {
    /// As a sample of the weight given, which radiance mode scales by (η_i/η_t)².
    pub(crate) fn sample(
        self,
        weight: Color<R>,
        pdf: R,
        mode: TransportMode,
    ) -> Option<BsdfSampleOf<R>> {
        let scale = match mode {
            TransportMode::Radiance => radiance_scale(self.eta),
            TransportMode::Importance => R::ONE,
        };
        BsdfSampleOf {
            wi: self.wi,
            weight: (weight * scale).0,
            pdf,
            lobe: crate::Refraction::FLAGS,
            eta: self.eta,
        }
        .checked()
    }
}

/// Where `wo` refracts to; `None` at total internal reflection.
pub(crate) fn refracted<R: Real>(wo: [R; 3], eta: R) -> Option<Passage<R>> {
    let below = wo[2] < R::ZERO;
    let wi = refract(mirror(wo, below), up(), eta)?;
    Some(Passage {
        wi: mirror(wi, below),
        eta,
    })
}
