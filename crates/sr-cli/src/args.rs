//! What can be typed.

use crate::compare::parse_ppd;
use crate::replay::parse_sample;
use crate::units::{parse_crop, parse_positive, parse_seconds};
use clap::{Args, Parser, Subcommand, ValueEnum};
use sr_pipeline::replay::SampleId;
use std::path::PathBuf;

/// A physically based renderer, and a bench for light-transport experiments.
#[derive(Parser)]
#[command(name = "steradian", version)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Subcommand)]
pub enum Command {
    /// Render a picture.
    Render(Box<RenderArgs>),
    /// Say what would run, what is left out, and why; of an experiment its runs and their cost.
    Plan(Box<SceneArgs>),
    /// Run everything that an experiment file describes, and show it.
    Experiment(Box<ExperimentArgs>),
    /// List what can be named in files and on the command line.
    List(ListArgs),
    /// Check numerical stability: the renderer's own, suite by suite, or that of one scene.
    Check(CheckArgs),
    /// Measure how far an image is from a reference, or judge whether two renders are the same.
    Compare(CompareArgs),
}

/// A scene and how to render it.
#[derive(Args)]
pub struct SceneArgs {
    /// A configuration (.ron), a scene (.scene.ron) or a model (.gltf, .glb, .obj). `plan` takes
    /// an experiment (.exp.ron) too.
    #[arg(value_name = "FILE")]
    pub input: PathBuf,
    /// Set anything that has a path, such as film.width=640 (see: steradian list settings). Applied
    /// after all other options.
    #[arg(long, value_name = "PATH=VALUE", value_parser = parse_assignment)]
    pub set: Vec<(String, String)>,
    /// Stop after N samples a pixel. Any of --spp, --time and --target-error replaces the budget of
    /// the configuration; given together, whichever is reached first ends the render.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub spp: Option<u64>,
    /// Stop after this time of integration, such as 10s, 500ms or 2m.
    #[arg(long, value_name = "TIME", value_parser = parse_seconds)]
    pub time: Option<f64>,
    /// Stop when the estimated relMSE is below E.
    #[arg(long, value_name = "E", value_parser = parse_positive)]
    pub target_error: Option<f64>,
    /// Sample adaptively: a pixel has enough when the half width of its confidence interval is TOL of
    /// its mean, such as 0.05. The budget's samples are the most that a pixel gets.
    #[arg(long, value_name = "TOL", value_parser = parse_positive)]
    pub adaptive: Option<f64>,
    /// Most bounces: 0 shows what glows, 1 adds direct light.
    #[arg(long, value_name = "N")]
    pub max_depth: Option<u32>,
    /// Width of the picture in pixels.
    #[arg(long, value_name = "W", value_parser = clap::value_parser!(u32).range(1..))]
    pub width: Option<u32>,
    /// Height of the picture in pixels.
    #[arg(long, value_name = "H", value_parser = clap::value_parser!(u32).range(1..))]
    pub height: Option<u32>,
    /// The integrator, such as path, direct or path_bsdf (see: steradian list integrators).
    #[arg(long, value_name = "NAME")]
    pub integrator: Option<String>,
    /// Threads to use; one for each core unless given. The picture does not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Another seed is another, independent picture.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Render only this part: left, top, one past right, one past bottom, in pixels.
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_crop)]
    pub crop: Option<[u32; 4]>,
}

/// Arguments of `render`.
#[derive(Args)]
pub struct RenderArgs {
    /// What to render.
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Where to write: x.exr writes x.png beside it, x.png only the PNG, a name without extension
    /// both, a folder both under the name of FILE. Default: the folder out.
    #[arg(short, long, value_name = "PATH")]
    pub output: Option<PathBuf>,
    /// Write figures of the render as JSON (see docs/stats.md).
    #[arg(long, value_name = "FILE")]
    pub stats: Option<PathBuf>,
    /// Write the estimated error against time as CSV while it renders, a line at each doubling of the
    /// samples and at the end (see docs/convergence.md).
    #[arg(long, value_name = "FILE.csv")]
    pub convergence: Option<PathBuf>,
    /// Trace one sample of one pixel again and tell what happens to it: each vertex with shape and
    /// material, random numbers, weights, densities and what it adds. X,Y is the pixel from the top left of
    /// the whole picture. Nothing is written.
    #[arg(long, value_name = "X,Y,SAMPLE", value_parser = parse_sample,
          conflicts_with_all = ["output", "stats", "convergence", "quiet"])]
    pub replay: Option<SampleId>,
    /// Tell it as JSON (see docs/replay.md).
    #[arg(long, requires = "replay")]
    pub json: bool,
    /// Print errors only.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Arguments of `experiment`.
#[derive(Args)]
pub struct ExperimentArgs {
    /// An experiment (.exp.ron; see docs/experiments.md).
    #[arg(value_name = "FILE")]
    pub input: PathBuf,
    /// The folder to write to; it is made when it is missing. Default: a folder of the
    /// experiment's name in the folder out.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Go on with what the folder has of the same experiment. What is done stays as it is; a changed
    /// experiment is refused.
    #[arg(long)]
    pub resume: bool,
    /// Set anything in every run, such as film.width=64. Applied after all that the file says.
    #[arg(long, value_name = "PATH=VALUE", value_parser = parse_assignment)]
    pub set: Vec<(String, String)>,
    /// Threads to use; one for each core unless given. Pictures do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print errors only.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Arguments of `list`.
#[derive(Args)]
pub struct ListArgs {
    /// What to list.
    pub what: Listing,
}

/// What can be listed.
#[derive(Clone, Copy, ValueEnum)]
pub enum Listing {
    /// Ways to compute light, and their settings.
    Integrators,
    /// Lobes, and their parameters.
    Materials,
    /// Lights, and their parameters.
    Lights,
    /// Sources of random numbers.
    Samplers,
    /// What a scene may have or lack; see `plan` for what yours has.
    Features,
    /// Every path that --set reaches, with type and default.
    Settings,
}

/// Arguments of `check`.
#[derive(Args)]
pub struct CheckArgs {
    /// Suites by name and experiments with `stability` (.exp.ron; see docs/stability.md), or one scene,
    /// configuration or model whose samples are examined (see docs/health.md). Without any, all suites.
    #[arg(value_name = "SUITE|FILE")]
    pub what: Vec<String>,
    /// Dig deeper: minutes instead of seconds.
    #[arg(long)]
    pub long: bool,
    /// Of a scene: trace some of its samples in f64 too, with the same random numbers, and tell where the two
    /// paths part.
    #[arg(long)]
    pub oracle: bool,
    /// Print JSON (see docs/stability.md, and of a scene docs/health.md).
    #[arg(long)]
    pub json: bool,
    /// A folder for report.html and check.json, and for the plots of suites as SVG.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Set anything in what is rendered, such as film.width=64.
    #[arg(long, value_name = "PATH=VALUE", value_parser = parse_assignment)]
    pub set: Vec<(String, String)>,
    /// Threads to use; one for each core unless given. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print errors only.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Arguments of `compare`.
#[derive(Args)]
pub struct CompareArgs {
    /// The image to judge: EXR, PNG or HDR.
    pub image: PathBuf,
    /// What it should be.
    pub reference: PathBuf,
    /// Print JSON (see docs/compare.md).
    #[arg(long)]
    pub json: bool,
    /// Judge whether both have the same expected picture, from the variance in their EXR files. The
    /// exit status is 0 if they have and 1 if they differ.
    #[arg(long)]
    pub same: bool,
    /// Write a map of where they differ, as PNG.
    #[arg(short, long, value_name = "FILE.png")]
    pub output: Option<PathBuf>,
    /// What the map shows.
    #[arg(long, value_enum, default_value_t = MapKind::Flip, requires = "output", conflicts_with = "same")]
    pub map: MapKind,
    /// Pixels per degree of sight that FLIP assumes; 67 unless given: a display 3840 pixels and 0.7
    /// m wide, 0.7 m away.
    #[arg(long, value_name = "N", value_parser = parse_ppd, conflicts_with = "same")]
    pub ppd: Option<f64>,
}

/// Maps of where an image and its reference differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MapKind {
    /// FLIP: from black, not to be seen, to light yellow.
    Flip,
    /// Squared error, six decades up to the largest.
    Squared,
    /// Squared relative error, six decades up to the largest.
    Relative,
    /// Relative error with its sign: red too bright, blue too dark, full at 50 %.
    Signed,
}

/// `path=value`; the value may hold further equals signs.
fn parse_assignment(text: &str) -> Result<(String, String), String> {
    let (path, value) = text
        .split_once('=')
        .ok_or("expected PATH=VALUE, such as film.width=640")?;
    let (path, value) = (path.trim(), value.trim());
    if path.is_empty() {
        return Err("the path before `=` is missing".into());
    }
    if value.is_empty() {
        return Err(format!("the value after `{path}=` is missing"));
    }
    Ok((path.to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_of_the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn an_assignment_splits_at_its_first_equals_sign() {
        let pair = |a: &str, b: &str| Ok((a.to_owned(), b.to_owned()));
        assert_eq!(parse_assignment("a.b = 3"), pair("a.b", "3"));
        assert_eq!(parse_assignment("a=\"x=y\""), pair("a", "\"x=y\""));
        assert!(parse_assignment("a.b").is_err());
        assert!(parse_assignment("=3").is_err());
        assert!(parse_assignment("a=").is_err());
    }
}
