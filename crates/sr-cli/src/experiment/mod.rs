//! `steradian experiment`, and `steradian plan` of an experiment.

pub mod host;
mod table;

use crate::args::{ExperimentArgs, SceneArgs};
use crate::failure::Failure;
use crate::overrides::overrides;
use crate::{Context, interrupt, units};
use host::Terminal;
use sr_experiment::{Folder, Host, Outcome, PAGE, Plan, PlanError};
use sr_io::Override;
use sr_pipeline::StageSeconds;
use sr_pipeline::catalog::IntegratorCatalog;
use std::path::{Path, PathBuf};

/// Where experiments go when nobody says.
const DEFAULT_FOLDER: &str = "out";

/// Whether a file's name is that of an experiment.
pub fn is_one(path: &Path) -> bool {
    let name = path.to_string_lossy().to_lowercase();
    name.ends_with(sr_experiment::EXTENSION)
}

/// Looks at everything, runs it, and writes what it came to.
pub fn run(args: &ExperimentArgs, context: &Context<'_>) -> Result<(), Failure> {
    let set = args.set.iter().map(|(path, value)| Override {
        path: path.clone(),
        value: value.clone(),
        origin: "--set".into(),
    });
    let host = Terminal::new(context, args.threads.unwrap_or(0).into(), set.collect());
    let (plan, folder) = prepare(&args.input, args.output.as_deref(), &host)?;
    // Before this, Ctrl-C just ends the program: there is nothing to save.
    interrupt::watch(context.console.quiet);
    let done = match args.resume {
        true => sr_experiment::resume(&plan, &folder, &host).map_err(Failure::Input)?,
        false => Vec::new(),
    };
    let outcome = sr_experiment::run(&plan, &folder, &host, done).map_err(Failure::Work)?;
    tell(&plan, &outcome, &folder, context)
}

/// Tells the runs of an experiment and what they will cost. Writes nothing.
pub fn plan_only(args: &SceneArgs, context: &Context<'_>) -> Result<(), Failure> {
    let pipeline = crate::session::pipeline(1, context)?;
    let overrides = overrides(args, pipeline.world.resource::<IntegratorCatalog>());
    let host = Terminal::new(context, args.threads.unwrap_or(0).into(), overrides);
    let plan = look(&args.input, &host)?;
    let costs = sr_experiment::estimate(&plan, &host);
    context.console.say(table::plan(&plan, &costs));
    Ok(())
}

/// Everything that can be wrong, found out before the folder is touched.
fn prepare(
    input: &Path,
    output: Option<&Path>,
    host: &Terminal<'_>,
) -> Result<(Plan, Folder), Failure> {
    let experiment = read(input, host)?;
    let default = || Path::new(DEFAULT_FOLDER).join(experiment.stem());
    let path: PathBuf = output.map_or_else(default, Path::to_owned);
    let folder = Folder::check(&path).map_err(Failure::Input)?;
    Ok((planned(experiment, host)?, folder))
}

fn look(input: &Path, host: &Terminal<'_>) -> Result<Plan, Failure> {
    planned(read(input, host)?, host)
}

fn read(input: &Path, host: &Terminal<'_>) -> Result<sr_experiment::Experiment, Failure> {
    sr_experiment::read(input).map_err(|problems| {
        for problem in &problems {
            host.diagnose(problem);
        }
        wrong(problems.len())
    })
}

fn planned(experiment: sr_experiment::Experiment, host: &Terminal<'_>) -> Result<Plan, Failure> {
    sr_experiment::plan(experiment, host).map_err(|error| match error {
        PlanError::Input { errors } => wrong(errors),
        PlanError::Pipeline(error) => error.into(),
    })
}

fn wrong(errors: usize) -> Failure {
    Failure::Input(match errors {
        1 => "the input has 1 error".into(),
        n => format!("the input has {n} errors"),
    })
}

/// What the runs took, on the clock of comparisons and off it.
fn seconds(outcome: &Outcome) -> String {
    let sum = |of: fn(&StageSeconds) -> f64| {
        let all = outcome.done.iter().map(|d| of(&d.seconds));
        units::duration(all.sum())
    };
    format!(
        "{} of integration; off that clock {} of loading, {} of compiling, {} of measuring, {} of writing",
        sum(|s| s.integrate),
        sum(|s| s.load),
        sum(|s| s.compile),
        sum(|s| s.measure),
        sum(|s| s.post),
    )
}

/// The closing lines, and whether the work was done.
fn tell(
    plan: &Plan,
    outcome: &Outcome,
    folder: &Folder,
    context: &Context<'_>,
) -> Result<(), Failure> {
    let (done, all) = (outcome.done.len() as u64, plan.runs.len() as u64);
    let path = folder.path().display();
    for line in outcome.analysis.words() {
        context.console.say(line);
    }
    if !outcome.done.is_empty() {
        context.console.say(seconds(outcome));
        let page = folder.file(PAGE);
        let page = page.display();
        context
            .console
            .say(format_args!("wrote {path}: open {page}"));
    }
    if outcome.interrupted {
        let runs = units::counted(all, "run");
        let message = format!("interrupted: {done} of {runs} are done; they are in {path}");
        return Err(Failure::Work(message));
    }
    match outcome.failed.len() as u64 {
        0 => Ok(()),
        n => Err(Failure::Work(format!(
            "{} of {all} failed; the others are in {path}",
            units::counted(n, "run")
        ))),
    }
}
