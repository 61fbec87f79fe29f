//! What the suites of lobes share: the lobes, directions, and random numbers.

mod facets;

pub(super) use facets::Facets;

use sr_pipeline::bsdf::metals::{METALS, Metal};
use sr_pipeline::bsdf::{
    Bsdf, Conductor, ConductorFresnel, Dielectric, FresnelKind, Lambert, MetallicRoughness,
    Microsurface, Mirror, Ndf, OrenNayar, Refraction, RoughDielectric, ThinDielectric,
};
use sr_pipeline::glam::{Vec2, Vec3};
use sr_pipeline::math::hash::{mix, unit_f32};

pub(super) const NDFS: [Ndf; 2] = [Ndf::Beckmann, Ndf::Ggx];

/// The index of an isotropic surface, and the contrast of a brushed one: α_x/α_y.
pub(super) const BRUSHED: f32 = 1000.0;

/// A lobe and what to call it.
#[derive(Clone, Debug)]
pub(super) struct Case {
    pub name: String,
    pub bsdf: Bsdf,
}

impl Case {
    pub fn new(name: impl Into<String>, bsdf: Bsdf) -> Self {
        Self {
            name: name.into(),
            bsdf,
        }
    }
}

/// A unit vector, rounded once; the cosine is kept as it is.
pub(super) fn direction(cos: f32, phi: f64) -> Vec3 {
    let c = f64::from(cos);
    let sin = ((1.0 - c) * (1.0 + c)).sqrt();
    Vec3::new((sin * phi.cos()) as f32, (sin * phi.sin()) as f32, cos)
}

pub(super) fn wide(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// Sample `i` of the sequence `key`: `uc` and `u`.
pub(super) fn random(key: u32, i: u32) -> (f32, Vec2) {
    let r = |k| unit_f32(mix(mix(key, i), k));
    (r(0), Vec2::new(r(1), r(2)))
}

/// Sample `i` of `n` that fill the cube evenly (Hammersley 1960, in the bases 2 and 3).
pub(super) fn even(i: u32, n: u32) -> (f32, Vec2) {
    let below_one = |x: f64| (x as f32).min(1.0 - f32::EPSILON / 2.0);
    let inverse = |base: u32| {
        let (mut rest, mut digit, mut sum) = (i, 1.0 / f64::from(base), 0.0);
        while rest > 0 {
            sum += f64::from(rest % base) * digit;
            digit /= f64::from(base);
            rest /= base;
        }
        sum
    };
    let x = (f64::from(i) + 0.5) / f64::from(n);
    let u = Vec2::new(below_one(x), below_one(inverse(2)));
    (below_one(inverse(3)), u)
}

pub(super) fn gold() -> &'static Metal {
    let found = METALS.iter().find(|m| m.symbol == "Au");
    found.expect("gold is among the metals")
}

pub(super) fn gold_conductor(surface: Microsurface) -> Conductor {
    let Metal { eta, k, .. } = *gold();
    Conductor::new(eta, k, ConductorFresnel::Exact, surface)
}

/// An index of i reflects everything at every angle: |(c − w)/(c + w)| = 1 for an imaginary w.
pub(super) fn white_conductor(surface: Microsurface) -> Conductor {
    Conductor::new(Vec3::ZERO, Vec3::ONE, ConductorFresnel::Exact, surface)
}

/// Glass that keeps all light, of index 1.5.
pub(super) fn white_glass(surface: Microsurface) -> RoughDielectric {
    RoughDielectric::new(1.5, Vec3::ONE, Vec3::ONE, surface)
}

pub(super) fn gltf(metallic: f32, alpha: f32, transmission: f32) -> Bsdf {
    Bsdf::MetallicRoughness(MetallicRoughness {
        base_color: Vec3::new(1.0, 0.6, 0.2),
        metallic,
        roughness: alpha.sqrt(),
        ior: 1.5,
        transmission,
    })
}

/// α in both directions, and a thousandth of it in one.
pub(super) fn surfaces(alpha: f32) -> Vec<(String, Microsurface)> {
    let of = |ndf| {
        let brushed = Microsurface::new(ndf, [alpha, alpha / BRUSHED]);
        [
            (format!("{ndf:?}"), Microsurface::isotropic(ndf, alpha)),
            (format!("{ndf:?} 1000:1"), brushed),
        ]
    };
    NDFS.into_iter().flat_map(of).collect()
}

/// Every lobe that has a roughness.
pub(super) fn rough(alpha: f32) -> Vec<Case> {
    let mut all = Vec::new();
    for (name, surface) in surfaces(alpha) {
        let (metal, glass) = (gold_conductor(surface), white_glass(surface));
        all.push(Case::new(format!("gold {name}"), Bsdf::Conductor(metal)));
        let glass = Bsdf::RoughDielectric(glass);
        all.push(Case::new(format!("glass {name}"), glass));
    }
    for (name, metallic, transmission) in
        [("metal", 1.0, 0.0), ("thin", 0.0, 1.0), ("mixed", 0.4, 0.3)]
    {
        let bsdf = gltf(metallic, alpha, transmission);
        all.push(Case::new(format!("MetallicRoughness {name}"), bsdf));
    }
    all
}

/// All nine lobes, rough and smooth.
pub(super) fn all() -> Vec<Case> {
    let (reflectance, transmittance) = (Vec3::new(0.9, 0.8, 0.7), Vec3::new(0.5, 0.6, 1.0));
    let mut all = vec![
        Case::new("Lambert", Bsdf::Lambert(Lambert { reflectance })),
        Case::new("Mirror", Bsdf::Mirror(Mirror { reflectance })),
    ];
    for degrees in [10.0f32, 60.0] {
        let sigma = degrees.to_radians();
        let lobe = OrenNayar { reflectance, sigma };
        all.push(Case::new(
            format!("OrenNayar {degrees}°"),
            Bsdf::OrenNayar(lobe),
        ));
    }
    for ior in [1.0 / 1.5, 1.000_000_1, 1.5, 100.0] {
        let refraction = Refraction { transmittance, ior };
        let thin = ThinDielectric {
            ior,
            reflectance,
            transmittance,
        };
        let glass = |fresnel| {
            Bsdf::Dielectric(Dielectric {
                ior,
                reflectance,
                transmittance,
                fresnel,
            })
        };
        all.extend([
            Case::new(format!("Refraction {ior}"), Bsdf::Refraction(refraction)),
            Case::new(format!("ThinDielectric {ior}"), Bsdf::ThinDielectric(thin)),
            Case::new(format!("Dielectric {ior}"), glass(FresnelKind::Exact)),
            Case::new(
                format!("Dielectric Schlick {ior}"),
                glass(FresnelKind::Schlick),
            ),
        ]);
    }
    for alpha in [0.0, 0.001, 0.03, 0.3, 1.0] {
        let at = |case: Case| Case::new(format!("{} α {alpha}", case.name), case.bsdf);
        all.extend(rough(alpha).into_iter().map(at));
    }
    all
}
