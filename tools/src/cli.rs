//! The command line of `steradian-tools`; the only module that prints.
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "this is the command line"
)]

use crate::convert::{
    CameraMode, Error, Framing, NormalsMode, Options, Report, View, convert_file,
};
use crate::envmap_debug::{self, EnvmapDebugArgs};
use crate::generate::{self, Generate, generate};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Make scenes for Steradian.
#[derive(Parser)]
#[command(name = "steradian-tools", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Convert a COLLADA file to DIR/<stem>.glb and DIR/<stem>.scene.ron.
    Convert(ConvertArgs),
    /// Make something from numbers alone.
    #[command(subcommand)]
    Generate(Generate),
    /// Draw how an environment map is sampled: the density, with samples over it.
    EnvmapDebug(EnvmapDebugArgs),
}

#[derive(Args)]
struct ConvertArgs {
    /// The COLLADA file (.dae).
    scene: PathBuf,
    /// Folder for the results; made if need be.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Camera as the file has it, or framed as the viewer of the classic assignment does. Default:
    /// course for files with that assignment's blocks, else file.
    #[arg(long, value_name = "HOW")]
    camera: Option<CameraArg>,
    /// Size of the picture that --camera course frames for.
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [480, 360])]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=65536))]
    course_size: Vec<u32>,
    /// Normals of the file, or computed ones. Default: smooth with --camera course, else file.
    #[arg(long, value_name = "WHICH")]
    normals: Option<NormalsArg>,
    /// Add an environment map, mapped (and mirrored) as in the classic assignment.
    #[arg(long, value_name = "MAP.EXR")]
    environment: Option<PathBuf>,
    /// Pass over faults in the file with a warning.
    #[arg(long)]
    lenient: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum CameraArg {
    File,
    Course,
}

#[derive(Clone, Copy, ValueEnum)]
enum NormalsArg {
    File,
    Smooth,
}

/// Run the program: exit status 0 done, 1 the work failed, 2 bad usage or bad input.
pub fn main() -> ExitCode {
    match Cli::parse().command {
        Command::Convert(args) => convert(&args),
        Command::Generate(what) => make(&what),
        Command::EnvmapDebug(args) => debug_map(&args),
    }
}

fn debug_map(args: &EnvmapDebugArgs) -> ExitCode {
    match envmap_debug::write(args) {
        Ok(told) => {
            told.iter().for_each(|line| println!("{line}"));
            ExitCode::SUCCESS
        }
        Err(envmap_debug::Error::Map(why)) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
        Err(envmap_debug::Error::Write(why)) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}

fn make(what: &Generate) -> ExitCode {
    match generate(what) {
        Ok(made) => {
            for line in &made.summary {
                println!("{line}");
            }
            for path in &made.written {
                println!("wrote {}", path.display());
            }
            ExitCode::SUCCESS
        }
        Err(e) => {
            eprintln!("error: {e}");
            match e {
                generate::Error::Usage(_) => ExitCode::from(2),
                generate::Error::Write { .. } => ExitCode::FAILURE,
            }
        }
    }
}

fn convert(args: &ConvertArgs) -> ExitCode {
    let environment = match &args.environment {
        None => None,
        Some(map) => match relative_to(map, &args.output) {
            Ok(path) => Some(path),
            Err(e) => {
                eprintln!("error: {}: {e}", map.display());
                return ExitCode::from(2);
            }
        },
    };
    let options = Options {
        camera: args.camera.map(|c| match c {
            CameraArg::File => CameraMode::File,
            CameraArg::Course => CameraMode::Course,
        }),
        // clap has made sure that there are two.
        course_size: (args.course_size[0], args.course_size[1]),
        normals: args.normals.map(|n| match n {
            NormalsArg::File => NormalsMode::File,
            NormalsArg::Smooth => NormalsMode::Smooth,
        }),
        environment,
        lenient: args.lenient,
    };
    match convert_file(&args.scene, &args.output, &options) {
        Ok((report, written)) => {
            print(&args.scene, &report);
            for path in written {
                println!("wrote {}", path.display());
            }
            ExitCode::SUCCESS
        }
        Err(e) => {
            tell(&e);
            match e {
                Error::Io { reading: false, .. } => ExitCode::FAILURE,
                _ => ExitCode::from(2),
            }
        }
    }
}

fn tell(error: &Error) {
    let Error::Invalid { file, problems } = error else {
        eprintln!("error: {error}");
        return;
    };
    for p in problems {
        eprintln!("error: {}:{p}\n  hint: {}", file.display(), p.hint);
    }
    let n = problems.len();
    let plural = if n == 1 { "" } else { "s" };
    eprintln!("{n} problem{plural}; nothing was written");
}

fn print(input: &Path, report: &Report) {
    for w in &report.warnings {
        eprintln!("warning: {}:{w}: {}", input.display(), w.hint);
    }
    println!("{}", input.display());
    for line in &report.summary {
        println!("  {line}");
    }
    let mark = |mode| {
        if mode == report.camera { " (used)" } else { "" }
    };
    let course = match &report.course_framing {
        Ok(framing) => describe(framing),
        Err(why) => format!("none: {why}"),
    };
    let file = match &report.file_framing {
        Some(framing) => describe(framing),
        None => "none: no camera, or its matrix gives no direction".to_owned(),
    };
    let course_mark = report
        .course_framing
        .as_ref()
        .map_or("", |_| mark(CameraMode::Course));
    let file_mark = report
        .file_framing
        .as_ref()
        .map_or("", |_| mark(CameraMode::File));
    println!("  camera course{course_mark}: {course}");
    println!("  camera file{file_mark}: {file}");
    if !report.notes.is_empty() {
        println!("  dropped or approximated:");
    }
    for note in &report.notes {
        println!("    {note}");
    }
}

fn describe(framing: &Framing) -> String {
    let view = match framing.view {
        View::Hfov(x) => format!("hfov {x:.6} deg"),
        View::Vfov(y) => format!("vfov {y:.6} deg"),
        View::Width(w) => format!("width {w:.6} m"),
        View::Height(h) => format!("height {h:.6} m"),
    };
    let point = |p: glam::DVec3| {
        // Adding zero takes the sign off negative zeros.
        let [x, y, z] = p.to_array().map(|x| (x * 1e6).round() / 1e6 + 0.0);
        format!("({x}, {y}, {z})")
    };
    let (w, h) = framing.film;
    format!(
        "from {} to {} up {}, {view}, for {w} x {h}",
        point(framing.from),
        point(framing.to),
        point(framing.up),
    )
}

/// How to name a file in a scene file of the folder `dir`, which need not exist yet.
fn relative_to(file: &Path, dir: &Path) -> std::io::Result<String> {
    let file = file.canonicalize()?;
    let dir = std::path::absolute(dir)?;
    // The part of the folder that exists may go through links.
    let existing = dir.ancestors().find_map(|a| {
        let rest = dir.strip_prefix(a).ok()?;
        Some(a.canonicalize().ok()?.join(rest))
    });
    let dir = existing.unwrap_or(dir);
    let shared = file
        .components()
        .zip(dir.components())
        .take_while(|(a, b)| a == b)
        .count();
    let mut out = PathBuf::new();
    for _ in dir.components().skip(shared) {
        out.push("..");
    }
    out.extend(file.components().skip(shared));
    Ok(out.to_string_lossy().replace('\\', "/"))
}
