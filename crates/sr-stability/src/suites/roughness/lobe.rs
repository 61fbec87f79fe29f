//! Values, densities and weights of rough lobes: finite, consistent, and those of `f64`.

use super::lobes::{Facets, direction, random, rough, wide};
use super::{ALL, ALPHAS, ROUGH, rough_alphas};
use crate::worst::{Worst, relative};
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::glam::{Vec2, Vec3};

const ULP: f64 = f32::EPSILON as f64;
const MODE: TransportMode = TransportMode::Radiance;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let mut all = vec![finite::<K>()];
    all.extend(accuracy::<K>());
    all.push(consistency::<K>());
    all
}

/// From above and from below, none of them grazing: that is a suite of its own.
fn wos() -> impl Iterator<Item = Vec3> {
    let cosines = [1.0, 0.7, 0.2];
    cosines
        .into_iter()
        .enumerate()
        .map(|(i, c)| direction(c, 0.7 + i as f64))
}

fn both_sides(w: Vec3) -> [Vec3; 2] {
    [w, Vec3::new(w.x, w.y, -w.z)]
}

fn harmless(x: Vec3) -> bool {
    x.is_finite() && x.min_element() >= 0.0
}

/// Nothing is let off: samples at the ends of every random number, and values at and around what they give.
fn finite<K: Kernels>() -> Sweep {
    const ENDS: [f32; 4] = [0.0, 1.0 / 16_777_216.0, 0.5, 1.0 - f32::EPSILON / 2.0];
    let points = ALPHAS.map(|alpha| {
        let mut bad = Worst::default();
        for case in rough(alpha) {
            for wo in wos().chain([direction(1e-4, 1.0)]).flat_map(both_sides) {
                let mut wis = vec![wo, -wo, Vec3::new(-wo.x, -wo.y, wo.z), Vec3::X];
                for (uc, u) in ENDS.iter().flat_map(|&uc| {
                    ENDS.iter()
                        .flat_map(move |&x| ENDS.map(|y| (uc, Vec2::new(x, y))))
                }) {
                    let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, MODE) else {
                        continue;
                    };
                    let fine = harmless(s.weight) && s.wi.is_finite() && s.pdf.is_finite();
                    if !(fine && s.pdf > 0.0) {
                        bad.count(|| format!("{}, wo {wo}, uc {uc}, u {u}: {s:?}", case.name));
                    }
                    wis.push(s.wi);
                }
                for wi in wis {
                    let (f, pdf) = K::bsdf_eval_pdf(&case.bsdf, wo, wi, MODE);
                    if !(harmless(f) && pdf.is_finite() && pdf >= 0.0) {
                        bad.count(|| format!("{}, wo {wo}, wi {wi}: {f} {pdf}", case.name));
                    }
                }
            }
        }
        bad.at(alpha.into())
    });
    Sweep {
        name: "finite".into(),
        about: "Samples, values and densities of every rough lobe, smooth ones included, at the ends of all random \
                numbers: how many are not finite, or negative."
            .into(),
        parameter: "α".into(),
        error: "results that are not finite".into(),
        bound: 0.0,
        holds: ALL,
        points: points.into(),
    }
}

/// Largest relative error of three components; what is black in both agrees.
fn colours_apart(a: Vec3, b: [f64; 3]) -> f64 {
    let pairs = wide(a).into_iter().zip(b);
    pairs.map(|(a, b)| relative(a, b)).fold(0.0, f64::max)
}

/// Values and densities, then weights, against the same lobe in `f64` at the same directions as they round to `f32`.
///
/// The half vector of a refraction is a difference: wo + η wi of length η − 1 errs by an ulp of 1, D by that over
/// (η − 1)·α. From weights D has cancelled.
fn accuracy<K: Kernels>() -> [Sweep; 2] {
    let (mut values, mut weights) = (Vec::new(), Vec::new());
    for alpha in rough_alphas() {
        let (mut value, mut weight) = (Worst::default(), Worst::default());
        for lobe in Facets::all(alpha) {
            for wo in lobe.views(wos()) {
                for wi in lobe.directions(wo) {
                    let (f, pdf) = K::bsdf_eval_pdf(&lobe.bsdf, wo, wi, MODE);
                    let (exact_f, exact_pdf) = lobe.bsdf.eval_pdf_real(wide(wo), wide(wi), MODE);
                    let off = colours_apart(f, exact_f).max(relative(pdf.into(), exact_pdf));
                    value.see(off, || {
                        format!("{}, wo {wo}, wi {wi}: {f} {pdf}", lobe.name)
                    });
                }
                for i in 0..64 {
                    let (uc, u) = random(5, i);
                    let Some(s) = K::bsdf_sample(&lobe.bsdf, wo, uc, u, MODE) else {
                        continue;
                    };
                    let (f, pdf) = lobe.bsdf.eval_pdf_real(wide(wo), wide(s.wi), MODE);
                    let exact = f.map(|f| f * f64::from(s.wi.z).abs() / pdf);
                    weight.see(colours_apart(s.weight, exact), || {
                        format!("{}, wo {wo}, uc {uc}, u {u}: {s:?}", lobe.name)
                    });
                }
            }
        }
        values.push(value.at(alpha.into()));
        weights.push(weight.at(alpha.into()));
    }
    let sweep = |name: &str, what: &str, bound, points| Sweep {
        name: name.into(),
        about: format!(
            "{what} of rough metal, glass and glTF, against the same lobe in f64 at the same directions."
        ),
        parameter: "α".into(),
        error: "relative error".into(),
        bound,
        holds: ROUGH,
        points,
    };
    [
        sweep("value", "Values and densities", 1e-2, values),
        sweep("weight", "Weights", 1e-4, weights),
    ]
}

/// weight = f·|cosθ|/pdf, and the density of a sample is that of its direction; 16 ulp are the rounding of the few products
/// in which the two ways differ.
fn consistency<K: Kernels>() -> Sweep {
    let points = rough_alphas().map(|alpha| {
        let mut worst = Worst::default();
        for case in rough(alpha) {
            for wo in wos().flat_map(both_sides) {
                for i in 0..64 {
                    let (uc, u) = random(6, i);
                    let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, MODE) else {
                        continue;
                    };
                    let (f, pdf) = K::bsdf_eval_pdf(&case.bsdf, wo, s.wi, MODE);
                    let cos = f64::from(s.wi.z).abs();
                    let weight = wide(f).map(|f| f * cos / f64::from(pdf));
                    let off =
                        colours_apart(s.weight, weight).max(relative(s.pdf.into(), pdf.into()));
                    worst.see(off, || {
                        format!("{}, wo {wo}, uc {uc}, u {u}: {s:?}", case.name)
                    });
                }
            }
        }
        worst.at(alpha.into())
    });
    Sweep {
        name: "consistency".into(),
        about: "A sample's weight against f·|cosθ|/pdf of its direction, and its density against that direction's."
            .into(),
        parameter: "α".into(),
        error: "relative difference".into(),
        bound: 16.0 * ULP,
        holds: ROUGH,
        points: points.collect(),
    }
}
