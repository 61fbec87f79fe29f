//! Distribution functions and quantiles.
//!
//! Thin names over `statrs`; tails are asked for as tails (`erfc`, upper gamma), so that a p-value
//! of 10⁻²⁰ is not rounded to 0.

use statrs::distribution::{ContinuousCDF, StudentsT};
use statrs::function::{beta, erf, gamma};
use std::f64::consts::SQRT_2;

/// Q(a, x) = Γ(a, x)/Γ(a), the upper tail of the gamma distribution of shape `a`; 1 for `x ≤ 0`.
///
/// # Panics
/// When `a` is not positive or `x` is NaN.
pub fn gamma_upper_regularized(a: f64, x: f64) -> f64 {
    assert!(a > 0.0 && !x.is_nan(), "Q({a}, {x}) is not defined");
    if x <= 0.0 {
        1.0
    } else if x.is_infinite() {
        0.0
    } else {
        gamma::gamma_ur(a, x)
    }
}

/// Iₓ(a, b), the regularised incomplete beta function.
///
/// # Panics
/// When `a` or `b` is not positive or `x` lies outside `[0, 1]`.
pub fn beta_regularized(a: f64, b: f64, x: f64) -> f64 {
    beta::beta_reg(a, b, x)
}

/// P(Z ≤ z) of a standard normal variable.
pub fn normal_cdf(z: f64) -> f64 {
    0.5 * erf::erfc(-z / SQRT_2)
}

/// The z with P(Z ≤ z) = p; ±∞ at the ends.
///
/// # Panics
/// When `p` lies outside `[0, 1]`.
pub fn normal_quantile(p: f64) -> f64 {
    assert!((0.0..=1.0).contains(&p), "{p} is not a probability");
    -SQRT_2 * erf::erfc_inv(2.0 * p)
}

/// P(T ≤ t) of Student's t with `dof` degrees of freedom.
///
/// # Panics
/// When `dof` is not positive and finite.
pub fn student_cdf(t: f64, dof: f64) -> f64 {
    student(dof).cdf(t)
}

/// The t with P(T ≤ t) = p; ±∞ at the ends.
///
/// # Panics
/// When `dof` is not positive and finite or `p` lies outside `[0, 1]`.
pub fn student_quantile(p: f64, dof: f64) -> f64 {
    assert!((0.0..=1.0).contains(&p), "{p} is not a probability");
    let tail = student(dof);
    if p > 0.5 {
        return -student_quantile(1.0 - p, dof);
    }
    // Bisection of the distribution: `statrs` has a quantile too, but it is off by 0.2 % at 10⁷
    // degrees of freedom.
    if p == 0.0 {
        return f64::NEG_INFINITY;
    }
    let mut lo = -1.0;
    while tail.cdf(lo) > p {
        lo *= 2.0;
    }
    let mut hi = 0.0;
    loop {
        let mid = 0.5 * (lo + hi);
        if mid <= lo || mid >= hi {
            return hi;
        }
        if tail.cdf(mid) < p {
            lo = mid
        } else {
            hi = mid
        }
    }
}

fn student(dof: f64) -> StudentsT {
    assert!(dof.is_finite() && dof > 0.0, "{dof} degrees of freedom");
    StudentsT::new(0.0, 1.0, dof).expect("location 0, scale 1 and a positive dof are valid")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, relative: f64) {
        assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
    }

    /// Closed forms: Q(1, x) = e⁻ˣ, Q(1/2, x) = erfc √x, Q(n, x) = e⁻ˣ Σ xᵏ/k!.
    #[test]
    fn gamma_tail_has_its_closed_forms() {
        for x in [1e-6, 0.1, 1.0, 7.0, 40.0] {
            close(gamma_upper_regularized(1.0, x), (-x).exp(), 1e-12);
            let half = 2.0 * normal_cdf(-(2.0 * x).sqrt());
            close(gamma_upper_regularized(0.5, x), half, 1e-9);
            let mut term = (-x).exp();
            let mut sum = 0.0;
            for k in 0..10 {
                sum += term;
                term *= x / f64::from(k + 1);
            }
            close(gamma_upper_regularized(10.0, x), sum, 1e-11);
        }
        assert_eq!(gamma_upper_regularized(3.0, 0.0), 1.0);
        assert_eq!(gamma_upper_regularized(3.0, f64::INFINITY), 0.0);
    }

    /// Iₓ(1, b) = 1 − (1 − x)ᵇ, and the reflection Iₓ(a, b) = 1 − I₁₋ₓ(b, a).
    #[test]
    fn beta_has_its_closed_forms() {
        for x in [0.0, 0.01, 0.3, 0.5, 0.99, 1.0f64] {
            close(
                beta_regularized(1.0, 3.0, x),
                1.0 - (1.0 - x).powi(3),
                1e-11,
            );
            let sum = beta_regularized(2.5, 7.0, x) + beta_regularized(7.0, 2.5, 1.0 - x);
            close(sum, 1.0, 1e-12);
        }
    }

    /// Tabulated by Abramowitz and Stegun, table 26.5, and the inverse over sixteen decades.
    #[test]
    fn normal_quantile_inverts_the_distribution() {
        close(normal_quantile(0.975), 1.959_963_984_540_054, 1e-12);
        close(normal_quantile(1e-10), -6.361_340_902_404_056, 1e-9);
        for k in 1..16 {
            let p = 10f64.powi(-k);
            close(normal_cdf(normal_quantile(p)), p, 1e-9);
        }
    }

    /// t with 1 degree is Cauchy, with 2 algebraic, with many normal.
    #[test]
    fn student_has_its_closed_forms() {
        close(
            student_quantile(0.975, 1.0),
            (0.475 * std::f64::consts::PI).tan(),
            1e-9,
        );
        close(
            student_cdf(1.5, 2.0),
            0.5 + 1.5 / (2.0 * (2.0 + 1.5f64.powi(2)).sqrt()),
            1e-12,
        );
        close(student_quantile(0.99, 1e7), normal_quantile(0.99), 1e-6);
        assert_eq!(student_quantile(0.0, 3.0), f64::NEG_INFINITY);
        assert_eq!(student_quantile(1.0, 3.0), f64::INFINITY);
        for dof in [1.0, 3.5, 30.0] {
            close(student_cdf(student_quantile(0.2, dof), dof), 0.2, 1e-9);
        }
    }
}
