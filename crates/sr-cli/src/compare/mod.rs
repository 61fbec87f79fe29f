//! `steradian compare`.

mod figures;
mod maps;
mod same;

use crate::args::CompareArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::units::parse_positive;
use serde::Serialize;
use sr_experiment::PPD_RANGE;
use sr_pipeline::film_kernel::{DisplayImage, write_png};
use std::path::Path;
use std::process::ExitCode;

/// Version of both JSON formats; docs/compare.md is their contract.
const VERSION: u32 = 1;

/// Pixels per degree that FLIP can be computed for.
pub fn parse_ppd(text: &str) -> Result<f64, String> {
    let ppd = parse_positive(text)?;
    if PPD_RANGE.contains(&ppd) {
        Ok(ppd)
    } else {
        Err(format!(
            "must lie between {} and {}",
            PPD_RANGE.start(),
            PPD_RANGE.end()
        ))
    }
}

/// Measures one picture against the other, or judges whether they are the same: then the status is
/// 1 if they are not.
pub fn run(args: &CompareArgs, console: &Console) -> Result<ExitCode, Failure> {
    if let Some(output) = &args.output {
        check_output(output, args)?;
    }
    if args.same {
        same::run(args, console)
    } else {
        figures::run(args, console).map(|()| ExitCode::SUCCESS)
    }
}

fn print(
    args: &CompareArgs,
    console: &Console,
    json: &impl Serialize,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    if args.json {
        let json = serde_json::to_string_pretty(json)
            .map_err(|e| Failure::Work(format!("cannot write JSON: {e}")))?;
        console.say(json);
    } else {
        console.say(text());
    }
    Ok(())
}

/// A map is a PNG file and none of the pictures, found out before any work.
fn check_output(output: &Path, args: &CompareArgs) -> Result<(), Failure> {
    let refuse = |cause: &str| {
        let message = format!("cannot write {}: {cause}", output.display());
        Err(Failure::Input(message))
    };
    let extension = output
        .extension()
        .map(|e| e.to_string_lossy().to_lowercase());
    if extension.as_deref() != Some("png") {
        return refuse("maps are written as .png");
    }
    if output.is_dir() {
        return refuse("it is a folder");
    }
    let same = |a: &Path| Some(a.canonicalize().ok()? == output.canonicalize().ok()?);
    if [&args.image, &args.reference]
        .iter()
        .any(|p| same(p) == Some(true))
    {
        return refuse("it is one of the pictures");
    }
    let folder = output.parent().filter(|p| !p.as_os_str().is_empty());
    if folder.is_some_and(|f| !f.is_dir()) {
        return refuse("there is no such folder");
    }
    Ok(())
}

fn write_map(output: &Path, map: &DisplayImage) -> Result<(), Failure> {
    write_png(output, map).map_err(|e| Failure::Work(e.to_string()))
}
