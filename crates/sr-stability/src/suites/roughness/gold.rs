//! Gold under a small light: a lobe as narrow as it gets against a light that is as small, the pair at which renderers
//! without multiple importance sampling fail, and those with it overflow.

use super::lobes::{direction, gold_conductor, random, wide};
use super::{ALL, ALPHAS};
use crate::worst::Worst;
use crate::{Effort, Kernels, Sweep};
use sr_pipeline::bsdf::{Bsdf, Microsurface, Ndf, TransportMode};
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::light::{Light, SphereLight};
use sr_pipeline::math::orthonormal_basis;
use std::f64::consts::TAU;

const MODE: TransportMode = TransportMode::Radiance;
/// Radii of a light at a distance of 1.
const RADII: [f32; 4] = [0.3, 1e-2, 1e-4, 1e-6];

/// A sphere of radiance 1 around the specular direction of `wo`, seen from the origin.
struct Lamp {
    light: Light,
    axis: DVec3,
    /// sin² of the angle that it fills half of.
    sin2: f64,
}

impl Lamp {
    fn new(wo: Vec3, radius: f32) -> Self {
        let center = Vec3::new(-wo.x, -wo.y, wo.z);
        let d2 = center.as_dvec3().length_squared();
        Self {
            light: Light::Sphere(SphereLight::new(center, radius, Vec3::ONE, false)),
            axis: center.as_dvec3() / d2.sqrt(),
            sin2: f64::from(radius).powi(2) / d2,
        }
    }

    fn is_met(&self, wi: Vec3) -> bool {
        let w = wi.as_dvec3().normalize();
        w.cross(self.axis).length_squared() <= self.sin2 && w.dot(self.axis) > 0.0
    }
}

/// ∫ f·cosθ over the light in `f64`, first component: the lobe's peak is at the centre of the disk, so that in θ = s·sinh t
/// about it, s a quarter of its width, the midpoint rule converges.
fn exact(bsdf: &Bsdf, wo: Vec3, lamp: &Lamp, alpha: f64) -> f64 {
    const RINGS: u32 = 400;
    const SPOKES: u32 = 48;
    if bsdf.flags().is_delta() {
        let sample = bsdf.sample_real(wide(wo), 0.5, [0.5; 2], MODE);
        return sample.map_or(0.0, |s| s.weight[0]);
    }
    let (s, t) = orthonormal_basis(lamp.axis.to_array());
    let (s, t) = (DVec3::from(s), DVec3::from(t));
    let most = lamp.sin2.sqrt().asin();
    let scale = 0.25 * alpha.min(most);
    let step = (most / scale).asinh() / f64::from(RINGS);
    let mut sum = 0.0;
    for i in 0..RINGS {
        let x = (f64::from(i) + 0.5) * step;
        let theta = scale * x.sinh();
        for j in 0..SPOKES {
            let phi = TAU * (f64::from(j) + 0.5) / f64::from(SPOKES);
            let around = s * phi.cos() + t * phi.sin();
            let wi = lamp.axis * theta.cos() + around * theta.sin();
            let f = bsdf.eval_pdf_real(wide(wo), wi.to_array(), MODE).0[0];
            sum += f * wi.z * theta.sin() * scale * x.cosh();
        }
    }
    sum * step * TAU / f64::from(SPOKES)
}

/// One sample of the light and one of the lobe, weighted as the integrators weight them.
fn sample<K: Kernels>(bsdf: &Bsdf, wo: Vec3, lamp: &Lamp, i: u32) -> f64 {
    let mut sum = 0.0;
    let (_, u) = random(11, i);
    if let Some(l) = lamp.light.sample_li(Vec3::ZERO, u) {
        let (f, pdf) = K::bsdf_eval_pdf(bsdf, wo, l.wi, MODE);
        let arrives = l.radiance / l.pdf * (l.wi.z.abs() * K::mis_weight(l.pdf, pdf));
        sum += f64::from((f * arrives).x);
    }
    let (uc, u) = random(12, i);
    if let Some(s) = K::bsdf_sample(bsdf, wo, uc, u, MODE).filter(|s| lamp.is_met(s.wi)) {
        let weight = if s.lobe.is_delta() {
            1.0
        } else {
            let pdf = lamp.light.pdf_li(Vec3::ZERO, s.wi, 1.0, -s.wi);
            K::mis_weight(s.pdf, pdf)
        };
        sum += f64::from(s.weight.x * weight);
    }
    sum
}

pub(super) fn small_light<K: Kernels>(effort: &Effort) -> Sweep {
    let samples = effort.choose(20_000, 1_000_000);
    let wo = direction(0.6, 0.7);
    let points = ALPHAS.map(|alpha| {
        let mut worst = Worst::default();
        for ndf in [Ndf::Beckmann, Ndf::Ggx] {
            let surface = Microsurface::isotropic(ndf, alpha);
            let bsdf = Bsdf::Conductor(gold_conductor(surface));
            for radius in RADII {
                let lamp = Lamp::new(wo, radius);
                let truth = exact(&bsdf, wo, &lamp, alpha.into());
                let (mut sum, mut squares) = (0.0, 0.0);
                for i in 0..samples {
                    let x = sample::<K>(&bsdf, wo, &lamp, i);
                    sum += x;
                    squares += x * x;
                }
                let n = f64::from(samples);
                let mean = sum / n;
                let deviation = ((squares / n - mean * mean).max(0.0) / (n - 1.0)).sqrt();
                let error = (mean / truth - 1.0).abs();
                worst.see_mean(error, 4.0 * deviation / truth, || {
                    format!("{ndf:?}, a light of radius {radius}: {mean:.6e}, truth {truth:.6e}")
                });
            }
        }
        worst.at(alpha.into())
    });
    Sweep {
        name: "gold_small_light".into(),
        about: "Gold under spheres of radiance 1 that fill from 17° down to 10⁻⁶ radian about the specular direction: \
                lights and lobes sampled and combined, against quadrature in f64."
            .into(),
        parameter: "α".into(),
        error: "relative error of radiance".into(),
        // Weights of two techniques that are alike leave a spread of about the mean: four standard errors of that, twice.
        bound: 8.0 / f64::from(samples).sqrt(),
        holds: ALL,
        points: points.into(),
    }
}
