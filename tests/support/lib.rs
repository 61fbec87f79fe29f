//! What the themes share: rendering a scene built in code or read from a file.

use glam::DVec3;
use sr_pipeline::film_kernel::{FilmImage, Rect};
use sr_pipeline::prelude::*;
use sr_pipeline::{Pipeline, RenderReport};
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{Budget, FilmSettings, SamplerSettings};
use std::ops::ControlFlow;

/// A pipeline with all integrators, the examples' included.
pub fn pipeline(threads: usize) -> Pipeline {
    let mut pipeline = Pipeline::new(threads).expect("threads start");
    pipeline
        .add_plugin(sr_integrators::integrators)
        .add_plugin(example_ambient_occlusion::ambient_occlusion)
        .add_plugin(example_light_tracer::light_tracer);
    pipeline
}

/// A render of a scene that code spawns.
pub struct Job {
    pipeline: Pipeline,
}

/// What a render gave.
pub struct Rendered {
    /// The picture.
    pub image: FilmImage,
    /// Counts.
    pub report: RenderReport,
}

impl Job {
    /// A job of `size` pixels, `samples` samples and seed `seed`.
    pub fn new(size: [u32; 2], samples: u64, seed: u64) -> Self {
        let mut pipeline = pipeline(0);
        let world = &mut pipeline.world;
        let mut film = world.resource_mut::<FilmSettings>();
        (film.width, film.height) = (Some(size[0]), Some(size[1]));
        world.resource_mut::<Budget>().samples = Some(samples);
        world.resource_mut::<SamplerSettings>().seed = seed;
        Self { pipeline }
    }

    /// The world, to spawn the scene into and to change settings.
    pub fn world(&mut self) -> &mut World {
        &mut self.pipeline.world
    }

    /// Selects an integrator.
    pub fn integrator<I: Integrator>(mut self, settings: I::Settings) -> Self {
        self.pipeline.world.insert_resource(SelectedIntegrator {
            name: I::NAME.into(),
            settings: Box::new(settings),
        });
        self
    }

    /// With a scene.
    pub fn scene(mut self, spawn: impl FnOnce(&mut World)) -> Self {
        spawn(&mut self.pipeline.world);
        self
    }

    /// Compiles and renders.
    pub fn render(mut self) -> Rendered {
        self.pipeline.compile().unwrap_or_else(|e| panic!("{e}"));
        self.finish()
    }

    /// Renders what is compiled.
    fn finish(mut self) -> Rendered {
        self.pipeline
            .render(|_| ControlFlow::Continue(()))
            .unwrap_or_else(|e| panic!("{e}"));
        let film = self.pipeline.world.resource::<FilmResource>();
        Rendered {
            image: film.film.resolve(film.estimator),
            report: self.pipeline.world.resource::<RenderReport>().clone(),
        }
    }
}

impl Rendered {
    /// Mean over pixels and channels, and the standard error that the film's variance gives it.
    pub fn mean(&self) -> (f64, f64) {
        let n = self.image.rgb.pixels.len() as f64 * 3.0;
        let sum = |image: &sr_pipeline::film_kernel::Image| -> DVec3 {
            image.pixels.iter().map(|p| p.as_dvec3()).sum()
        };
        let mean = sum(&self.image.rgb).element_sum() / n;
        // Channels of a pixel share their paths: in the worst case they err together.
        let variance = sum(&self.image.variance_of_mean).element_sum() * 3.0 / (n * n);
        (mean, variance.sqrt())
    }
}

/// The whole picture.
pub fn whole(size: [u32; 2]) -> Rect {
    Rect::of_size(size[0], size[1])
}
