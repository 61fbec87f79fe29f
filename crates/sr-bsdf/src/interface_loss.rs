//! What a rough interface of two dielectrics loses to further facets, and a lobe that gives it back.
//!
//! Kulla and Conty 2017 for two sides. With m the loss of a direction, M its mean over the side it lies on
//! and n the index of that side,
//!
//!   f(wo, wi) = c(wo, wi)·m(wo)·m(wi)/(π·M_i),   c = 1 − b_o within a side, b_o across.
//!
//! Whatever b is, m(wo) comes back in all. Reciprocity across, f(wo, wi)/n_i² = f(wi, wo)/n_o², asks for
//! b_o/(M_i·n_i²) = b_i/(M_o·n_o²). The mean transmittances T of the smooth interface fulfil
//! T_o·n_o² = T_i·n_i², so b_o = T_o·M_i/max(M_o, M_i) does, and neither b exceeds its T.

use crate::dielectric::choose;
use crate::fresnel::fresnel_dielectric;
use crate::local::strength;
use crate::microfacet::Alpha;
use crate::missing_energy::{MissingEnergy, diffuse_mean};
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// The loss from either side.
#[derive(Debug, PartialEq)]
pub(crate) struct InterfaceLoss {
    outside: Side,
    inside: Side,
    ior: f32,
}

#[derive(Debug, PartialEq)]
struct Side {
    table: MissingEnergy,
    /// Share of the loss that crosses the surface, for `wo` on this side.
    crosses: f32,
}

/// The lobe at two directions.
pub(crate) struct Several {
    /// Its value, importance transported.
    pub f: Vec3,
    /// Probability of the lobe.
    pub share: f32,
    /// Density of `wi` in it.
    pub pdf: f32,
}

type Tints = (Vec3, Vec3);

impl InterfaceLoss {
    /// `albedo(wo, u, eta)` is what a sample brings back of single scattering, white, from `wo` of the upper
    /// side, η = n_t/n_i seen from there.
    pub fn new(alpha: Alpha<f32>, ior: f32, albedo: impl Fn(Vec3, Vec2, f32) -> f32) -> Self {
        let table = |eta: f32| MissingEnergy::new(alpha, |wo, u| albedo(wo, u, eta));
        let (outside, inside) = (table(ior), table(1.0 / ior));
        let passes = |eta: f32| {
            let mean = diffuse_mean(|cos| Vec3::splat(fresnel_dielectric(cos, eta)));
            1.0 - mean.x
        };
        // From the denser side the mean has a kink at the critical angle: take it from the other one.
        let (from_outside, from_inside) = if ior >= 1.0 {
            let t = passes(ior);
            (t, t / (ior * ior))
        } else {
            let t = passes(1.0 / ior);
            (t * (ior * ior), t)
        };
        let (mo, mi) = (outside.average(), inside.average());
        let largest = mo.max(mi).max(f32::MIN_POSITIVE);
        Self {
            outside: Side {
                table: outside,
                crosses: from_outside * (mi / largest),
            },
            inside: Side {
                table: inside,
                crosses: from_inside * (mo / largest),
            },
            ior,
        }
    }

    /// The side of `wo` and the other one. η tells them apart, and a side of index 1 is never made.
    fn sides(&self, eta: f32) -> (&Side, &Side) {
        if eta == self.ior {
            (&self.outside, &self.inside)
        } else {
            (&self.inside, &self.outside)
        }
    }

    /// Probability of the lobe: its share of the energy.
    pub fn share(&self, wo: Vec3, eta: f32, (reflectance, transmittance): Tints) -> f32 {
        let here = self.sides(eta).0;
        let lost = here.table.missing(wo);
        let (r, t) = (strength(reflectance), strength(transmittance));
        let several = lost * ((1.0 - here.crosses) * r + here.crosses * t);
        several / (several + (1.0 - lost) * r.max(t)).max(f32::MIN_POSITIVE)
    }

    /// What is lost from `wo`, and what comes back of it.
    pub fn albedo(&self, wo: Vec3, eta: f32, (reflectance, transmittance): Tints) -> (f32, Vec3) {
        let here = self.sides(eta).0;
        let lost = here.table.missing(wo);
        let tint = (1.0 - here.crosses) * reflectance + here.crosses * transmittance;
        (lost, lost * tint)
    }

    /// Probabilities of staying and of crossing.
    fn chances(here: &Side, (reflectance, transmittance): Tints) -> (f32, f32) {
        choose(
            (1.0 - here.crosses, reflectance),
            (here.crosses, transmittance),
        )
    }

    /// For `wo` of the upper side.
    pub fn lobe(&self, wo: Vec3, wi: Vec3, eta: f32, tints: Tints) -> Several {
        let (here, there) = self.sides(eta);
        let (stay, cross) = Self::chances(here, tints);
        let (end, part, chance, tint) = if wi.z > 0.0 {
            (here, 1.0 - here.crosses, stay, tints.0)
        } else {
            (there, here.crosses, cross, tints.1)
        };
        let average = end.table.average().max(f32::MIN_POSITIVE);
        let joint = here.table.missing(wo) * (end.table.missing(wi) / average);
        Several {
            f: tint * (part * joint * FRAC_1_PI),
            share: self.share(wo, eta, tints),
            pdf: chance * end.table.pdf(wi),
        }
    }

    /// A direction of the lobe, for `wo` of the upper side.
    pub fn sample(&self, uc: f32, u: Vec2, eta: f32, tints: Tints) -> Option<Vec3> {
        let (here, there) = self.sides(eta);
        if uc < Self::chances(here, tints).0 {
            return here.table.sample(u);
        }
        let wi = there.table.sample(u)?;
        Some(Vec3::new(wi.x, wi.y, -wi.z))
    }
}
