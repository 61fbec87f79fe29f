//! The lobes and directions that the tests go through.

use glam::{Vec2, Vec3};
use sr_bsdf::{
    Bsdf, Conductor, Dielectric, FresnelKind, Lambert, MetallicRoughness, Mirror, Refraction,
    ThinDielectric,
};
use sr_math::hash::{mix, unit_f32};

/// Gold, about.
pub fn gold(alpha: f32) -> Bsdf {
    let (eta, k) = (
        Vec3::new(0.143, 0.375, 1.442),
        Vec3::new(3.983, 2.386, 1.603),
    );
    Bsdf::Conductor(Conductor { eta, k, alpha })
}

/// An index of i reflects everything at every angle: |(c − w)/(c + w)| = 1 for an imaginary w.
pub fn perfect_metal(alpha: f32) -> Bsdf {
    Bsdf::Conductor(Conductor {
        eta: Vec3::ZERO,
        k: Vec3::ONE,
        alpha,
    })
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

/// The lobe can be resolved: it is α·cosθ wide across, and below 10⁻⁵ the lattice of f32 directions, 6·10⁻⁸,
/// shows in counts and in quadrature.
pub fn resolved(bsdf: &Bsdf, wo: Vec3) -> bool {
    width(bsdf) * f64::from(wo.z.abs()) > 0.9e-5
}

/// Width of the narrowest lobe that is not a delta.
pub fn width(bsdf: &Bsdf) -> f64 {
    match bsdf {
        Bsdf::Conductor(c) => f64::from(c.alpha),
        Bsdf::MetallicRoughness(m) if m.roughness >= 0.0101 => f64::from(m.roughness).powi(2),
        _ => 1.0,
    }
}
