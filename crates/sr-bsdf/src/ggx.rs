//! The GGX (Trowbridge–Reitz) distribution of microfacet normals.
//!
//! Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33–34; Heitz 2014, section 5.4 for two roughnesses.
//! Normals `h` and directions `w` are unit vectors.

use crate::microfacet::{Alpha, normal_of_slope, open};
use sr_math::Real;

/// The density of normals D(h), per solid angle; ∫ D·cosθ = 1. 0 below the horizon.
///
/// α_x²/(πr(x² + (y/r)² + α_x²z²)²), r = α_y/α_x: the usual (α² − 1)z² + 1 cancels where the lobe is narrow.
#[inline]
pub fn d<R: Real>(h: [R; 3], alpha: Alpha<R>) -> R {
    if h[2] <= R::ZERO {
        return R::ZERO;
    }
    let q = h[0].sqr() + (h[1] / alpha.ratio).sqr() + (alpha.x * h[2]).sqr();
    // One factor α/q at a time, so that a narrow lobe's α² and q² do not underflow.
    (alpha.x / q) * (alpha.x / q) * R::INV_PI / alpha.ratio
}

/// cosθ·Λ(w), Smith's term times the cosine (Heitz 2014, eq. 72): finite at grazing.
///
/// (√(z² + (α_x·x)² + (α_y·y)²) − z)/2, with the difference of roots turned into a quotient.
#[inline]
pub fn cos_lambda<R: Real>(w: [R; 3], alpha: Alpha<R>) -> R {
    let c = w[2].abs();
    let spread2 = alpha.x * alpha.x * (w[0].sqr() + (alpha.ratio * w[1]).sqr());
    if spread2 == R::ZERO {
        return R::ZERO;
    }
    R::lit(0.5) * spread2 / (c + (c * c + spread2).sqrt())
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
/// Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps": on the stretched surface
/// the reflected direction is uniform on a cap. The cap's height and the sum with `wo` are written in
/// `u[1]` without cancellation.
#[inline]
pub fn sample_vndf<R: Real>(wo: [R; 3], alpha: Alpha<R>, u: [R; 2]) -> [R; 3] {
    let [x, y] = alpha.stretch([wo[0], wo[1]]);
    let length = (x * x + y * y + wo[2] * wo[2]).sqrt();
    let [x, y, z] = if length > R::ZERO {
        [x / length, y / length, wo[2].max(R::ZERO) / length]
    } else {
        [R::ZERO, R::ZERO, R::ONE]
    };
    // The cap reaches from the pole down to −z; `down` is the way from the pole.
    let span = R::ONE + z;
    let down = u[1] * span;
    let r = (down * (R::lit(2.0) - down)).safe_sqrt();
    let phi = R::lit(2.0) * R::PI * u[0];
    let [hx, hy] = alpha.stretch([r * phi.cos() + x, r * phi.sin() + y]);
    let hz = (R::ONE - u[1]) * span;
    let norm = (hx.sqr() + hy.sqr() + hz.sqr()).sqrt();
    [hx / norm, hy / norm, hz / norm]
}

/// A normal of density D(h)·cosθ, whoever looks (Walter et al. 2007, eq. 35–36). `u[0]` = 0 is taken half a
/// step inside.
#[inline]
pub fn sample_ndf<R: Real>(alpha: Alpha<R>, u: [R; 2]) -> [R; 3] {
    let v = open(u[0]);
    let r = ((R::ONE - v) / v).sqrt();
    let phi = R::lit(2.0) * R::PI * u[1];
    normal_of_slope(alpha.stretch([r * phi.cos(), r * phi.sin()]))
}
