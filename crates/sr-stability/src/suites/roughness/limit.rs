//! The step from the narrowest lobe to its delta limit.

use super::lobes::{Case, direction, even, rough};
use super::{ALL, ALPHAS};
use crate::worst::Worst;
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::glam::{DVec3, Vec3};

const MODE: TransportMode = TransportMode::Radiance;

/// Albedo, and mean direction weighted by the energy that goes there: 1024 samples.
fn moments<K: Kernels>(case: &Case, wo: Vec3) -> (f64, DVec3) {
    const N: u32 = 1024;
    let (mut albedo, mut mean) = (0.0, DVec3::ZERO);
    for i in 0..N {
        let (uc, u) = even(i, N);
        if let Some(s) = K::bsdf_sample(&case.bsdf, wo, uc, u, MODE) {
            albedo += f64::from(s.weight.x);
            mean += f64::from(s.weight.x) * s.wi.as_dvec3();
        }
    }
    (albedo / f64::from(N), mean / f64::from(N))
}

/// A facet tilts by about α and the direction by twice that; the lobe is chosen by the same numbers in both. So what
/// changes at the threshold is of the order of 10⁻⁴, magnified by up to 5 (Schlick's slope) and by 1/cosθ = 3: 20 α.
pub(super) fn delta_limit<K: Kernels>() -> Sweep {
    let wos = [1.0, 0.6, 0.3, -0.95, -0.5].map(|c| direction(c, 0.7));
    let limits = rough(0.0);
    let points = ALPHAS.map(|alpha| {
        let mut worst = Worst::default();
        for (case, limit) in rough(alpha).iter().zip(&limits) {
            for wo in wos {
                let (albedo, mean) = moments::<K>(case, wo);
                let (smooth, towards) = moments::<K>(limit, wo);
                let off = (albedo - smooth).abs().max((mean - towards).length());
                worst.see(off, || {
                    format!("{}, wo {wo}: albedo {albedo:.6} and {smooth:.6}", case.name)
                });
            }
        }
        worst.at(alpha.into())
    });
    Sweep {
        name: "delta_limit".into(),
        about: "Albedo and mean direction of rough lobes against those of their smooth limit, which takes over below \
                α = 10⁻⁴: the step there is what must not be seen."
            .into(),
        parameter: "α".into(),
        error: "difference".into(),
        bound: 20.0 * 1.01e-4,
        holds: [ALL[0], 1.1e-4],
        points: points.into(),
    }
}
