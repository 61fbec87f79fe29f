//! The GGX (Trowbridge–Reitz) distribution of microfacet normals, isotropic.
//!
//! Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33–34. Normals `h` and directions `w` are unit
//! vectors; `alpha` > 0.

use sr_math::Real;

/// The density of normals D(h), per solid angle; ∫ D·cosθ = 1. 0 below the horizon.
///
/// α²/(π(x² + y² + α²z²)²): the usual (α² − 1)z² + 1 cancels where the lobe is narrow.
#[inline]
pub fn d<R: Real>(h: [R; 3], alpha: R) -> R {
    if h[2] <= R::ZERO {
        return R::ZERO;
    }
    let q = h[0].sqr() + h[1].sqr() + (alpha * h[2]).sqr();
    // One factor α/q at a time, so that a narrow lobe's α² and q² do not underflow.
    (alpha / q) * (alpha / q) * R::INV_PI
}

/// cosθ·Λ(w), Smith's term times the cosine (Heitz 2014, eq. 72): finite at grazing.
///
/// (√(z² + α²(x² + y²)) − z)/2, with the difference of roots turned into a quotient.
#[inline]
pub fn cos_lambda<R: Real>(w: [R; 3], alpha: R) -> R {
    let c = w[2].abs();
    let spread2 = alpha * alpha * (w[0].sqr() + w[1].sqr());
    if spread2 == R::ZERO {
        return R::ZERO;
    }
    R::lit(0.5) * spread2 / (c + (c * c + spread2).sqrt())
}

/// Smith's Λ(w): how much of the visible microsurface is hidden, relative to what is not.
#[inline]
pub fn lambda<R: Real>(w: [R; 3], alpha: R) -> R {
    cos_lambda(w, alpha) / w[2].abs()
}

/// Masking G₁(w) = 1/(1 + Λ).
#[inline]
pub fn g1<R: Real>(w: [R; 3], alpha: R) -> R {
    let c = w[2].abs();
    c / (c + cos_lambda(w, alpha))
}

/// Height-correlated masking and shadowing G₂ = 1/(1 + Λ_o + Λ_i).
#[inline]
pub fn g2<R: Real>(wo: [R; 3], wi: [R; 3], alpha: R) -> R {
    let (co, ci) = (wo[2].abs(), wi[2].abs());
    co * ci / (co * ci + cos_lambda(wo, alpha) * ci + co * cos_lambda(wi, alpha))
}

/// Density of [`sample_vndf`]: D(h)·max(wo·h, 0)/(cosθ_o (1 + Λ_o)).
#[inline]
pub fn pdf_vndf<R: Real>(wo: [R; 3], h: [R; 3], alpha: R) -> R {
    let seen = wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2];
    d(h, alpha) * seen.max(R::ZERO) / (wo[2].abs() + cos_lambda(wo, alpha))
}

/// A normal that `wo` (on the upper side) sees, with density [`pdf_vndf`].
///
/// Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps": on the stretched surface
/// the reflected direction is uniform on a cap. The cap's height and the sum with `wo` are written in
/// `u[1]` without cancellation.
#[inline]
pub fn sample_vndf<R: Real>(wo: [R; 3], alpha: R, u: [R; 2]) -> [R; 3] {
    let (x, y) = (alpha * wo[0], alpha * wo[1]);
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
    let h = [
        alpha * (r * phi.cos() + x),
        alpha * (r * phi.sin() + y),
        (R::ONE - u[1]) * span,
    ];
    let norm = (h[0].sqr() + h[1].sqr() + h[2].sqr()).sqrt();
    h.map(|k| k / norm)
}
