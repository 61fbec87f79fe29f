//! A thin plate of glass.

use crate::color::Color;
use crate::dielectric::{Passage, choose, reflected, relative_ior};
use crate::fresnel::{fresnel_dielectric, normal_reflectance};
use crate::local::{has_side, up};
use crate::{BsdfSampleOf, LobeFlags, TransportMode};
use glam::Vec3;
use sr_math::Real;
use sr_math::vec3::neg;

/// A plate thin enough that light leaves where it came in: it passes straight through.
///
/// All reflections between the two faces are summed (Stokes 1862): R' = R + T²R/(1 − R²) = 2R/(1 + R)
/// and T' = (1 − R)/(1 + R), R the reflectance of one face. The tints multiply the whole of either.
/// Reflection or passage is chosen as in [`Dielectric`](crate::Dielectric). Both sides are outside, so
/// `eta` of a sample is 1 and both modes of transport agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Index of refraction of the plate relative to what surrounds it, positive.
    pub ior: f32,
    /// Tint of what comes back; 1 is physical.
    pub reflectance: Vec3,
    /// Tint of what passes.
    pub transmittance: Vec3,
}

impl ThinDielectric {
    pub(crate) const FLAGS: LobeFlags = crate::Dielectric::FLAGS;

    pub(crate) fn sample<R: Real>(&self, wo: [R; 3], uc: R) -> Option<BsdfSampleOf<R>> {
        if !has_side(wo) {
            return None;
        }
        // The same from both sides: the plate is entered from outside.
        let eta = relative_ior(up(), self.ior)?;
        let (r, t) = plate(fresnel_dielectric(wo[2], eta));
        let tints = [self.reflectance, self.transmittance].map(Color::lift);
        let (reflect, transmit) = choose((r, tints[0]), (t, tints[1]));
        if uc < reflect {
            return reflected(wo, tints[0] * (r / reflect), reflect);
        }
        let passage = Passage {
            wi: neg(wo),
            eta: R::ONE,
        };
        passage.sample(
            tints[1] * (t / transmit),
            transmit,
            TransportMode::Importance,
        )
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let (r, t) = plate(normal_reflectance(self.ior));
        r * self.reflectance + t * self.transmittance
    }
}

/// Reflectance and transmittance of a plate whose faces reflect `r`.
fn plate<R: Real>(r: R) -> (R, R) {
    (R::lit(2.0) * r / (R::ONE + r), (R::ONE - r) / (R::ONE + r))
}
