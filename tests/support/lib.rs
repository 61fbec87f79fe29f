//! What the themes share: rendering a scene built in code or read from a file.

pub mod agree;
pub mod fuzz;

use glam::DVec3;
use sr_io::{LoadRequest, Override};
use sr_pipeline::diagnostics::Diagnostics;
use sr_pipeline::film_kernel::{ClampReport, FilmImage};
use sr_pipeline::prelude::*;
use sr_pipeline::{Pipeline, RenderReport};
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{Budget, FilmSettings, SamplerSettings};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// The repository's root.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the tests lie in the repository")
        .to_owned()
}

/// Every scene of the repository.
pub fn repository_scenes() -> Vec<PathBuf> {
    let folders = std::fs::read_dir(repository().join("scenes")).expect("there are scenes");
    let mut scenes: Vec<PathBuf> = folders
        .map(|f| f.expect("a folder of scenes").path())
        .map(|f| {
            f.join(f.file_name().expect("a name"))
                .with_extension("scene.ron")
        })
        .collect();
    scenes.sort();
    assert!(
        scenes.len() >= 4 && scenes.iter().all(|s| s.is_file()),
        "{scenes:?}"
    );
    scenes
}

/// A pipeline with all integrators, the examples' included.
pub fn pipeline(threads: usize) -> Pipeline {
    let mut pipeline = Pipeline::new(threads).expect("threads start");
    pipeline
        .add_plugin(sr_integrators::integrators)
        .add_plugin(example_ambient_occlusion::ambient_occlusion)
        .add_plugin(example_light_tracer::light_tracer);
    pipeline
}

/// A scene from a file, compiled once, to be rendered with several seeds.
pub struct Scene {
    pipeline: Pipeline,
}

impl Scene {
    /// Loads a scene or configuration with some overrides, and compiles it.
    pub fn load(path: &Path, overrides: &[(&str, &str)]) -> Self {
        Self::load_with(path, overrides, 0)
    }

    /// The same with a number of threads; 0 means one for each core.
    pub fn load_with(path: &Path, overrides: &[(&str, &str)], threads: usize) -> Self {
        let mut pipeline = pipeline(threads);
        sr_io::install(&mut pipeline.world);
        let overrides = overrides.iter().map(|(path, value)| Override {
            path: (*path).into(),
            value: (*value).into(),
            origin: "the test".into(),
        });
        pipeline.world.insert_resource(LoadRequest {
            path: path.to_owned(),
            overrides: overrides.collect(),
            ..Default::default()
        });
        let loaded = pipeline.load().and_then(|()| pipeline.compile());
        if let Err(error) = loaded {
            let diagnostics = &pipeline.world.resource::<Diagnostics>().0;
            let lines: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
            panic!("{}: {error}\n{}", path.display(), lines.join("\n"));
        }
        Self { pipeline }
    }

    /// The world, to look at or to change settings.
    pub fn world(&mut self) -> &mut World {
        &mut self.pipeline.world
    }

    /// The pipeline, for what has more to do with the scene than to render it.
    pub fn pipeline(&mut self) -> &mut Pipeline {
        &mut self.pipeline
    }

    /// A picture of `samples` samples.
    pub fn render(&mut self, samples: u64, seed: u64) -> Rendered {
        self.pipeline.world.resource_mut::<Budget>().samples = Some(samples);
        self.pipeline.world.resource_mut::<SamplerSettings>().seed = seed;
        finish(&mut self.pipeline)
    }
}

/// Converts a COLLADA file into a folder, lit by a map of that name there if any; the path of the scene
/// file. Slips of the file are let pass.
pub fn convert(dae: &Path, folder: &Path, environment: Option<&str>) -> PathBuf {
    let options = sr_tools::convert::Options {
        lenient: true,
        environment: environment.map(str::to_owned),
        ..Default::default()
    };
    match sr_tools::convert::convert_file(dae, folder, &options) {
        Ok((_, paths)) => paths
            .into_iter()
            .find(|p| p.extension().is_some_and(|e| e == "ron"))
            .expect("the converter writes a scene"),
        Err(error) => panic!("{}: {error:?}", dae.display()),
    }
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
    /// What a clamp took.
    pub clamp: Option<ClampReport>,
}

impl Job {
    /// A job of `size` pixels, `samples` samples and seed `seed`.
    pub fn new(size: [u32; 2], samples: u64, seed: u64) -> Self {
        Self::with_threads(size, samples, seed, 0)
    }

    /// The same with a number of threads; 0 means one for each core.
    pub fn with_threads(size: [u32; 2], samples: u64, seed: u64, threads: usize) -> Self {
        let mut pipeline = pipeline(threads);
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

    /// Compiles.
    pub fn compile(mut self) -> Pipeline {
        self.pipeline.compile().unwrap_or_else(|e| panic!("{e}"));
        self.pipeline
    }

    /// Compiles and renders.
    pub fn render(self) -> Rendered {
        finish(&mut self.compile())
    }
}

/// Renders what is compiled.
fn finish(pipeline: &mut Pipeline) -> Rendered {
    pipeline
        .render(|_| ControlFlow::Continue(()))
        .unwrap_or_else(|e| panic!("{e}"));
    let film = pipeline.world.resource::<FilmResource>();
    Rendered {
        image: film.film.resolve(film.estimator),
        report: pipeline.world.resource::<RenderReport>().clone(),
        clamp: film.film.clamp_report(),
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
