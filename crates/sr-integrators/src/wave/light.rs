//! Connections from surfaces to sampled points on lights.

use super::columns::{Paths, Vertices};
use super::{LightStrategy, Outcome, Wave, power_heuristic};
use sr_pipeline::accel::Ray;
use sr_pipeline::bsdf::{LobeFlags, TransportMode};
use sr_pipeline::prelude::*;

/// Shadow rays, and what arrives if nothing stands in their way.
#[derive(Default)]
pub(crate) struct Connections {
    ray: Vec<Ray>,
    contribution: Vec<Vec3>,
    slot: Vec<u32>,
    occluded: Vec<bool>,
}

impl Connections {
    fn clear(&mut self) {
        self.ray.clear();
        self.contribution.clear();
        self.slot.clear();
    }

    /// Traces the shadow rays as one batch and adds what arrives; the number of rays.
    pub fn trace(&mut self, scene: &RenderScene, outcome: &mut Outcome) -> u64 {
        self.occluded.clear();
        self.occluded.resize(self.ray.len(), false);
        scene.accel().occluded(&self.ray, &mut self.occluded);
        for ((slot, contribution), occluded) in
            self.slot.iter().zip(&self.contribution).zip(&self.occluded)
        {
            if !occluded {
                outcome.radiance[*slot as usize] += *contribution;
            }
        }
        self.ray.len() as u64
    }
}

impl Wave<'_> {
    /// Samples one light for each path whose surface is more than a delta lobe.
    pub(super) fn connect_to_lights<S: Sampler>(
        &self,
        paths: &Paths<S>,
        vertices: &Vertices,
        depth: u32,
        connections: &mut Connections,
    ) {
        connections.clear();
        for (i, point) in vertices.point.iter().enumerate() {
            let bsdf = self.scene.bsdf(point);
            if !(bsdf
                .flags()
                .intersects(LobeFlags::DIFFUSE | LobeFlags::GLOSSY))
            {
                continue;
            }
            let sampler = &paths.sampler[i];
            let u_select = sampler.d1(Dim::bounce(depth, BounceDim::LightSelect));
            let u = sampler.d2(Dim::bounce(depth, BounceDim::Light));
            let Some(c) = self.scene.sample_light(point, u_select, u) else {
                continue;
            };
            if self.settings.light == LightStrategy::DeltaOnly && !c.sample.is_delta {
                continue;
            }
            let wo = point.to_local(point.wo);
            let wi = point.to_local(c.sample.wi);
            let (f, bsdf_pdf) = bsdf.eval_pdf(wo, wi, TransportMode::Radiance);
            let weight = match self.settings.light {
                LightStrategy::Mis if !c.sample.is_delta => power_heuristic(c.sample.pdf, bsdf_pdf),
                _ => 1.0,
            };
            // One factor at a time: a product of small numbers over a small density stays in
            // range where the product of the small numbers alone would not.
            let arrives = c.sample.radiance / c.sample.pdf * (wi.z.abs() * weight);
            let contribution = paths.beta[i] * f * arrives;
            if contribution != Vec3::ZERO {
                connections.ray.push(c.shadow_ray);
                connections.contribution.push(contribution);
                connections.slot.push(paths.slot[i]);
            }
        }
    }
}
