//! Ray origins that cannot hit the surface they leave.
//!
//! A computed hit point is off its surface by a rounding error with a known bound. Moving the
//! origin along the geometric normal by that bound is enough, at any scale, and no constant has to
//! be tuned: Pharr, Jakob, Humphreys 2023, "Physically Based Rendering" 4th ed., §6.8.6.

use crate::Real;
use glam::Vec3;

/// γₙ = n u / (1 − n u), u the unit round-off of `f32`: the relative error of n roundings in a
/// row is below it (Higham 2002, "Accuracy and Stability of Numerical Algorithms", lemma 3.1).
#[inline]
pub const fn gamma(n: u32) -> f32 {
    const UNIT_ROUNDOFF: f32 = f32::EPSILON * 0.5;
    let x = n as f32 * UNIT_ROUNDOFF;
    x / (1.0 - x)
}

/// [`gamma`] of the type that a formula is computed in.
#[inline(always)]
pub fn gamma_of<R: Real>(n: u32) -> R {
    let x = R::lit(f64::from(n)) * (R::EPSILON * R::lit(0.5));
    x / (R::ONE - x)
}

/// The origin of a ray that leaves `p` towards `w`, outside the error box `p ± p_err` on the side
/// of the unit geometric normal `ng` that `w` points to.
#[inline]
pub fn offset_ray_origin(p: Vec3, p_err: Vec3, ng: Vec3, w: Vec3) -> Vec3 {
    let d = ng.abs().dot(p_err);
    let offset = if w.dot(ng) < 0.0 { -ng * d } else { ng * d };
    let q = p + offset;
    // The sum rounds; one more step outward covers it.
    Vec3::new(
        step(q.x, offset.x),
        step(q.y, offset.y),
        step(q.z, offset.z),
    )
}

/// The next float in the direction of `towards`, or `x` itself when that is zero.
#[inline]
fn step(x: f32, towards: f32) -> f32 {
    if towards > 0.0 {
        x.next_up()
    } else if towards < 0.0 {
        x.next_down()
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gamma_is_that_of_the_type() {
        for n in 0..300 {
            assert_eq!(gamma_of::<f32>(n), gamma(n));
            let unit = 0.5 * f64::EPSILON * f64::from(n);
            assert_eq!(gamma_of::<f64>(n), unit / (1.0 - unit));
        }
    }

    #[test]
    fn the_origin_leaves_the_error_box_on_the_side_of_w() {
        for i in 0..50_000u32 {
            let h = |k| crate::hash::unit_f32(crate::hash::mix(i, k)) * 2.0 - 1.0;
            let ng = Vec3::new(h(0), h(1), h(2)).normalize();
            let scale = 10f32.powi(i as i32 % 15 - 7);
            let p = Vec3::new(h(3), h(4), h(5)) * scale;
            let p_err = gamma(7) * p.abs();
            for w in [ng, -ng] {
                let q = offset_ray_origin(p, p_err, ng, w).as_dvec3() - p.as_dvec3();
                let moved = q.dot(w.as_dvec3());
                let needed = ng.abs().dot(p_err) as f64;
                assert!(moved >= needed * (1.0 - 1e-6), "{moved} < {needed}");
            }
        }
    }
}
