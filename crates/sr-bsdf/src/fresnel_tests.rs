//! Fresnel's formulas against the textbook's, against f64, and at their limits.

use super::*;
use sr_math::hash::{mix, unit_f32};

const ULP: f64 = f32::EPSILON as f64;

/// Indices from the nearest to 1 to absurdly dense, on both sides.
fn etas() -> impl Iterator<Item = f32> {
    let few = [
        1.0 + f32::EPSILON,
        1.0 - f32::EPSILON,
        1.0,
        1.001,
        1.33,
        1.5,
        2.42,
        4.0,
        100.0,
    ];
    few.into_iter().flat_map(|e| [e, 1.0 / e])
}

/// 0 and 1, and cosines spaced evenly in themselves and in their logarithm down to 10⁻⁷.
fn cosines() -> impl Iterator<Item = f32> {
    let even = (0..500u32).map(|i| unit_f32(mix(i, 1)));
    let grazing = (0..500u32).map(|i| 10f32.powf(-7.0 * unit_f32(mix(i, 2))));
    [0.0, 1.0].into_iter().chain(even).chain(grazing)
}

fn textbook(c: f64, eta: f64) -> f64 {
    let sin2_t = (1.0 - c * c) / (eta * eta);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let t = (1.0 - sin2_t).sqrt();
    let rs = (c - eta * t) / (c + eta * t);
    let rp = (eta * c - t) / (eta * c + t);
    0.5 * (rs * rs + rp * rp)
}

/// The textbook's differences err by some ulp of 1, divided by a sum that is at least about √ulp where
/// it is not total reflection; 10⁻⁷ covers that and would show any wrong term.
#[test]
fn dielectric_is_the_textbook_formula() {
    for eta in etas().map(f64::from).filter(|&e| e != 1.0) {
        for c in cosines().map(f64::from) {
            let (a, b) = (fresnel_dielectric(c, eta), textbook(c, eta));
            assert!((a - b).abs() < 1e-7, "{c} {eta}: {a} {b}");
        }
    }
    assert!((fresnel_dielectric(1.0, 1.5) - 0.04f64).abs() < 1e-16);
}

/// Mixed forward and backward stability: F32(c) lies within 16 ulp relative of F64 at some cosine within
/// 4 ulp of c. For η → 1 this is relative accuracy of a number of 10⁻¹⁵; at the critical angle it is
/// what the cosine's own rounding allows.
#[test]
fn dielectric_f32_is_stable() {
    for eta in etas() {
        for c in cosines() {
            let (cw, ew) = (f64::from(c), f64::from(eta));
            let oracle = fresnel_dielectric(cw, ew);
            let shaken = [1.0 - 4.0 * ULP, 1.0 + 4.0 * ULP]
                .map(|k| (fresnel_dielectric(cw * k, ew) - oracle).abs());
            let bound = 16.0 * ULP * oracle + shaken[0].max(shaken[1]);
            let f = f64::from(fresnel_dielectric(c, eta));
            assert!((f - oracle).abs() <= bound, "{c} {eta}: {f} {oracle}");
        }
    }
}

#[test]
fn dielectric_keeps_its_accuracy_at_an_index_next_to_one() {
    for eta in [1.0 + f32::EPSILON, 1.0 - f32::EPSILON / 2.0] {
        let exact = ((f64::from(eta) - 1.0) / (f64::from(eta) + 1.0)).powi(2);
        let f = f64::from(fresnel_dielectric(1.0, eta));
        assert!((f - exact).abs() < 8.0 * ULP * exact, "{f} {exact}");
    }
    assert!(cosines().all(|c| fresnel_dielectric(c, 1.0) == 0.0));
}

/// Light takes the same way back: F(c_i, η) = F(c_t, 1/η). In f64; near the critical angle
/// rounding of g² by 10⁻¹⁶ moves F by 10⁻¹⁶/g², which is 10⁻¹⁰ at the g admitted (g seen from inside is c/η).
#[test]
fn dielectric_is_the_same_from_both_sides() {
    for eta in etas().map(f64::from) {
        for c in cosines().map(f64::from) {
            let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
            if g2 > 1e-6 && c / eta.max(1.0) > 1e-3 {
                let back = fresnel_dielectric(g2.sqrt() / eta, 1.0 / eta);
                let there = fresnel_dielectric(c, eta);
                assert!((there - back).abs() < 1e-9, "{c} {eta}: {there} {back}");
            }
        }
    }
}

#[test]
fn total_reflection_and_grazing_are_one() {
    let critical = (1.0f32 - 1.0 / 2.25).sqrt();
    assert_eq!(fresnel_dielectric(critical * 0.99, 1.0 / 1.5), 1.0);
    assert!(fresnel_dielectric(critical * 1.01, 1.0 / 1.5) < 0.7);
    for eta in etas().filter(|&e| e != 1.0) {
        assert!(
            fresnel_dielectric(0.0, eta) > 1.0 - 4.0 * f32::EPSILON,
            "{eta}"
        );
    }
}

/// The definition, in complex arithmetic of pairs: r_s = (c − w)/(c + w), r_p = (n²c − w)/(n²c + w),
/// w = √(n² − sin²).
fn complex_textbook(c: f64, eta: f64, k: f64) -> f64 {
    let n2 = (eta * eta - k * k, 2.0 * eta * k);
    let z = (n2.0 - (1.0 - c * c), n2.1);
    let (r, phi) = (z.0.hypot(z.1).sqrt(), 0.5 * z.1.atan2(z.0));
    let w = (r * phi.cos(), r * phi.sin());
    let norm2 = |a: (f64, f64)| a.0 * a.0 + a.1 * a.1;
    let ratio = |a: (f64, f64)| norm2((a.0 - w.0, a.1 - w.1)) / norm2((a.0 + w.0, a.1 + w.1));
    0.5 * (ratio((c, 0.0)) + ratio((n2.0 * c, n2.1 * c)))
}

const METALS: [(f32, f32); 7] = [
    (0.143, 3.98),
    (1.66, 9.22),
    (0.2, 3.9),
    (3.1, 3.3),
    (1.5, 0.0),
    (0.01, 100.0),
    (2.0, 1e-4),
];

/// Both are sums of few terms of order 1; 10⁻¹¹ is some thousand ulp of f64, for the textbook's n²c.
#[test]
fn conductor_is_the_complex_formula() {
    for (eta, k) in METALS.map(|(a, b)| (f64::from(a), f64::from(b))) {
        for c in cosines().map(f64::from) {
            let (a, b) = (fresnel_conductor(c, eta, k), complex_textbook(c, eta, k));
            assert!((a - b).abs() < 1e-11, "{c} {eta} {k}: {a} {b}");
        }
    }
}

#[test]
fn conductor_without_absorption_is_the_dielectric() {
    for eta in [1.1, 1.5, 3.0f64] {
        for c in cosines().map(f64::from) {
            assert!((fresnel_conductor(c, eta, 0.0) - fresnel_dielectric(c, eta)).abs() < 1e-13);
        }
    }
}

/// Absolute: R is of order 1 for every metal. 32 ulp is 2·10⁻⁶ of a colour.
#[test]
fn conductor_f32_agrees_with_f64() {
    for (eta, k) in METALS {
        for c in cosines() {
            let a = f64::from(fresnel_conductor(c, eta, k));
            let b = fresnel_conductor(f64::from(c), f64::from(eta), f64::from(k));
            assert!((a - b).abs() < 32.0 * ULP, "{c} {eta} {k}: {a} {b}");
        }
    }
}

#[test]
fn no_argument_makes_a_reflectance_outside_its_range() {
    let odd = [
        0.0f32,
        1e-30,
        1e-7,
        0.5,
        1.0,
        1.0 + f32::EPSILON,
        1e4,
        1e19,
        1e30,
        f32::MAX,
    ];
    for c in cosines().chain([-1.0, -1e-7, 1.0 + f32::EPSILON, 1e-30]) {
        for a in odd {
            for b in odd {
                let f = fresnel_conductor(c, a, b);
                assert!((0.0..=1.0).contains(&f), "conductor {c} {a} {b}: {f}");
            }
            if a > 0.0 {
                let f = fresnel_dielectric(c, a);
                assert!((0.0..=1.0).contains(&f), "dielectric {c} {a}: {f}");
            }
            let f = schlick(c, a.min(1.0));
            assert!((0.0..=1.0).contains(&f), "Schlick {c} {a}: {f}");
        }
    }
}

/// At R₀ = 0.04 the approximation is known to stay within 0.04 of Fresnel's; its ends are exact.
#[test]
fn schlick_meets_fresnel_at_the_ends() {
    let r0 = normal_reflectance(1.5f32);
    assert_eq!(schlick(1.0, r0), r0);
    assert_eq!(schlick(0.0, r0), 1.0);
    assert!((normal_reflectance(1.0 / 1.5f32) - r0).abs() < 4.0 * f32::EPSILON * r0);
    for c in cosines() {
        assert!((schlick(c, r0) - fresnel_dielectric(c, 1.5)).abs() < 0.04);
    }
}

/// The classic assignment's expressions, which differ from ours only in how squares are completed: 10⁻¹² relative to
/// 1 in f64. In f32 each sum of squares errs by a few ulp of itself, but (η − c)² is a square of a difference with
/// an error of an ulp of η: 16 ulp absolute, since the quotients are at most 1.
#[test]
fn the_approximation_is_that_of_the_assignment() {
    let metals = [
        (0.143f32, 3.983f32),
        (1.442, 1.603),
        (0.9, 0.0),
        (3.0, 3.3),
        (100.0, 100.0),
    ];
    for (eta, k) in metals {
        for c in cosines() {
            let (n, kw, cw) = (f64::from(eta), f64::from(k), f64::from(c));
            let q = n * n + kw * kw;
            let rs = (q - 2.0 * n * cw + cw * cw) / (q + 2.0 * n * cw + cw * cw);
            let rp = (q * cw * cw - 2.0 * n * cw + 1.0) / (q * cw * cw + 2.0 * n * cw + 1.0);
            let wide = fresnel_conductor_approximate(cw, n, kw);
            assert!((wide - 0.5 * (rs + rp)).abs() < 1e-12, "{eta} {k} {c}");
            let single = f64::from(fresnel_conductor_approximate(c, eta, k));
            assert!(
                (single - wide).abs() < 16.0 * ULP,
                "{eta} {k} {c}: {single} {wide}"
            );
        }
    }
    // Near the exact one for a good metal.
    for c in cosines() {
        let exact = fresnel_conductor(c, 0.143f32, 3.983);
        let off = (fresnel_conductor_approximate(c, 0.143, 3.983) - exact).abs();
        assert!(off < 0.01, "{c}: {off}");
    }
}
