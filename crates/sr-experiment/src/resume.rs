//! Going on with an experiment that was ended, by Ctrl-C or by force.
//!
//! `results.json` is written anew after each run, so it tells which are done. They stay as they are if the
//! experiment would make them the same way again: their configuration must be the same text, and the
//! first sample a pixel the same bits, which also tells of files and renderers that have changed.

use crate::folder::{Folder, JSON};
use crate::host::Host;
use crate::machine::Machine;
use crate::measure::LogPoint;
use crate::plan::Plan;
use crate::results::{SecondsJson, VERSION, stop_name};
use crate::run::Done;
use crate::session;
use serde::Deserialize;
use similar::TextDiff;
use sr_pipeline::{StageSeconds, StopReason};
use std::collections::HashSet;

/// What ends a run that is done.
const STOPS: [StopReason; 4] = [
    StopReason::Samples,
    StopReason::Seconds,
    StopReason::TargetError,
    StopReason::Converged,
];

/// What is read of `results.json`.
#[derive(Deserialize)]
struct Record {
    program_version: String,
    machine: Option<Machine>,
    runs: Vec<RunRecord>,
    rows: Vec<RowRecord>,
}

#[derive(Deserialize)]
struct RunRecord {
    id: String,
    seconds: SecondsJson,
    stop: String,
    over_seconds: Option<f64>,
    first_sample: String,
    config_hash: String,
    config: String,
}

#[derive(Deserialize)]
struct RowRecord {
    run: String,
    seed: u64,
    #[serde(flatten)]
    log: LogPoint,
}

/// The runs of a plan that the folder has, in order. One whose picture is gone is not done.
///
/// # Errors
/// When the folder holds something else: in words, with what differs.
pub fn resume(plan: &Plan, folder: &Folder, host: &dyn Host) -> Result<Vec<Done>, String> {
    let Some(record) = read(folder)? else {
        return Ok(Vec::new());
    };
    let here = host.machine();
    if let Some(there) = record
        .machine
        .filter(|m| *m != here && !record.runs.is_empty())
    {
        let cause =
            format!("its seconds are those of another machine\n  {there}; this one is\n  {here}");
        return Err(refusal(folder, &cause));
    }
    let mut done = Vec::new();
    for run in &record.runs {
        let id = &run.id;
        let Some(number) = plan.runs.iter().position(|r| r.id == *id) else {
            return Err(refusal(
                folder,
                &format!("it has the run `{id}`, which the experiment does not"),
            ));
        };
        if folder.run(id, ".exr").is_file() {
            done.push((number, run));
        }
    }
    done.sort_by_key(|(number, _)| *number);
    let mut known = HashSet::new();
    let mut resumed = Vec::new();
    for (number, run) in done {
        // Runs of a point differ in their seeds only.
        if known.insert(plan.runs[number].point) {
            check(plan, number, run, folder, host)?;
        }
        let rows = record.rows.iter().filter(|r| r.run == run.id);
        resumed.push(run.done(number, &rows.collect::<Vec<_>>())?);
    }
    host.say(&format!(
        "{} of {} runs are done already",
        resumed.len(),
        plan.runs.len()
    ));
    Ok(resumed)
}

/// `None` when nothing was begun.
fn read(folder: &Folder) -> Result<Option<Record>, String> {
    let path = folder.file(JSON);
    if !path.exists() {
        return Ok(None);
    }
    let text = std::fs::read_to_string(&path);
    let text = text.map_err(|e| format!("cannot read {}: {e}", path.display()))?;
    let value: serde_json::Value =
        serde_json::from_str(&text).map_err(|e| unreadable(folder, &e))?;
    if value["version"] != VERSION {
        let cause = format!(
            "its {JSON} has version {}, this program writes {VERSION}",
            value["version"]
        );
        return Err(refusal(folder, &cause));
    }
    let record: Record = serde_json::from_value(value).map_err(|e| unreadable(folder, &e))?;
    let ours = env!("CARGO_PKG_VERSION");
    if record.program_version != ours && !record.runs.is_empty() {
        let theirs = &record.program_version;
        let cause = format!("it was begun by Steradian {theirs}, this is {ours}");
        return Err(refusal(folder, &cause));
    }
    Ok(Some(record))
}

fn unreadable(folder: &Folder, error: &serde_json::Error) -> String {
    refusal(folder, &format!("its {JSON} cannot be understood: {error}"))
}

fn refusal(folder: &Folder, cause: &str) -> String {
    format!(
        "cannot resume `{}`: {cause}\n  run without --resume to begin anew, or name a new folder",
        folder.path().display()
    )
}

/// Whether a run would be the same again.
fn check(
    plan: &Plan,
    number: usize,
    run: &RunRecord,
    folder: &Folder,
    host: &dyn Host,
) -> Result<(), String> {
    let wanted = &plan.runs[number];
    let changes = plan.points[wanted.point].changes(&plan.experiment, wanted.seed);
    let mut pipeline = session::open(&plan.experiment, changes, host)?;
    let config = sr_io::resolved_config(&pipeline.world);
    if config != run.config {
        let difference = difference(&run.config, &config);
        let id = &run.id;
        let cause = format!("the configuration of `{id}` has changed\n{difference}");
        return Err(refusal(folder, &cause));
    }
    let probe = session::probe(&mut pipeline).map_err(|e| host.explain(e))?;
    if format!("{:016x}", probe.hash) != run.first_sample {
        let cause = format!(
            "`{}` has the same configuration, but its first sample a pixel comes out differently: a \
             file of the scene, the program or the machine has changed",
            run.id
        );
        return Err(refusal(folder, &cause));
    }
    Ok(())
}

/// Lines that are gone and lines that are new, with one around them.
fn difference(old: &str, new: &str) -> String {
    let diff = TextDiff::from_lines(old, new);
    let text = diff
        .unified_diff()
        .context_radius(1)
        .header("done", "wanted")
        .to_string();
    text.trim_end().to_owned()
}

impl RunRecord {
    fn done(&self, number: usize, rows: &[&RowRecord]) -> Result<Done, String> {
        let bad = |what: &str| format!("{JSON}: the {what} of `{}` cannot be understood", self.id);
        let stop = STOPS.into_iter().find(|s| stop_name(*s) == self.stop);
        let first = rows.first().ok_or_else(|| bad("rows"))?;
        Ok(Done {
            run: number,
            seed: first.seed,
            log: rows.iter().map(|r| r.log.clone()).collect(),
            seconds: StageSeconds {
                load: self.seconds.load,
                compile: self.seconds.compile,
                integrate: self.seconds.integrate,
                measure: self.seconds.measure,
                post: self.seconds.post,
            },
            stop: stop.ok_or_else(|| bad("stop"))?,
            over_seconds: self.over_seconds,
            first_sample: u64::from_str_radix(&self.first_sample, 16)
                .map_err(|_| bad("first_sample"))?,
            config: self.config.clone(),
            config_hash: self.config_hash.clone(),
        })
    }
}
