//! The critical angle from both sides.

use super::ULP;
use super::energy::{interfaces, off};
use super::fresnel::textbook;
use crate::worst::Worst;
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::refract;
use sr_pipeline::glam::{DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;

/// How far from the critical angle, in radian.
const DISTANCES: [f64; 12] = [
    1.0, 0.3, 0.1, 3e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8,
];
const IORS: [f32; 6] = [1.000_000_1, 1.001, 1.1, 1.5, 2.42, 100.0];

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![
        direction::<K>(),
        snell::<K>(),
        reflectance::<K>(),
        energy::<K>(),
    ]
}

/// A direction and the index that it meets.
#[derive(Clone, Copy, Debug)]
struct Ray {
    wo: Vec3,
    eta: f32,
}

impl Ray {
    fn at(theta: f64, phi: f64, eta: f32) -> Option<Self> {
        let wo = DVec3::new(
            theta.sin() * phi.cos(),
            theta.sin() * phi.sin(),
            theta.cos(),
        );
        let ahead = (0.0..FRAC_PI_2).contains(&theta);
        ahead.then_some(Self {
            wo: wo.as_vec3(),
            eta,
        })
    }

    fn tangent(self) -> f64 {
        self.wo.as_dvec3().truncate().length()
    }

    /// cos²θ_t by Snell's law, from the tangential part alone; negative where all is reflected.
    fn cos2(self) -> f64 {
        let sin = self.tangent() / f64::from(self.eta);
        (1.0 - sin) * (1.0 + sin)
    }
}

/// From inside at the distance from the critical angle, before and beyond it; from outside at the distance from grazing,
/// which refracts to just before it.
fn rays(distance: f64) -> impl Iterator<Item = Ray> {
    IORS.into_iter().flat_map(move |ior| {
        let inside = 1.0 / ior;
        let critical = f64::from(inside).asin();
        [1.1, 2.7, 4.4].into_iter().flat_map(move |phi| {
            [
                Ray::at(critical - distance, phi, inside),
                Ray::at(critical + distance, phi, inside),
                Ray::at(FRAC_PI_2 - distance, phi, ior),
            ]
            .into_iter()
            .flatten()
        })
    })
}

fn sweep(name: &str, about: &str, error: &str, bound: f64, at: impl Fn(&mut Worst, Ray)) -> Sweep {
    let points = DISTANCES.map(|distance| {
        let mut worst = Worst::default();
        rays(distance).for_each(|ray| at(&mut worst, ray));
        worst.at(distance)
    });
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: "distance from the critical angle, radian".into(),
        error: error.into(),
        bound,
        holds: [0.9e-8, 1.0],
        points: points.into(),
    }
}

/// sin θ_t takes five roundings, of which the square has twice as many.
fn direction<K: Kernels>() -> Sweep {
    let up = [0.0, 0.0, 1.0];
    let error = |through: Option<f64>, exact: f64| match through {
        Some(cos) => (cos * cos - exact).abs(),
        None => exact.max(0.0),
    };
    sweep(
        "critical_direction",
        "Refracted directions before and beyond the critical angle, and into it from outside, against Snell's law in f64. By \
         the square of the cosine, which is what a rounding moves: the cosine moves by its root.",
        "error of cos² θ of the refracted direction",
        16.0 * ULP,
        |worst, ray| {
            let Ray { wo, eta } = ray;
            let through = K::refract(wo.to_array(), up, eta).map(|w| f64::from(w[2]));
            worst.see(error(through, ray.cos2()), || {
                format!("wo {wo:?}, η {eta:.8}: cos θ {through:?}")
            });
            let wide = refract(wo.to_array().map(f64::from), up.map(f64::from), eta.into());
            worst.see_oracle(error(wide.map(|w| w[2]), ray.cos2()));
        },
    )
}

/// The tangential part takes two roundings, the length those of a sine and of its cosine.
fn snell<K: Kernels>() -> Sweep {
    sweep(
        "critical_snell",
        "Refracted directions: η sin θ_t against sin θ_i, and the length against 1.",
        "relative error",
        8.0 * ULP,
        |worst, ray| {
            let Ray { wo, eta } = ray;
            let Some(wi) = K::refract(wo.to_array(), [0.0, 0.0, 1.0], eta) else {
                return;
            };
            let wi = DVec3::from(wi.map(f64::from));
            let sum = wi.truncate() * f64::from(eta) + wo.as_dvec3().truncate();
            let off = sum.length() / ray.tangent().max(f64::MIN_POSITIVE);
            worst.see(off.max((wi.length() - 1.0).abs()), || {
                format!("wo {wo:?}, η {eta:.8}: {wi}")
            });
        },
    )
}

/// 1 − F begins like the root of the distance, 4 cosθ_t/cosθ_i: its square is what a rounding moves, up to 16 times.
fn reflectance<K: Kernels>() -> Sweep {
    sweep(
        "critical_fresnel",
        "Reflectance before and beyond the critical angle, against the textbook's in f64. By the square of 1 − F, which is \
         what a rounding moves.",
        "error of (1 − F)²",
        64.0 * ULP,
        |worst, ray| {
            let Ray { wo, eta } = ray;
            let square = |f: f64| (1.0 - f) * (1.0 - f);
            let exact = textbook(wo.z.into(), eta.into());
            let f = K::fresnel_dielectric(wo.z, eta);
            let off = (square(f.into()) - square(exact)).abs();
            worst.see(off, || format!("wo {wo:?}, η {eta:.8}: {f}, truth {exact}"));
        },
    )
}

fn energy<K: Kernels>() -> Sweep {
    let lobes = IORS.map(|ior| (ior, interfaces(ior)));
    sweep(
        "critical_energy",
        "Clear glass gives back all that it gets, frosted glass no more, before and beyond the critical angle.",
        "energy gained, or lost by clear glass",
        1e-3,
        |worst, Ray { wo, eta }| {
            let side = if eta < 1.0 { -1.0 } else { 1.0 };
            let wo = Vec3::new(wo.x, wo.y, side * wo.z);
            let same = |ior: f32| ior == eta || 1.0 / ior == eta;
            for white in lobes
                .iter()
                .filter(|(ior, _)| same(*ior))
                .flat_map(|l| &l.1)
            {
                let (off, mean) = off::<K>(white, wo, 512);
                worst.see(off, || format!("{}, wo {wo:?}: {mean:.6}", white.0.name));
            }
        },
    )
}
