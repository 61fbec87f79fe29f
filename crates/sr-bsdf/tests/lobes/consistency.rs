//! `sample`, `eval`, `pdf` and `flags` say the same; what goes there comes back.

use crate::catalogue::{delta, random, reflected, wide, wos};
use glam::Vec3;
use sr_bsdf::{Bsdf, BsdfSample, LobeFlags, TransportMode};

const MODES: [TransportMode; 2] = [TransportMode::Radiance, TransportMode::Importance];

/// Relative difference of colours, by the largest component.
fn apart(a: Vec3, b: Vec3) -> f32 {
    (a - b).abs().max_element() / b.abs().max_element().max(f32::MIN_POSITIVE)
}

fn all() -> impl Iterator<Item = Bsdf> {
    wide().into_iter().chain(delta())
}

/// weight = f·|cosθ|/pdf to 16 ulp, which is the rounding of the few products that differ; the density is
/// the same bits, and so are the three ways to evaluate.
#[test]
fn the_weight_is_value_times_cosine_by_density() {
    for (key, bsdf) in wide().into_iter().enumerate() {
        for wo in wos() {
            for i in 0..500 {
                let (uc, u) = random(key as u32, i);
                let Some(s) = bsdf
                    .sample(wo, uc, u, MODES[0])
                    .filter(|s| !s.lobe.is_delta())
                else {
                    continue;
                };
                let (f, pdf) = bsdf.eval_pdf(wo, s.wi, MODES[0]);
                assert_eq!(pdf.to_bits(), s.pdf.to_bits(), "{bsdf:?} {wo} {s:?}");
                assert_eq!(pdf.to_bits(), bsdf.pdf(wo, s.wi).to_bits());
                assert_eq!(f, bsdf.eval(wo, s.wi, MODES[0]));
                let weight = f * (s.wi.z.abs() / pdf);
                assert!(
                    apart(s.weight, weight) < 16.0 * f32::EPSILON,
                    "{bsdf:?} {wo} {s:?} {weight}"
                );
            }
        }
    }
}

/// The sampled lobe has one side and one width, is among the flags, and lies on the side it names; the
/// direction is unit to 16 ulp. Each lobe that the flags promise is met, unless it cannot be: total
/// reflection, or a Fresnel term that leaves less than 1/500 of it.
#[test]
fn flags_tell_what_is_sampled() {
    let sides = LobeFlags::REFLECTION | LobeFlags::TRANSMISSION;
    for (key, bsdf) in all().enumerate() {
        let mut met = LobeFlags::empty();
        for wo in wos() {
            for i in 0..500 {
                let (uc, u) = random(key as u32, i);
                let Some(s) = bsdf.sample(wo, uc, u, MODES[0]) else {
                    continue;
                };
                assert!(bsdf.flags().contains(s.lobe), "{bsdf:?} {s:?}");
                assert!(s.lobe.intersects(sides) && !s.lobe.contains(sides));
                assert_eq!(
                    s.lobe.contains(LobeFlags::REFLECTION),
                    s.wi.z * wo.z > 0.0,
                    "{bsdf:?}"
                );
                let widths = [LobeFlags::DIFFUSE, LobeFlags::GLOSSY, LobeFlags::DELTA];
                assert_eq!(widths.iter().filter(|&&w| s.lobe.contains(w)).count(), 1);
                assert!(
                    (s.wi.length() - 1.0).abs() < 16.0 * f32::EPSILON,
                    "{bsdf:?} {wo} {s:?}"
                );
                met = met | s.lobe;
            }
        }
        let glass_of_index_one = matches!(&bsdf, Bsdf::Dielectric(d) if d.ior == 1.0)
            || matches!(&bsdf, Bsdf::RoughDielectric(d) if d.ior() == 1.0)
            || matches!(&bsdf, Bsdf::ThinDielectric(d) if d.ior == 1.0);
        assert!(
            met == bsdf.flags() || glass_of_index_one,
            "{bsdf:?}: {met:?}"
        );
        assert_eq!(bsdf.flags().is_delta(), delta().contains(&bsdf), "{bsdf:?}");
    }
}

/// How much a relative error of the half vector's terms is magnified in the value; 1 for a reflection.
fn refraction_condition(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> f32 {
    let Bsdf::RoughDielectric(d) = bsdf else {
        return 1.0;
    };
    if wo.z * wi.z > 0.0 {
        return 1.0;
    }
    let eta = if wo.z > 0.0 { d.ior() } else { 1.0 / d.ior() };
    let sum = wo + eta * wi;
    let angle = eta.max(1.0) / sum.length();
    let h = sum.normalize().abs();
    let seen = h.dot(wo).abs().min(h.dot(wi).abs()).max(1e-6);
    let steep = 1.0 / (h.z * h.z).max(1e-12);
    let alpha = d.surface().alpha().x.min(d.surface().alpha().y());
    angle * (1.0 + steep * (1.0 + h.truncate().length() / (alpha * alpha)) + 1.0 / seen)
}

/// f(wo, wi) in one mode is f(wi, wo) in the other; for reflection, and through a thin sheet, where η² is 1, the
/// modes agree: to 16 ulp, since the half vector is the same bits. `eval` is 0 for deltas.
///
/// The half vector of a refraction is a difference, wo + ηwi, that errs by some ulp of the longer term. D changes by
/// its relative slope times that, 2·tanθ_h/α² at most in the slope for either distribution: which is the bound,
/// where it is below 1.
#[test]
fn values_are_reciprocal() {
    let wis: Vec<Vec3> = wos()
        .chain(wos().map(reflected))
        .chain([Vec3::new(0.48, 0.6, 0.64)])
        .collect();
    for bsdf in all() {
        for wo in wos() {
            for &wi in &wis {
                let (there, back) = (bsdf.eval(wo, wi, MODES[0]), bsdf.eval(wi, wo, MODES[1]));
                let bound = 16.0 * f32::EPSILON * refraction_condition(&bsdf, wo, wi);
                assert!(
                    apart(there, back) < bound || bound > 1.0,
                    "{bsdf:?} {wo} {wi}: {there} {back}"
                );
                assert!(!bsdf.flags().is_delta() || there == Vec3::ZERO);
            }
        }
    }
}

/// The two outcomes of a delta lobe: `uc` at either end.
fn outcomes(bsdf: &Bsdf, wo: Vec3, mode: TransportMode) -> Vec<BsdfSample> {
    let u = glam::Vec2::splat(0.5);
    let ends = [0.0, 1.0 - f32::EPSILON / 2.0];
    let mut found: Vec<BsdfSample> = Vec::new();
    for s in ends.iter().filter_map(|&uc| bsdf.sample(wo, uc, u, mode)) {
        if found.iter().all(|f| f.lobe != s.lobe) {
            found.push(s);
        }
    }
    found
}

/// A delta's strength is weight·pdf. There and back it is the same, after radiance's factor: T/η² one way,
/// T·η² the other; importance has T both ways. Refraction
/// into or out of a grazing direction has a cosine that is the root of a difference, so that an ulp of its square
/// counts 1/cos² times: 8 ulp of it are admitted, and 10⁻⁵ besides.
#[test]
fn deltas_are_reciprocal_up_to_eta_squared() {
    for bsdf in delta() {
        for wo in wos() {
            for mode in MODES {
                for s in outcomes(&bsdf, wo, mode) {
                    let back = outcomes(&bsdf, s.wi, mode)
                        .into_iter()
                        .find(|b| b.lobe == s.lobe)
                        .expect("what went there comes back");
                    let scale = if mode == MODES[0] { s.eta * s.eta } else { 1.0 };
                    let there = s.weight * s.pdf * scale;
                    let again = back.weight * back.pdf / scale;
                    let grazing = s.wi.z.abs().min(wo.z.abs());
                    let bound = 1e-5 + 8.0 * f32::EPSILON / (grazing * grazing);
                    assert!(apart(there, again) < bound, "{bsdf:?} {wo} {s:?} {back:?}");
                    let miss = (back.wi - wo).abs().max_element();
                    assert!(miss < bound, "{bsdf:?} {wo} {back:?}");
                    assert!((s.eta * back.eta - 1.0).abs() < 2.0 * f32::EPSILON);
                }
            }
        }
    }
}

/// `eta` is the index on entering and its inverse on leaving; 1 where nothing is crossed, and through thin
/// sheets.
#[test]
fn eta_is_seen_from_wo() {
    for bsdf in all() {
        let ior = match &bsdf {
            Bsdf::Dielectric(d) => d.ior,
            Bsdf::RoughDielectric(d) => d.ior(),
            Bsdf::Refraction(d) => d.ior,
            _ => 1.0,
        };
        for wo in wos() {
            for s in outcomes(&bsdf, wo, MODES[0]) {
                let crossing = if wo.z > 0.0 { ior } else { 1.0 / ior };
                let through = s.lobe.contains(LobeFlags::TRANSMISSION);
                assert_eq!(s.eta, if through { crossing } else { 1.0 }, "{bsdf:?} {wo}");
                let snell = (s.wi.x * s.eta + wo.x)
                    .abs()
                    .max((s.wi.y * s.eta + wo.y).abs());
                let bends = through && s.lobe.is_delta();
                assert!(!bends || snell < 4.0 * f32::EPSILON, "{bsdf:?} {wo} {s:?}");
            }
        }
    }
}
