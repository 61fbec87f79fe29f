//! `steradian render`.

mod convergence;
mod output;
mod stats;
mod summary;

use crate::Context;
use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::progress::Reporter;
use crate::replay::{self, Replays};
use crate::session::Session;
use crate::{experiment, interrupt, provenance};
use output::Outputs;
use sr_pipeline::settings::{AdaptiveSettings, Budget};
use sr_pipeline::{OutputRequest, Pipeline, most_samples};
use std::ops::ControlFlow;

/// Loads, compiles, renders and writes.
pub fn run(args: &RenderArgs, context: &Context<'_>) -> Result<(), Failure> {
    if experiment::is_one(&args.scene.input) {
        let message = format!(
            "{} is an experiment; run `steradian experiment` with it",
            args.scene.input.display()
        );
        return Err(Failure::Input(message));
    }
    if let Some(id) = args.replay {
        return replay::run(args, id, context);
    }
    let mut outputs = Outputs::choose(args)?;
    outputs.check(&args.scene.input)?;
    let mut session = Session::new(&args.scene, context)?;
    let mut reporter = Reporter::new(context.console.quiet);
    let loaded = reporter.during("loading", || session.pipeline.load());
    session.settle(loaded)?;
    if session
        .pipeline
        .world
        .resource::<AdaptiveSettings>()
        .is_on()
    {
        outputs.add_rate();
        outputs.check(&args.scene.input)?;
    }
    let compiled = reporter.during("compiling", || session.pipeline.compile());
    session.settle(compiled)?;
    outputs.make_folder()?;
    hand_over(&mut session.pipeline, &outputs, context);
    if let Some(path) = &outputs.convergence {
        convergence::install(&mut session.pipeline, path);
    }

    // Before this, Ctrl-C just ends the program: there is nothing to save.
    interrupt::watch(context.console.quiet);
    let world = &session.pipeline.world;
    let most = most_samples(
        world.resource::<Budget>(),
        world.resource::<AdaptiveSettings>(),
    );
    reporter.start(most);
    let rendered = session.pipeline.render(|progress| {
        reporter.pass(progress);
        if interrupt::asked() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    reporter.finish();
    let stop = session.settle(rendered)?;
    let written = session.pipeline.post();
    session.settle(written)?;
    let replays = Replays::new(&session.pipeline, &args.scene, &context.command_line);
    if let Some(path) = &outputs.stats {
        stats::write(&session.pipeline, stop, &replays, path)?;
    }
    summary::print(
        &session.pipeline,
        stop,
        &outputs,
        &replays,
        &context.console,
    );
    convergence::finish(&session.pipeline)
}

/// Tells the pipeline what to write and what to write about it.
fn hand_over(pipeline: &mut Pipeline, outputs: &Outputs, context: &Context<'_>) {
    let world = &mut pipeline.world;
    world.insert_resource(OutputRequest {
        exr: outputs.exr.clone(),
        png: outputs.png.clone(),
        rate: outputs.rate.clone(),
    });
    let provenance = provenance::of(world, &context.command_line);
    world.insert_resource(provenance);
}
