//! Connections from surfaces to sampled points on lights.

use super::columns::{Paths, Vertices};
use super::{LightStrategy, Outcome, Wave, power_heuristic};
use sr_pipeline::accel::Ray;
use sr_pipeline::bsdf::{Bsdf, LobeFlags};
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Connection, Event, Witness};
use sr_pipeline::{LightConnection, LightId};

/// Most shadow rays that wait to be traced, so that memory does not grow with the number of samples
/// or lights.
const BATCH: usize = 4096;

/// Shadow rays, and what arrives if nothing stands in their way.
#[derive(Default)]
pub(crate) struct Connections {
    ray: Vec<Ray>,
    contribution: Vec<Vec3>,
    slot: Vec<u32>,
    occluded: Vec<bool>,
    /// Shadow rays traced.
    traced: u64,
}

impl Connections {
    /// Traces the shadow rays as one batch and adds what arrives.
    fn trace<W: Witness>(&mut self, scene: &RenderScene, outcome: &mut Outcome, witness: &mut W) {
        self.occluded.clear();
        self.occluded.resize(self.ray.len(), false);
        scene.accel().occluded(&self.ray, &mut self.occluded);
        self.tell(witness);
        for ((slot, contribution), occluded) in
            self.slot.iter().zip(&self.contribution).zip(&self.occluded)
        {
            if !occluded {
                outcome.radiance[*slot as usize] += *contribution;
            }
        }
        self.traced += self.ray.len() as u64;
        self.ray.clear();
        self.contribution.clear();
        self.slot.clear();
    }

    /// Tells what became of the shadow rays.
    fn tell<W: Witness>(&self, witness: &mut W) {
        let rays = self.slot.iter().zip(&self.ray);
        let ends = self.contribution.iter().zip(&self.occluded);
        for ((slot, ray), (contribution, occluded)) in rays.zip(ends) {
            let shadow = Event::Shadow {
                ray: *ray,
                occluded: *occluded,
                contribution: Some(*contribution),
            };
            witness.see(*slot, shadow);
        }
    }
}

/// A path at a surface that lights are sampled for.
struct Vertex<'a, S> {
    point: &'a SurfacePoint,
    bsdf: &'a Bsdf,
    wo: Vec3,
    beta: Vec3,
    slot: u32,
    sampler: S,
    depth: u32,
}

impl Wave<'_> {
    /// Samples lights for each path whose surface is more than a delta lobe; the number of shadow
    /// rays.
    pub(super) fn connect_to_lights<S: Sampler, W: Witness>(
        &self,
        paths: &Paths<S>,
        vertices: &Vertices,
        depth: u32,
        connections: &mut Connections,
        outcome: &mut Outcome,
        witness: &mut W,
    ) -> u64 {
        connections.traced = 0;
        for (i, point) in vertices.point.iter().enumerate() {
            let bsdf = self.scene.bsdf(point);
            if !(bsdf
                .flags()
                .intersects(LobeFlags::DIFFUSE | LobeFlags::GLOSSY))
            {
                continue;
            }
            let vertex = Vertex {
                point,
                bsdf,
                wo: point.to_local(point.wo),
                beta: paths.beta[i],
                slot: paths.slot[i],
                sampler: paths.sampler[i],
                depth,
            };
            if self.all_lights {
                self.sample_every_light(&vertex, connections, outcome, witness);
            } else {
                self.sample_some_lights(&vertex, connections, outcome, witness);
            }
        }
        connections.trace(self.scene, outcome, witness);
        connections.traced
    }

    /// As many times as the settings say, one light and a point on it.
    fn sample_some_lights<S: Sampler, W: Witness>(
        &self,
        vertex: &Vertex<'_, S>,
        connections: &mut Connections,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        let n = self.settings.light_samples;
        for j in 0..n {
            let sampler = vertex.sampler.split(j, n);
            let u_select = sampler.d1(Dim::bounce(vertex.depth, BounceDim::LightSelect));
            let u = sampler.d2(Dim::bounce(vertex.depth, BounceDim::Light));
            let Some(c) = self.scene.sample_light(vertex.point, u_select, u) else {
                continue;
            };
            if self.settings.light == LightStrategy::DeltaOnly && !c.sample.is_delta {
                continue;
            }
            self.connect(vertex, &c, n, connections, outcome, witness);
        }
    }

    /// Each light as many times as the settings say, one that has but one sample to give once. Lights
    /// have numbers of their own.
    fn sample_every_light<S: Sampler, W: Witness>(
        &self,
        vertex: &Vertex<'_, S>,
        connections: &mut Connections,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        for (light, k) in self.scene.lights().iter().zip(0u32..) {
            let n = match (light.is_delta(), self.settings.light) {
                (true, _) => 1,
                (false, LightStrategy::DeltaOnly) => continue,
                (false, _) => self.settings.light_samples,
            };
            let own = vertex.sampler.fork(k);
            for j in 0..n {
                let u = own
                    .split(j, n)
                    .d2(Dim::bounce(vertex.depth, BounceDim::Light));
                if let Some(c) = self.scene.connect_light(LightId(k), vertex.point, u) {
                    self.connect(vertex, &c, n, connections, outcome, witness);
                }
            }
        }
    }

    /// One of `n` samples of a technique: what it brings if nothing is in the way.
    #[inline]
    fn connect<S: Sampler, W: Witness>(
        &self,
        vertex: &Vertex<'_, S>,
        c: &LightConnection,
        n: u32,
        connections: &mut Connections,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        let wi = vertex.point.to_local(c.sample.wi);
        if !self.scene.scatters_along(vertex.point, c.sample.wi) {
            return;
        }
        let n = n as f32;
        let (f, scatter_pdf) = self.eval_pdf(vertex.bsdf, vertex.wo, wi);
        let weight = match self.settings.light {
            LightStrategy::Mis if !c.sample.is_delta => {
                let directions = self.directions(vertex.depth) as f32;
                power_heuristic(n * c.sample.pdf, directions * scatter_pdf)
            }
            _ => 1.0,
        };
        // One factor at a time: a product of small numbers over a small density stays in
        // range where the product of the small numbers alone would not.
        let arrives = c.sample.radiance / c.sample.pdf * (wi.z.abs() * (weight / n));
        let contribution = vertex.beta * f * arrives;
        let told = Connection {
            depth: vertex.depth,
            light: c.light,
            wi: c.sample.wi,
            dist: c.sample.dist,
            radiance: c.sample.radiance,
            light_pdf: c.sample.pdf,
            f,
            scatter_pdf,
            weight,
            contribution,
        };
        witness.see(vertex.slot, Event::Connection(told));
        if contribution == Vec3::ZERO {
            return;
        }
        connections.ray.push(c.shadow_ray);
        connections.contribution.push(contribution);
        connections.slot.push(vertex.slot);
        if connections.ray.len() == BATCH {
            connections.trace(self.scene, outcome, witness);
        }
    }
}
