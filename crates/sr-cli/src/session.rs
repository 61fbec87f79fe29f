//! A pipeline from files to a sealed scene, with everything there is to tell told once.

use crate::Context;
use crate::args::SceneArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::overrides::overrides;
use sr_io::LoadRequest;
use sr_pipeline::catalog::IntegratorCatalog;
use sr_pipeline::diagnostics::{Diagnostics, Severity};
use sr_pipeline::{Pipeline, PipelineError};
use std::collections::HashSet;

/// The pipeline of one command.
pub struct Session<'a> {
    /// World and schedules.
    pub pipeline: Pipeline,
    console: &'a Console,
    /// How many diagnostics are printed already.
    told: usize,
    texts: HashSet<String>,
}

/// Readers, built-in integrators and what a stranger's binary adds.
pub fn pipeline(threads: usize, context: &Context<'_>) -> Result<Pipeline, PipelineError> {
    let mut pipeline = Pipeline::new(threads)?;
    sr_io::install(&mut pipeline.world);
    pipeline.add_plugin(sr_integrators::integrators);
    for plugin in context.plugins {
        plugin.build(&mut pipeline);
    }
    Ok(pipeline)
}

impl<'a> Session<'a> {
    /// A pipeline that knows what to load.
    pub fn new(args: &SceneArgs, context: &'a Context<'_>) -> Result<Self, Failure> {
        let mut pipeline = pipeline(args.threads.unwrap_or(0).into(), context)?;
        let request = LoadRequest {
            path: args.input.clone(),
            overrides: overrides(args, pipeline.world.resource::<IntegratorCatalog>()),
            ..Default::default()
        };
        pipeline.world.insert_resource(request);
        Ok(Self {
            pipeline,
            console: &context.console,
            told: 0,
            texts: HashSet::new(),
        })
    }

    /// What a step of the pipeline came to, after printing what it had to say.
    pub fn settle<T>(&mut self, result: Result<T, PipelineError>) -> Result<T, Failure> {
        self.tell();
        Ok(result?)
    }

    /// Prints the diagnostics that are new, equal ones once.
    fn tell(&mut self) {
        let all = &self.pipeline.world.resource::<Diagnostics>().0;
        for diagnostic in all.iter().skip(self.told) {
            let text = diagnostic.to_string();
            if self.texts.contains(&text) {
                continue;
            }
            match diagnostic.severity {
                Severity::Error => self.console.error(&text),
                Severity::Warning | Severity::Notice => self.console.note(&text),
            }
            self.texts.insert(text);
        }
        self.told = all.len();
    }
}
