//! The health of one scene.

use super::host;
use crate::Context;
use crate::args::{CheckArgs, SceneArgs};
use crate::failure::Failure;
use crate::replay::replay_command;
use crate::session::Session;
use sr_experiment::Host;
use sr_stability::Effort;
use sr_stability::health::{Condition, Examination, SceneReport, examine};
use std::path::Path;
use std::process::ExitCode;

/// Loads, compiles, examines and tells; the status is 1 where something is broken.
pub fn run(path: &Path, args: &CheckArgs, context: &Context<'_>) -> Result<ExitCode, Failure> {
    let scene_args = scene_args(path, args);
    let mut session = Session::new(&scene_args, context)?;
    let loaded = session.pipeline.load();
    session.settle(loaded)?;
    let compiled = session.pipeline.compile();
    session.settle(compiled)?;
    let host = host(args, context);
    let how = Examination {
        effort: Effort { long: args.long },
        oracle: args.oracle,
        replay: &|id| replay_command(&context.command_line, &scene_args, id),
        host: &host,
    };
    let health = examine(&mut session.pipeline, &how).map_err(super::failure)?;
    let scene = path.display().to_string();
    let report = SceneReport {
        scene: &scene,
        health: &health,
        command: &context.command_line,
        machine: &host.machine(),
    };
    tell(&report, args, context)?;
    Ok(match health.condition() {
        Condition::Ok | Condition::Look => ExitCode::SUCCESS,
        Condition::Broken => ExitCode::from(1),
    })
}

/// As `render` would take them.
fn scene_args(path: &Path, args: &CheckArgs) -> SceneArgs {
    SceneArgs {
        input: path.to_owned(),
        set: args.set.clone(),
        threads: args.threads,
        spp: None,
        time: None,
        target_error: None,
        adaptive: None,
        max_depth: None,
        width: None,
        height: None,
        integrator: None,
        seed: None,
        crop: None,
    }
}

fn tell(report: &SceneReport<'_>, args: &CheckArgs, context: &Context<'_>) -> Result<(), Failure> {
    let console = &context.console;
    let json = report.json().map_err(Failure::Work)?;
    if args.json {
        console.say(&json);
    } else {
        report.lines().iter().for_each(|line| console.say(line));
        console.say(report.summary());
    }
    let Some(folder) = &args.output else {
        return Ok(());
    };
    let page = report.html().map_err(Failure::Work)?;
    super::write(folder, &page, &json)?;
    if !args.json {
        super::wrote(folder, context);
    }
    Ok(())
}
