//! The next direction of each path, and whether it lives on.

use super::columns::{Paths, Vertices};
use super::{LightStrategy, ScatterStrategy, Wave};
use sr_pipeline::bsdf::{Bsdf, BsdfSample, LobeFlags, TransportMode};
use sr_pipeline::math::{Real, warp};
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Event, PathEnd, Scatter, Witness};

/// What a path survives with that has lost nothing, so that even between perfect mirrors paths end,
/// after 1024 bounces on average.
const LOSSLESS_SURVIVAL: f32 = 1.0 - 1.0 / 1024.0;

/// A path has lost nothing if rounding may have taken what is missing: some bounces' worth of ulps. A path
/// that has lost more survives with what is left. With a limit its weight would grow at each bounce by the limit's
/// inverse, and from an albedo of √[`LOSSLESS_SURVIVAL`] on, 0.9995, its variance would be infinite.
const LOSSLESS: f32 = 1.0 - 8.0 * f32::EPSILON;

impl Wave<'_> {
    /// Samples the lobes, and drops the paths that end here.
    pub(super) fn scatter<S: Sampler, W: Witness>(
        &self,
        paths: &mut Paths<S>,
        vertices: &Vertices,
        depth: u32,
        alive: &mut Vec<bool>,
        witness: &mut W,
    ) {
        alive.clear();
        if self.asks_for_normals() {
            paths.from_n.resize(paths.len(), Vec3::ZERO);
        }
        for (i, point) in vertices.point.iter().enumerate() {
            alive.push(self.step(paths, i, point, depth, [0, 1], witness));
        }
        paths.retain(|i| alive[i]);
    }

    /// Number `j` of the directions that leave each surface, as paths of their own; surfaces with
    /// nothing but delta lobes have one.
    pub(super) fn spread<S: Sampler, W: Witness>(
        &self,
        paths: &Paths<S>,
        vertices: &Vertices,
        depth: u32,
        j: u32,
        children: &mut Paths<S>,
        witness: &mut W,
    ) {
        children.clear();
        for (i, point) in vertices.point.iter().enumerate() {
            let n = if self.scene.bsdf(point).flags().is_delta() {
                1
            } else {
                self.directions(depth)
            };
            if j >= n {
                continue;
            }
            children.push_child(paths, i, paths.sampler[i].split(j, n));
            if self.asks_for_normals() {
                children.from_n.push(Vec3::ZERO);
            }
            let child = children.len() - 1;
            if !self.step(children, child, point, depth, [j, n], witness) {
                children.truncate(child);
            }
        }
    }

    /// Takes path `i` from a surface in direction j of n; whether it lives on.
    #[inline]
    fn step<S: Sampler, W: Witness>(
        &self,
        paths: &mut Paths<S>,
        i: usize,
        point: &SurfacePoint,
        depth: u32,
        branch: [u32; 2],
        witness: &mut W,
    ) -> bool {
        let sampler = paths.sampler[i];
        let slot = paths.slot[i];
        let wo = point.to_local(point.wo);
        let end = |why, beta| Event::End { why, depth, beta };
        let Some(sample) = self.sample(self.scene.bsdf(point), wo, &sampler, depth) else {
            witness.see(slot, end(PathEnd::Absorbed, paths.beta[i]));
            return false;
        };
        let delta = sample.lobe.is_delta();
        if depth + 1 == self.settings.max_depth && !self.last_ray_counts(delta) {
            witness.see(slot, end(PathEnd::LastRay, paths.beta[i]));
            return false;
        }
        let wi = point.to_world(sample.wi);
        if !self.scene.scatters_along(point, wi) {
            witness.see(slot, end(PathEnd::Absorbed, paths.beta[i]));
            return false;
        }
        let n = branch[1] as f32;
        paths.beta[i] *= sample.weight * n.recip();
        paths.eta_scale[i] *= sample.eta * sample.eta;
        paths.pdf[i] = if delta { f32::INFINITY } else { n * sample.pdf };
        paths.from[i] = point.p;
        if let Some(normal) = paths.from_n.get_mut(i) {
            *normal = self.scene.receiver(point).n;
        }
        paths.ray[i] = point.spawn_ray(wi);
        let scattered = Scatter {
            depth,
            branch,
            lobe: sample.lobe,
            wi,
            weight: sample.weight,
            pdf: sample.pdf,
            eta: sample.eta,
            beta: paths.beta[i],
        };
        witness.see(slot, Event::Scatter(scattered));
        if paths.beta[i] == Vec3::ZERO {
            witness.see(slot, end(PathEnd::Absorbed, Vec3::ZERO));
            return false;
        }
        self.survives(paths, i, depth, witness)
    }

    /// Whether a ray whose path ends where it arrives can bring anything: there must be lights that
    /// rays meet, and sampling them must not be the one way that counts.
    pub(super) fn last_ray_counts(&self, delta: bool) -> bool {
        let met = SceneFeatures::AREA_LIGHTS.union(SceneFeatures::ENVIRONMENT);
        self.features.intersects(met) && (delta || self.settings.light != LightStrategy::Only)
    }

    fn sample<S: Sampler>(
        &self,
        bsdf: &Bsdf,
        wo: Vec3,
        sampler: &S,
        depth: u32,
    ) -> Option<BsdfSample> {
        let u = sampler.d2(Dim::bounce(depth, BounceDim::Bsdf));
        if self.scatters_uniformly(bsdf) {
            return sample_uniformly(bsdf, wo, u);
        }
        let uc = sampler.d1(Dim::bounce(depth, BounceDim::Lobe));
        bsdf.sample(wo, uc, u, TransportMode::Radiance)
    }

    fn scatters_uniformly(&self, bsdf: &Bsdf) -> bool {
        self.settings.scatter == ScatterStrategy::Hemisphere
            && !bsdf.flags().contains(LobeFlags::DELTA)
    }

    /// The lobe, and the density with which a direction `wi` is scattered to.
    #[inline]
    pub(super) fn eval_pdf(&self, bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> (Vec3, f32) {
        if self.scatters_uniformly(bsdf) {
            let f = bsdf.eval(wo, wi, TransportMode::Radiance);
            (f, uniform_pdf(bsdf, wo, wi))
        } else {
            bsdf.eval_pdf(wo, wi, TransportMode::Radiance)
        }
    }

    /// Russian roulette: ends a path with a probability that grows as its throughput falls, and
    /// lets the survivors stand for those that ended, so that the mean stays.
    fn survives<S: Sampler, W: Witness>(
        &self,
        paths: &mut Paths<S>,
        i: usize,
        depth: u32,
        witness: &mut W,
    ) -> bool {
        if depth < self.settings.roulette_from {
            return true;
        }
        let worth = (paths.beta[i] * paths.eta_scale[i]).max_element();
        let survival = survival(worth);
        let u = paths.sampler[i].d1(Dim::bounce(depth, BounceDim::Roulette));
        let lives = u < survival;
        let before = paths.beta[i];
        if lives {
            paths.beta[i] /= survival;
        }
        let (slot, beta) = (paths.slot[i], paths.beta[i]);
        witness.see(
            slot,
            Event::Roulette {
                depth,
                u,
                survival,
                beta,
            },
        );
        if !lives {
            let why = PathEnd::Roulette;
            let beta = before;
            witness.see(slot, Event::End { why, depth, beta });
        }
        lives
    }
}

/// The probability with which roulette lets a path live, whose throughput is `worth` at most, without the scaling of
/// radiance by refraction.
#[inline]
pub fn survival<R: Real>(worth: R) -> R {
    if worth < R::from_f32(LOSSLESS) {
        worth
    } else {
        R::from_f32(LOSSLESS_SURVIVAL)
    }
}

/// Density of a direction that knows nothing of the lobe: uniform over the hemisphere of `wo`, or
/// over the sphere when light passes through.
fn uniform_pdf(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> f32 {
    if bsdf.flags().contains(LobeFlags::TRANSMISSION) {
        std::f32::consts::FRAC_1_PI * 0.25
    } else if wi.z.signum() == wo.z.signum() {
        std::f32::consts::FRAC_1_PI * 0.5
    } else {
        0.0
    }
}

/// A direction with the density of [`uniform_pdf`].
fn sample_uniformly(bsdf: &Bsdf, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    let wi = if bsdf.flags().contains(LobeFlags::TRANSMISSION) {
        Vec3::from(warp::uniform_sphere(u.to_array()))
    } else {
        let wi = Vec3::from(warp::uniform_hemisphere(u.to_array()));
        wi * Vec3::new(1.0, 1.0, wo.z.signum())
    };
    let pdf = uniform_pdf(bsdf, wo, wi);
    let weight = bsdf.eval(wo, wi, TransportMode::Radiance) * (wi.z.abs() / pdf);
    Some(BsdfSample {
        wi,
        weight,
        pdf,
        lobe: LobeFlags::GLOSSY,
        eta: 1.0,
    })
}
