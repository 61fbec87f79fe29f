//! One run's pipeline, from files to a sealed scene.

use crate::document::Experiment;
use crate::host::Host;
use sr_io::{Change, LoadRequest};
use sr_pipeline::diagnostics::Diagnostics;
use sr_pipeline::settings::{AdaptiveSettings, Budget};
use sr_pipeline::{FilmResource, Pipeline, PipelineError, StopReason};
use std::ops::ControlFlow;

/// Loads and compiles the base with some changes. What there is to tell is in the pipeline's
/// [`Diagnostics`], whether it failed or not.
pub(crate) fn compile(
    experiment: &Experiment,
    changes: Vec<Change>,
    host: &dyn Host,
) -> Result<(Pipeline, Result<(), PipelineError>), PipelineError> {
    let mut pipeline = host.pipeline()?;
    pipeline.world.insert_resource(LoadRequest {
        path: experiment.base.clone(),
        changes,
        overrides: host.overrides().to_vec(),
    });
    let result = pipeline.load().and_then(|()| pipeline.compile());
    Ok((pipeline, result))
}

/// The same for what was found to be right already: an error is one of the work.
pub(crate) fn open(
    experiment: &Experiment,
    changes: Vec<Change>,
    host: &dyn Host,
) -> Result<Pipeline, String> {
    let opened = compile(experiment, changes, host);
    let (pipeline, result) = opened.map_err(|e| host.explain(e))?;
    result.map_err(|error| {
        // Files may have changed since they were looked at.
        for diagnostic in &pipeline.world.resource::<Diagnostics>().0 {
            host.diagnose(diagnostic);
        }
        host.explain(error)
    })?;
    Ok(pipeline)
}

/// All passes of a render that the host shows and may stop.
pub(crate) fn render(
    pipeline: &mut Pipeline,
    name: &str,
    host: &dyn Host,
) -> Result<StopReason, PipelineError> {
    let provenance = host.provenance(&pipeline.world);
    pipeline.world.insert_resource(provenance);
    host.begin(name, most_samples(pipeline));
    let stop = pipeline.render(|progress| {
        host.pass(progress);
        if host.stopped() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    host.end();
    stop
}

/// Samples a pixel at which a render ends at the latest, when that is known.
pub(crate) fn most_samples(pipeline: &Pipeline) -> Option<u64> {
    let world = &pipeline.world;
    sr_pipeline::most_samples(
        world.resource::<Budget>(),
        world.resource::<AdaptiveSettings>(),
    )
}

/// What one sample a pixel came to.
pub(crate) struct Probe {
    /// How long it took.
    pub seconds: f64,
    /// FNV-1a over the bits of the picture.
    pub hash: u64,
}

/// Renders one sample a pixel and leaves the budget as it was: a measure of time, and a short name
/// of everything that goes into the picture.
pub(crate) fn probe(pipeline: &mut Pipeline) -> Result<Probe, PipelineError> {
    let own = pipeline.world.resource::<Budget>().clone();
    pipeline.world.insert_resource(Budget {
        samples: Some(1),
        ..Default::default()
    });
    let rendered = pipeline.render(|_| ControlFlow::Continue(()));
    pipeline.world.insert_resource(own);
    rendered?;
    let film = pipeline.world.resource::<FilmResource>();
    let image = film.film.resolve(film.estimator).rgb;
    let bytes = image.pixels.iter().flat_map(|p| p.to_array());
    let bytes = bytes.flat_map(|v| v.to_bits().to_le_bytes());
    Ok(Probe {
        seconds: pipeline
            .world
            .resource::<sr_pipeline::StageSeconds>()
            .integrate,
        hash: bytes.fold(FNV_OFFSET, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(FNV_PRIME)
        }),
    })
}

/// Fowler, Noll, Vo 1991, the 64-bit constants.
const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;
