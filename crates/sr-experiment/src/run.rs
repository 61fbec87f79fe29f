//! The runner: references, a warm-up, the runs in turns; what is done is on the disk after each.

use crate::analysis::{Analysis, analyse};
use crate::folder::{CSV, Folder, JSON, SHEET};
use crate::host::Host;
use crate::machine::Machine;
use crate::measure::{self, ErrorLog, LogPoint};
use crate::metric::Metric;
use crate::pictures::cut;
use crate::plan::Plan;
use crate::reference::{Attempt, Reference, references};
use crate::results::Results;
use crate::units::three_digits;
use crate::{report, session, sheet, words};
use sr_film::{ImageError, write_atomically, write_png};
use sr_pipeline::settings::{AdaptiveSettings, SamplerSettings};
use sr_pipeline::{Developed, OutputRequest, Pipeline, RenderReport, StageSeconds, StopReason};
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
    /// Seconds beyond those of its budget, less than 0 where the next pass would not have fitted;
    /// `None` where time neither ended it nor was overrun.
    pub over_seconds: Option<f64>,
    /// Short name of its first sample a pixel: it tells whether it would come out the same again.
    pub first_sample: u64,
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
    /// The reference of each point, where there is to be one, or why there is none.
    pub references: Vec<Option<Attempt>>,
    /// What the runs say together; empty until all are done.
    pub analysis: Analysis,
    /// Where it was made; unset until it begins.
    pub machine: Option<Machine>,
    /// The command line.
    pub command: String,
    /// What a reader must know beside the numbers.
    pub warnings: Vec<String>,
}

/// Runs everything but what is `done` already, and writes pictures, rows, sheet and page.
///
/// A run or a reference that fails is told and leaves the others alone, and so is a file that cannot be written.
///
/// # Errors
/// When the folder or what is said of all runs cannot be written.
pub fn run(
    plan: &Plan,
    folder: &Folder,
    host: &dyn Host,
    done: Vec<Done>,
) -> Result<Outcome, String> {
    let mut outcome = Outcome {
        done,
        machine: Some(host.machine()),
        command: host.command_line().to_owned(),
        ..Outcome::default()
    };
    folder.make()?;
    // From here on the folder is known as an experiment's.
    write_rows(plan, &outcome, folder)?;
    let Some(references) = references(plan, folder, host) else {
        outcome.interrupted = true;
        return Ok(outcome);
    };
    outcome.references = references;
    for number in 0..plan.runs.len() {
        if host.stopped() {
            outcome.interrupted = true;
            break;
        }
        if outcome.done.iter().any(|d| d.run == number) {
            continue;
        }
        match one(plan, number, &outcome, folder, host) {
            Ok(Some(done)) => {
                host.say(&words::done(plan, &done));
                outcome.take(done);
                // If this fails, so may it at the end, where it is told.
                let _ = write_rows(plan, &outcome, folder);
            }
            Ok(None) => outcome.interrupted = true,
            Err(cause) => {
                host.warn(&format!("{}: {cause}", words::run(plan, number)));
                outcome.failed.push(Failed { run: number, cause });
            }
        }
    }
    outcome.warnings = outcome
        .done
        .iter()
        .filter_map(|d| distrust(plan, d, &outcome))
        .collect();
    outcome.analysis = analyse(plan, &outcome, folder);
    for warning in &outcome.warnings {
        host.warn(warning);
    }
    write_rows(plan, &outcome, folder)?;
    write_pages(plan, &outcome, folder)?;
    Ok(outcome)
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
    let reference = match &outcome.references[run.point] {
        Some(Err(cause)) => return Err(format!("it has no reference: {cause}")),
        Some(Ok(reference)) => Some(reference.clone()),
        None => None,
    };
    let changes = plan.points[run.point].changes(&plan.experiment, run.seed);
    let mut pipeline = session::open(&plan.experiment, changes, host)?;
    // It loads code and wakes the machine's clock besides.
    let probe = session::probe(&mut pipeline).map_err(|e| host.explain(e))?;
    measure::install(&mut pipeline, reference, &plan.experiment.log_seconds);
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
    Ok(Some(collect(&mut pipeline, number, stop, probe.hash)))
}

fn collect(pipeline: &mut Pipeline, run: usize, stop: StopReason, first_sample: u64) -> Done {
    let world = &mut pipeline.world;
    let log = std::mem::take(&mut world.resource_mut::<ErrorLog>().points);
    let config = sr_io::resolved_config(world);
    Done {
        run,
        seed: world.resource::<SamplerSettings>().seed,
        log,
        seconds: *world.resource::<StageSeconds>(),
        stop,
        over_seconds: world.resource::<RenderReport>().over_budget,
        first_sample,
        config_hash: sr_io::config_hash(&config),
        config,
    }
}

fn write_crop(pipeline: &Pipeline, crop: [u32; 4], path: &Path) -> Result<(), String> {
    let display = &pipeline.world.resource::<Developed>().display;
    write_png(path, &cut(display, crop)).map_err(|e| e.to_string())
}

/// A reference with half of what was measured is no reference.
const TOO_MUCH: f64 = 0.5;

/// Words for a run whose error is largely its reference's.
fn distrust(plan: &Plan, done: &Done, outcome: &Outcome) -> Option<String> {
    let reference = outcome.reference(plan.runs[done.run].point)?;
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
    report::write(plan, outcome, folder)
}

/// Writes a text file, whole or not at all.
///
/// # Errors
/// A failure of the file system, in words that name the file.
pub fn write_text(path: &Path, text: &str) -> Result<(), String> {
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
    /// The reference of a point, if there is one.
    pub fn reference(&self, point: usize) -> Option<&Arc<Reference>> {
        self.references.get(point)?.as_ref()?.as_ref().ok()
    }

    /// In the order of the plan.
    fn take(&mut self, done: Done) {
        let at = self.done.partition_point(|d| d.run < done.run);
        self.done.insert(at, done);
    }

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
