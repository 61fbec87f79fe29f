//! Light that paths meet by chance.

use super::columns::{Paths, Vertices};
use super::{LightStrategy, Outcome, Wave, power_heuristic};
use sr_pipeline::LightId;
use sr_pipeline::accel::Hit;
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Emission, Event, Witness};

impl Wave<'_> {
    /// Adds what infinite lights send along the rays that leave the scene.
    pub(super) fn add_background<S: Sampler, W: Witness>(
        &self,
        paths: &Paths<S>,
        hits: &[Hit],
        depth: u32,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        if !self.features.contains(SceneFeatures::ENVIRONMENT) {
            return;
        }
        for i in (0..paths.len()).filter(|i| !hits[*i].is_hit()) {
            let d = paths.ray[i].d;
            for light in self.scene.infinite_lights() {
                let le = self.scene.light(*light).le_environment(d);
                let (weight, light_pdf) = self.weight(paths, i, *light, f32::INFINITY, Vec3::ZERO);
                let contribution = paths.beta[i] * le * weight;
                outcome.radiance[paths.slot[i] as usize] += contribution;
                let met = Emission {
                    depth,
                    light: *light,
                    le,
                    light_pdf,
                    weight,
                    contribution,
                };
                witness.see(paths.slot[i], Event::Emission(met));
            }
        }
    }

    /// Adds what glowing surfaces send along the rays that reach them.
    pub(super) fn add_emission<S: Sampler, W: Witness>(
        &self,
        paths: &Paths<S>,
        hits: &[Hit],
        vertices: &Vertices,
        depth: u32,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        if !self.features.contains(SceneFeatures::AREA_LIGHTS) {
            return;
        }
        for (i, point) in vertices.point.iter().enumerate() {
            let Some(light) = self.scene.light_of(point.prim) else {
                continue;
            };
            let le = self.scene.light(light).le(point.wo, point.ng);
            if le != Vec3::ZERO {
                let (weight, light_pdf) = self.weight(paths, i, light, hits[i].t, point.ng);
                let contribution = paths.beta[i] * le * weight;
                outcome.radiance[paths.slot[i] as usize] += contribution;
                let met = Emission {
                    depth,
                    light,
                    le,
                    light_pdf,
                    weight,
                    contribution,
                };
                witness.see(paths.slot[i], Event::Emission(met));
            }
        }
    }

    /// What a light that was met by chance counts, given that it may have been sampled too; and the
    /// density with which it would have been, where that competes.
    fn weight<S: Sampler>(
        &self,
        paths: &Paths<S>,
        i: usize,
        light: LightId,
        dist: f32,
        ng: Vec3,
    ) -> (f32, Option<f32>) {
        let pdf = paths.pdf[i];
        if pdf == f32::INFINITY {
            return (1.0, None);
        }
        match self.settings.light {
            LightStrategy::DeltaOnly => (1.0, None),
            LightStrategy::Only => (0.0, None),
            LightStrategy::Mis => {
                let d = paths.ray[i].d;
                let receiver = paths.receiver(i);
                let light_pdf = if self.all_lights {
                    self.scene.light(light).pdf_li(receiver.p, d, dist, ng)
                } else {
                    self.scene.light_pdf(light, &receiver, d, dist, ng)
                };
                let weight = power_heuristic(pdf, self.settings.light_samples as f32 * light_pdf);
                (weight, Some(light_pdf))
            }
        }
    }
}
