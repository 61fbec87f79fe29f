//! Samples against densities: χ², and densities that integrate to 1.

use super::lobes::{Facets, direction, random};
use super::{ROUGH, rough_alphas};
use crate::worst::Worst;
use crate::{Effort, Kernels, Sweep};
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::glam::Vec3;
use sr_stats::{SphereBins, chi2_test, family_p_value};

const MODE: TransportMode = TransportMode::Radiance;

/// What a bin expects at least, as a share: the quadrature's absolute error, so that a sample in a sliver of a bin that
/// all nodes missed is rare, and not impossible.
const SLIVER: f64 = 1e-6;

pub(super) fn sweeps<K: Kernels>(effort: &Effort) -> [Sweep; 2] {
    let samples = effort.choose(20_000, 400_000);
    let bins = SphereBins::uniform(16, 12);
    let (mut fits, mut integrals) = (Vec::new(), Vec::new());
    for (a, alpha) in rough_alphas().enumerate() {
        let (mut smallest, mut tests) = ((1.0, String::new()), 0);
        let mut integral = Worst::default();
        for (l, lobe) in Facets::all(alpha).iter().enumerate() {
            for (v, wo) in lobe.views(wos()).into_iter().enumerate() {
                let key = (100 * a + 10 * l + v) as u32;
                let one = fit::<K>(lobe, wo, &bins, samples, key);
                tests += 1;
                let name = || format!("{} from {wo}", lobe.name);
                if one.p_value < smallest.0 {
                    smallest = (one.p_value, name());
                }
                integral.see_mean(one.excess, one.half_width, name);
            }
        }
        let mut worst = Worst::default();
        let p = family_p_value(smallest.0, tests * rough_alphas().count());
        worst.see(-p.max(1e-300).log10(), || smallest.1);
        fits.push(worst.at(alpha.into()));
        integrals.push(integral.at(alpha.into()));
    }
    [
        Sweep {
            name: "chi2".into(),
            about: "Directions of rough metal, glass and glTF against their densities, isotropic and 1000:1, from either \
                    side: Pearson's χ² over the normals of facets, all tests of the sweep taken together. One of some \
                    hundred bins finds a density that is off by 5 %."
                .into(),
            parameter: "α".into(),
            error: "−log₁₀ of the p-value".into(),
            // A false alarm in a thousand, on fixed seeds.
            bound: 3.0,
            holds: ROUGH,
            points: fits,
        },
        Sweep {
            name: "pdf_integral".into(),
            about: "The density's integral and the share of samples that fail sum to 1.".into(),
            parameter: "α".into(),
            error: "distance from 1".into(),
            // Of a share of a half of the samples a standard error is 1/(2 √n): the largest of some hundred such shares is off
            // by up to four of them, and as many are the uncertainty; and the quadrature's 10⁻³.
            bound: 4.0 / f64::from(samples).sqrt() + 1e-3,
            holds: ROUGH,
            points: integrals,
        },
    ]
}

fn wos() -> [Vec3; 2] {
    [direction(0.9, 0.7), direction(0.3, 2.1)]
}

struct Fit {
    p_value: f64,
    /// Distance of the integral from what it should be.
    excess: f64,
    half_width: f64,
}

fn fit<K: Kernels>(lobe: &Facets, wo: Vec3, bins: &SphereBins, samples: u32, key: u32) -> Fit {
    let draw = |i| {
        let (uc, u) = random(key, i);
        K::bsdf_sample(&lobe.bsdf, wo, uc, u, MODE).map(|s| s.wi)
    };
    let observed = lobe.count(bins, wo, (0..samples).map(draw));
    let density = |wi: Vec3| f64::from(K::bsdf_eval_pdf(&lobe.bsdf, wo, wi, MODE).1);
    let mut expected = lobe.masses(bins, wo, density);
    let total: f64 = expected.iter().sum();
    let n = f64::from(samples);
    let failed = observed.last().map_or(0.0, |&k| k as f64 / n);
    expected.push((1.0 - total).max(0.0));
    for e in &mut expected {
        *e = e.max(SLIVER) * n;
    }
    let finite = expected.iter().all(|e| e.is_finite());
    Fit {
        p_value: if finite {
            chi2_test(&observed, &expected, 5.0).p_value
        } else {
            0.0
        },
        excess: (total + failed - 1.0).abs(),
        half_width: 4.0 * (failed * (1.0 - failed) / n).sqrt(),
    }
}
