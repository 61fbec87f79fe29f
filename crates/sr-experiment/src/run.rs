//! The runner: references, a warm-up, the runs in turns; what is done is on the disk after each.

use crate::folder::{CSV, Folder, JSON, PAGE, SHEET};
use crate::host::Host;
use crate::measure::{self, ErrorLog, LogPoint};
use crate::metric::Metric;
use crate::plan::Plan;
use crate::reference::{Missing, Reference, references};
use crate::results::Results;
use crate::units::three_digits;
use crate::{html, session, sheet, words};
use sr_film::{DisplayImage, ImageError, write_atomically, write_png};
use sr_pipeline::settings::{AdaptiveSettings, SamplerSettings};
use sr_pipeline::{Developed, OutputRequest, Pipeline, StageSeconds, StopReason};
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

/// A run that is done.
#[derive(Clone, Debug)]
pub struct Done {
    /// Its number in the plan.
    pub run: usize,
    /// The seed that it had.
    pub seed: u64,
    /// Log points, the end last.
    pub log: Vec<LogPoint>,
    /// Seconds by stage.
    pub seconds: StageSeconds,
    /// What ended it.
    pub stop: StopReason,
    /// Its picture's configuration.
    pub config: String,
    /// Short name of the configuration.
    pub config_hash: String,
}

/// A run that failed.
#[derive(Clone, Debug)]
pub struct Failed {
    /// Its number in the plan.
    pub run: usize,
    /// Why.
    pub cause: String,
}

/// What an experiment came to.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Runs that are done, in the order of the plan.
    pub done: Vec<Done>,
    /// Runs that failed.
    pub failed: Vec<Failed>,
    /// Somebody asked for an end before the end.
    pub interrupted: bool,
    /// The reference of each point.
    pub references: Vec<Option<Arc<Reference>>>,
    /// What a reader must know beside the numbers.
    pub warnings: Vec<String>,
}

/// Runs everything and writes pictures, rows, sheet and page.
///
/// A run that fails is told and leaves the others alone.
///
/// # Errors
/// When the folder refuses files, or a reference fails.
pub fn run(plan: &Plan, folder: &Folder, host: &dyn Host) -> Result<Outcome, String> {
    folder.make()?;
    let mut outcome = Outcome::default();
    // From here on the folder is known as an experiment's.
    write_rows(plan, &outcome, folder)?;
    match references(plan, folder, host) {
        Ok(references) => outcome.references = references,
        Err(Missing::Stopped) => {
            outcome.interrupted = true;
            return Ok(outcome);
        }
        Err(Missing::Failed(cause)) => return Err(cause),
    }
    warm_up(plan, host);
    for number in 0..plan.runs.len() {
        if host.stopped() {
            outcome.interrupted = true;
            break;
        }
        match one(plan, number, &outcome, folder, host) {
            Ok(Some(done)) => {
                outcome.warnings.extend(distrust(plan, &done, &outcome));
                host.say(&words::done(plan, &done));
                outcome.done.push(done);
                write_rows(plan, &outcome, folder)?;
            }
            Ok(None) => outcome.interrupted = true,
            Err(cause) => {
                host.warn(&format!("{}: {cause}", words::run(plan, number)));
                outcome.failed.push(Failed { run: number, cause });
            }
        }
    }
    for warning in &outcome.warnings {
        host.warn(warning);
    }
    write_rows(plan, &outcome, folder)?;
    write_pages(plan, &outcome, folder)?;
    Ok(outcome)
}

/// The first render of a process also loads code and wakes the machine's clock.
fn warm_up(plan: &Plan, host: &dyn Host) {
    let (Some(point), seed) = (plan.points.first(), None) else {
        return;
    };
    let changes = point.changes(&plan.experiment, seed);
    if let Ok(mut pipeline) = session::open(&plan.experiment, changes, host) {
        // If it fails, so will the run, which is told.
        let _ = session::probe(&mut pipeline);
    }
}

/// One run; `None` when it was interrupted, which leaves nothing of it.
fn one(
    plan: &Plan,
    number: usize,
    outcome: &Outcome,
    folder: &Folder,
    host: &dyn Host,
) -> Result<Option<Done>, String> {
    let run = &plan.runs[number];
    let changes = plan.points[run.point].changes(&plan.experiment, run.seed);
    let mut pipeline = session::open(&plan.experiment, changes, host)?;
    measure::install(&mut pipeline, outcome.references[run.point].clone());
    let adapts = pipeline.world.resource::<AdaptiveSettings>().is_on();
    pipeline.world.insert_resource(OutputRequest {
        exr: Some(folder.run(&run.id, ".exr")),
        png: Some(folder.run(&run.id, ".png")),
        rate: adapts.then(|| folder.run(&run.id, "_rate.png")),
    });
    let stop = session::render(&mut pipeline, &words::run(plan, number), host);
    let stop = stop.map_err(|e| host.explain(e))?;
    if stop == StopReason::Asked {
        return Ok(None);
    }
    folder.clear_further_pictures(&run.id);
    pipeline.post().map_err(|e| host.explain(e))?;
    if let Some(crop) = plan.experiment.show.crop {
        write_crop(&pipeline, crop, &folder.run(&run.id, "_crop.png"))?;
    }
    Ok(Some(collect(&mut pipeline, number, stop)))
}

fn collect(pipeline: &mut Pipeline, run: usize, stop: StopReason) -> Done {
    let world = &mut pipeline.world;
    let log = std::mem::take(&mut world.resource_mut::<ErrorLog>().points);
    let config = sr_io::resolved_config(world);
    Done {
        run,
        seed: world.resource::<SamplerSettings>().seed,
        log,
        seconds: *world.resource::<StageSeconds>(),
        stop,
        config_hash: sr_io::config_hash(&config),
        config,
    }
}

fn write_crop(pipeline: &Pipeline, crop: [u32; 4], path: &Path) -> Result<(), String> {
    let display = &pipeline.world.resource::<Developed>().display;
    write_png(path, &cut(display, crop)).map_err(|e| e.to_string())
}

/// The part x0, y0, x1, y1 of a picture, which lies inside of it.
fn cut(image: &DisplayImage, [x0, y0, x1, y1]: [u32; 4]) -> DisplayImage {
    let rows = (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y)));
    let pixel = |(x, y): (u32, u32)| image.pixels[y as usize * image.width as usize + x as usize];
    DisplayImage {
        width: x1 - x0,
        height: y1 - y0,
        pixels: rows.map(pixel).collect(),
    }
}

/// A reference with half of what was measured is no reference.
const TOO_MUCH: f64 = 0.5;

/// Words for a run whose error is largely its reference's.
fn distrust(plan: &Plan, done: &Done, outcome: &Outcome) -> Option<String> {
    let reference = outcome.references[plan.runs[done.run].point].as_ref()?;
    let (own, measured) = (reference.facts.relmse?, done.log.last()?.relmse?);
    (own > TOO_MUCH * measured).then(|| {
        format!(
            "{}: the reference is not good enough: of the relMSE of {}, {} is the reference's own; \
             give it more samples",
            words::run(plan, done.run),
            three_digits(measured),
            three_digits(own),
        )
    })
}

fn write_rows(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Result<(), String> {
    let results = Results::new(plan, outcome, folder);
    write_text(&folder.file(JSON), &results.json()?)?;
    write_text(&folder.file(CSV), &results.csv())
}

fn write_pages(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Result<(), String> {
    let sheet = sheet::draw(plan, outcome, folder)?;
    write_png(folder.file(SHEET), &sheet).map_err(|e| e.to_string())?;
    write_text(&folder.file(PAGE), &html::page(plan, outcome, folder)?)
}

fn write_text(path: &Path, text: &str) -> Result<(), String> {
    let written = write_atomically(path, |file| {
        file.write_all(text.as_bytes())
            .map_err(|source| ImageError::Io {
                path: path.to_owned(),
                source,
            })
    });
    written.map_err(|e| e.to_string())
}

impl Outcome {
    /// The last log point of each run of a point that is done.
    pub fn ends<'a>(&'a self, plan: &'a Plan, point: usize) -> impl Iterator<Item = &'a LogPoint> {
        let of_point = self
            .done
            .iter()
            .filter(move |d| plan.runs[d.run].point == point);
        of_point.filter_map(|d| d.log.last())
    }

    /// A metric at the end of each run of a point.
    pub fn errors(&self, plan: &Plan, point: usize, metric: Metric) -> Vec<f64> {
        self.ends(plan, point)
            .filter_map(|l| l.metric(metric))
            .collect()
    }

    /// The run whose picture stands for a point: that of the first seed that is done.
    pub fn shown(&self, plan: &Plan, point: usize) -> Option<&Done> {
        self.done.iter().find(|d| plan.runs[d.run].point == point)
    }
}
