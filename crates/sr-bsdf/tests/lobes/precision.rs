//! The lobes in `f32` and in `f64` are one: the same source, the same samples.

use crate::catalogue::{delta, random, wide, wide_array, wos};
use sr_bsdf::{Bsdf, BsdfSampleOf, TransportMode};

const MODE: TransportMode = TransportMode::Radiance;

/// A few roundings, magnified by what the terms of a half vector magnify.
const ROUNDINGS: f64 = 64.0 * f32::EPSILON as f64;

fn all() -> impl Iterator<Item = Bsdf> {
    wide().into_iter().chain(delta())
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

/// The same numbers give the same lobe and the same direction, up to rounding: at grazing (cosθ 10⁻², the worst here) a
/// normal's rounding turns into a relative 100 times as large of the slope, and Beckmann's is found by iteration to an
/// ulp: 10⁻⁴. The weights agree as well as the directions. A sample at the edge between two lobes may fall on
/// either side: up to two in a thousand are let off, and a wrong branch is one in ten.
#[test]
fn samples_in_both_precisions_are_the_same() {
    let (mut compared, mut apart_by_branch) = (0u32, 0u32);
    for (key, bsdf) in all().enumerate() {
        for wo in wos() {
            for i in 0..200 {
                let (uc, u) = random(key as u32, i);
                let single = bsdf.sample(wo, uc, u, MODE);
                let u = u.to_array().map(f64::from);
                let wide: Option<BsdfSampleOf<f64>> =
                    bsdf.sample_real(wide_array(wo), f64::from(uc), u, MODE);
                compared += 1;
                match (single, wide) {
                    (None, None) => {}
                    (Some(a), Some(b)) if a.lobe == b.lobe => {
                        let off = apart(wide_array(a.wi), b.wi);
                        assert!(off < 1e-4, "{bsdf:?} {wo} {uc} {u:?}: {a:?} {b:?}");
                        let largest = b.weight.into_iter().fold(1.0, f64::max);
                        let off = apart(wide_array(a.weight), b.weight) / largest;
                        assert!(off < 1e-3, "{bsdf:?} {wo} {uc} {u:?}: {a:?} {b:?}");
                        assert!((f64::from(a.eta) - b.eta).abs() < ROUNDINGS);
                    }
                    _ => apart_by_branch += 1,
                }
            }
        }
    }
    assert!(
        apart_by_branch * 500 < compared,
        "{apart_by_branch} of {compared}"
    );
}

/// In f64, where the only thing that may differ is the order of a few products: weight = f·|cosθ|/pdf to 10⁻¹¹, which is
/// the rounding of f64 times the 10⁴ by which the narrowest lobe magnifies it.
#[test]
fn the_wide_weight_is_value_times_cosine_by_density() {
    for (key, bsdf) in wide().into_iter().enumerate() {
        for wo in wos() {
            for i in 0..100 {
                let (uc, u) = random(key as u32, i);
                let (wo, u) = (wide_array(wo), u.to_array().map(f64::from));
                let sample = bsdf.sample_real(wo, f64::from(uc), u, MODE);
                let Some(s) = sample.filter(|s| !s.lobe.is_delta()) else {
                    continue;
                };
                let (f, pdf) = bsdf.eval_pdf_real(wo, s.wi, MODE);
                assert_eq!(pdf.to_bits(), s.pdf.to_bits(), "{bsdf:?} {wo:?} {s:?}");
                let weight = f.map(|x| x * s.wi[2].abs() / pdf);
                let scale = weight.into_iter().fold(1e-30, f64::max);
                assert!(apart(weight, s.weight) < 1e-11 * scale, "{bsdf:?} {s:?}");
            }
        }
    }
}
