//! The closing lines of a render.

use super::output::Outputs;
use crate::console::Console;
use crate::replay::Replays;
use crate::units;
use sr_pipeline::film_kernel::{AdaptiveReport, ClampReport, ErrorEstimate, WriteReport};
use sr_pipeline::replay::SampleId;
use sr_pipeline::{
    Developed, Estimate, FilmResource, Pipeline, RenderReport, RenderScene, SealedScene,
    StageSeconds, StopReason,
};

/// Prints what was done, what was wrong with it and where it is.
pub fn print(
    pipeline: &Pipeline,
    stop: StopReason,
    outputs: &Outputs,
    replays: &Replays<'_>,
    console: &Console,
) {
    let world = &pipeline.world;
    let report = world.resource::<RenderReport>();
    let scene: &RenderScene = world.resource::<SealedScene>();
    for line in rejected(report, scene, replays) {
        console.note(line);
    }
    let written = world.get_resource::<Developed>().and_then(|d| d.written);
    for line in written.iter().flat_map(out_of_range) {
        console.note(line);
    }
    let seconds = *world.resource::<StageSeconds>();
    let error = world.resource::<Estimate>().0;
    let film = &world.resource::<FilmResource>().film;
    let adaptive = film.adaptive_report();
    console.say(closing_line(
        report,
        seconds,
        stop,
        error.as_ref(),
        adaptive,
    ));
    if let Some(adaptive) = adaptive {
        console.say(adaptive_line(&adaptive));
    }
    if let (Some(limit), Some(clamp)) = (film.spec().clamp, film.clamp_report()) {
        console.say(clamp_line(limit, &clamp, report));
    }
    let files: Vec<String> = outputs.files().map(|f| f.display().to_string()).collect();
    console.say(format_args!("wrote {}", files.join(", ")));
}

/// What half precision did to values that it has no place for.
fn out_of_range(written: &WriteReport) -> Vec<String> {
    let line = |n, what| {
        let values = units::counted(n, "value");
        format!("warning: {values} {what} in half precision; `film.precision=Float` keeps them")
    };
    let large = (written.saturated, "beyond ±65504 became ±65504");
    let small = (written.vanished, "below 3·10⁻⁸ became 0");
    let lost = [large, small].into_iter().filter(|(n, _)| *n > 0);
    lost.map(|(n, what)| line(n, what)).collect()
}

fn closing_line(
    report: &RenderReport,
    seconds: StageSeconds,
    stop: StopReason,
    error: Option<&ErrorEstimate>,
    adaptive: Option<AdaptiveReport>,
) -> String {
    let rays = report.tiles.rays.total() as f64 / seconds.integrate;
    let mut parts = vec![
        match adaptive {
            None => {
                let samples = units::counted(report.samples_per_pixel, "sample");
                format!("{samples} a pixel")
            }
            Some(adaptive) => {
                let mean = adaptive.taken as f64 / adaptive.pixels as f64;
                format!("{mean:.1} samples a pixel on average")
            }
        },
        units::duration(seconds.integrate),
        format!("{}rays/s", units::scaled(rays)),
    ];
    parts.push(match error {
        Some(error) => units::error(error),
        None => "too few samples to estimate the error".into(),
    });
    parts.push(format!("{} of measuring", units::duration(seconds.measure)));
    let mut why = match stop {
        StopReason::Samples => Vec::new(),
        StopReason::Seconds | StopReason::TargetError | StopReason::Converged => {
            vec![stop.describe().to_owned()]
        }
        StopReason::Asked => vec!["interrupted: the picture has the samples so far".into()],
    };
    why.extend(report.over_budget.map(off_budget));
    if why.is_empty() {
        return parts.join(", ");
    }
    format!("{} ({})", parts.join(", "), why.join("; "))
}

/// What a time budget missed.
fn off_budget(over: f64) -> String {
    let side = if over > 0.0 { "over" } else { "short of" };
    format!("{} {side} the time budget", units::duration(over.abs()))
}

/// What adaptive sampling did.
fn adaptive_line(adaptive: &AdaptiveReport) -> String {
    let (fewest, most) = adaptive.range;
    let converged = adaptive.converged as f64 / adaptive.pixels as f64;
    format!(
        "adaptive: {} to {} a pixel, {} of the pixels reached the tolerance, {} of the samples \
         served decisions only",
        units::grouped(fewest),
        units::grouped(most),
        units::percent(converged),
        units::percent(adaptive.left_out()),
    )
}

/// What a clamp cost.
fn clamp_line(limit: f32, clamp: &ClampReport, report: &RenderReport) -> String {
    if clamp.clamped == 0 {
        return format!("clamp at {limit}: no sample was brighter, nothing is missing");
    }
    let share = clamp.clamped as f64 / report.samples.max(1) as f64;
    format!(
        "clamp at {limit}: {} ({} of all) cut down; the picture is biased, it lacks {} of its light",
        units::counted(clamp.clamped, "sample"),
        units::percent(share),
        units::percent(clamp.removed_share()),
    )
}

/// Lines about rejected samples; `--stats` has them all.
const MOST_KINDS: usize = 5;

/// A line for each cause, bounce and material, the most frequent first, and below it the command that
/// replays one of them.
fn rejected(report: &RenderReport, scene: &RenderScene, replays: &Replays<'_>) -> Vec<String> {
    let rejects = &report.tiles.rejects;
    if rejects.total() == 0 {
        return Vec::new();
    }
    let mut entries: Vec<_> = rejects.0.iter().collect();
    entries.sort_by_key(|(_, (count, _, _))| std::cmp::Reverse(*count));
    let share = rejects.total() as f64 / report.samples.max(1) as f64;
    let mut lines = vec![format!(
        "warning: {} rejected ({} of all):",
        units::counted(rejects.total(), "sample"),
        units::percent(share)
    )];
    let (shown, others) = entries.split_at(entries.len().min(MOST_KINDS));
    for &(key, &(count, [x, y], sample)) in shown {
        let material = key
            .material
            .map_or_else(String::new, |m| format!(" on `{}`", scene.material(m).name));
        lines.push(format!(
            "  {} {} after {}{material}, such as pixel {x},{y} sample {sample}",
            units::grouped(count),
            key.cause,
            units::counted(key.bounce.into(), "bounce"),
        ));
        let id = SampleId {
            pixel: [x, y],
            sample,
        };
        lines.extend(replays.command(id).map(|command| format!("    {command}")));
    }
    if !others.is_empty() {
        let more: u64 = others.iter().map(|(_, (count, _, _))| count).sum();
        lines.push(format!(
            "  {} after other bounces or on other materials; --stats lists them",
            units::grouped(more)
        ));
    }
    lines
}
