//! Every lobe, light, filter and aperture, with the parameters at which they branch.

use sr_pipeline::bsdf::{
    Bsdf, Conductor, ConductorFresnel, Dielectric, FresnelKind, Lambert, MetallicRoughness,
    Microsurface, Mirror, Ndf, OrenNayar, Refraction, RoughDielectric, Sampling, ThinDielectric,
};
use sr_pipeline::glam::{Mat3, Vec3};
use sr_pipeline::light::{
    ConstantEnvironment, DirectionalLight, EnvironmentMap, EnvironmentSampling, ImageEnvironment,
    Light, PointLight, QuadLight, SphereLight, SpotLight, TriangleLight,
};
use sr_pipeline::sampling::{Filter, FilterSampler};
use sr_pipeline::sr_render::{Aperture, Lens};
use std::sync::Arc;

const COLOR: Vec3 = Vec3::new(1.0, 0.5, 0.0);

pub(super) fn lobes() -> Vec<(String, Bsdf)> {
    let mut lobes = smooth();
    for ndf in [Ndf::Beckmann, Ndf::Ggx] {
        for sampling in [Sampling::Visible, Sampling::Ndf, Sampling::Cosine] {
            for alpha in [[0.0; 2], [1e-3; 2], [0.3; 2], [1.0; 2], [0.001, 1.0]] {
                let surface = Microsurface::new(ndf, alpha).sampled(sampling);
                let name = format!("α {alpha:?} of {ndf:?} by {sampling:?}");
                lobes.extend(rough(&name, surface));
            }
        }
    }
    let surface = Microsurface::isotropic(Ndf::Ggx, 0.5);
    let metal = gold(surface).compensated();
    lobes.push(("compensated metal".into(), Bsdf::Conductor(metal)));
    let glass = RoughDielectric::new(1.5, COLOR, COLOR, surface).compensated();
    lobes.push(("compensated glass".into(), Bsdf::RoughDielectric(glass)));
    lobes
}

fn gold(surface: Microsurface) -> Conductor {
    let (eta, k) = (
        Vec3::new(0.143, 0.375, 1.442),
        Vec3::new(3.983, 2.386, 1.603),
    );
    Conductor::new(eta, k, ConductorFresnel::Exact, surface)
}

fn rough(name: &str, surface: Microsurface) -> [(String, Bsdf); 2] {
    let glass = RoughDielectric::new(1.5, Vec3::ONE, COLOR, surface);
    [
        (format!("metal, {name}"), Bsdf::Conductor(gold(surface))),
        (format!("glass, {name}"), Bsdf::RoughDielectric(glass)),
    ]
}

fn smooth() -> Vec<(String, Bsdf)> {
    let mut lobes = vec![
        (
            "Lambert".to_owned(),
            Bsdf::Lambert(Lambert { reflectance: COLOR }),
        ),
        (
            "mirror".to_owned(),
            Bsdf::Mirror(Mirror { reflectance: COLOR }),
        ),
    ];
    for sigma in [0.0, 0.5, std::f32::consts::FRAC_PI_2] {
        let lobe = OrenNayar {
            reflectance: COLOR,
            sigma,
        };
        lobes.push((format!("Oren–Nayar {sigma}"), Bsdf::OrenNayar(lobe)));
    }
    for ior in [1.0, 1.000_000_1, 1.5, 1.0 / 1.5, 100.0] {
        let (reflectance, transmittance) = (COLOR, Vec3::ONE);
        let refraction = Refraction { transmittance, ior };
        lobes.push((format!("refraction {ior}"), Bsdf::Refraction(refraction)));
        let pane = ThinDielectric {
            ior,
            reflectance,
            transmittance,
        };
        lobes.push((format!("pane {ior}"), Bsdf::ThinDielectric(pane)));
        for fresnel in [FresnelKind::Exact, FresnelKind::Schlick] {
            let glass = Dielectric {
                ior,
                reflectance,
                transmittance,
                fresnel,
            };
            lobes.push((format!("{fresnel:?} glass {ior}"), Bsdf::Dielectric(glass)));
        }
    }
    for (metallic, transmission) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (0.0, 1.0)] {
        for roughness in [0.0, 0.1, 1.0] {
            let lobe = MetallicRoughness {
                base_color: COLOR,
                metallic,
                roughness,
                ior: 1.5,
                transmission,
            };
            let name = format!(
                "glTF, metallic {metallic}, transmission {transmission}, roughness {roughness}"
            );
            lobes.push((name, Bsdf::MetallicRoughness(lobe)));
        }
    }
    lobes
}

/// Directions from the axis to grazing, on both sides.
pub(super) fn views() -> Vec<Vec3> {
    let cosines = [1.0f64, 0.5, 1e-3, 1e-7];
    let up = cosines.map(|cos| {
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        Vec3::new((0.6 * sin) as f32, (-0.8 * sin) as f32, cos as f32)
    });
    up.into_iter()
        .flat_map(|w| [w, Vec3::new(w.x, w.y, -w.z)])
        .collect()
}

pub(super) fn lights() -> Vec<(&'static str, Light)> {
    let (o, x, y, z, r) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, COLOR);
    let mut lights = vec![
        (
            "a triangle",
            Light::Triangle(TriangleLight::new([o, x, y], r, true)),
        ),
        (
            "a needle",
            Light::Triangle(TriangleLight::new([o, 1e-6 * x, 10.0 * y], r, true)),
        ),
        (
            "a rectangle",
            Light::Quad(QuadLight::new(-x - y, 2.0 * x, 2.0 * y, r, true)),
        ),
        (
            "a parallelogram",
            Light::Quad(QuadLight::new(o, x, 0.5 * x + y, r, true)),
        ),
        (
            "a strip",
            Light::Quad(QuadLight::new(o, 100.0 * x, 1e-4 * y, r, true)),
        ),
        ("a sphere", Light::Sphere(SphereLight::new(o, 1.0, r, true))),
        (
            "a small sphere",
            Light::Sphere(SphereLight::new(x, 1e-6, r, false)),
        ),
        ("a point", Light::Point(PointLight { p: o, intensity: r })),
        (
            "the sun",
            Light::Directional(DirectionalLight {
                wi: z,
                irradiance: r,
            }),
        ),
        (
            "a white sky",
            Light::Environment(ConstantEnvironment { radiance: r }),
        ),
    ];
    let spot = SpotLight {
        p: o,
        axis: z,
        intensity: r,
        cos_inner: 0.9,
        cos_outer: 0.5,
    };
    lights.push(("a spot", Light::Spot(spot)));
    let maps = [
        ("a map", 8, 4),
        ("a map of one texel", 1, 1),
        ("a map of two texels", 2, 1),
    ];
    for (name, width, height) in maps {
        for sampling in [
            EnvironmentSampling::Importance,
            EnvironmentSampling::Uniform,
        ] {
            lights.extend(sky(width, height, sampling).map(|sky| (name, sky)));
        }
    }
    lights
}

/// One hot texel among black rows.
fn sky(width: u32, height: u32, sampling: EnvironmentSampling) -> Option<Light> {
    let mut texels = vec![Vec3::ZERO; (width * height) as usize];
    *texels.last_mut()? = 1e6 * COLOR;
    let map = EnvironmentMap::new(width, height, texels).ok()?;
    Some(Light::ImageEnvironment(ImageEnvironment {
        map: Arc::new(map),
        to_map: Mat3::IDENTITY,
        scale: Vec3::ONE,
        sampling,
    }))
}

/// Before and behind the lights, inside of the sphere, in their planes, close and far.
pub(super) fn receivers() -> Vec<Vec3> {
    vec![
        Vec3::new(0.2, 0.1, 1.5),
        Vec3::new(0.2, 0.3, -3.0),
        Vec3::new(0.3, -0.1, 0.2),
        Vec3::new(3.0, 2.0, 0.0),
        Vec3::new(0.2, 0.2, 1e-6),
        Vec3::new(1e-3, 1e5, 1e6),
    ]
}

pub(super) fn filters() -> Vec<(Filter, FilterSampler)> {
    let all = [
        Filter::Box { radius: 0.5 },
        Filter::Tent { radius: 1.0 },
        Filter::Gaussian {
            radius: 1.5,
            sigma: 0.5,
        },
        Filter::BlackmanHarris { radius: 64.0 },
    ];
    all.into_iter()
        .filter_map(|f| Some((f, FilterSampler::new(f)?)))
        .collect()
}

pub(super) fn lenses() -> Vec<Lens> {
    let apertures = [
        Aperture::Round,
        Aperture::polygon(3, 0.0),
        Aperture::polygon(6, 10.0),
    ];
    apertures
        .into_iter()
        .filter_map(|a| Lens::new(0.1, 1.0, a))
        .collect()
}
