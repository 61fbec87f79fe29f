//! White furnaces: what a lobe gives back of a uniform light.

use crate::catalogue::{
    ALPHAS, ROUGHNESSES, direction, glass, gltf, gold, narrow, perfect_metal, random, reflected,
    resolved, through, through_width, wide, wide_array, width, wos,
};
use glam::{Vec2, Vec3};
use sr_bsdf::{
    Bsdf, FresnelKind, Lambert, LobeFlags, Mirror, Refraction, ThinDielectric, TransportMode,
};
use sr_stats::{SphereBins, normal_quantile, sidak};

/// ∫ f·|cosθ| dω of the non-delta lobes, first component; the quadrature is good to 10⁻⁴.
pub fn integral(bsdf: &Bsdf, wo: Vec3) -> f64 {
    let flags = bsdf.flags();
    // Deltas have no width to focus a grid on.
    if !flags.intersects(LobeFlags::GLOSSY | LobeFlags::DIFFUSE) {
        return 0.0;
    }
    let value = |focus: Vec3, above: bool, scale: f64| {
        let bins = SphereBins::focused(24, 16, wide_array(focus), scale);
        let f = |wi: [f64; 3]| {
            let wi = narrow(wi);
            let counted = (wi.z * wo.z > 0.0) == above;
            if counted {
                f64::from(bsdf.eval(wo, wi, TransportMode::Importance).x * wi.z.abs())
            } else {
                0.0
            }
        };
        bins.integrate(f).iter().sum::<f64>()
    };
    value(reflected(wo), true, width(bsdf)) + value(through(bsdf, wo), false, through_width(bsdf))
}

/// Σ weight·pdf over the deltas, first component: each once, found by scanning `uc`.
fn delta_sum(bsdf: &Bsdf, wo: Vec3) -> f64 {
    let mut seen: Vec<(LobeFlags, f64)> = Vec::new();
    for i in 0..=256 {
        let uc = (i as f32 / 256.0).min(1.0 - f32::EPSILON / 2.0);
        if let Some(s) = bsdf.sample(wo, uc, Vec2::splat(0.3), TransportMode::Importance)
            && s.lobe.is_delta()
            && seen.iter().all(|(l, _)| *l != s.lobe)
        {
            seen.push((s.lobe, f64::from(s.weight.x) * f64::from(s.pdf)));
        }
    }
    seen.iter().map(|(_, e)| e).sum()
}

/// Mean of the weights and its standard error, first component.
fn estimate(bsdf: &Bsdf, wo: Vec3, key: u32) -> (f64, f64) {
    const N: u32 = 20_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..N {
        let (uc, u) = random(key, i);
        let w = bsdf
            .sample(wo, uc, u, TransportMode::Importance)
            .map_or(0.0, |s| f64::from(s.weight.x));
        sum += w;
        squares += w * w;
    }
    let n = f64::from(N);
    let mean = sum / n;
    (
        mean,
        ((squares / n - mean * mean).max(0.0) / (n - 1.0)).sqrt(),
    )
}

/// The mean of the weights is the integral that quadrature gives, deltas included: a family-wise level of
/// 10⁻³, plus the quadrature's 3·10⁻⁴. With standard errors near 0.3 % this finds a lobe that is left out, or a
/// weight that is off by 2 %.
#[test]
fn sampling_estimates_the_integral() {
    let lobes = wide();
    let z = -normal_quantile(0.5 * sidak(1e-3, lobes.len() * wos().count()));
    for (key, bsdf) in lobes.iter().enumerate() {
        for (j, wo) in wos().enumerate().filter(|(_, wo)| resolved(bsdf, *wo)) {
            let want = integral(bsdf, wo) + delta_sum(bsdf, wo);
            let (mean, error) = estimate(bsdf, wo, (key * 16 + j) as u32);
            let bound = z * error + 3e-4 * want.max(1.0);
            assert!(
                (mean - want).abs() <= bound,
                "{bsdf:?} {wo}: {mean} ± {error}, {want}"
            );
        }
    }
}

/// With white tints every sample's weight is 1: no noise, no loss. 8 ulp are the rounding of F/F and of
/// (1 − F)/(1 − F).
#[test]
fn white_lobes_lose_nothing() {
    let white = Vec3::ONE;
    let mut lobes = vec![
        Bsdf::Lambert(Lambert { reflectance: white }),
        Bsdf::Mirror(Mirror { reflectance: white }),
        perfect_metal(0.0),
        gltf(white, 1.0, 0.0, 0.0),
        gltf(white, 0.0, 0.0, 1.0),
    ];
    for ior in [1.0 / 1.5, 1.000_000_1, 1.5, 100.0] {
        lobes.push(glass(ior, FresnelKind::Exact));
        lobes.push(glass(ior, FresnelKind::Schlick));
        lobes.push(Bsdf::ThinDielectric(ThinDielectric {
            ior,
            reflectance: white,
            transmittance: white,
        }));
    }
    for (key, bsdf) in lobes.iter().enumerate() {
        for wo in wos() {
            for i in 0..500 {
                let (uc, u) = random(key as u32, i);
                let s = bsdf
                    .sample(wo, uc, u, TransportMode::Importance)
                    .expect("nothing is lost");
                assert!(
                    (s.weight - white).abs().max_element() < 8.0 * f32::EPSILON,
                    "{bsdf:?} {wo} {s:?}"
                );
            }
        }
    }
}

/// Reflectance and transmittance of clear glass sum to 1 from both sides, in importance mode; in radiance
/// mode transmission carries 1/η² besides.
#[test]
fn glass_conserves_energy() {
    for kind in [FresnelKind::Exact, FresnelKind::Schlick] {
        for ior in [1.0 / 1.5, 1.0, 1.5, 2.4] {
            for wo in wos() {
                let bsdf = glass(ior, kind);
                assert!((delta_sum(&bsdf, wo) - 1.0).abs() < 1e-6, "{bsdf:?} {wo}");
                let end = 1.0 - f32::EPSILON / 2.0;
                let through = |mode| bsdf.sample(wo, end, Vec2::ZERO, mode);
                if let (Some(r), Some(i)) = (
                    through(TransportMode::Radiance),
                    through(TransportMode::Importance),
                ) {
                    let ratio = i.weight.x / r.weight.x;
                    assert!(
                        (ratio - r.eta * r.eta).abs() < 4.0 * f32::EPSILON * ratio,
                        "{bsdf:?} {wo}"
                    );
                }
            }
        }
    }
}

/// Refraction keeps its transmittance up to the critical angle and nothing beyond.
#[test]
fn refraction_absorbs_at_total_reflection() {
    let bsdf = Bsdf::Refraction(Refraction {
        transmittance: Vec3::splat(0.5),
        ior: 1.5,
    });
    for (cos, passes) in [(0.9, true), (0.75, true), (0.74, false), (0.1, false)] {
        let wo = direction(cos, 1.0) * Vec3::new(1.0, 1.0, -1.0);
        let s = bsdf.sample(wo, 0.5, Vec2::ZERO, TransportMode::Importance);
        assert_eq!(s.map(|s| s.weight), passes.then_some(Vec3::splat(0.5)));
    }
}

/// A perfect metal gains nothing, and loses what meets a second facet. At normal incidence that is at least
/// what is reflected below the horizon, facets of slope above 1: exp(−1/α²). What is smooth loses nothing.
#[test]
fn rough_metal_gains_nothing() {
    for alpha in ALPHAS {
        for wo in wos().filter(|wo| resolved(&gold(alpha), *wo)) {
            let e = integral(&perfect_metal(alpha), wo);
            assert!(e < 1.0 + 1e-4, "α {alpha} {wo}: {e}");
        }
        let e = integral(&perfect_metal(alpha), Vec3::Z);
        let above = 1.0 - (-f64::from(alpha).powi(-2)).exp();
        assert!(
            e < above + 1e-4 && e > 0.5 * above,
            "α {alpha}: {e} {above}"
        );
        assert!(alpha > 0.02 || e > 1.0 - 1e-3, "α {alpha}: {e}");
    }
}

/// The white glTF material: a metal, and clear glass, gold, gain nothing. The diffuse layer is weighted by 1 − F
/// at the half vector, as the specification has it, which can gain: at most the layer's own
/// (1 − t)(1 − R₀) = 0.96(1 − t), and nothing at normal incidence, where the half vector's Fresnel term is
/// at least that of the specular lobe's bulk.
#[test]
fn gltf_gains_no_more_than_its_specification() {
    for roughness in ROUGHNESSES {
        for (metallic, transmission) in [(1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (0.5, 0.5)] {
            let bsdf = gltf(Vec3::ONE, metallic, roughness, transmission);
            let gain = 0.96 * f64::from((1.0 - metallic) * (1.0 - transmission));
            for wo in wos().filter(|wo| resolved(&bsdf, *wo)) {
                let e = integral(&bsdf, wo) + delta_sum(&bsdf, wo);
                let limit = if wo.z.abs() == 1.0 { 1.0 } else { 1.0 + gain };
                assert!(e < limit + 1e-4, "{bsdf:?} {wo}: {e}");
            }
        }
    }
}

/// The larger roughness, as far as there is any.
fn roughest(bsdf: &Bsdf) -> f64 {
    let larger = |s: &sr_bsdf::Microsurface| f64::from(s.alpha().x.max(s.alpha().y()));
    match bsdf {
        Bsdf::Conductor(c) => larger(c.surface()),
        Bsdf::RoughDielectric(d) => larger(d.surface()),
        _ => width(bsdf),
    }
}

/// Exact for what is smooth or diffuse. For rough lobes the excess grows with α: at most 0.03 up to 0.2,
/// 0.4 at 0.7, and 0.8 at 1.5.
#[test]
fn albedo_is_the_reflectance_at_normal_incidence() {
    for bsdf in wide().into_iter().chain(crate::catalogue::delta()) {
        let exact = integral(&bsdf, Vec3::Z) + delta_sum(&bsdf, Vec3::Z);
        let excess = f64::from(bsdf.albedo().x) - exact;
        let limit = match roughest(&bsdf) {
            _ if !bsdf.flags().contains(LobeFlags::GLOSSY) => 0.01,
            alpha if alpha <= 0.2 => 0.03,
            alpha if alpha <= 0.7 => 0.4,
            _ => 0.8,
        };
        assert!(
            excess > -0.01 && excess < limit,
            "{bsdf:?}: {exact} {excess}"
        );
    }
}
