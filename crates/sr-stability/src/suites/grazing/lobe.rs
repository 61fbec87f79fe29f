//! Values, densities and weights of every lobe at grazing incidence.

use super::lobes::{Case, all, direction, random, wide};
use super::{COSINES, DIRECTIONS, EVERYWHERE};
use crate::worst::{Worst, relative};
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::TransportMode::{Importance, Radiance};
use sr_pipeline::glam::{Vec2, Vec3};

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let lobes = all();
    let mut sweeps = vec![finite::<K>(&lobes)];
    sweeps.extend(accuracy::<K>(&lobes));
    sweeps.push(reciprocity::<K>(&lobes));
    sweeps
}

/// From above and from below.
fn wos(cos: f32) -> [Vec3; 2] {
    [cos, -cos].map(|c| direction(c, 0.7))
}

fn harmless(x: Vec3) -> bool {
    x.is_finite() && x.min_element() >= 0.0
}

/// Samples at the ends of every random number, and values there and where both directions graze.
fn finite<K: Kernels>(lobes: &[Case]) -> Sweep {
    const ENDS: [f32; 4] = [0.0, 1.0 / 16_777_216.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    let numbers = |i: usize| (ENDS[i / 16], Vec2::new(ENDS[i / 4 % 4], ENDS[i % 4]));
    let points = COSINES.map(|cos| {
        let mut bad = Worst::default();
        for case in lobes {
            for wo in wos(cos) {
                let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
                let tilted = direction(wo.z, 3.7);
                let mut wis = vec![
                    wo,
                    -wo,
                    mirrored,
                    -mirrored,
                    tilted,
                    -tilted,
                    Vec3::X,
                    Vec3::Z,
                ];
                for (uc, u) in (0..64).map(numbers) {
                    let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, Radiance) else {
                        continue;
                    };
                    let fine = harmless(s.weight) && s.wi.is_finite() && s.pdf.is_finite();
                    let unit = (s.wi.as_dvec3().length() - 1.0).abs() < 1e-6;
                    if !(fine && unit && s.pdf > 0.0) {
                        bad.count(|| format!("{}, wo {wo:?}, uc {uc}, u {u}: {s:?}", case.name));
                    }
                    wis.push(s.wi);
                }
                for wi in wis {
                    let (f, pdf) = K::bsdf_eval_pdf(&case.bsdf, wo, wi, Radiance);
                    if !(harmless(f) && pdf.is_finite() && pdf >= 0.0) {
                        bad.count(|| format!("{}, wo {wo:?}, wi {wi:?}: {f} {pdf}", case.name));
                    }
                }
            }
        }
        bad.at(cos.into())
    });
    Sweep {
        name: "finite".into(),
        about: "Samples, values and densities of all nine lobes from both sides, at the ends of all random numbers: how \
                many are not finite, or negative, or not of unit length."
            .into(),
        parameter: "cos θ".into(),
        error: "results that are not finite".into(),
        bound: 0.0,
        holds: EVERYWHERE,
        points: points.into(),
    }
}

/// Largest relative error of three components; what is black in both agrees.
fn colours_apart(a: Vec3, b: [f64; 3]) -> f64 {
    let pairs = wide(a).into_iter().zip(b);
    pairs.map(|(a, b)| relative(a, b)).fold(0.0, f64::max)
}

/// The values of lobes that have any, at directions that they are sampled at; then weights.
fn accuracy<K: Kernels>(lobes: &[Case]) -> [Sweep; 2] {
    let (mut values, mut weights) = (Vec::new(), Vec::new());
    for cos in COSINES {
        let (mut value, mut weight) = (Worst::default(), Worst::default());
        for case in lobes.iter().filter(|c| !c.bsdf.flags().is_delta()) {
            for wo in wos(cos) {
                for i in 0..48 {
                    let (uc, u) = random(7, i);
                    let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, Radiance) else {
                        continue;
                    };
                    if s.lobe.is_delta() {
                        continue;
                    }
                    let (f, pdf) = K::bsdf_eval_pdf(&case.bsdf, wo, s.wi, Radiance);
                    let (exact_f, exact_pdf) =
                        case.bsdf.eval_pdf_real(wide(wo), wide(s.wi), Radiance);
                    let off = colours_apart(f, exact_f).max(relative(pdf.into(), exact_pdf));
                    value.see(off, || {
                        format!("{}, wo {wo:?}, wi {:?}: {f} {pdf}", case.name, s.wi)
                    });
                    let exact = exact_f.map(|f| f * f64::from(s.wi.z).abs() / exact_pdf);
                    weight.see(colours_apart(s.weight, exact), || {
                        format!("{}, wo {wo:?}, uc {uc}, u {u}: {s:?}", case.name)
                    });
                }
            }
        }
        values.push(value.at(cos.into()));
        weights.push(weight.at(cos.into()));
    }
    let sweep = |name: &str, what: &str, bound, points| Sweep {
        name: name.into(),
        about: format!(
            "{what} of all lobes from both sides, against the same lobe in f64 at the same directions."
        ),
        parameter: "cos θ".into(),
        error: "relative error".into(),
        bound,
        holds: DIRECTIONS,
        points,
    };
    [
        sweep("value", "Values and densities", 1e-2, values),
        sweep("weight", "Weights", 1e-4, weights),
    ]
}

/// f(wo, wi) of radiance is f(wi, wo) of importance.
fn reciprocity<K: Kernels>(lobes: &[Case]) -> Sweep {
    let points = COSINES.map(|cos| {
        let mut worst = Worst::default();
        for case in lobes.iter().filter(|c| !c.bsdf.flags().is_delta()) {
            for wo in wos(cos) {
                for i in 0..48 {
                    let (uc, u) = random(8, i);
                    let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, Radiance) else {
                        continue;
                    };
                    let there = K::bsdf_eval_pdf(&case.bsdf, wo, s.wi, Radiance).0;
                    let back = K::bsdf_eval_pdf(&case.bsdf, s.wi, wo, Importance).0;
                    worst.see(colours_apart(there, wide(back)), || {
                        format!("{}, wo {wo:?}, wi {:?}: {there} {back}", case.name, s.wi)
                    });
                }
            }
        }
        worst.at(cos.into())
    });
    Sweep {
        name: "reciprocity".into(),
        about: "f(wo, wi) of radiance against f(wi, wo) of importance.".into(),
        parameter: "cos θ".into(),
        error: "relative difference".into(),
        bound: 1e-2,
        holds: DIRECTIONS,
        points: points.into(),
    }
}
