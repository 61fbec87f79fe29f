//! The next direction of each path, and whether it lives on.

use super::columns::{Paths, Vertices};
use super::{ScatterStrategy, Wave};
use sr_pipeline::bsdf::{Bsdf, BsdfSample, LobeFlags, TransportMode};
use sr_pipeline::math::warp;
use sr_pipeline::prelude::*;

/// Most that a path may survive with, so that even between perfect mirrors paths end, after 1024
/// bounces on average. The variance of roulette is finite while albedo² < survival: a lower limit
/// would spoil the very scenes with long paths.
const SURVIVAL_LIMIT: f32 = 1.0 - 1.0 / 1024.0;

impl Wave<'_> {
    /// Samples the lobes, and drops the paths that end here.
    pub(super) fn scatter<S: Sampler>(
        &self,
        paths: &mut Paths<S>,
        vertices: &Vertices,
        depth: u32,
        alive: &mut Vec<bool>,
    ) {
        alive.clear();
        alive.resize(paths.len(), false);
        if self.asks_for_normals() {
            paths.from_n.resize(paths.len(), Vec3::ZERO);
        }
        for (i, point) in vertices.point.iter().enumerate() {
            let sampler = paths.sampler[i];
            let wo = point.to_local(point.wo);
            let Some(sample) = self.sample(self.scene.bsdf(point), wo, &sampler, depth) else {
                continue;
            };
            let delta = sample.lobe.is_delta();
            paths.beta[i] *= sample.weight;
            paths.eta_scale[i] *= sample.eta * sample.eta;
            paths.pdf[i] = if delta { f32::INFINITY } else { sample.pdf };
            paths.from[i] = point.p;
            if let Some(n) = paths.from_n.get_mut(i) {
                *n = self.scene.receiver(point).n;
            }
            paths.ray[i] = point.spawn_ray(point.to_world(sample.wi));
            alive[i] = paths.beta[i] != Vec3::ZERO && self.survives(paths, i, depth);
        }
        paths.retain(|i| alive[i]);
    }

    fn sample<S: Sampler>(
        &self,
        bsdf: &Bsdf,
        wo: Vec3,
        sampler: &S,
        depth: u32,
    ) -> Option<BsdfSample> {
        let u = sampler.d2(Dim::bounce(depth, BounceDim::Bsdf));
        let uniform = self.settings.scatter == ScatterStrategy::Hemisphere
            && !bsdf.flags().contains(LobeFlags::DELTA);
        if uniform {
            return sample_uniformly(bsdf, wo, u);
        }
        let uc = sampler.d1(Dim::bounce(depth, BounceDim::Lobe));
        bsdf.sample(wo, uc, u, TransportMode::Radiance)
    }

    /// Russian roulette: ends a path with a probability that grows as its throughput falls, and
    /// lets the survivors stand for those that ended, so that the mean stays.
    fn survives<S: Sampler>(&self, paths: &mut Paths<S>, i: usize, depth: u32) -> bool {
        if depth < self.settings.roulette_from {
            return true;
        }
        let worth = (paths.beta[i] * paths.eta_scale[i]).max_element();
        let survival = worth.min(SURVIVAL_LIMIT);
        let u = paths.sampler[i].d1(Dim::bounce(depth, BounceDim::Roulette));
        if u >= survival {
            return false;
        }
        paths.beta[i] /= survival;
        true
    }
}

/// A direction that knows nothing of the lobe: over the hemisphere of `wo`, or over the sphere
/// when light passes through.
fn sample_uniformly(bsdf: &Bsdf, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    let through = bsdf.flags().contains(LobeFlags::TRANSMISSION);
    let wi = if through {
        Vec3::from(warp::uniform_sphere(u.to_array()))
    } else {
        let wi = Vec3::from(warp::uniform_hemisphere(u.to_array()));
        wi * Vec3::new(1.0, 1.0, wo.z.signum())
    };
    let pdf = std::f32::consts::FRAC_1_PI * if through { 0.25 } else { 0.5 };
    let weight = bsdf.eval(wo, wi, TransportMode::Radiance) * (wi.z.abs() / pdf);
    Some(BsdfSample {
        wi,
        weight,
        pdf,
        lobe: LobeFlags::GLOSSY,
        eta: 1.0,
    })
}
