//! Pipelines for checks that nobody watches.

use sr_experiment::{Host, Machine};
use sr_io::{LoadRequest, Override};
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::diagnostics::{Diagnostic, Diagnostics};
use sr_pipeline::glam::Vec3;
use sr_pipeline::{FilmResource, RenderReport};
use sr_pipeline::{Pipeline, PipelineError, Progress, Provenance};
use std::ops::ControlFlow;
use std::sync::Mutex;

/// The readers and the built-in integrators, and a host without a screen: what there is to tell is kept.
#[derive(Debug, Default)]
pub struct Bench {
    /// Threads of its pipelines; 0 for one each core.
    pub threads: usize,
    told: Mutex<Vec<String>>,
}

impl Bench {
    /// With so many threads; 0 for one each core.
    pub fn new(threads: usize) -> Self {
        Self {
            threads,
            told: Mutex::default(),
        }
    }

    /// What went wrong so far, a line each.
    pub fn told(&self) -> Vec<String> {
        self.told.lock().map(|t| t.clone()).unwrap_or_default()
    }

    fn keep(&self, line: String) {
        if let Ok(mut told) = self.told.lock() {
            told.push(line);
        }
    }

    /// A pipeline, loaded and compiled, from the text of a scene and `path=value` changes to it.
    ///
    /// # Errors
    /// What is wrong with the scene, in words.
    pub fn scene(&self, text: &str, set: &[(&str, &str)]) -> Result<Pipeline, String> {
        let folder = tempfile::tempdir().map_err(|e| format!("no temporary folder: {e}"))?;
        let path = folder.path().join("bench.scene.ron");
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
        let mut pipeline = self.pipeline().map_err(|e| e.to_string())?;
        let change = |(path, value): &(&str, &str)| Override {
            path: (*path).into(),
            value: (*value).into(),
            origin: "the check".into(),
        };
        pipeline.world.insert_resource(LoadRequest {
            path,
            overrides: set.iter().map(change).collect(),
            ..Default::default()
        });
        let ready = pipeline.load().and_then(|()| pipeline.compile());
        ready.map_err(|e| {
            let told = &pipeline.world.resource::<Diagnostics>().0;
            let told: Vec<String> = told.iter().map(Diagnostic::to_string).collect();
            format!("{e}: {}", told.join("; "))
        })?;
        Ok(pipeline)
    }

    /// The pixels of the picture of such a scene.
    ///
    /// # Errors
    /// As of [`Bench::scene`], and where the film refused samples.
    pub fn picture(&self, text: &str, set: &[(&str, &str)]) -> Result<Vec<Vec3>, String> {
        let mut pipeline = self.scene(text, set)?;
        let stop = pipeline.render(|_| ControlFlow::Continue(()));
        stop.map_err(|e| e.to_string())?;
        let report = pipeline.world.resource::<RenderReport>();
        let film = pipeline.world.resource::<FilmResource>();
        match report.tiles.rejects.total() {
            0 => Ok(film.film.resolve(film.estimator).rgb.pixels),
            n => Err(format!("{n} samples were refused")),
        }
    }
}

impl Host for Bench {
    fn pipeline(&self) -> Result<Pipeline, PipelineError> {
        let mut pipeline = Pipeline::new(self.threads)?;
        sr_io::install(&mut pipeline.world);
        pipeline.add_plugin(sr_integrators::integrators);
        Ok(pipeline)
    }

    fn overrides(&self) -> &[Override] {
        &[]
    }

    fn provenance(&self, _: &World) -> Provenance {
        Provenance::default()
    }

    fn command_line(&self) -> &str {
        ""
    }

    fn machine(&self) -> Machine {
        Machine::here(self.threads)
    }

    fn stopped(&self) -> bool {
        false
    }

    fn diagnose(&self, diagnostic: &Diagnostic) {
        self.keep(diagnostic.to_string());
    }

    fn begin(&self, _: &str, _: Option<u64>) {}

    fn pass(&self, _: &Progress) {}

    fn end(&self) {}

    fn say(&self, _: &str) {}

    fn warn(&self, text: &str) {
        self.keep(text.to_owned());
    }
}
