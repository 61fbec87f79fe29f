//! Maps from the unit square to directions and to points on shapes.
//!
//! All are generic over [`Real`] and take `u` in `[0, 1)²`. Local +Z is the pole. Quantities that
//! vanish at an end of the range (cosine at grazing, sine near the pole) are computed from `u`
//! without cancellation, so that their *relative* error stays at a few ulp.

mod regular_polygon;
mod spherical_rectangle;

pub use regular_polygon::{regular_polygon, regular_polygon_area};
pub use spherical_rectangle::SphericalRectangle;

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

/// A direction at height `1 − one_minus_z`, turned by `u` of a full circle.
#[inline(always)]
fn at_height<R: Real>(one_minus_z: R, u: R) -> [R; 3] {
    let sin_theta = (one_minus_z * (R::lit(2.0) - one_minus_z)).safe_sqrt();
    let phi = R::lit(2.0) * R::PI * u;
    [
        sin_theta * phi.cos(),
        sin_theta * phi.sin(),
        R::ONE - one_minus_z,
    ]
}

/// A uniform direction of the upper hemisphere; density 1/(2π). Its height is never 0.
#[inline]
pub fn uniform_hemisphere<R: Real>(u: [R; 2]) -> [R; 3] {
    at_height(u[0], u[1])
}

/// A uniform direction; density 1/(4π).
#[inline]
pub fn uniform_sphere<R: Real>(u: [R; 2]) -> [R; 3] {
    at_height(R::lit(2.0) * u[0], u[1])
}

/// `1 − cos θ` of an angle up to 90°, given `sin²θ`; without cancellation.
#[inline]
pub fn one_minus_cos<R: Real>(sin2_theta: R) -> R {
    sin2_theta / (R::ONE + (R::ONE - sin2_theta).safe_sqrt())
}

/// A uniform direction within `theta_max` ≤ 90° of +Z, given `sin²(theta_max)`; density
/// [`uniform_cone_pdf`].
///
/// Accurate down to the smallest cones: their height rounds to 1, their x and y do not.
#[inline]
pub fn uniform_cone<R: Real>(u: [R; 2], sin2_theta_max: R) -> [R; 3] {
    at_height(u[0] * one_minus_cos(sin2_theta_max), u[1])
}

/// Density of [`uniform_cone`] per solid angle, within the cone; infinite for a cone of no width.
#[inline]
pub fn uniform_cone_pdf<R: Real>(sin2_theta_max: R) -> R {
    R::ONE / (R::lit(2.0) * R::PI * one_minus_cos(sin2_theta_max))
}

/// Barycentric coordinates `[b0, b1]` of a uniform point of a triangle; the third is `1 − b0 − b1`.
///
/// Heitz 2019, "A Low-Distortion Map Between Triangle and Square": unlike the square-root map it
/// keeps the stratification of `u`.
#[inline]
pub fn uniform_triangle<R: Real>(u: [R; 2]) -> [R; 2] {
    let half = R::lit(0.5);
    if u[1] > u[0] {
        let b0 = half * u[0];
        [b0, u[1] - b0]
    } else {
        let b1 = half * u[1];
        [u[0] - b1, b1]
    }
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

    #[test]
    fn sphere_maps_invert_and_agree_with_f64() {
        let full = 2.0 * std::f64::consts::PI;
        // φ is one rounded product of up to 2π: its error moves the point by as much.
        let bound = ULPS + full * f64::from(f32::EPSILON);
        for u in squares() {
            let h = uniform_hemisphere(u);
            assert!(h[2] > 0.0);
            for (w, exact, scale) in [
                (h, uniform_hemisphere(wide(u)), 1.0),
                (uniform_sphere(u), uniform_sphere(wide(u)), 2.0),
            ] {
                assert!((length(wide(w)) - 1.0).abs() < ULPS, "{u:?}");
                assert!(apart(w, exact) < bound, "{u:?}");
                let turn = exact[1].atan2(exact[0]).rem_euclid(full) / full;
                let back = [(1.0 - exact[2]) / scale, turn];
                assert!((back[0] - f64::from(u[0])).abs() < 1e-15, "{u:?}");
                // At a pole the angle is lost.
                if exact[0].hypot(exact[1]) > 0.0 {
                    assert!((back[1] - f64::from(u[1])).abs() < 1e-15, "{u:?}");
                }
            }
        }
    }

    /// sin θ of a sample is `√u` of that of the cone, to second order: relative accuracy at every
    /// size shows that nothing was subtracted from 1.
    #[test]
    fn cones_keep_their_relative_accuracy_down_to_1e_30_steradian() {
        for exponent in 0..=30 {
            let sin2 = 10f32.powi(-exponent);
            let pdf = f64::from(uniform_cone_pdf(sin2));
            let exact = uniform_cone_pdf(f64::from(sin2));
            assert!((pdf / exact - 1.0).abs() < ULPS, "{sin2}");
            for u in squares().take(200) {
                let w = uniform_cone(u, sin2);
                let exact = uniform_cone(wide(u), f64::from(sin2));
                assert!((length(wide(w)) - 1.0).abs() < ULPS);
                let radius = exact[0].hypot(exact[1]);
                let bound = (ULPS + 2.0 * std::f64::consts::PI * f64::from(f32::EPSILON)) * radius;
                assert!(
                    apart([w[0], w[1]], [exact[0], exact[1]]) <= bound,
                    "{sin2} {u:?}"
                );
                let one_minus_z = radius * radius / (1.0 + exact[2]);
                let back = one_minus_z / one_minus_cos(f64::from(sin2));
                assert!(
                    (back - f64::from(u[0])).abs() < 1e-12,
                    "{sin2} {u:?}: {back}"
                );
            }
        }
    }

    #[test]
    fn triangle_map_inverts_and_stays_inside() {
        for u in squares() {
            let b = uniform_triangle(u);
            assert!(
                b[0] >= 0.0 && b[1] >= 0.0 && 1.0 - b[0] - b[1] >= 0.0,
                "{u:?}"
            );
            assert!(apart(b, uniform_triangle(wide(u))) < ULPS);
            let b = wide(b);
            let back = if b[1] > b[0] {
                [2.0 * b[0], b[1] + b[0]]
            } else {
                [b[0] + b[1], 2.0 * b[1]]
            };
            assert!(apart(u, back) < ULPS, "{u:?} {back:?}");
        }
    }
}
