//! The terminal around an experiment.

use crate::failure::Failure;
use crate::progress::Reporter;
use crate::{Context, interrupt, provenance, session};
use sr_experiment::{Host, Machine};
use sr_io::Override;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::diagnostics::{Diagnostic, Severity};
use sr_pipeline::{Pipeline, PipelineError, Progress, Provenance};
use std::cell::RefCell;

/// Pipelines as all commands have them, and lines for people.
pub struct Terminal<'a> {
    context: &'a Context<'a>,
    threads: usize,
    overrides: Vec<Override>,
    reporter: RefCell<Reporter>,
}

impl<'a> Terminal<'a> {
    /// With the changes of the command line.
    pub fn new(context: &'a Context<'a>, threads: usize, overrides: Vec<Override>) -> Self {
        Self {
            context,
            threads,
            overrides,
            reporter: RefCell::new(Reporter::new(context.console.quiet)),
        }
    }
}

impl Host for Terminal<'_> {
    fn pipeline(&self) -> Result<Pipeline, PipelineError> {
        session::pipeline(self.threads, self.context)
    }

    fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    fn provenance(&self, world: &World) -> Provenance {
        provenance::of(world, &self.context.command_line)
    }

    fn command_line(&self) -> &str {
        &self.context.command_line
    }

    fn machine(&self) -> Machine {
        Machine::here(self.threads)
    }

    fn explain(&self, error: PipelineError) -> String {
        Failure::from(error).to_string()
    }

    fn stopped(&self) -> bool {
        interrupt::asked()
    }

    fn diagnose(&self, diagnostic: &Diagnostic) {
        match diagnostic.severity {
            Severity::Error => self.context.console.error(diagnostic),
            Severity::Warning | Severity::Notice => self.context.console.note(diagnostic),
        }
    }

    fn begin(&self, what: &str, samples: Option<u64>) {
        self.reporter.borrow_mut().start_named(what, samples);
    }

    fn pass(&self, progress: &Progress) {
        self.reporter.borrow_mut().pass(progress);
    }

    fn end(&self) {
        self.reporter.borrow_mut().finish();
    }

    fn say(&self, text: &str) {
        self.context.console.note(text);
    }

    fn warn(&self, text: &str) {
        self.context.console.error(format_args!("warning: {text}"));
    }
}
