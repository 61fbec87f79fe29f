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

use crate::color::Color;
use crate::dielectric::choose;
use crate::fresnel::fresnel_dielectric;
use crate::local::mirror;
use crate::microfacet::Alpha;
use crate::missing_energy::{MissingEnergy, diffuse_mean};
use sr_math::Real;

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
pub(crate) struct Several<R> {
    /// Its value, importance transported.
    pub f: Color<R>,
    /// Probability of the lobe.
    pub share: R,
    /// Density of `wi` in it.
    pub pdf: R,
}

/// Of reflection and of passage.
type Tints<R> = [Color<R>; 2];

impl Side {
    fn crosses<R: Real>(&self) -> R {
        R::from_f32(self.crosses)
    }
}

impl InterfaceLoss {
    /// `albedo(wo, u, eta)` is what a sample brings back of single scattering, white, from `wo` of the upper
    /// side, η = n_t/n_i seen from there.
    pub fn new(
        alpha: Alpha<f32>,
        ior: f32,
        albedo: impl Fn([f32; 3], [f32; 2], f32) -> f32,
    ) -> Self {
        let table = |eta: f32| MissingEnergy::new(alpha, |wo, u| albedo(wo, u, eta));
        let (outside, inside) = (table(ior), table(1.0 / ior));
        let passes = |eta: f32| {
            let mean = diffuse_mean(|cos| Color::splat(fresnel_dielectric(cos, eta)));
            1.0 - mean.0[0]
        };
        // From the denser side the mean has a kink at the critical angle: take it from the other one.
        let (from_outside, from_inside) = if ior >= 1.0 {
            let t = passes(ior);
            (t, t / (ior * ior))
        } else {
            let t = passes(1.0 / ior);
            (t * (ior * ior), t)
        };
        let (mo, mi) = (outside.average::<f32>(), inside.average::<f32>());
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
    fn sides<R: Real>(&self, eta: R) -> (&Side, &Side) {
        if eta == R::from_f32(self.ior) {
            (&self.outside, &self.inside)
        } else {
            (&self.inside, &self.outside)
        }
    }

    /// Probability of the lobe: its share of the energy.
    pub fn share<R: Real>(&self, wo: [R; 3], eta: R, tints: Tints<R>) -> R {
        let here = self.sides(eta).0;
        let (lost, crosses) = (here.table.missing(wo), here.crosses());
        let [r, t] = tints.map(Color::strength);
        let several = lost * ((R::ONE - crosses) * r + crosses * t);
        several / (several + (R::ONE - lost) * r.max(t)).max(R::MIN_POSITIVE)
    }

    /// What is lost from `wo`, and what comes back of it.
    pub fn albedo<R: Real>(&self, wo: [R; 3], eta: R, tints: Tints<R>) -> (R, Color<R>) {
        let here = self.sides(eta).0;
        let (lost, crosses) = (here.table.missing(wo), here.crosses());
        let tint = tints[0] * (R::ONE - crosses) + tints[1] * crosses;
        (lost, tint * lost)
    }

    /// Probabilities of staying and of crossing.
    fn chances<R: Real>(here: &Side, tints: Tints<R>) -> (R, R) {
        let crosses = here.crosses();
        choose((R::ONE - crosses, tints[0]), (crosses, tints[1]))
    }

    /// For `wo` of the upper side.
    pub fn lobe<R: Real>(&self, wo: [R; 3], wi: [R; 3], eta: R, tints: Tints<R>) -> Several<R> {
        let (here, there) = self.sides(eta);
        let (stay, cross) = Self::chances(here, tints);
        let crosses = here.crosses();
        let (end, part, chance, tint) = if wi[2] > R::ZERO {
            (here, R::ONE - crosses, stay, tints[0])
        } else {
            (there, crosses, cross, tints[1])
        };
        let average = end.table.average::<R>().max(R::MIN_POSITIVE);
        let joint = here.table.missing(wo) * (end.table.missing(wi) / average);
        Several {
            f: tint * (part * joint * R::INV_PI),
            share: self.share(wo, eta, tints),
            pdf: chance * end.table.pdf(wi),
        }
    }

    /// A direction of the lobe, for `wo` of the upper side.
    pub fn sample<R: Real>(&self, uc: R, u: [R; 2], eta: R, tints: Tints<R>) -> Option<[R; 3]> {
        let (here, there) = self.sides(eta);
        if uc < Self::chances(here, tints).0 {
            return here.table.sample(u);
        }
        let wi = there.table.sample(u)?;
        Some(mirror(wi, true))
    }
}
