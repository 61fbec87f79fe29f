//! Rows of data: `results.csv` and `results.json`. docs/experiments.md is their contract; a change that
//! could break a reader raises [`VERSION`].

use crate::analysis::Analysis;
use crate::folder::Folder;
use crate::machine::Machine;
use crate::measure::{ErrorSource, LogPoint};
use crate::metric::Metric;
use crate::plan::Plan;
use crate::reference::ReferenceFacts;
use crate::run::{Done, Outcome};
use crate::stats::{CONFIDENCE, Mean, mean};
use serde::{Deserialize, Serialize};
use sr_film::RELMSE_OFFSET;
use sr_pipeline::StopReason;
use std::collections::BTreeMap;

/// Version of both formats.
pub const VERSION: u32 = 1;

/// Everything that an experiment tells.
#[derive(Serialize)]
pub(crate) struct Results<'a> {
    version: u32,
    program_version: &'static str,
    title: &'a str,
    note: &'a str,
    experiment: &'a str,
    command: &'a str,
    machine: Option<&'a Machine>,
    relmse_offset: f64,
    confidence: f64,
    axes: Vec<&'a str>,
    metrics: Vec<Metric>,
    complete: bool,
    warnings: &'a [String],
    runs: Vec<RunJson<'a>>,
    failed: Vec<FailedJson<'a>>,
    references: Vec<ReferenceJson<'a>>,
    summary: Vec<SummaryJson<'a>>,
    analysis: &'a Analysis,
    rows: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct RunJson<'a> {
    id: &'a str,
    exr: String,
    png: String,
    seconds: SecondsJson,
    stop: &'static str,
    over_seconds: Option<f64>,
    first_sample: String,
    config_hash: &'a str,
    config: &'a str,
}

/// Seconds by stage.
#[derive(Serialize, Deserialize)]
pub(crate) struct SecondsJson {
    pub load: f64,
    pub compile: f64,
    pub integrate: f64,
    pub measure: f64,
    pub post: f64,
}

#[derive(Serialize)]
struct FailedJson<'a> {
    id: &'a str,
    cause: &'a str,
}

#[derive(Serialize)]
struct ReferenceJson<'a> {
    #[serde(flatten)]
    facts: &'a ReferenceFacts,
    points: Vec<&'a str>,
}

#[derive(Serialize)]
struct SummaryJson<'a> {
    point: &'a str,
    method: Option<&'a str>,
    axes: BTreeMap<&'a str, &'a str>,
    seconds: Mean,
    errors: BTreeMap<&'static str, Mean>,
}

#[derive(Serialize)]
struct Row<'a> {
    run: &'a str,
    scene: &'a str,
    method: Option<&'a str>,
    axes: BTreeMap<&'a str, &'a str>,
    integrator: &'a str,
    seed: u64,
    last: bool,
    #[serde(flatten)]
    log: &'a LogPoint,
}

/// Columns of the CSV file after those of the axes.
const COLUMNS: [&str; 22] = [
    "integrator",
    "seed",
    "last",
    "passes",
    "samples",
    "samples_total",
    "seconds",
    "rays",
    "rejected",
    "error_source",
    "mse",
    "relmse",
    "relmse_trimmed",
    "mape",
    "smape",
    "flip",
    "mse_debiased",
    "relmse_debiased",
    "relmse_estimate",
    "relmse_estimate_std_error",
    "stop",
    "over_seconds",
];

impl<'a> Results<'a> {
    /// What is there so far.
    pub fn new(plan: &'a Plan, outcome: &'a Outcome, folder: &Folder) -> Self {
        let e = &plan.experiment;
        Self {
            version: VERSION,
            program_version: env!("CARGO_PKG_VERSION"),
            title: &e.title,
            note: &e.note,
            experiment: &e.text,
            command: &outcome.command,
            machine: outcome.machine.as_ref(),
            relmse_offset: RELMSE_OFFSET,
            confidence: CONFIDENCE,
            axes: e.axes.iter().map(|a| a.name.as_str()).collect(),
            metrics: e.metrics.clone(),
            complete: outcome.done.len() == plan.runs.len(),
            warnings: &outcome.warnings,
            runs: outcome
                .done
                .iter()
                .map(|d| run_json(plan, d, folder))
                .collect(),
            failed: outcome
                .failed
                .iter()
                .map(|f| FailedJson {
                    id: &plan.runs[f.run].id,
                    cause: &f.cause,
                })
                .collect(),
            references: references(plan, outcome),
            summary: (0..plan.points.len())
                .filter_map(|p| summary(plan, outcome, p))
                .collect(),
            analysis: &outcome.analysis,
            rows: outcome.done.iter().flat_map(|d| rows(plan, d)).collect(),
        }
    }

    /// As JSON.
    pub fn json(&self) -> Result<String, String> {
        let text = serde_json::to_string_pretty(self);
        text.map(|t| t + "\n")
            .map_err(|e| format!("cannot write JSON: {e}"))
    }

    /// As CSV after RFC 4180, with a first line of names; what is not known is empty.
    pub fn csv(&self) -> String {
        let mut names = vec!["run", "scene", "method"];
        names.extend(&self.axes);
        names.extend(COLUMNS);
        let mut text = line(names.iter().map(|n| (*n).to_owned()));
        for row in &self.rows {
            text += &line(self.cells(row));
        }
        text
    }

    fn cells(&self, row: &Row<'_>) -> impl Iterator<Item = String> {
        let run = self.runs.iter().find(|r| r.id == row.run);
        let mut cells = vec![
            row.run.to_owned(),
            row.scene.to_owned(),
            row.method.unwrap_or_default().to_owned(),
        ];
        let label = |axis: &&str| row.axes.get(axis).copied().unwrap_or_default().to_owned();
        cells.extend(self.axes.iter().map(label));
        let log = row.log;
        cells.extend([
            row.integrator.to_owned(),
            row.seed.to_string(),
            row.last.to_string(),
            log.passes.to_string(),
            log.samples.to_string(),
            log.samples_total.to_string(),
            log.seconds.to_string(),
            log.rays.to_string(),
            log.rejected.to_string(),
            match log.error_source {
                ErrorSource::Reference => "reference",
                ErrorSource::Estimate => "estimate",
                ErrorSource::None => "none",
            }
            .to_owned(),
        ]);
        let errors = [
            log.mse,
            log.relmse,
            log.relmse_trimmed,
            log.mape,
            log.smape,
            log.flip,
            log.mse_debiased,
            log.relmse_debiased,
            log.relmse_estimate,
            log.relmse_estimate_std_error,
        ];
        let number = |n: Option<f64>| n.map_or_else(String::new, |n| n.to_string());
        cells.extend(errors.map(number));
        cells.push(run.map_or("", |r| r.stop).to_owned());
        cells.push(number(run.and_then(|r| r.over_seconds)));
        cells.into_iter()
    }
}

/// Cells with commas, quotes or line ends are quoted.
pub(crate) fn line(cells: impl Iterator<Item = String>) -> String {
    let quoted = cells.map(|cell| {
        if cell.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell
        }
    });
    quoted.collect::<Vec<_>>().join(",") + "\r\n"
}

/// A reason as files name it.
pub(crate) const fn stop_name(stop: StopReason) -> &'static str {
    match stop {
        StopReason::Samples => "samples",
        StopReason::Seconds => "seconds",
        StopReason::TargetError => "target_error",
        StopReason::Converged => "converged",
        StopReason::Asked => "interrupted",
    }
}

fn run_json<'a>(plan: &'a Plan, done: &'a Done, folder: &Folder) -> RunJson<'a> {
    let id = &plan.runs[done.run].id;
    let file = |end| folder.relative(&folder.run(id, end));
    RunJson {
        id,
        exr: file(".exr"),
        png: file(".png"),
        seconds: SecondsJson {
            load: done.seconds.load,
            compile: done.seconds.compile,
            integrate: done.seconds.integrate,
            measure: done.seconds.measure,
            post: done.seconds.post,
        },
        stop: stop_name(done.stop),
        over_seconds: done.over_seconds,
        first_sample: format!("{:016x}", done.first_sample),
        config_hash: &done.config_hash,
        config: &done.config,
    }
}

fn rows<'a>(plan: &'a Plan, done: &'a Done) -> impl Iterator<Item = Row<'a>> {
    let run = &plan.runs[done.run];
    let facts = &plan.facts[run.point];
    done.log.iter().enumerate().map(move |(i, log)| Row {
        run: &run.id,
        scene: &facts.scene,
        method: method(plan, run.point),
        axes: axes(plan, run.point),
        integrator: &facts.integrator,
        seed: done.seed,
        last: i + 1 == done.log.len(),
        log,
    })
}

fn method(plan: &Plan, point: usize) -> Option<&str> {
    let number = plan.points[point].method?;
    Some(&plan.experiment.methods[number].label)
}

/// The label of each axis' value.
fn axes(plan: &Plan, point: usize) -> BTreeMap<&str, &str> {
    let values = &plan.points[point].settings;
    let axes = plan.experiment.axes.iter().zip(values);
    axes.map(|(axis, v)| (axis.name.as_str(), axis.settings[*v].label.as_str()))
        .collect()
}

fn references<'a>(plan: &'a Plan, outcome: &'a Outcome) -> Vec<ReferenceJson<'a>> {
    let mut all: Vec<ReferenceJson<'a>> = Vec::new();
    for point in 0..plan.points.len() {
        let Some(reference) = outcome.reference(point) else {
            continue;
        };
        let id = plan.points[point].id.as_str();
        match all
            .iter_mut()
            .find(|r| r.facts.file == reference.facts.file)
        {
            Some(known) => known.points.push(id),
            None => all.push(ReferenceJson {
                facts: &reference.facts,
                points: vec![id],
            }),
        }
    }
    all
}

/// Means over the seeds at the end of the runs.
fn summary<'a>(plan: &'a Plan, outcome: &Outcome, point: usize) -> Option<SummaryJson<'a>> {
    let seconds: Vec<f64> = outcome.ends(plan, point).map(|e| e.seconds).collect();
    let errors = Metric::ALL.into_iter().filter_map(|metric| {
        let mean = mean(&outcome.errors(plan, point, metric))?;
        Some((metric.name(), mean))
    });
    Some(SummaryJson {
        point: &plan.points[point].id,
        method: method(plan, point),
        axes: axes(plan, point),
        seconds: mean(&seconds)?,
        errors: errors.collect(),
    })
}
