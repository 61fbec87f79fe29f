//! A wave of one path, under the eyes of a record.

use super::{Outcome, Scratch, Wave, WaveIntegrator};
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Record, SampleId, SampleTracer, Traced};
use sr_pipeline::sampling::FilterSampler;
use sr_pipeline::settings::{FilmSettings, SamplerSettings};
use sr_pipeline::{MaterialId, RayCounts, SampleSource, Samples, camera_ray, filter_sampler};

struct WaveTracer<'a> {
    wave: Wave<'a>,
    filter: FilterSampler,
    samples: Samples,
}

/// The tracer of `I`.
pub(super) fn tracer<I: WaveIntegrator>(
    world: &World,
) -> Result<Box<dyn SampleTracer + '_>, String> {
    let scene = world
        .get_resource::<SealedScene>()
        .ok_or("the scene is not compiled")?;
    let settings = world
        .get_resource::<SelectedIntegrator>()
        .and_then(|choice| choice.settings::<I::Settings>())
        .ok_or("the settings are another integrator's")?;
    Ok(Box::new(WaveTracer {
        wave: Wave::new(scene, I::wave(settings)?, I::USES),
        filter: filter_sampler(world.resource::<FilmSettings>())?,
        samples: Samples::new(world.resource::<SamplerSettings>()),
    }))
}

impl SampleTracer for WaveTracer<'_> {
    fn trace(&self, id: SampleId, record: &Record) -> Traced {
        match self.samples {
            Samples::Sobol(s) => self.trace_with(id, s.at(id.pixel, id.sample), record),
            Samples::Independent(s) => self.trace_with(id, s.at(id.pixel, id.sample), record),
        }
    }
}

impl WaveTracer<'_> {
    fn trace_with<S: Sampler>(&self, id: SampleId, sampler: S, record: &Record) -> Traced {
        let sampler = record.sampler(sampler);
        let mut scratch = Scratch::default();
        let mut outcome = Outcome::default();
        let [x, y] = id.pixel;
        let camera = self.wave.scene.camera();
        let ray = camera_ray(camera, &self.filter, (x, y), &sampler);
        scratch.paths.push(ray, sampler);
        outcome.reset(1);
        let mut watching = record;
        let mut rays = RayCounts::default();
        self.wave
            .run(&mut scratch, &mut outcome, &mut rays, &mut watching);
        let material = outcome.material[0];
        Traced {
            radiance: outcome.radiance[0],
            bounces: outcome.bounces[0],
            material: (material != u32::MAX).then_some(MaterialId(material)),
        }
    }
}
