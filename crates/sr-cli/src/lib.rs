//! The command line of Steradian, as a function.
//!
//! The binary `steradian` calls [`run`] without plug-ins. A binary of your own calls it with some,
//! and has the same commands, options and exit statuses, with your integrators and components
//! known by name in files, to `--set` and to `list`:
//!
//! ```no_run
//! use sr_pipeline::Pipeline;
//! use std::process::ExitCode;
//!
//! fn my_integrators(pipeline: &mut Pipeline) {
//!     // pipeline.add_ray_integrator::<MyIntegrator>();
//! }
//!
//! fn main() -> ExitCode {
//!     sr_cli::run(std::env::args_os(), &[&my_integrators])
//! }
//! ```
//!
//! Exit statuses: 0 done, 1 the work failed (or `compare --same` found a difference, or
//! `check` a bound that does not hold, or a sample that is refused), 2 bad usage
//! or bad input. Results go to the standard output; errors, warnings, notices and progress to the
//! standard error.

mod args;
mod check;
mod compare;
mod console;
mod experiment;
mod failure;
mod interrupt;
mod list;
mod overrides;
mod panics;
mod plan;
mod progress;
mod provenance;
mod render;
mod replay;
mod session;
mod units;

use args::{Cli, Command};
use clap::Parser;
use console::Console;
use failure::Failure;
use sr_pipeline::Plugin;
use std::ffi::{OsStr, OsString};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;

/// Runs one command line, of which the first argument is the program's name, with the built-in
/// readers and integrators and with `plugins`.
///
/// For the whole process, panics are silenced while `RUST_BACKTRACE` is unset: they come back as
/// errors that name what panicked. A render takes over Ctrl-C, and so does an
/// experiment.
pub fn run<I>(args: I, plugins: &[&dyn Plugin]) -> ExitCode
where
    I: IntoIterator,
    I::Item: Into<OsString> + Clone,
{
    panics::silence();
    let args: Vec<OsString> = args.into_iter().map(Into::into).collect();
    let cli = match Cli::try_parse_from(&args) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version come this way too, and are no failure. A closed pipe is nobody's.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { 2 } else { 0 });
        }
    };
    let context = Context {
        plugins,
        console: Console {
            quiet: match &cli.command {
                Command::Render(render) => render.quiet,
                Command::Experiment(experiment) => experiment.quiet,
                Command::Check(check) => check.quiet,
                _ => false,
            },
        },
        command_line: command_line(&args),
    };
    let work = AssertUnwindSafe(|| dispatch(&cli.command, &context));
    let result = catch_unwind(work).unwrap_or_else(|_| Err(Failure::bug()));
    match result {
        Ok(status) => status,
        Err(failure) => {
            context.console.error(format_args!("error: {failure}"));
            failure.status()
        }
    }
}

/// What every command may use.
struct Context<'a> {
    plugins: &'a [&'a dyn Plugin],
    console: Console,
    /// As it was typed, for the record.
    command_line: String,
}

/// As it was typed, the program without its folder.
fn command_line(args: &[OsString]) -> String {
    let name = args
        .first()
        .and_then(|program| Path::new(program).file_name());
    let words = name
        .into_iter()
        .chain(args.iter().skip(1).map(OsString::as_os_str));
    let words: Vec<_> = words.map(OsStr::to_string_lossy).collect();
    words.join(" ")
}

fn dispatch(command: &Command, context: &Context<'_>) -> Result<ExitCode, Failure> {
    match command {
        Command::Render(args) => render::run(args, context),
        Command::Plan(args) if experiment::is_one(&args.input) => {
            experiment::plan_only(args, context)
        }
        Command::Plan(args) => plan::run(args, context),
        Command::Experiment(args) => experiment::run(args, context),
        Command::List(args) => list::run(args, context),
        // Those whose result is a status too.
        Command::Check(args) => return check::run(args, context),
        Command::Compare(args) => return compare::run(args, &context.console),
    }
    .map(|()| ExitCode::SUCCESS)
}
