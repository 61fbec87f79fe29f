//! Rough diffuse reflection.

use crate::color::Color;
use crate::local::{has_side, mirror, same_side};
use crate::{BsdfSampleOf, Lambert, LobeFlags};
use glam::Vec3;
use sr_math::Real;
use sr_math::warp::{cosine_hemisphere, uniform_hemisphere};

/// A diffuse surface of V-shaped grooves, flatter and brighter towards the light than Lambert's (Oren and Nayar
/// 1994). Two-sided.
///
/// The form is that of Portsmouth, Kutz and Hill 2024, "EON: A Practical Energy-Preserving Rough Diffuse BRDF":
/// Fujii's variant of the model, which has no dark ring, and a reciprocal lobe for light between facets, so
/// that the white surface returns exactly what it gets at every angle. (The qualitative model of 1994 returns
/// 1.014 of it near grazing at σ = 10°, and 0.77 head on at 30°.) Fujii's roughness r is taken such that the two terms of
/// the model have the ratio B/A of Oren and Nayar's qualitative one (eq. 30 there) at the same σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar {
    /// Albedo of a facet by colour, in [0, 1].
    pub reflectance: Vec3,
    /// Standard deviation of the slope angle, radian; 0 is Lambert.
    pub sigma: f32,
}

/// Fujii's model of roughness r and albedo 1, and what it loses.
#[derive(Clone, Copy, Debug)]
struct Fujii<R> {
    r: R,
    /// A = 1/(1 + r·(1/2 − 2/(3π))).
    a: R,
}

impl<R: Real> Fujii<R> {
    fn new(sigma: R) -> Self {
        let s2 = sigma.sqr();
        let a = R::ONE - R::lit(0.5) * s2 / (s2 + R::lit(0.33));
        let b = R::lit(0.45) * s2 / (s2 + R::lit(0.09));
        let r = b / a;
        Self {
            r,
            a: R::ONE / (R::ONE + Self::fall() * r),
        }
    }

    /// 1/2 − 2/(3π).
    fn fall() -> R {
        R::lit(0.5) - R::lit(2.0) / (R::lit(3.0) * R::PI)
    }

    /// π·f for directions of the upper side.
    fn value(&self, wo: [R; 3], wi: [R; 3]) -> R {
        let s = wo[0] * wi[0] + wo[1] * wi[1];
        let t = if s > R::ZERO {
            wo[2].max(wi[2])
        } else {
            R::ONE
        };
        self.a * (R::ONE + self.r * (s / t))
    }

    /// (1 − E(cosθ))/(A·r), E = A·(1 + r·G/π) the albedo. Without the factor there is nothing to cancel where the
    /// roughness is small.
    ///
    /// G = sinθ·(θ − sinθ·cosθ) + (2/3)·(tanθ·(1 − sin³θ) − sinθ); tanθ·(1 − sin³θ) is written as
    /// sinθ·cosθ·(1 + sinθ + sin²θ)/(1 + sinθ), which is finite at grazing.
    fn lost(cos: R) -> R {
        let c = cos.min(R::ONE);
        let s = ((R::ONE - c) * (R::ONE + c)).sqrt();
        let tail = s * c * (R::ONE + s + s * s) / (R::ONE + s) - s;
        let g = s * (c.acos() - s * c) + R::lit(2.0) / R::lit(3.0) * tail;
        (Self::fall() - g * R::INV_PI).max(R::ZERO)
    }

    /// The same of the mean albedo 2 ∫ E(μ)·μ dμ = A·(1 + r·(2/3 − 28/(15π))).
    fn mean_lost() -> R {
        let rise = R::lit(2.0) / R::lit(3.0) - R::lit(28.0) / (R::lit(15.0) * R::PI);
        Self::fall() - rise
    }
}

impl OrenNayar {
    pub(crate) const FLAGS: LobeFlags = Lambert::FLAGS;

    /// What is left of light between facets: ρ²·Ē/(1 − ρ·(1 − Ē)), Ē the mean albedo of one scattering.
    fn survives<R: Real>(&self, rough: Fujii<R>) -> Color<R> {
        let rho = Color::lift(self.reflectance);
        let lost = rough.a * rough.r * Fujii::<R>::mean_lost();
        rho * rho * (R::ONE - lost) / (Color::WHITE - rho * lost)
    }

    fn rough<R: Real>(&self) -> Fujii<R> {
        Fujii::new(R::from_f32(self.sigma))
    }

    /// Value and density for directions of the upper side.
    fn terms<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (Color<R>, R) {
        let rough = self.rough();
        let single = Color::lift(self.reflectance) * rough.value(wo, wi);
        let (lost_o, lost_i) = (Fujii::lost(wo[2]), Fujii::lost(wi[2]));
        let joint = rough.a * rough.r * (lost_o * lost_i / Fujii::<R>::mean_lost());
        let several = self.survives(rough) * joint;
        let share = uniform_share(rough.r, wo);
        let pdf = (share * R::lit(0.5) + (R::ONE - share) * wi[2]) * R::INV_PI;
        ((single + several) * R::INV_PI, pdf)
    }

    pub(crate) fn eval_pdf<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (Color<R>, R) {
        match same_side(wo, wi) {
            Some((wo, wi)) => self.terms(wo, wi),
            None => (Color::BLACK, R::ZERO),
        }
    }

    /// By the cosine, and by a share of r·sinθ_o/(1 + r·sinθ_o) uniformly: the retroreflecting term does not fall
    /// with the cosine. The weights are at most 2(1 + r) and about 1.
    pub(crate) fn sample<R: Real>(&self, wo: [R; 3], uc: R, u: [R; 2]) -> Option<BsdfSampleOf<R>> {
        let below = wo[2] < R::ZERO;
        let share = uniform_share(self.rough().r, wo);
        let wi = if uc < share {
            uniform_hemisphere(u)
        } else {
            cosine_hemisphere(u)
        };
        let (up, wi) = same_side(mirror(wo, below), wi)?;
        if !has_side(wo) {
            return None;
        }
        let (f, pdf) = self.terms(up, wi);
        BsdfSampleOf {
            wi: mirror(wi, below),
            weight: (f * (wi[2] / pdf)).0,
            pdf,
            lobe: Self::FLAGS,
            eta: R::ONE,
        }
        .checked()
    }

    /// One scattering and the light between facets, at normal incidence.
    pub(crate) fn albedo(&self) -> Vec3 {
        let rough = self.rough::<f32>();
        let lost = rough.a * rough.r * Fujii::lost(1.0);
        self.reflectance * (1.0 - lost) + self.survives(rough).narrow() * lost
    }
}

/// Probability of uniform sampling.
fn uniform_share<R: Real>(r: R, wo: [R; 3]) -> R {
    let term = r * (wo[0] * wo[0] + wo[1] * wo[1]).sqrt().min(R::ONE);
    term / (R::ONE + term)
}
