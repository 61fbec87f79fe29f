//! `--convergence`: the error against time, a line at each log point. docs/convergence.md is the
//! contract; columns mean what those of `results.csv` of an experiment mean.

use crate::failure::Failure;
use sr_pipeline::bevy_ecs::{self, prelude::*};
use sr_pipeline::film_kernel::{ImageError, write_atomically};
use sr_pipeline::{
    Estimate, FilmResource, Measure, MeasureSet, Pipeline, RenderReport, StageSeconds, at_log_point,
};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Names and values of a line.
const COLUMNS: [&str; 11] = [
    "passes",
    "samples",
    "samples_mean",
    "samples_total",
    "seconds",
    "rays",
    "rejected",
    "error_source",
    "mse",
    "relmse",
    "relmse_estimate_std_error",
];

/// The file so far.
#[derive(Resource)]
struct Log {
    path: PathBuf,
    text: String,
    /// Why the last line could not be written.
    failure: Option<String>,
}

/// Lets a pipeline keep the log in a file.
pub fn install(pipeline: &mut Pipeline, path: &Path) {
    pipeline.world.insert_resource(Log {
        path: path.to_owned(),
        text: line(COLUMNS.map(str::to_owned)),
        failure: None,
    });
    let system = add_line.in_set(MeasureSet::Log).run_if(at_log_point);
    pipeline.add_systems(Measure, system);
}

/// Whether every line has come to the disk. A disk that is full costs the log, not the render.
pub fn finish(pipeline: &Pipeline) -> Result<(), Failure> {
    let log = pipeline.world.get_resource::<Log>();
    match log.and_then(|log| log.failure.clone()) {
        Some(failure) => Err(Failure::Work(failure)),
        None => Ok(()),
    }
}

/// Writes the whole file anew, so that a render that is killed leaves all lines but the next.
fn add_line(
    film: Res<'_, FilmResource>,
    report: Res<'_, RenderReport>,
    seconds: Res<'_, StageSeconds>,
    estimate: Res<'_, Estimate>,
    mut log: ResMut<'_, Log>,
) {
    let pixels = film.film.spec().sampled().pixel_count();
    let known = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
    let error = estimate.0;
    log.text += &line([
        report.passes.to_string(),
        report.samples_per_pixel.to_string(),
        (report.samples as f64 / pixels as f64).to_string(),
        report.samples.to_string(),
        seconds.integrate.to_string(),
        report.tiles.rays.total().to_string(),
        report.tiles.rejects.total().to_string(),
        match error {
            Some(_) => "estimate".into(),
            None => "none".into(),
        },
        known(error.map(|e| e.mse)),
        known(error.map(|e| e.relmse)),
        known(error.and_then(|e| e.relmse_std_error)),
    ]);
    let written = write_atomically(&log.path, |file| {
        file.write_all(log.text.as_bytes())
            .map_err(|source| ImageError::Io {
                path: log.path.clone(),
                source,
            })
    });
    log.failure = written.err().map(|e| e.to_string());
}

/// A line after RFC 4180; no cell has a comma or quotes.
fn line(cells: [String; COLUMNS.len()]) -> String {
    cells.join(",") + "\r\n"
}
