//! Beckmann's distribution of microfacet normals.
//!
//! Slopes are Gaussian, P₂₂ = exp(−(x/α_x)² − (y/α_y)²)/(πα_xα_y) (Beckmann and Spizzichino 1963; Walter et
//! al. 2007, eq. 25; Heitz 2014, section 5.4 for two roughnesses). The shadowing term is the exact one, with the error function, so that the density of
//! visible normals integrates to 1. Normals `h` and directions `w` are unit vectors.

use crate::erf::{erf_inv, erfc};
use crate::microfacet::{Alpha, normal_of_slope, open};
use sr_math::Real;

/// The density of normals D(h), per solid angle; ∫ D·cosθ = 1. 0 below the horizon.
///
/// From the slope (x² + y²)/z², not from 1 − z²: a normal that is nearly the axis keeps its accuracy.
#[inline]
pub fn d<R: Real>(h: [R; 3], alpha: Alpha<R>) -> R {
    let z2 = h[2] * h[2];
    if h[2] <= R::ZERO || z2 < R::MIN_POSITIVE {
        return R::ZERO;
    }
    let alpha2 = alpha.x * alpha.x;
    let e = (-(h[0].sqr() + (h[1] / alpha.ratio).sqr()) / z2 / alpha2).exp();
    if e == R::ZERO {
        return R::ZERO;
    }
    e / (R::PI * alpha2 * z2) / z2 / alpha.ratio
}

/// cosθ·Λ(w), Smith's term times the cosine (Heitz 2014, eq. 72): finite at grazing.
#[inline]
pub fn cos_lambda<R: Real>(w: [R; 3], alpha: Alpha<R>) -> R {
    let c = w[2].abs();
    let spread = alpha.spread(w);
    if spread == R::ZERO {
        return R::ZERO;
    }
    let a = c / spread;
    let gauss = spread * (-(a * a)).exp() / R::PI.sqrt();
    // Both terms fall together; past rounding the difference is 0, not below.
    (R::lit(0.5) * (gauss - c * erfc(a))).max(R::ZERO)
}

/// Smith's Λ(w): how much of the visible microsurface is hidden, relative to what is not.
#[inline]
pub fn lambda<R: Real>(w: [R; 3], alpha: Alpha<R>) -> R {
    cos_lambda(w, alpha) / w[2].abs()
}

/// Masking G₁(w) = 1/(1 + Λ).
#[inline]
pub fn g1<R: Real>(w: [R; 3], alpha: Alpha<R>) -> R {
    let c = w[2].abs();
    c / (c + cos_lambda(w, alpha))
}

/// Height-correlated masking and shadowing G₂ = 1/(1 + Λ_o + Λ_i).
#[inline]
pub fn g2<R: Real>(wo: [R; 3], wi: [R; 3], alpha: Alpha<R>) -> R {
    let (co, ci) = (wo[2].abs(), wi[2].abs());
    co * ci / (co * ci + cos_lambda(wo, alpha) * ci + co * cos_lambda(wi, alpha))
}

/// Density of [`sample_vndf`]: D(h)·max(wo·h, 0)/(cosθ_o (1 + Λ_o)).
#[inline]
pub fn pdf_vndf<R: Real>(wo: [R; 3], h: [R; 3], alpha: Alpha<R>) -> R {
    let seen = wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2];
    d(h, alpha) * seen.max(R::ZERO) / (wo[2].abs() + cos_lambda(wo, alpha))
}

/// A normal that `wo` (on the upper side) sees, with density [`pdf_vndf`].
///
/// The surface is stretched to α_x = α_y = 1 (Heitz and d'Eon 2014). There the slope across the direction of
/// incidence is Gaussian, and the slope along it has the density (cosθ − x sinθ)·exp(−x²) for
/// x < cot θ, whose integral is inverted by Newton's method inside a bracket: as Jakob 2014 does, but in
/// the slope itself, where no inverse error function is needed on the way and grazing is no special
/// case. `u` = 0 is taken half a step inside. The map is monotone in each number.
#[inline]
pub fn sample_vndf<R: Real>(wo: [R; 3], alpha: Alpha<R>, u: [R; 2]) -> [R; 3] {
    let [x, y] = alpha.stretch([wo[0], wo[1]]);
    let r = (x * x + y * y).sqrt();
    let length = (r * r + wo[2] * wo[2]).sqrt();
    let (cos_theta, sin_theta) = if length > R::ZERO {
        (wo[2].max(R::ZERO) / length, r / length)
    } else {
        (R::ONE, R::ZERO)
    };
    let (cos_phi, sin_phi) = if r > R::ZERO {
        (x / r, y / r)
    } else {
        (R::ONE, R::ZERO)
    };
    let along = visible_slope(cos_theta, sin_theta, open(u[0]));
    let across = erf_inv(R::lit(2.0) * open(u[1]) - R::ONE);
    let slope = [
        cos_phi * along - sin_phi * across,
        sin_phi * along + cos_phi * across,
    ];
    normal_of_slope(alpha.stretch(slope))
}

/// A normal of density D(h)·cosθ, whoever looks (Walter et al. 2007, eq. 35–36). `u[0]` = 0 is taken half a
/// step inside.
#[inline]
pub fn sample_ndf<R: Real>(alpha: Alpha<R>, u: [R; 2]) -> [R; 3] {
    let r = (-open(u[0]).ln()).sqrt();
    let phi = R::lit(2.0) * R::PI * u[1];
    normal_of_slope(alpha.stretch([r * phi.cos(), r * phi.sin()]))
}

/// Slopes beyond ±7 have a probability below 10⁻²¹, less than either float type can ask for.
const STEEPEST: f64 = 7.0;

/// The x with F(x) = u·F(cot θ), F(x) = ∫ (c − t·s)·exp(−t²) dt from −∞ to x
/// = c·√π/2·erfc(−x) + s/2·exp(−x²): a sum of positive terms.
fn visible_slope<R: Real>(c: R, s: R, u: R) -> R {
    let half = R::lit(0.5);
    let half_root_pi = half * R::PI.sqrt();
    let gauss = |x: R| (-(x * x)).exp();
    let integral = |x: R| c * half_root_pi * erfc(-x) + half * s * gauss(x);
    let steepest = R::lit(STEEPEST);
    let (mut lo, mut hi) = (-steepest, if c < steepest * s { c / s } else { steepest });
    let target = u * integral(hi);
    // Exact at normal incidence and at grazing; a guess between.
    let mut x = c * erf_inv(R::lit(2.0) * u - R::ONE) - (R::ONE - c) * (-u.ln()).sqrt();
    // Every other step at least halves the bracket or is Newton's; Newton alone takes four or five.
    for _ in 0..100 {
        if x <= lo || x >= hi {
            x = half * (lo + hi);
        }
        let excess = integral(x) - target;
        if excess > R::ZERO {
            hi = x
        } else {
            lo = x
        }
        let step = excess / ((c - x * s) * gauss(x));
        if step.abs() <= R::EPSILON * x.abs().max(half) || hi - lo <= R::EPSILON * x.abs().max(half)
        {
            break;
        }
        x -= step;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash::{mix, unit_f32};

    fn integral(x: f64, c: f64, s: f64) -> f64 {
        c * 0.5 * std::f64::consts::PI.sqrt() * erfc(-x) + 0.5 * s * (-x * x).exp()
    }

    /// F(x) = u·F(cot θ) at every incidence, grazing included: in f64 to 16 ulp of the probability; in
    /// f32 to 16 ulp, and to what one ulp of x itself moves F by.
    #[test]
    fn the_slope_inverts_its_distribution() {
        for i in 0..20_000u32 {
            let c = match i % 4 {
                0 => 0.0,
                1 => 10f32.powf(-8.0 * unit_f32(mix(i, 0))),
                2 => unit_f32(mix(i, 0)),
                _ => 1.0,
            };
            let s = ((1.0 - c) * (1.0 + c)).sqrt();
            let u = open(unit_f32(mix(i, 1)));
            let (cw, sw, uw) = (f64::from(c), f64::from(s), f64::from(u));
            let end = integral(if c < 7.0 * s { cw / sw } else { 7.0 }, cw, sw);
            let wide = integral(visible_slope(cw, sw, uw), cw, sw) / end;
            assert!((wide - uw).abs() < 16.0 * f64::EPSILON, "{c} {u}: {wide}");
            let x = f64::from(visible_slope(c, s, u));
            let slope = (cw - x * sw).abs() * (-x * x).exp() / end;
            let bound = f64::from(f32::EPSILON) * (16.0 + slope * x.abs().max(1.0));
            let single = integral(x, cw, sw) / end;
            assert!((single - uw).abs() < bound, "{c} {u}: {single}");
        }
    }

    /// The numbers that samplers give at the ends of their range have finite slopes.
    #[test]
    fn the_ends_of_the_range_are_finite() {
        for c in [0.0f32, 1e-20, 1e-7, 0.5, 1.0 - f32::EPSILON / 2.0, 1.0] {
            let s = ((1.0 - c) * (1.0 + c)).sqrt();
            for u in [0.0f32, 1.0 / 16_777_216.0, 0.5, 1.0 - f32::EPSILON / 2.0] {
                let x = visible_slope(c, s, open(u));
                assert!(x.is_finite() && x.abs() <= 7.0 && x * s <= c * (1.0 + f32::EPSILON));
            }
        }
    }
}
