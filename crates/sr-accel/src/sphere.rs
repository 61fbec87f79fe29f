//! Ray and sphere: the quadratic in the form of Haines, Günther, Akenine-Möller 2019, "Precision
//! Improvements for Ray/Sphere Intersection", Ray Tracing Gems ch. 7.
//!
//! The textbook discriminant `b² − 4ac` loses a small or far sphere in the difference of two large
//! squares. Here it comes from the distance of the line's nearest point to the centre, and the
//! nearer root comes from `c/q`, without a difference of like numbers. What is left is the error
//! of `o − centre`, which no formula can get back.

use sr_math::Real;

fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The smallest positive `t` at which `o + t d` is on the sphere.
///
/// From the surface outward there is none, once the origin is outside by 3 u r: then c > 0, and
/// either both roots are negative or, at grazing angles, the nearest point is outside.
#[inline]
pub(crate) fn intersect<R: Real>(o: [R; 3], d: [R; 3], center: [R; 3], radius: R) -> Option<R> {
    let f: [R; 3] = std::array::from_fn(|k| o[k] - center[k]);
    let a = dot(d, d);
    let b = -dot(f, d);
    let to_nearest = b / a;
    let nearest: [R; 3] = std::array::from_fn(|k| f[k] + to_nearest * d[k]);
    let discriminant = radius * radius - dot(nearest, nearest);
    // NaN is a miss, too.
    let real = discriminant >= R::ZERO;
    if !real {
        return None;
    }
    let c = dot(f, f) - radius * radius;
    // The product of both would be subnormal for small spheres and short directions.
    let q = b + (a.sqrt() * discriminant.sqrt()).copysign(b);
    let (t0, t1) = (c / q, q / a);
    let (near, far) = if t0 < t1 { (t0, t1) } else { (t1, t0) };
    if near > R::ZERO {
        Some(near)
    } else if far > R::ZERO {
        Some(far)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash::{mix, unit_f32};

    /// The error of `t` relative to the larger of distance and radius, over sizes and distances.
    #[test]
    fn f32_agrees_with_f64_for_small_large_near_and_far_spheres() {
        let mut compared = 0;
        for i in 0..100_000u32 {
            let r = |k: u32| unit_f32(mix(i, k)) * 2.0 - 1.0;
            let radius = 10f32.powi(i as i32 % 9 - 4);
            let away = 10f32.powi(i as i32 / 9 % 9 - 3);
            let center = [r(0), r(1), r(2)];
            let side = [r(3) * radius, r(4) * radius, r(5) * radius];
            let o = [away * r(6), away * r(7), away * r(8)];
            let d: [f32; 3] = std::array::from_fn(|k| (center[k] + side[k]) - o[k]);
            let wide = |v: [f32; 3]| v.map(f64::from);
            let exact = intersect(wide(o), wide(d), wide(center), f64::from(radius));
            let Some(exact) = exact else { continue };
            let length = dot(wide(d), wide(d)).sqrt();
            let d64 = wide(d);
            let n: [f64; 3] =
                std::array::from_fn(|k| f64::from(o[k]) + exact * d64[k] - f64::from(center[k]));
            let slope = dot(n, d64).abs() / (f64::from(radius) * length);
            // The rim amplifies an error by its slope; the origin near the surface picks a root.
            let f: [f64; 3] = std::array::from_fn(|k| f64::from(o[k]) - f64::from(center[k]));
            let from_surface = (dot(f, f).sqrt() / f64::from(radius) - 1.0).abs();
            let distance = dot(f, f).sqrt();
            let blur = 16.0 * 6e-8 * distance / f64::from(radius);
            if slope < 0.1 + 10.0 * blur.sqrt() || from_surface < 1e-3 {
                continue;
            }
            compared += 1;
            let t = intersect(o, d, center, radius).expect("hit in f64, far from the rim");
            let bound = 16.0 * 6e-8 * (distance + f64::from(radius)) / slope;
            let error = (f64::from(t) - exact).abs() * length;
            assert!(error < bound, "ray {i}: {error} > {bound}");
        }
        assert!(compared > 20_000, "{compared}");
    }

    /// A sphere of 10⁻¹¹ m met by a direction as short: the product of their squares is no normal number.
    #[test]
    fn small_spheres_are_hit_by_short_directions() {
        for scale in [1e-9f32, 1e-10, 1e-11] {
            let o = [scale, 0.0, 3.0 * scale];
            let d = [-0.3 * scale, 0.0, -scale];
            let wide = |v: [f32; 3]| v.map(f64::from);
            let exact = intersect(wide(o), wide(d), [0.0; 3], f64::from(scale));
            let found = intersect(o, d, [0.0; 3], scale).expect("hit");
            let exact = exact.expect("hit in f64");
            assert!(
                (f64::from(found) / exact - 1.0).abs() < 1e-6,
                "{found} {exact}"
            );
        }
    }

    #[test]
    fn from_the_inside_the_far_side_is_hit_and_from_behind_nothing() {
        let c = [1.0f32, 2.0, 3.0];
        assert_eq!(intersect(c, [0.0, 0.0, 2.0], c, 4.0), Some(2.0));
        assert_eq!(intersect([1.0, 2.0, 9.0], [0.0, 0.0, 1.0], c, 4.0), None);
        assert_eq!(
            intersect([1.0, 2.0, 9.0], [0.0, 0.0, -1.0], c, 4.0),
            Some(2.0)
        );
    }
}
