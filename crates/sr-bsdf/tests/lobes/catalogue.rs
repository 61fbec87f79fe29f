//! The lobes and directions that the tests go through.

use glam::{Vec2, Vec3};
use sr_bsdf::{
    Bsdf, Conductor, ConductorFresnel, Dielectric, FresnelKind, Lambert, MetallicRoughness,
    Microsurface, Mirror, Ndf, OrenNayar, Refraction, RoughDielectric, Sampling, ThinDielectric,
    refract,
};
use sr_math::hash::{mix, unit_f32};

pub const GOLD: (Vec3, Vec3) = (
    Vec3::new(0.143, 0.375, 1.442),
    Vec3::new(3.983, 2.386, 1.603),
);

/// Gold, about.
pub fn gold(alpha: f32) -> Bsdf {
    Bsdf::Conductor(gold_with(Microsurface::isotropic(Ndf::Beckmann, alpha)))
}

pub fn gold_with(surface: Microsurface) -> Conductor {
    Conductor::new(GOLD.0, GOLD.1, ConductorFresnel::Exact, surface)
}

/// An index of i reflects everything at every angle: |(c − w)/(c + w)| = 1 for an imaginary w.
pub fn perfect_metal(alpha: f32) -> Bsdf {
    Bsdf::Conductor(perfect_metal_with(Microsurface::isotropic(
        Ndf::Beckmann,
        alpha,
    )))
}

pub fn perfect_metal_with(surface: Microsurface) -> Conductor {
    Conductor::new(Vec3::ZERO, Vec3::ONE, ConductorFresnel::Exact, surface)
}

pub fn glass(ior: f32, fresnel: FresnelKind) -> Bsdf {
    let white = Vec3::ONE;
    Bsdf::Dielectric(Dielectric {
        ior,
        reflectance: white,
        transmittance: white,
        fresnel,
    })
}

/// Clear frosted glass.
pub fn frosted(ior: f32, surface: Microsurface) -> RoughDielectric {
    RoughDielectric::new(ior, Vec3::ONE, Vec3::ONE, surface)
}

pub fn gltf(base_color: Vec3, metallic: f32, roughness: f32, transmission: f32) -> Bsdf {
    Bsdf::MetallicRoughness(MetallicRoughness {
        base_color,
        metallic,
        roughness,
        ior: 1.5,
        transmission,
    })
}

/// Both sides of the threshold of smoothness, and beyond α = 1 for Beckmann.
pub const ALPHAS: [f32; 6] = [1e-4, 1e-3, 0.02, 0.2, 0.7, 1.5];
pub const ROUGHNESSES: [f32; 6] = [0.0, 0.02, 0.1, 0.4, 0.8, 1.0];
pub const NDFS: [Ndf; 2] = [Ndf::Beckmann, Ndf::Ggx];

/// Rough surfaces of every kind: each distribution, roughness and sampling.
///
/// By the cosine only where the lobe is wide enough for the mean of its weights to be known from 10⁴ samples.
pub fn surfaces() -> Vec<Microsurface> {
    let mut surfaces = Vec::new();
    for (i, ndf) in NDFS.into_iter().enumerate() {
        for alpha in [
            [1e-4; 2],
            [0.02; 2],
            [0.2; 2],
            [1.0; 2],
            [0.05, 0.4],
            [0.5, 0.02],
        ] {
            surfaces.push(Microsurface::new(ndf, alpha));
        }
        for alpha in [[1e-4; 2], [0.2; 2], [0.3, 0.1]] {
            let surface = Microsurface::new(ndf, alpha);
            surfaces.push(surface.sampled(Sampling::Ndf));
        }
        let alpha = [[0.3, 0.7], [0.5, 0.5]][i];
        surfaces.push(Microsurface::new(ndf, alpha).sampled(Sampling::Cosine));
    }
    surfaces
}

/// Lobes of facets with what single scattering loses given back.
pub fn compensated() -> Vec<Bsdf> {
    let surfaces = [
        Microsurface::isotropic(Ndf::Beckmann, 0.2),
        Microsurface::isotropic(Ndf::Ggx, 1.0),
        Microsurface::new(Ndf::Ggx, [0.6, 0.15]),
        Microsurface::isotropic(Ndf::Ggx, 0.4).sampled(Sampling::Ndf),
        Microsurface::isotropic(Ndf::Beckmann, 0.6).sampled(Sampling::Cosine),
    ];
    let metals = surfaces.map(|s| Bsdf::Conductor(gold_with(s).compensated()));
    let glasses = surfaces.into_iter().zip([1.5, 1.5, 1.0 / 1.5, 2.4, 1.5]);
    let glasses = glasses.map(|(s, ior)| Bsdf::RoughDielectric(tinted(ior, s).compensated()));
    metals.into_iter().chain(glasses).collect()
}

/// Frosted glass that keeps more of one colour.
pub fn tinted(ior: f32, surface: Microsurface) -> RoughDielectric {
    let (r, t) = (Vec3::new(0.9, 0.8, 0.7), Vec3::new(0.5, 0.6, 1.0));
    RoughDielectric::new(ior, r, t, surface)
}

/// Lobes that have a density, whole or in part.
pub fn wide() -> Vec<Bsdf> {
    let color = Vec3::new(0.8, 0.5, 0.1);
    let mut lobes = vec![Bsdf::Lambert(Lambert { reflectance: color })];
    lobes.extend(ALPHAS.map(gold));
    for roughness in ROUGHNESSES {
        for (metallic, transmission) in [(0.0, 0.0), (1.0, 0.0), (0.4, 0.3), (0.0, 1.0)] {
            lobes.push(gltf(color, metallic, roughness, transmission));
        }
    }
    for (i, surface) in surfaces().into_iter().enumerate() {
        let ior = [1.5, 1.0 / 1.5, 1.05, 2.4][i % 4];
        lobes.push(Bsdf::RoughDielectric(tinted(ior, surface)));
        // What reflects is the same on both; each kind of surface on one metal is enough.
        if i % 2 == 1 {
            lobes.push(Bsdf::Conductor(gold_with(surface)));
        }
    }
    let surface = Microsurface::isotropic(Ndf::Ggx, 0.3);
    let fresnel = ConductorFresnel::Approximate;
    lobes.push(Bsdf::Conductor(Conductor::new(
        GOLD.0, GOLD.1, fresnel, surface,
    )));
    lobes.extend(compensated());
    for degrees in [0.0f32, 10.0, 30.0, 90.0] {
        lobes.push(Bsdf::OrenNayar(OrenNayar {
            reflectance: color,
            sigma: degrees.to_radians(),
        }));
    }
    lobes.retain(|b| !b.flags().is_delta());
    lobes
}

/// Lobes of deltas only.
pub fn delta() -> Vec<Bsdf> {
    let (r, t) = (Vec3::new(0.9, 0.8, 0.7), Vec3::new(0.5, 0.6, 1.0));
    let mut lobes = vec![
        Bsdf::Mirror(Mirror { reflectance: r }),
        gold(1e-5),
        gltf(r, 1.0, 0.005, 0.0),
        gltf(r, 0.0, 0.0, 1.0),
    ];
    for ior in [1.0 / 1.5, 1.0, 1.5, 2.4] {
        lobes.push(Bsdf::Refraction(Refraction {
            transmittance: t,
            ior,
        }));
        lobes.push(Bsdf::ThinDielectric(ThinDielectric {
            ior,
            reflectance: r,
            transmittance: t,
        }));
        for fresnel in [FresnelKind::Exact, FresnelKind::Schlick] {
            lobes.push(Bsdf::Dielectric(Dielectric {
                ior,
                reflectance: r,
                transmittance: t,
                fresnel,
            }));
        }
        // An index of 1 is passed straight, however rough.
        let alpha = if ior == 1.0 { 0.5 } else { 1e-5 };
        let surface = Microsurface::isotropic(Ndf::Ggx, alpha);
        lobes.push(Bsdf::RoughDielectric(tinted(ior, surface).compensated()));
    }
    lobes
}

pub fn direction(cos: f32, phi: f32) -> Vec3 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    Vec3::new(sin * phi.cos(), sin * phi.sin(), cos)
}

/// From the axis to grazing, from above and below, at azimuths of no symmetry.
pub fn wos() -> impl Iterator<Item = Vec3> {
    let cosines = [1.0, -0.6, 0.1, -0.1, 0.01, -0.01f32];
    cosines
        .into_iter()
        .enumerate()
        .map(|(i, cos)| direction(cos, 0.7 + i as f32))
}

/// Sample `i` of the sequence `key`: `uc` and `u`.
pub fn random(key: u32, i: u32) -> (f32, Vec2) {
    let r = |k| unit_f32(mix(mix(key, i), k));
    (r(0), Vec2::new(r(1), r(2)))
}

pub fn wide_array(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

pub fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from(v.map(|x| x as f32))
}

/// The specular direction.
pub fn reflected(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// Where light goes through: refracted at the smooth surface, along it at total reflection, or straight on.
pub fn through(bsdf: &Bsdf, wo: Vec3) -> Vec3 {
    let Bsdf::RoughDielectric(d) = bsdf else {
        return -wo;
    };
    let side = wo.z.signum();
    let eta = if side > 0.0 { d.ior() } else { 1.0 / d.ior() };
    match refract(wo.to_array(), [0.0, 0.0, side], eta) {
        Some(wi) => Vec3::from(wi),
        None => Vec3::new(-wo.x, -wo.y, -0.01 * side).normalize(),
    }
}

/// The lobe can be resolved: it is α·cosθ wide across, and below 10⁻⁵ the lattice of f32 directions, 6·10⁻⁸,
/// shows in counts and in quadrature. A refracted one is narrower by about 1 − 1/η.
pub fn resolved(bsdf: &Bsdf, wo: Vec3) -> bool {
    width(bsdf).min(through_width(bsdf)) * f64::from(wo.z.abs()) > 0.9e-5
}

/// Width of the narrowest lobe that is not a delta, on the side of `wo`.
pub fn width(bsdf: &Bsdf) -> f64 {
    match bsdf {
        Bsdf::Conductor(c) => narrower(c.surface()),
        Bsdf::RoughDielectric(d) => narrower(d.surface()),
        Bsdf::MetallicRoughness(m) if m.roughness >= 0.0101 => f64::from(m.roughness).powi(2),
        _ => 1.0,
    }
}

/// The same on the other side.
pub fn through_width(bsdf: &Bsdf) -> f64 {
    match bsdf {
        Bsdf::RoughDielectric(d) => {
            let ior = f64::from(d.ior());
            narrower(d.surface()) * ((ior - 1.0).abs() / ior.max(1.0)).min(1.0)
        }
        _ => width(bsdf),
    }
}

fn narrower(surface: &Microsurface) -> f64 {
    f64::from(surface.alpha().x.min(surface.alpha().y()))
}

/// Lobe directions come from the cosine alone.
pub fn is_sampled_by_cosine(bsdf: &Bsdf) -> bool {
    match bsdf {
        Bsdf::Conductor(c) => c.surface().sampling() == Sampling::Cosine,
        Bsdf::RoughDielectric(d) => d.surface().sampling() == Sampling::Cosine,
        _ => false,
    }
}
