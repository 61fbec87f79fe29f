//! White furnaces: what a lobe gives back of a uniform light.

use super::lobes::{Facets, direction, even};
use super::{ROUGH, rough_alphas};
use crate::worst::Worst;
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::glam::Vec3;
use sr_stats::SphereBins;

const MODE: TransportMode = TransportMode::Importance;

/// Accuracy of the quadrature.
const QUADRATURE: f64 = 1e-3;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let [gain, estimate] = single::<K>();
    vec![gain, estimate, compensated::<K>()]
}

fn wos() -> [Vec3; 2] {
    [direction(0.95, 0.7), direction(0.25, 2.1)]
}

/// ∫ f·|cosθ| dω, first component, over the normals of facets.
fn integral<K: Kernels>(lobe: &Facets, wo: Vec3) -> f64 {
    let bins = SphereBins::uniform(12, 8);
    let value = |wi: Vec3| {
        let f = K::bsdf_eval_pdf(&lobe.bsdf, wo, wi, MODE).0;
        f64::from(f.x) * f64::from(wi.z).abs()
    };
    lobe.masses(&bins, wo, value).iter().sum()
}

/// The mean of the weights, first component, of samples that fill the unit cube evenly.
fn estimate<K: Kernels>(lobe: &Facets, wo: Vec3) -> f64 {
    const N: u32 = 8192;
    let weight = |i| {
        let (uc, u) = even(i, N);
        K::bsdf_sample(&lobe.bsdf, wo, uc, u, MODE).map_or(0.0, |s| f64::from(s.weight.x))
    };
    (0..N).map(weight).sum::<f64>() / f64::from(N)
}

fn single<K: Kernels>() -> [Sweep; 2] {
    let (mut gains, mut differences) = (Vec::new(), Vec::new());
    for alpha in rough_alphas() {
        let (mut gain, mut difference) = (Worst::default(), Worst::default());
        for lobe in Facets::all(alpha) {
            for wo in lobe.views(wos()) {
                let (by_value, by_samples) = (integral::<K>(&lobe, wo), estimate::<K>(&lobe, wo));
                let name = || format!("{} from {wo}: {by_value:.5} {by_samples:.5}", lobe.name);
                gain.see((by_value.max(by_samples) - 1.0).max(0.0), name);
                difference.see((by_value - by_samples).abs(), name);
            }
        }
        gains.push(gain.at(alpha.into()));
        differences.push(difference.at(alpha.into()));
    }
    [
        Sweep {
            name: "energy".into(),
            about: "White metal, white glass and glTF give back no more than they get, by quadrature of their values and by \
                    the mean of their weights."
                .into(),
            parameter: "α".into(),
            error: "energy gained".into(),
            bound: QUADRATURE,
            holds: ROUGH,
            points: gains,
        },
        Sweep {
            name: "albedo".into(),
            about: "The mean of the weights against the integral of the values.".into(),
            parameter: "α".into(),
            error: "difference".into(),
            // 8192 points of a sequence of three dimensions err by about log³N/N.
            bound: 4e-3,
            holds: ROUGH,
            points: differences,
        },
    ]
}

/// With compensation all light comes back, up to the 3·10⁻³ of its tables and to the quadrature.
fn compensated<K: Kernels>() -> Sweep {
    let points = rough_alphas().step_by(2).map(|alpha| {
        let mut worst = Worst::default();
        for lobe in Facets::compensated(alpha) {
            for wo in lobe.views(wos()) {
                let by_samples = estimate::<K>(&lobe, wo);
                worst.see((by_samples - 1.0).abs(), || {
                    format!("{} from {wo}: {by_samples:.5}", lobe.name)
                });
            }
        }
        worst.at(alpha.into())
    });
    Sweep {
        name: "compensated".into(),
        about: "White metal and glass with `compensate` give back all that they get.".into(),
        parameter: "α".into(),
        error: "distance of the albedo from 1".into(),
        bound: 3e-3 + 2e-3,
        holds: ROUGH,
        points: points.collect(),
    }
}
