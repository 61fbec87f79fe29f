//! D and G₂ by themselves: the formulas hold at any roughness; it is directions that f32 cannot say finely enough.

use super::lobes::{BRUSHED, NDFS, direction, wide};
use super::{ALL, ALPHAS, ROUGH};
use crate::worst::{Worst, relative};
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::microfacet::Alpha;
use sr_pipeline::bsdf::{Ndf, beckmann, erf, ggx};
use sr_pipeline::glam::{DVec3, Vec3};

const ULP: f64 = f32::EPSILON as f64;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let mut all = Vec::new();
    for ndf in NDFS {
        all.push(density::<K>(ndf));
        all.push(masking::<K>(ndf));
    }
    all.push(rounded_normal::<K>());
    all
}

fn lower(ndf: Ndf) -> &'static str {
    match ndf {
        Ndf::Beckmann => "beckmann",
        Ndf::Ggx => "ggx",
    }
}

/// Isotropic, and brushed with a thousandth of the roughness in one direction.
fn both(alpha: f32) -> [Alpha<f32>; 2] {
    [Alpha::isotropic(alpha), Alpha::new(alpha, alpha / BRUSHED)]
}

fn widened(alpha: Alpha<f32>) -> Alpha<f64> {
    Alpha {
        x: f64::from(alpha.x),
        ratio: f64::from(alpha.ratio),
    }
}

/// Normals up to 4 α steep: slopes in units of α, in eight directions.
fn normals(alpha: Alpha<f64>) -> impl Iterator<Item = (f64, DVec3)> {
    (0..=8).flat_map(move |i| {
        (0..8).map(move |j| {
            let (slope, phi) = (0.5 * f64::from(i), 0.3 + 0.8 * f64::from(j));
            let h = DVec3::new(
                alpha.x * slope * phi.cos(),
                alpha.x * alpha.ratio * slope * phi.sin(),
                1.0,
            );
            (slope, h.normalize())
        })
    })
}

/// D as a density of slopes P₂₂ over cos⁴θ (Heitz 2014, eq. 6 and 19, 45): no formula of ours.
fn exact_d(ndf: Ndf, h: DVec3, alpha: Alpha<f64>) -> f64 {
    let slope2 = (h.x / h.z / alpha.x).powi(2) + (h.y / h.z / (alpha.x * alpha.ratio)).powi(2);
    let shape = match ndf {
        Ndf::Beckmann => (-slope2).exp(),
        Ndf::Ggx => (1.0 + slope2).powi(-2),
    };
    shape / (std::f64::consts::PI * alpha.x.powi(2) * alpha.ratio * h.z.powi(4))
}

/// Rounding is all there is: GGX takes ten operations, two of them on a sum that is squared. Beckmann's exponent, 16 at
/// a slope of 4 α, magnifies the error of its argument, about 4 roundings of half an ulp.
fn density<K: Kernels>(ndf: Ndf) -> Sweep {
    let wide_d = match ndf {
        Ndf::Beckmann => beckmann::d::<f64>,
        Ndf::Ggx => ggx::d::<f64>,
    };
    let points = ALPHAS.map(|a| {
        let mut worst = Worst::default();
        for alpha in both(a) {
            let wide_alpha = widened(alpha);
            for (slope, h) in normals(wide_alpha) {
                let h = h.as_vec3();
                let exact = exact_d(ndf, h.as_dvec3(), wide_alpha);
                let d = K::ndf_d(ndf, h.to_array(), alpha);
                worst.see(relative(d.into(), exact), || {
                    format!("ratio {}, a slope of {slope} α, h {h}", alpha.ratio)
                });
                worst.see_oracle(relative(wide_d(wide(h), wide_alpha), exact));
            }
        }
        worst.at(a.into())
    });
    Sweep {
        name: format!("{}_d", lower(ndf)),
        about: format!(
            "{ndf:?}'s density of normals, isotropic and 1000:1, against the density of slopes in f64."
        ),
        parameter: "α".into(),
        error: "relative error of D".into(),
        bound: if ndf == Ndf::Ggx { 8.0 } else { 48.0 } * ULP,
        holds: ALL,
        points: points.into(),
    }
}

/// Λ(a), a = cotθ/α seen along `w` (Heitz 2014, eq. 68 and 71). GGX's (√(1 + 1/a²) − 1)/2 is sinh²(asinh(1/a)/2).
fn exact_lambda(ndf: Ndf, w: DVec3, alpha: Alpha<f64>) -> f64 {
    let spread = alpha.x * w.x.hypot(alpha.ratio * w.y);
    if spread == 0.0 {
        return 0.0;
    }
    let a = w.z / spread;
    match ndf {
        Ndf::Ggx => (0.5 * (1.0 / a).asinh()).sinh().powi(2),
        Ndf::Beckmann => {
            let tail = erf::erfc(a);
            0.5 * ((-a * a).exp() / (a * std::f64::consts::PI.sqrt()) - tail)
        }
    }
}

/// G₂ = 1/(1 + Λ_o + Λ_i) from the axis down to 10⁻⁶, and in proportion to α, where masking sets in: Λ takes about ten
/// roundings, and the quotient three.
fn masking<K: Kernels>(ndf: Ndf) -> Sweep {
    let wide_g2 = match ndf {
        Ndf::Beckmann => beckmann::g2::<f64>,
        Ndf::Ggx => ggx::g2::<f64>,
    };
    let points = ALPHAS.map(|a| {
        let cosines = [1.0, 0.5, 0.1, 1e-3, 1e-6, 0.3 * a, a.min(0.9), 0.03 * a];
        let mut worst = Worst::default();
        for alpha in both(a) {
            let wide_alpha = widened(alpha);
            for (wo, wi) in pairs(&cosines) {
                let lambda = |w: DVec3| exact_lambda(ndf, w, wide_alpha);
                let exact = 1.0 / (1.0 + lambda(wo.as_dvec3()) + lambda(wi.as_dvec3()));
                let g2 = K::ndf_g2(ndf, wo.to_array(), wi.to_array(), alpha);
                worst.see(relative(g2.into(), exact), || {
                    format!("ratio {}, wo {wo}, wi {wi}", alpha.ratio)
                });
                let oracle = wide_g2(wide(wo), wide(wi), wide_alpha);
                worst.see_oracle(relative(oracle, exact));
            }
        }
        worst.at(a.into())
    });
    Sweep {
        name: format!("{}_masking", lower(ndf)),
        about: format!(
            "{ndf:?}'s masking and shadowing G₂, isotropic and 1000:1, against Λ in another form in f64."
        ),
        parameter: "α".into(),
        error: "relative error of G₂".into(),
        bound: 16.0 * ULP,
        holds: ALL,
        points: points.into(),
    }
}

fn pairs(cosines: &[f32]) -> Vec<(Vec3, Vec3)> {
    let at = |i: usize| direction(cosines[i], 0.7 + i as f64);
    let n = cosines.len();
    (0..n)
        .flat_map(|i| (0..n).map(move |j| (at(i), at(j))))
        .collect()
}

/// Why lobes below α = 10⁻⁴ are replaced by their limit: a normal that is rounded to `f32` is off by up to 6·10⁻⁸, which
/// is 6·10⁻⁸/α of the lobe's width, and D at a slope of α changes by 2.0 (GGX) to 2 (Beckmann) times that.
fn rounded_normal<K: Kernels>() -> Sweep {
    let points = ALPHAS.map(|a| {
        let mut worst = Worst::default();
        let alpha = Alpha::isotropic(a);
        for ndf in NDFS {
            for (slope, h) in normals(widened(alpha)).filter(|(slope, _)| *slope <= 2.0) {
                let exact = exact_d(ndf, h, widened(alpha));
                let d = K::ndf_d(ndf, h.as_vec3().to_array(), alpha);
                worst.see(relative(d.into(), exact), || {
                    format!("{ndf:?} at a slope of {slope} α, h {h}")
                });
            }
        }
        worst.at(a.into())
    });
    Sweep {
        name: "rounded_normal".into(),
        about: "D at a normal that is rounded to f32, up to 2 α steep, against D at the normal itself: below α = 10⁻⁴ \
                a lobe is its delta limit, because f32 cannot say where in the lobe a direction lies."
            .into(),
        parameter: "α".into(),
        error: "relative error of D".into(),
        bound: 4e-3,
        holds: ROUGH,
        points: points.into(),
    }
}
