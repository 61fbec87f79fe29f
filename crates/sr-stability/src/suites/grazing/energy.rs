//! White furnaces at grazing incidence.

use super::lobes::{Case, direction, even, white_conductor, white_glass};
use super::{COSINES, DIRECTIONS};
use crate::worst::Worst;
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::{
    Bsdf, Dielectric, FresnelKind, Lambert, MetallicRoughness, Microsurface, Mirror, Ndf,
    OrenNayar, Refraction, RoughDielectric, ThinDielectric, TransportMode,
};
use sr_pipeline::glam::Vec3;

/// What a white lobe gives back.
#[derive(Clone, Copy, Debug)]
pub(super) enum Returns {
    /// All of it.
    All,
    /// At most so much.
    AtMost(f64),
}

pub(super) type White = (Case, Returns);

/// How far the mean of the weights, first component, is from what it may be, and that mean: `n` samples that fill the
/// unit cube evenly.
pub(super) fn off<K: Kernels>((case, returns): &White, wo: Vec3, n: u32) -> (f64, f64) {
    let weight = |i| {
        let (uc, u) = even(i, n);
        let sample = K::bsdf_sample(&case.bsdf, wo, uc, u, TransportMode::Importance);
        sample.map_or(0.0, |s| f64::from(s.weight.x))
    };
    let mean = (0..n).map(weight).sum::<f64>() / f64::from(n);
    let off = match returns {
        Returns::All => (mean - 1.0).abs(),
        Returns::AtMost(most) => (mean - most).max(0.0),
    };
    (off, mean)
}

/// White interfaces of glass: clear, frosted, and frosted with what facets lose given back.
pub(super) fn interfaces(ior: f32) -> Vec<White> {
    let clear = |fresnel| {
        Bsdf::Dielectric(Dielectric {
            ior,
            reflectance: Vec3::ONE,
            transmittance: Vec3::ONE,
            fresnel,
        })
    };
    let mut all = vec![
        (Case::new("clear", clear(FresnelKind::Exact)), Returns::All),
        (
            Case::new("clear Schlick", clear(FresnelKind::Schlick)),
            Returns::All,
        ),
        (
            Case::new(
                "Refraction",
                Bsdf::Refraction(Refraction {
                    transmittance: Vec3::ONE,
                    ior,
                }),
            ),
            Returns::AtMost(1.0),
        ),
    ];
    for alpha in [0.03, 0.5] {
        let surface = Microsurface::isotropic(Ndf::Ggx, alpha);
        let frosted = RoughDielectric::new(ior, Vec3::ONE, Vec3::ONE, surface);
        all.push((
            Case::new(format!("frosted {alpha}"), Bsdf::RoughDielectric(frosted)),
            Returns::AtMost(1.0),
        ));
    }
    for (case, _) in &mut all {
        case.name += &format!(" {ior}");
    }
    all
}

fn white() -> Vec<White> {
    let reflectance = Vec3::ONE;
    let mut all = vec![
        (
            Case::new("Lambert", Bsdf::Lambert(Lambert { reflectance })),
            Returns::All,
        ),
        (
            Case::new("Mirror", Bsdf::Mirror(Mirror { reflectance })),
            Returns::All,
        ),
    ];
    for degrees in [10.0f32, 30.0, 60.0] {
        let lobe = OrenNayar {
            reflectance,
            sigma: degrees.to_radians(),
        };
        let case = Case::new(format!("OrenNayar {degrees}°"), Bsdf::OrenNayar(lobe));
        all.push((case, Returns::All));
    }
    for ior in [1.0 / 1.5, 1.000_000_1, 1.5, 100.0] {
        let thin = ThinDielectric {
            ior,
            reflectance,
            transmittance: Vec3::ONE,
        };
        let case = Case::new(format!("thin {ior}"), Bsdf::ThinDielectric(thin));
        all.push((case, Returns::All));
        all.extend(interfaces(ior));
    }
    for alpha in [0.001, 0.03, 0.3, 1.0] {
        for ndf in [Ndf::Beckmann, Ndf::Ggx] {
            let surface = Microsurface::isotropic(ndf, alpha);
            let metal = white_conductor(surface);
            let name = format!("metal {ndf:?} {alpha}");
            let lossy = Case::new(name.clone(), Bsdf::Conductor(metal.clone()));
            all.push((lossy, Returns::AtMost(1.0)));
            if alpha >= 0.3 {
                let name = format!("{name} compensated");
                let case = Case::new(&name, Bsdf::Conductor(metal.compensated()));
                all.push((case, Returns::All));
                let glass = Bsdf::RoughDielectric(white_glass(surface).compensated());
                let case = Case::new(name.replace("metal", "glass"), glass);
                all.push((case, Returns::All));
            }
        }
        all.extend([0.0, 1.0].map(|metallic| gltf(alpha, metallic)));
    }
    all
}

/// The layers of glTF's dielectric gain up to (1 − R₀) at grazing, as the specification has them.
fn gltf(alpha: f32, metallic: f32) -> White {
    let bsdf = Bsdf::MetallicRoughness(MetallicRoughness {
        base_color: Vec3::ONE,
        metallic,
        roughness: alpha.sqrt(),
        ior: 1.5,
        transmission: 0.0,
    });
    let case = Case::new(format!("MetallicRoughness {metallic} {alpha}"), bsdf);
    let most = 1.0 + 0.96 * (1.0 - f64::from(metallic));
    (case, Returns::AtMost(most))
}

pub(super) fn furnace<K: Kernels>() -> Sweep {
    let lobes = white();
    let points = COSINES.map(|cos| {
        let mut worst = Worst::default();
        for white in &lobes {
            for wo in [cos, -cos].map(|c| direction(c, 0.7)) {
                let (off, mean) = off::<K>(white, wo, 4096);
                worst.see(off, || format!("{}, wo {wo:?}: {mean:.6}", white.0.name));
            }
        }
        worst.at(cos.into())
    });
    Sweep {
        name: "energy".into(),
        about: "White lobes by the mean of their weights: diffuse, clear and compensated ones give back all that they get, \
                others no more than that."
            .into(),
        parameter: "cos θ".into(),
        error: "energy gained, or lost by those that lose nothing".into(),
        // Tables of compensation are good to 3·10⁻³, and 4096 points to about as much.
        bound: 6e-3,
        holds: DIRECTIONS,
        points: points.into(),
    }
}
