//! A thin plate of glass.

use crate::dielectric::{Passage, choose, reflected, relative_ior};
use crate::fresnel::{fresnel_dielectric, normal_reflectance};
use crate::local::has_side;
use crate::{BsdfSample, LobeFlags, TransportMode};
use glam::Vec3;

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

    pub(crate) fn sample(&self, wo: Vec3, uc: f32) -> Option<BsdfSample> {
        if !has_side(wo) {
            return None;
        }
        // The same from both sides: the plate is entered from outside.
        let eta = relative_ior(Vec3::Z, self.ior)?;
        let (r, t) = plate(fresnel_dielectric(wo.z, eta));
        let (reflect, transmit) = choose((r, self.reflectance), (t, self.transmittance));
        if uc < reflect {
            reflected(wo, self.reflectance * (r / reflect), reflect)
        } else {
            let weight = self.transmittance * (t / transmit);
            Passage { wi: -wo, eta: 1.0 }.sample(weight, transmit, TransportMode::Importance)
        }
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let (r, t) = plate(normal_reflectance(self.ior));
        r * self.reflectance + t * self.transmittance
    }
}

/// Reflectance and transmittance of a plate whose faces reflect `r`.
fn plate(r: f32) -> (f32, f32) {
    (2.0 * r / (1.0 + r), (1.0 - r) / (1.0 + r))
}
