//! Reflectance of a smooth interface for unpolarised light.
//!
//! `eta` = η_t/η_i seen from the side of the cosine; conductors have the complex index `eta + i·k`
//! relative to that side. Cosines lie in [0, 1].

use sr_math::Real;

/// Fresnel reflectance of a dielectric (Born and Wolf, section 1.5.2); 1 at total internal reflection.
///
/// With c = cosθ_i, g = η·cosθ_t = √(η² − sin²θ_i) and e = η² − 1, the amplitudes are written without
/// differences of nearly equal numbers:
///
///   r_s = −e/(c + g)²,   r_p = e·(η²c² − sin²θ_i)/(η²c + g)²
///
/// (the second is (η⁴c² − g²)/(η²c + g)² after e is factored out). So the result keeps its relative
/// accuracy for η → 1, where the textbook's (c − g)/(c + g) is all rounding error, and at grazing. What
/// remains is the condition of the problem: at the critical angle F has an infinite slope.
#[inline]
pub fn fresnel_dielectric<R: Real>(cos_i: R, eta: R) -> R {
    let c = cos_i.abs().min(R::ONE);
    let e = (eta - R::ONE) * (eta + R::ONE);
    let eta2 = eta * eta;
    let s2 = (R::ONE - c) * (R::ONE + c);
    let g2 = less_sine_squared(eta2, e, c);
    if e == R::ZERO {
        return R::ZERO;
    }
    if g2 <= R::ZERO {
        return R::ONE;
    }
    let g = g2.sqrt();
    let rs = e / (c + g).sqr();
    let p = eta2 * c + g;
    // Divided twice, so that an η⁴ of a very dense medium does not overflow.
    let rp = (e / p) * ((eta2 * c * c - s2) / p);
    (R::lit(0.5) * (rs * rs + rp * rp)).min(R::ONE)
}

/// The real part of n² − sin²θ for a complex index n, given that of n², and of n² − 1 without the rounding of a difference:
/// as n² − sin²θ or as n² − 1 + cos²θ, whichever has the smaller terms and so the smaller rounding. The second serves n
/// near 1, the first n near 0 whose critical angle is near normal incidence.
#[inline]
fn less_sine_squared<R: Real>(n2: R, off_one: R, c: R) -> R {
    let c2 = c * c;
    let s2 = (R::ONE - c) * (R::ONE + c);
    if off_one.abs() + c2 < n2.abs() + s2 {
        off_one + c2
    } else {
        n2 - s2
    }
}

/// Fresnel reflectance of a conductor of complex index `eta + i·k`, exact.
///
/// a + ib = √(η² − k² − sin² + 2iηk) is taken as a complex root: the larger part from a sum, the
/// smaller from the product a·b = ηk, so neither suffers cancellation. R_p is written without a
/// division by the cosine and is 1 at grazing. Beyond the range of the type it is 1, the limit of a
/// perfect conductor.
#[inline]
pub fn fresnel_conductor<R: Real>(cos: R, eta: R, k: R) -> R {
    let c = cos.abs().min(R::ONE);
    let half = R::lit(0.5);
    let c2 = c * c;
    let s2 = (R::ONE - c) * (R::ONE + c);
    let off_one = (eta - R::ONE) * (eta + R::ONE) - k * k;
    let re = less_sine_squared((eta - k) * (eta + k), off_one, c);
    let product = eta * k;
    if off_one == R::ZERO && product == R::ZERO {
        // No interface, at grazing incidence too.
        return R::ZERO;
    }
    let modulus = (re * re + R::lit(4.0) * product * product).sqrt();
    let larger = (half * (modulus + re.abs())).sqrt();
    let smaller = if larger > R::ZERO {
        product / larger
    } else {
        R::ZERO
    };
    let (a, b) = if re >= R::ZERO {
        (larger, smaller)
    } else {
        (smaller, larger)
    };
    let b2 = b * b;
    let quotient = |minus: R, plus: R, shift: R| (minus.sqr() + shift) / (plus.sqr() + shift);
    let rs = quotient(a - c, a + c, b2);
    let rp = rs * quotient(a * c - s2, a * c + s2, b2 * c2);
    let r = half * (rs + rp);
    if r.is_finite() {
        r.clamp_to(R::ZERO, R::ONE)
    } else {
        R::ONE
    }
}

/// Fresnel reflectance of a conductor against air, approximate for |η + ik|² ≫ 1 (Born and Wolf, section
/// 14.2, with cosθ_t ≈ 1), as in the classic assignment:
///
///   R_s = ((η − c)² + k²)/((η + c)² + k²),   R_p = ((ηc − 1)² + (kc)²)/((ηc + 1)² + (kc)²)
///
/// Sums of squares, so there is nothing to cancel. Beyond the range of the type it is 1.
#[inline]
pub fn fresnel_conductor_approximate<R: Real>(cos: R, eta: R, k: R) -> R {
    let c = cos.abs().min(R::ONE);
    let quotient = |minus: R, plus: R, shift: R| (minus.sqr() + shift) / (plus.sqr() + shift);
    let rs = quotient(eta - c, eta + c, k * k);
    let rp = quotient(eta * c - R::ONE, eta * c + R::ONE, (k * c).sqr());
    let r = R::lit(0.5) * (rs + rp);
    if r.is_finite() {
        r.clamp_to(R::ZERO, R::ONE)
    } else {
        R::ONE
    }
}

/// Schlick's approximation, R₀ + (1 − R₀)(1 − cosθ)⁵ (Schlick 1994, eq. 15).
///
/// At an interface the cosine has to be that of the less dense side, whichever side the light comes
/// from: only then is it reciprocal and 1 at the critical angle.
#[inline]
pub fn schlick<R: Real>(cos: R, r0: R) -> R {
    let m = (R::ONE - cos.abs()).max(R::ZERO);
    let m2 = m * m;
    r0 + (R::ONE - r0) * (m2 * m2 * m)
}

/// Reflectance at normal incidence, ((η − 1)/(η + 1))²: Schlick's R₀. The same for η and 1/η.
#[inline]
pub fn normal_reflectance<R: Real>(eta: R) -> R {
    ((eta - R::ONE) / (eta + R::ONE)).sqr()
}

#[cfg(test)]
#[path = "fresnel_tests.rs"]
mod tests;
