//! A lobe that narrows becomes its delta limit.

use crate::catalogue::{NDFS, gltf, gold, gold_with, random, tinted, wos};
use glam::Vec3;
use sr_bsdf::{Bsdf, Microsurface, Sampling, TransportMode};

/// A smooth function of direction with slopes up to about 2, which tells directions apart.
fn light(w: Vec3) -> f64 {
    f64::from(1.0 + 0.5 * w.x - 0.3 * w.y + 0.7 * w.z * w.z)
}

/// What `wo` sees of the light: 4000 samples.
fn seen(bsdf: &Bsdf, wo: Vec3) -> f64 {
    const N: u32 = 4000;
    let sum: f64 = (0..N)
        .map(|i| {
            let (uc, u) = random(17, i);
            bsdf.sample(wo, uc, u, TransportMode::Radiance)
                .map_or(0.0, |s| f64::from(s.weight.x) * light(s.wi))
        })
        .sum();
    sum / f64::from(N)
}

/// The difference to the delta limit stays below 20·α down to the threshold of 10⁻⁴: a facet tilts by about α,
/// the direction by twice that, and Schlick's term has a slope of up to 5 (at α ≪ cosθ;
/// masking comes in where they are alike). The lobe is chosen by the same
/// numbers in both, so the noise is of the order of α/√4000 besides. So at the threshold pictures differ by
/// under 0.2 %.
fn check(limit: Bsdf, rough: impl Fn(f32) -> Bsdf) {
    for wo in wos() {
        let smooth = seen(&limit, wo);
        for alpha in [1.01e-4f32, 3e-4, 1e-3] {
            let difference = (seen(&rough(alpha), wo) - smooth).abs();
            assert!(
                difference < 20.0 * f64::from(alpha),
                "{limit:?} α {alpha} {wo}: {difference}"
            );
        }
    }
}

#[test]
fn conductor_becomes_a_mirror() {
    assert!(gold(0.99e-4).flags().is_delta() && !gold(1.01e-4).flags().is_delta());
    check(gold(0.0), gold);
}

/// Both distributions, both ways to sample normals, compensated or not; with two roughnesses the larger one counts.
#[test]
fn every_metal_becomes_a_mirror() {
    for ndf in NDFS {
        for sampling in [Sampling::Visible, Sampling::Ndf] {
            let metal = |alpha: f32| {
                let surface = Microsurface::new(ndf, [alpha, 0.5 * alpha]).sampled(sampling);
                gold_with(surface)
            };
            check(Bsdf::Conductor(metal(0.0)), |a| Bsdf::Conductor(metal(a)));
            check(Bsdf::Conductor(metal(0.0)), |a| {
                Bsdf::Conductor(metal(a).compensated())
            });
        }
    }
}

/// From inside beyond the critical angle too, and for an index near 1, whose threshold is at 2.1·10⁻⁴.
#[test]
fn frosted_glass_becomes_clear() {
    for ndf in NDFS {
        for ior in [1.5, 1.0 / 1.5, 2.4, 1.05] {
            let glass = |alpha: f32| tinted(ior, Microsurface::isotropic(ndf, alpha));
            let is_delta = |a| Bsdf::RoughDielectric(glass(a)).flags().is_delta();
            let threshold = if ior == 1.05 { 2.1e-4 } else { 1e-4 };
            assert!(is_delta(0.99 * threshold) && !is_delta(1.01 * threshold));
            check(Bsdf::RoughDielectric(glass(0.0)), |a| {
                Bsdf::RoughDielectric(glass(a))
            });
        }
    }
}

#[test]
fn gltf_becomes_smooth() {
    let color = Vec3::new(0.8, 0.5, 0.1);
    for (metallic, transmission) in [(1.0, 0.0), (0.0, 1.0)] {
        let at = |roughness| gltf(color, metallic, roughness, transmission);
        assert!(at(0.009_9).flags().is_delta() && !at(0.010_1).flags().is_delta());
        check(at(0.0), |alpha| at(alpha.sqrt()));
    }
}
