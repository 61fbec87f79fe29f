//! What an experiment needs from the program that it runs in: pipelines with everything that is
//! registered there, and somebody to tell.

use crate::machine::Machine;
use sr_io::Override;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::diagnostics::Diagnostic;
use sr_pipeline::{Pipeline, PipelineError, Progress, Provenance};

/// The program around an experiment.
pub trait Host {
    /// A new pipeline with readers, integrators and plug-ins.
    ///
    /// # Errors
    /// When threads cannot be started.
    fn pipeline(&self) -> Result<Pipeline, PipelineError>;

    /// Changes that come after the experiment's: the command line's.
    fn overrides(&self) -> &[Override];

    /// What the files of a run say about themselves.
    fn provenance(&self, world: &World) -> Provenance;

    /// How the program was called, for the record.
    fn command_line(&self) -> &str;

    /// What it runs on.
    fn machine(&self) -> Machine;

    /// The whole story of a failure.
    fn explain(&self, error: PipelineError) -> String {
        error.to_string()
    }

    /// Whether somebody asked for an end.
    fn stopped(&self) -> bool;

    /// Something about the input.
    fn diagnose(&self, diagnostic: &Diagnostic);

    /// A render begins, of so many samples a pixel at most, if that is known.
    fn begin(&self, what: &str, samples: Option<u64>);

    /// One of its passes is done.
    fn pass(&self, progress: &Progress);

    /// The render is over.
    fn end(&self);

    /// A line of progress.
    fn say(&self, text: &str);

    /// Something that went wrong without ending the experiment.
    fn warn(&self, text: &str);
}
