//! Properties that both microfacet distributions share, and their f32 against their f64.

use crate::microfacet::Alpha;
use crate::{beckmann, ggx};
use sr_math::Real;
use sr_math::hash::{mix, unit_f32};
use sr_stats::{SphereBins, chi2_test, sidak};

/// A distribution in one float type.
#[derive(Clone, Copy)]
struct Ndf<R: Real> {
    name: &'static str,
    d: fn([R; 3], Alpha<R>) -> R,
    cos_lambda: fn([R; 3], Alpha<R>) -> R,
    sample: fn([R; 3], Alpha<R>, [R; 2]) -> [R; 3],
    pdf: fn([R; 3], [R; 3], Alpha<R>) -> R,
    sample_all: fn(Alpha<R>, [R; 2]) -> [R; 3],
}

fn both<R: Real>() -> [Ndf<R>; 2] {
    [
        Ndf {
            name: "Beckmann",
            d: beckmann::d,
            cos_lambda: beckmann::cos_lambda,
            sample: beckmann::sample_vndf,
            pdf: beckmann::pdf_vndf,
            sample_all: beckmann::sample_ndf,
        },
        Ndf {
            name: "GGX",
            d: ggx::d,
            cos_lambda: ggx::cos_lambda,
            sample: ggx::sample_vndf,
            pdf: ggx::pdf_vndf,
            sample_all: ggx::sample_ndf,
        },
    ]
}

const ALPHAS: [f64; 6] = [1e-4, 1e-3, 0.02, 0.2, 0.7, 1.5];
/// α_y/α_x.
const RATIOS: [f64; 3] = [1.0, 0.2, 8.0];

fn alphas() -> impl Iterator<Item = (f64, f64)> {
    let all = ALPHAS.into_iter().flat_map(|a| RATIOS.map(|r| (a, r)));
    all.filter(|(a, r)| a * r >= 1e-4 && a * r < 3.0)
}

/// Both roughnesses, in one float type.
fn lit<R: Real>((x, ratio): (f64, f64)) -> Alpha<R> {
    Alpha {
        x: R::lit(x),
        ratio: R::lit(ratio),
    }
}

/// Width of the narrower direction.
fn narrow((x, ratio): (f64, f64)) -> f64 {
    x * ratio.min(1.0)
}
const COSINES: [f64; 6] = [0.0, 1e-4, 0.01, 0.1, 0.6, 1.0];

fn direction(cos: f64) -> [f64; 3] {
    let (sin, phi) = (((1.0 - cos) * (1.0 + cos)).sqrt(), 2.3f64);
    [sin * phi.cos(), sin * phi.sin(), cos]
}

/// ∫ D·max(w·h, 0) dh = cosθ·(1 + Λ) for every w: Smith's identity, which ties D to Λ, and at w = z the
/// normalisation. Quadrature on bins that follow the lobe; 10⁻⁴ is its accuracy, and would show Walter's
/// rational fit of Λ (0.35 %).
#[test]
fn the_visible_area_is_the_projected_area() {
    for ndf in both::<f64>() {
        for alpha in alphas() {
            let bins = SphereBins::focused(48, 16, [0.0, 0.0, 1.0], narrow(alpha));
            let name = alpha;
            let alpha = lit(alpha);
            for w in COSINES.map(direction) {
                let seen = |h: [f64; 3]| (0..3).map(|k| w[k] * h[k]).sum::<f64>().max(0.0);
                let smith = w[2] + (ndf.cos_lambda)(w, alpha);
                let density = |h: [f64; 3]| (ndf.d)(h, alpha) * seen(h) / smith;
                let ratio: f64 = bins.integrate(density).iter().sum();
                assert!(
                    (ratio - 1.0).abs() < 1e-4,
                    "{} {name:?} {w:?}: {ratio}",
                    ndf.name
                );
            }
        }
    }
}

/// Normals in either precision against their density, the visible ones and all of them; the tests on fixed
/// seeds share a false-alarm rate of 10⁻³. 10⁵ samples find a relative error of 2 % of the density.
#[test]
fn normals_follow_their_density() {
    normals::<f32>(0);
    normals::<f64>(1);
}

fn normals<R: Real>(seed: u32) {
    let alphas: Vec<_> = alphas().filter(|&a| narrow(a) > 1.5e-4).collect();
    let level = sidak(1e-3, 4 * alphas.len() * (COSINES.len() + 1));
    for (n, ndf) in both::<R>().into_iter().enumerate() {
        for (a, &roughness) in alphas.iter().enumerate() {
            let alpha = lit(roughness);
            // No direction stands for all normals.
            let cosines = COSINES.into_iter().map(Some).chain([None]);
            // Two roughnesses share their formulas with one: every third direction is enough.
            let step = if roughness.1 == 1.0 { 1 } else { 3 };
            let cosines = cosines.step_by(step);
            for (c, cos) in cosines.enumerate() {
                let wo = direction(cos.unwrap_or(1.0)).map(R::lit);
                let samples = 100_000u32;
                let key = mix(seed, (n * 1000 + a * 10 + c) as u32);
                let draw = |i: u32| {
                    let u = [0, 1].map(|k| R::from_f32(unit_f32(mix(mix(key, i), k))));
                    let h = match cos {
                        Some(_) => (ndf.sample)(wo, alpha, u),
                        None => (ndf.sample_all)(alpha, u),
                    };
                    let h = h.map(R::to_f64);
                    h.iter().all(|x| x.is_finite()).then_some(h)
                };
                let bins = SphereBins::focused(24, 12, [0.0, 0.0, 1.0], narrow(roughness));
                let observed = bins.count((0..samples).map(draw));
                let density = |h: [f64; 3]| match cos {
                    Some(_) => (ndf.pdf)(wo, h.map(R::lit), alpha).to_f64(),
                    None => (ndf.d)(h.map(R::lit), alpha).to_f64() * h[2].max(0.0),
                };
                let expected = bins.expected(u64::from(samples), density);
                let test = chi2_test(&observed, &expected, 5.0);
                assert!(
                    test.p_value > level,
                    "{} α {roughness:?} cos {cos:?}: {test:?}",
                    ndf.name
                );
            }
        }
    }
}

/// Relative bounds, for f32 against f64 at the same f32 arguments. D: 16 ulp, and 6 ulp of the exponent
/// for Beckmann. cosθ·(1 + Λ): 8 ulp. Density: the two and the dot product, whose error is absolute.
#[test]
fn f32_agrees_with_f64() {
    let ulp = f64::from(f32::EPSILON);
    let (singles, doubles) = (both::<f32>(), both::<f64>());
    for (single, double) in singles.into_iter().zip(doubles) {
        for i in 0..50_000u32 {
            let r = |k| unit_f32(mix(i, k));
            let alpha = 10f32.powf(-4.0 * r(0)) * 1.5;
            let tangent = alpha * 10f32.powf(2.0 * r(1) - 1.5);
            let z = 1.0 / (1.0 + tangent * tangent).sqrt();
            let h = [
                z * tangent * (6.3 * r(2)).cos(),
                z * tangent * (6.3 * r(2)).sin(),
                z,
            ];
            let cos = 10f32.powf(-7.0 * r(3));
            let w = direction(f64::from(cos)).map(|x| x as f32);
            let (hw, ww) = (h.map(f64::from), w.map(f64::from));
            let ratio = [1.0, 0.5, 2.5][i as usize % 3];
            let aw = lit((f64::from(alpha), ratio));
            let alpha = lit::<f32>((f64::from(alpha), ratio));
            let exponent = if single.name == "GGX" {
                0.0
            } else {
                (f64::from(tangent) / narrow((aw.x, ratio))).powi(2)
            };
            let (a, b) = (f64::from((single.d)(h, alpha)), (double.d)(hw, aw));
            let bound = ulp * (16.0 + 6.0 * exponent);
            assert!(
                (a - b).abs() <= bound * b + f64::from(f32::MIN_POSITIVE),
                "D {alpha:?} {tangent}: {a} {b}"
            );

            let a = f64::from(w[2] + (single.cos_lambda)(w, alpha));
            let area = ww[2] + (double.cos_lambda)(ww, aw);
            assert!(
                (a - area).abs() <= 8.0 * ulp * area,
                "area {alpha:?} {w:?}: {a} {area}"
            );

            let (a, b) = (
                f64::from((single.pdf)(w, h, alpha)),
                (double.pdf)(ww, hw, aw),
            );
            let bound = (bound + 8.0 * ulp) * b + 4.0 * ulp * (double.d)(hw, aw) / area;
            assert!(
                (a - b).abs() <= bound + f64::from(f32::MIN_POSITIVE),
                "pdf {alpha:?}: {a} {b}"
            );
        }
    }
}

/// G₁ and G₂ are what their names say, within 8 ulp: 1/(1 + Λ), and G₁ for a `wi` that is not shadowed.
#[test]
fn masking_terms_agree_with_lambda() {
    for alpha in alphas().map(lit) {
        for w in COSINES.into_iter().skip(1).map(direction) {
            let close =
                |a: f64, b: f64| assert!((a - b).abs() <= 8.0 * f64::EPSILON * b, "{a} {b}");
            close(
                beckmann::g1(w, alpha),
                1.0 / (1.0 + beckmann::lambda(w, alpha)),
            );
            close(ggx::g1(w, alpha), 1.0 / (1.0 + ggx::lambda(w, alpha)));
            close(
                beckmann::g2(w, [0.0, 0.0, 1.0], alpha),
                beckmann::g1(w, alpha),
            );
            close(ggx::g2(w, [0.0, 0.0, 1.0], alpha), ggx::g1(w, alpha));
            let joint = 1.0 / (1.0 + 2.0 * ggx::lambda(w, alpha));
            close(ggx::g2(w, w, alpha), joint);
            assert!(beckmann::g2(w, w, alpha) >= beckmann::g1(w, alpha).powi(2));
        }
    }
}

/// Every sample is a unit vector of the upper half, whatever the arguments.
#[test]
fn samples_are_unit_normals_at_every_extreme() {
    let us = [0.0f32, 1.0 / 16_777_216.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    for ndf in both::<f32>() {
        let alphas = [1e-8f32, 1e-4, 0.3, 1.0, 100.0];
        for alpha in alphas
            .into_iter()
            .flat_map(|x| [1.0, 1e-4, 1e4].map(|r| Alpha { x, ratio: r }))
        {
            for cos in [0.0, 1e-20, 1e-7, 1e-3, 0.5, 1.0] {
                let w = direction(cos).map(|x| x as f32);
                for u in us.iter().flat_map(|&a| us.map(|b| [a, b])) {
                    let h = (ndf.sample)(w, alpha, u);
                    let length: f32 = h.iter().map(|x| x * x).sum();
                    assert!(
                        (length - 1.0).abs() < 8.0 * f32::EPSILON,
                        "{} {h:?}",
                        ndf.name
                    );
                    assert!(h[2] > 0.0, "{} {alpha:?} {cos} {u:?} {h:?}", ndf.name);
                    let free = (ndf.sample_all)(alpha, u);
                    let length: f32 = free.iter().map(|x| x * x).sum();
                    assert!((length - 1.0).abs() < 8.0 * f32::EPSILON && free[2] > 0.0);
                    for x in [(ndf.d)(h, alpha), (ndf.cos_lambda)(w, alpha)] {
                        assert!(
                            x.is_finite() && x >= 0.0,
                            "{} {alpha:?} {cos} {u:?}",
                            ndf.name
                        );
                    }
                }
            }
        }
    }
}
