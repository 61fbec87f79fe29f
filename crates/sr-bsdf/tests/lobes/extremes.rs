//! No argument makes a number that is not finite.

use crate::catalogue::{
    NDFS, compensated, direction, glass, gltf, gold, gold_with, perfect_metal, perfect_metal_with,
    reflected, tinted,
};
use glam::{Vec2, Vec3};
use sr_bsdf::{
    Bsdf, FresnelKind, Lambert, Microsurface, Mirror, OrenNayar, Refraction, Sampling,
    ThinDielectric, TransportMode,
};

const US: [f32; 4] = [0.0, 1.0 / 16_777_216.0, 0.5, 1.0 - f32::EPSILON / 2.0];
const COSINES: [f32; 9] = [1.0, 0.5, 1e-3, 1e-5, 1e-7, 1e-18, 1e-20, 1e-40, 0.0];
const IORS: [f32; 8] = [
    1.000_000_1,
    0.999_999_9,
    1.0,
    1.5,
    1.0 / 1.5,
    2.4,
    100.0,
    0.01,
];

fn lobes() -> Vec<Bsdf> {
    let c = Vec3::new(1.0, 0.5, 0.0);
    let mut lobes = vec![
        Bsdf::Lambert(Lambert { reflectance: c }),
        Bsdf::Lambert(Lambert {
            reflectance: Vec3::ZERO,
        }),
        Bsdf::Mirror(Mirror { reflectance: c }),
    ];
    for ior in IORS {
        lobes.push(glass(ior, FresnelKind::Exact));
        lobes.push(glass(ior, FresnelKind::Schlick));
        lobes.push(Bsdf::Refraction(Refraction {
            transmittance: c,
            ior,
        }));
        lobes.push(Bsdf::ThinDielectric(ThinDielectric {
            ior,
            reflectance: c,
            transmittance: c,
        }));
    }
    for alpha in [0.0, 1e-8, 0.999e-4, 1e-4, 1e-3, 0.5, 1.0, 10.0] {
        lobes.push(gold(alpha));
        lobes.push(perfect_metal(alpha));
        for color in [c, Vec3::ZERO, Vec3::ONE] {
            for (metallic, transmission) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (0.0, 1.0)] {
                lobes.push(gltf(
                    color,
                    metallic,
                    f32::min(alpha, 1.0).sqrt(),
                    transmission,
                ));
            }
        }
    }
    lobes.extend(rough());
    lobes.extend(compensated());
    for sigma in [0.0, 1e-20, 1e-3, 0.5, std::f32::consts::FRAC_PI_2] {
        for reflectance in [c, Vec3::ONE, Vec3::ZERO] {
            lobes.push(Bsdf::OrenNayar(OrenNayar { reflectance, sigma }));
        }
    }
    lobes
}

/// Facets of every distribution, roughness and sampling, on metal and between media.
fn rough() -> Vec<Bsdf> {
    let mut lobes = Vec::new();
    let alphas = [
        [1e-4; 2],
        [1e-3; 2],
        [1.0; 2],
        [10.0; 2],
        [1e-4, 1.0],
        [10.0, 0.0],
    ];
    let samplings = [Sampling::Visible, Sampling::Ndf, Sampling::Cosine];
    for (i, alpha) in alphas.into_iter().enumerate() {
        for (j, sampling) in samplings.into_iter().enumerate() {
            let ndf = NDFS[(i + j) % 2];
            let surface = Microsurface::new(ndf, alpha).sampled(sampling);
            lobes.push(Bsdf::Conductor(gold_with(surface)));
            lobes.push(Bsdf::Conductor(perfect_metal_with(surface)));
            for ior in [IORS[(i + j) % 8], IORS[(i + j + 3) % 8]] {
                lobes.push(Bsdf::RoughDielectric(tinted(ior, surface)));
            }
        }
    }
    lobes
}

fn directions() -> Vec<Vec3> {
    let up = COSINES
        .iter()
        .enumerate()
        .map(|(i, &cos)| direction(cos, i as f32));
    up.flat_map(|w| [w, Vec3::new(w.x, w.y, -w.z)]).collect()
}

fn harmless(x: Vec3) -> bool {
    x.is_finite() && x.min_element() >= 0.0
}

#[test]
fn sampling_is_finite_at_every_extreme() {
    for bsdf in lobes() {
        for wo in directions() {
            for uc in US {
                for u in US.iter().flat_map(|&a| US.map(|b| Vec2::new(a, b))) {
                    for mode in [TransportMode::Radiance, TransportMode::Importance] {
                        if let Some(s) = bsdf.sample(wo, uc, u, mode) {
                            assert!(
                                s.pdf > 0.0 && s.pdf.is_finite(),
                                "{bsdf:?} {wo} {uc} {u} {s:?}"
                            );
                            assert!(
                                harmless(s.weight) && s.wi.is_finite(),
                                "{bsdf:?} {wo} {uc} {u} {s:?}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn evaluation_is_finite_at_every_extreme() {
    for bsdf in lobes() {
        for wo in directions() {
            let related = [wo, -wo, reflected(wo), -reflected(wo)];
            for wi in directions().into_iter().chain(related) {
                let (f, pdf) = bsdf.eval_pdf(wo, wi, TransportMode::Radiance);
                assert!(
                    harmless(f) && pdf.is_finite() && pdf >= 0.0,
                    "{bsdf:?} {wo} {wi}: {f} {pdf}"
                );
            }
        }
        assert!(harmless(bsdf.albedo()), "{bsdf:?}");
    }
}

/// A tangent direction has no side: nothing is sampled from it and nothing scattered into it.
#[test]
fn tangent_directions_scatter_nothing() {
    for bsdf in lobes() {
        let (tangent, wi) = (Vec3::X, Vec3::new(-0.8, 0.0, 0.6));
        let mode = TransportMode::Radiance;
        assert!(
            bsdf.sample(tangent, 0.5, Vec2::splat(0.5), mode).is_none(),
            "{bsdf:?}"
        );
        assert_eq!(bsdf.eval_pdf(tangent, wi, mode), (Vec3::ZERO, 0.0));
        assert_eq!(bsdf.eval_pdf(wi, tangent, mode), (Vec3::ZERO, 0.0));
    }
}
