//! `steradian check`.

mod scene;
mod target;

use crate::args::CheckArgs;
use crate::experiment::host::Terminal;
use crate::failure::Failure;
use crate::{Context, interrupt};
use sr_experiment::{Host, PAGE, check_folder, write_text};
use sr_io::Override;
use sr_stability::report::{Report, words};
use sr_stability::{CheckError, Checked, Effort, Verdict, check, check_file};
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use target::{Target, Targets};

/// What `-o` has beside the page; its presence makes a folder one of ours.
const JSON: &str = "check.json";
/// And a folder with the plots of the page, one a file.
const PLOTS: &str = "plots";

/// Checks what is asked for; the status is 1 where a bound does not hold, or a scene is broken.
pub fn run(args: &CheckArgs, context: &Context<'_>) -> Result<ExitCode, Failure> {
    let targets = target::choose(&args.what)?;
    if let Some(folder) = &args.output {
        check_folder(folder, JSON, "check").map_err(Failure::Input)?;
    }
    interrupt::watch(context.console.quiet);
    match targets {
        Targets::Bounds(_) if args.oracle => Err(Failure::Input(
            "--oracle traces samples of one scene in f64; suites have their f64 in them: `check SCENE --oracle`".into(),
        )),
        Targets::Bounds(targets) => bounds(&targets, args, context),
        Targets::Scene(path) => scene::run(&path, args, context),
    }
}

fn bounds(
    targets: &[Target],
    args: &CheckArgs,
    context: &Context<'_>,
) -> Result<ExitCode, Failure> {
    let host = host(args, context);
    let effort = Effort { long: args.long };
    let mut checked = Vec::new();
    for target in targets {
        let one = match target {
            Target::Suite(suite) => check(suite, &effort, &host),
            Target::File(path) => check_file(path, &host),
        };
        let one = one.map_err(failure)?;
        if !args.json {
            tell(&one, context);
        }
        checked.push(one);
    }
    let machine = host.machine();
    let report = Report {
        checked: &checked,
        command: &context.command_line,
        machine: &machine,
    };
    let json = report.json().map_err(Failure::Work)?;
    match args.json {
        true => context.console.say(&json),
        false => context.console.say(report.summary()),
    }
    if let Some(folder) = &args.output {
        let page = report.html().map_err(Failure::Work)?;
        write(folder, &page, &json)?;
        let plots = report.plots().map_err(Failure::Work)?;
        write_plots(&folder.join(PLOTS), &plots)?;
        if !args.json {
            wrote(folder, context);
        }
    }
    Ok(match report.verdict() {
        Verdict::Holds => ExitCode::SUCCESS,
        Verdict::Unclear | Verdict::Broken => ExitCode::from(1),
    })
}

fn host<'a>(args: &CheckArgs, context: &'a Context<'a>) -> Terminal<'a> {
    let set = args.set.iter().map(|(path, value)| Override {
        path: path.clone(),
        value: value.clone(),
        origin: "--set".into(),
    });
    Terminal::new(context, args.threads.unwrap_or(0).into(), set.collect())
}

fn tell(checked: &Checked, context: &Context<'_>) {
    let heading = format!("{}: {}", checked.suite, checked.about);
    context.console.say(heading);
    for line in words::lines(checked) {
        context.console.say(line);
    }
}

fn failure(error: CheckError) -> Failure {
    match error {
        CheckError::Input { errors: 1 } => Failure::Input("the input has 1 error".into()),
        CheckError::Input { errors } => Failure::Input(format!("the input has {errors} errors")),
        CheckError::NoCheck(message) => Failure::Input(message),
        CheckError::Work(message) => Failure::Work(message),
        CheckError::Interrupted => Failure::Work("interrupted; nothing was written".into()),
    }
}

fn write(folder: &Path, page: &str, json: &str) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|e| Failure::Work(format!("{}: {e}", folder.display())))?;
    write_text(&folder.join(JSON), json).map_err(Failure::Work)?;
    write_text(&folder.join(PAGE), page).map_err(Failure::Work)
}

fn write_plots(folder: &Path, plots: &[(String, String)]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|e| Failure::Work(format!("{}: {e}", folder.display())))?;
    let mut files = plots.iter();
    files.try_for_each(|(name, svg)| write_text(&folder.join(name), svg).map_err(Failure::Work))
}

fn wrote(folder: &Path, context: &Context<'_>) {
    let page = folder.join(PAGE);
    context
        .console
        .say(format_args!("wrote {}", page.display()));
}
