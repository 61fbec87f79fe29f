//! Refraction at a smooth interface.

use sr_math::Real;

/// The direction that `wo` refracts into at an interface of normal `n`, or `None` at total internal
/// reflection.
///
/// `wo` and `n` are unit vectors with `wo·n ≥ 0`; `eta` = η_t/η_i seen from `wo`, positive. The sine
/// of the refracted angle is taken from the tangential part of `wo`, not from its cosine, and the
/// cosine as √((η − s)(η + s))/η: the result has unit length to a few ulp for every `eta`, where
/// 1 − (1 − cos²)/η² would magnify a rounding error of `wo` by 1/η². Near the critical angle the
/// direction moves like the square root of a change in `wo`, so it is good to √ulp there, as its input
/// is.
#[inline]
pub fn refract<R: Real>(wo: [R; 3], n: [R; 3], eta: R) -> Option<[R; 3]> {
    let cos_i = wo[0] * n[0] + wo[1] * n[1] + wo[2] * n[2];
    let tangent = [
        wo[0] - cos_i * n[0],
        wo[1] - cos_i * n[1],
        wo[2] - cos_i * n[2],
    ];
    let sin_i = (tangent[0].sqr() + tangent[1].sqr() + tangent[2].sqr()).sqrt();
    if sin_i >= eta {
        return None;
    }
    let cos_t = ((R::ONE - sin_i / eta) * (R::ONE + sin_i / eta)).safe_sqrt();
    let at = |k: usize| -(tangent[k] / eta) - cos_t * n[k];
    Some([at(0), at(1), at(2)])
}

/// What radiance is scaled by on a passage, (η_i/η_t)²; `eta` = η_t/η_i.
///
/// On the way back `eta` is a rounded reciprocal. Its own reciprocal is the index again, for nearly every index, so that
/// there and back cancel but for the rounding of one quotient: a path between panes of glass neither loses
/// nor gains light with each turn, where 1/η² both ways drifts by 10⁻⁷.
#[inline(always)]
pub(crate) fn radiance_scale<R: Real>(eta: R) -> R {
    if eta > R::ONE {
        R::ONE / (eta * eta)
    } else {
        let back = R::ONE / eta;
        back * back
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash::{mix, unit_f32};

    const UP: [f32; 3] = [0.0, 0.0, 1.0];
    const ETAS: [f32; 9] = [0.01, 0.2, 0.667, 0.999, 1.0, 1.000_000_1, 1.5, 2.42, 100.0];

    fn directions() -> impl Iterator<Item = [f32; 3]> {
        (0..2000u32).map(|i| {
            // Cosines down to 10⁻⁶, evenly in the logarithm.
            let z = 10f32.powf(-6.0 * unit_f32(mix(i, 0)));
            let phi = std::f32::consts::TAU * unit_f32(mix(i, 1));
            let r = ((1.0 - z) * (1.0 + z)).sqrt();
            [r * phi.cos(), r * phi.sin(), z]
        })
    }

    fn length(w: [f32; 3]) -> f64 {
        w.iter().map(|&x| f64::from(x).powi(2)).sum::<f64>().sqrt()
    }

    /// Unit length and Snell's law for every η. The sine is right to 4 ulp, and a length made of a
    /// sine and a cosine that both err by k ulp errs by no more.
    #[test]
    fn refracted_directions_are_unit_and_obey_snell() {
        for eta in ETAS {
            for wo in directions() {
                let Some(wt) = refract(wo, UP, eta) else {
                    assert!(wo[0].hypot(wo[1]) >= eta * (1.0 - f32::EPSILON));
                    continue;
                };
                assert!(
                    (length(wt) - 1.0).abs() < 4.0 * f64::from(f32::EPSILON),
                    "{wo:?} {eta}"
                );
                for k in 0..2 {
                    assert!((wt[k] * eta + wo[k]).abs() <= 2.0 * f32::EPSILON * wo[k].abs());
                }
                assert!(wt[2] <= 0.0);
            }
        }
    }

    /// Away from the critical angle a change δ of the input moves the cosine by at most
    /// tanθ_t·δ/cosθ_t relative to 1: the bound is that condition number, and never above √(8 ulp).
    #[test]
    fn f32_agrees_with_f64_within_the_condition_number() {
        let ulp = f64::from(f32::EPSILON);
        for eta in ETAS {
            for wo in directions() {
                let wide = refract(wo.map(f64::from), UP.map(f64::from), f64::from(eta));
                if let (Some(a), Some(b)) = (refract(wo, UP, eta), wide) {
                    let bound = (4.0 * ulp / b[2].abs()).min((8.0 * ulp).sqrt());
                    for k in 0..3 {
                        assert!(
                            (f64::from(a[k]) - b[k]).abs() <= bound,
                            "{wo:?} {eta} {a:?} {b:?}"
                        );
                    }
                }
            }
        }
    }

    /// There and back again gives the direction, for a tilted normal too; in f64, 10⁻¹² is a thousand
    /// ulp, times the condition number.
    #[test]
    fn refraction_is_reversible() {
        let n = [0.48, -0.6, 0.64];
        for eta in ETAS.map(f64::from) {
            for wo in directions() {
                // Unit in f64 too, as what comes back will be.
                let wo = wo.map(|x| f64::from(x) / length(wo));
                let cos: f64 = (0..3).map(|k| wo[k] * n[k]).sum();
                if cos <= 1e-3 {
                    continue;
                }
                if let Some(wt) = refract(wo, n, eta) {
                    let below = n.map(|x| -x);
                    let cos_t: f64 = (0..3).map(|k| wt[k] * below[k]).sum();
                    if let Some(back) = refract(wt, below, 1.0 / eta) {
                        for k in 0..3 {
                            let bound = 1e-12 / cos_t.min(cos).max(1e-6) * eta.max(1.0);
                            assert!((back[k] - wo[k]).abs() < bound);
                        }
                    } else {
                        panic!("no way back from {wt:?}");
                    }
                }
            }
        }
    }
}
