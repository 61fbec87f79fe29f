//! Maps from the unit square to directions and to points on shapes.
//!
//! All are generic over [`Real`] and take `u` in `[0, 1)²`. Local +Z is the pole. Quantities that
//! vanish at an end of the range (cosine at grazing, sine near the pole) are computed from `u`
//! without cancellation, so that their *relative* error stays at a few ulp.

use crate::Real;

/// Radius, cosine and sine of the concentric map; the radius may be negative.
///
/// Shirley, Chiu 1997, "A Low Distortion Map Between Disk and Square". `2u − 1` is exact for `u`
/// on the grid of 2⁻²⁴ that the samplers use, so the radius is exact too.
#[inline(always)]
fn concentric_polar<R: Real>(u: [R; 2]) -> (R, R, R) {
    let two = R::lit(2.0);
    let (a, b) = (two * u[0] - R::ONE, two * u[1] - R::ONE);
    let quarter_pi = R::lit(std::f64::consts::FRAC_PI_4);
    if a.abs() > b.abs() {
        let phi = quarter_pi * (b / a);
        (a, phi.cos(), phi.sin())
    } else if b != R::ZERO {
        let phi = quarter_pi * (a / b);
        (b, phi.sin(), phi.cos())
    } else {
        (R::ZERO, R::ONE, R::ZERO)
    }
}

/// A uniform point of the unit disk.
#[inline]
pub fn concentric_disk<R: Real>(u: [R; 2]) -> [R; 2] {
    let (r, c, s) = concentric_polar(u);
    [r * c, r * s]
}

/// A direction of the upper hemisphere with density [`cosine_hemisphere_pdf`].
///
/// The concentric disk lifted (Malley's method). The height is `√((1 − r)(1 + r))` with an exact
/// `1 − r`, so that it keeps its accuracy at grazing. It is 0 where `r = 1`, which a `u` of 0
/// reaches: such a sample has density 0 and the caller drops it.
#[inline]
pub fn cosine_hemisphere<R: Real>(u: [R; 2]) -> [R; 3] {
    let (r, c, s) = concentric_polar(u);
    [r * c, r * s, ((R::ONE - r) * (R::ONE + r)).safe_sqrt()]
}

/// Density of [`cosine_hemisphere`] per solid angle; 0 below the horizon.
#[inline]
pub fn cosine_hemisphere_pdf<R: Real>(cos_theta: R) -> R {
    cos_theta.max(R::ZERO) * R::INV_PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash;

    /// The `u` on which every map is tried: corners, centre, edges, then hashed ones.
    fn squares() -> impl Iterator<Item = [f32; 2]> {
        const ENDS: [f32; 5] = [0.0, 1.0 / 16_777_216.0, 0.25, 0.5, 1.0 - f32::EPSILON / 2.0];
        let grid = ENDS.into_iter().flat_map(|a| ENDS.map(|b| [a, b]));
        let hashed = (0..20_000u32).map(|i| [0, 1].map(|k| hash::unit_f32(hash::mix(i, k))));
        grid.chain(hashed)
    }

    fn wide<const N: usize>(v: [f32; N]) -> [f64; N] {
        v.map(f64::from)
    }

    /// Largest component of the difference, and the length of the `f64` vector.
    fn apart<const N: usize>(a: [f32; N], b: [f64; N]) -> f64 {
        wide(a)
            .iter()
            .zip(b)
            .map(|(x, y)| (x - y).abs())
            .fold(0.0, f64::max)
    }

    fn length<const N: usize>(v: [f64; N]) -> f64 {
        v.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn concentric_inverse(p: [f64; 2]) -> [f64; 2] {
        use std::f64::consts::FRAC_PI_4;
        let r = length(p);
        let (a, b) = if p[0].abs() > p[1].abs() {
            let a = r.copysign(p[0]);
            (a, a * (p[1] / p[0]).atan() / FRAC_PI_4)
        } else if p[1] != 0.0 {
            let b = r.copysign(p[1]);
            (b * (p[0] / p[1]).atan() / FRAC_PI_4, b)
        } else {
            (0.0, 0.0)
        };
        [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
    }

    /// A few roundings of numbers below 1.
    const ULPS: f64 = 4.0 * f32::EPSILON as f64;

    #[test]
    fn concentric_disk_inverts_and_agrees_with_f64() {
        for u in squares() {
            let p = concentric_disk(u);
            assert!(length(wide(p)) <= 1.0 + ULPS, "{u:?}");
            assert!(apart(p, concentric_disk(wide(u))) < ULPS, "{u:?}");
            assert!(apart(u, concentric_inverse(wide(p))) < ULPS, "{u:?}");
        }
    }

    #[test]
    fn cosine_hemisphere_keeps_its_relative_accuracy_at_grazing() {
        for u in squares() {
            let (w, exact) = (cosine_hemisphere(u), cosine_hemisphere(wide(u)));
            assert!((length(wide(w)) - 1.0).abs() < ULPS, "{u:?}");
            assert!(apart(w, exact) < ULPS, "{u:?}");
            assert!(
                (f64::from(w[2]) - exact[2]).abs() <= ULPS * exact[2],
                "{u:?}"
            );
        }
        assert_eq!(cosine_hemisphere_pdf(-0.5), 0.0);
        assert_eq!(cosine_hemisphere_pdf(1.0), std::f32::consts::FRAC_1_PI);
    }
}
