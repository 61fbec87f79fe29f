//! The tracer of integrators that answer one camera ray at a time: their context, with a record.

use super::{Event, Record, RecordingSampler, SampleId, SampleTracer, Traced};
use crate::ray_integrator::{RayContext, RayIntegrator};
use crate::tiles::{SampleSource, Samples, camera_ray, filter_sampler};
use bevy_ecs::prelude::*;
use sr_render::accel::Ray;
use sr_render::sampling::{FilterSampler, Sampler};
use sr_render::{MaterialId, RenderScene, SurfacePoint};
use sr_scene::bevy_ecs;
use sr_scene::compile::SealedScene;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{FilmSettings, SamplerSettings};

struct RayTracer<'a, I> {
    integrator: I,
    scene: &'a RenderScene,
    filter: FilterSampler,
    samples: Samples,
}

/// The tracer of `I`.
pub(crate) fn ray_tracer<I: RayIntegrator>(
    world: &World,
) -> Result<Box<dyn SampleTracer + '_>, String> {
    let scene = world
        .get_resource::<SealedScene>()
        .ok_or("the scene is not compiled")?;
    let settings = world
        .get_resource::<SelectedIntegrator>()
        .and_then(|choice| choice.settings::<I::Settings>())
        .ok_or("the settings are another integrator's")?;
    Ok(Box::new(RayTracer {
        integrator: I::prepare(settings, scene)?,
        scene,
        filter: filter_sampler(world.resource::<FilmSettings>())?,
        samples: Samples::new(world.resource::<SamplerSettings>()),
    }))
}

impl<I: RayIntegrator> SampleTracer for RayTracer<'_, I> {
    fn trace(&self, id: SampleId, record: &Record) -> Traced {
        match self.samples {
            Samples::Sobol(s) => self.trace_with(id, s.at(id.pixel, id.sample), record),
            Samples::Independent(s) => self.trace_with(id, s.at(id.pixel, id.sample), record),
        }
    }
}

impl<I: RayIntegrator> RayTracer<'_, I> {
    fn trace_with<S: Sampler>(&self, id: SampleId, sampler: S, record: &Record) -> Traced {
        let mut context = RecordingContext {
            scene: self.scene,
            sampler: record.sampler(sampler),
            record,
            bounces: 0,
            material: None,
        };
        let [x, y] = id.pixel;
        let ray = camera_ray(self.scene.camera(), &self.filter, (x, y), &context.sampler);
        let radiance = self.integrator.li(&ray, &mut context);
        Traced {
            radiance,
            bounces: context.bounces,
            material: context.material,
        }
    }
}

/// A context that enters what it is asked.
struct RecordingContext<'a, S> {
    scene: &'a RenderScene,
    sampler: RecordingSampler<'a, S>,
    record: &'a Record,
    bounces: u32,
    material: Option<MaterialId>,
}

impl<'a, S: Sampler> RayContext for RecordingContext<'a, S> {
    type Sampler = RecordingSampler<'a, S>;

    fn scene(&self) -> &RenderScene {
        self.scene
    }

    fn sampler(&self) -> &Self::Sampler {
        &self.sampler
    }

    fn closest(&mut self, ray: &Ray) -> Option<SurfacePoint> {
        self.record.push(Event::Ray(*ray));
        let hit = self.scene.accel().closest_one(ray);
        if !hit.is_hit() {
            self.record.push(Event::Miss);
            return None;
        }
        let point = self.scene.surface(ray, &hit);
        self.record.push(Event::Surface { t: hit.t, point });
        Some(point)
    }

    fn occluded(&mut self, ray: &Ray) -> bool {
        let occluded = self.scene.accel().occluded_one(ray);
        self.record.push(Event::Shadow {
            ray: *ray,
            occluded,
            contribution: None,
        });
        occluded
    }

    fn at(&mut self, bounce: u32, point: &SurfacePoint) {
        self.bounces = bounce;
        self.material = Some(point.material);
        self.record.push(Event::At {
            bounce,
            point: *point,
        });
    }
}
