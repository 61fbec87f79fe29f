//! What an experiment will cost, told before it starts.

use crate::document::Experiment;
use crate::host::Host;
use crate::plan::{Facts, Plan};
use crate::session;
use sr_io::Change;
use std::collections::HashMap;
use std::time::Instant;

/// Seconds that finding out how long runs take may take, one run beyond it aside.
const CALIBRATION_SECONDS: f64 = 10.0;

/// What a run is expected to cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Samples of all pixels, when the budget tells.
    pub samples: Option<u64>,
    /// Seconds of integration, when they are known.
    pub seconds: Option<f64>,
    /// Bytes of its files, at most.
    pub bytes: u64,
}

/// The costs of all runs, and of all references that are to be rendered.
#[derive(Clone, Debug, Default)]
pub struct Costs {
    /// In the order of the runs.
    pub runs: Vec<Cost>,
    /// In the order of the references.
    pub references: Vec<Cost>,
    /// Bytes of the report with its plots and crops, about.
    pub report: u64,
}

impl Costs {
    /// Seconds of everything, when they are known of everything.
    pub fn seconds(&self) -> Option<f64> {
        let all = self.runs.iter().chain(&self.references);
        all.map(|c| c.seconds).sum()
    }

    /// Bytes of everything.
    pub fn bytes(&self) -> u64 {
        let all = self.runs.iter().chain(&self.references);
        all.map(|c| c.bytes).sum::<u64>() + self.report
    }
}

/// Renders one sample a pixel of each kind of run, for some seconds at most, and expects others to
/// cost as much a sample.
pub fn estimate(plan: &Plan, host: &dyn Host) -> Costs {
    let mut clock = Calibration {
        experiment: &plan.experiment,
        host,
        start: Instant::now(),
        known: HashMap::new(),
    };
    let runs = plan.runs.iter().map(|run| {
        let point = &plan.points[run.point];
        let changes = || point.changes(&plan.experiment, run.seed);
        clock.cost(&plan.facts[run.point], changes)
    });
    let runs = runs.collect();
    let references = plan.references.iter().map(|r| {
        let changes = || {
            let changes = plan.points[r.point].reference_changes(&plan.experiment);
            changes.unwrap_or_default()
        };
        clock.cost(&r.facts, changes)
    });
    let references = references.collect();
    Costs {
        runs,
        references,
        report: report_bytes(plan),
    }
}

/// Bytes of one plot: a picture for papers, and its SVG twice, as a file and in the page.
const PLOT_BYTES: u64 = 200 << 10;

/// Bytes a pixel in the page: colours, FLIP, samples and seconds as `f32`, in base 64, if nothing could
/// be packed, and a map of differences.
const PAGE_BYTES: u64 = 6 * 4 * 4 / 3 + 3;

/// The page has the numbers of one seed of each point and of its reference, and two plots for each metric
/// of a group.
fn report_bytes(plan: &Plan) -> u64 {
    let e = &plan.experiment;
    let groups = plan.points.len() / e.contenders().len().max(1);
    let plots = 2 * groups * e.metrics.len();
    let facts = plan
        .facts
        .iter()
        .chain(plan.references.iter().map(|r| &r.facts));
    facts.map(|f| f.pixels() * PAGE_BYTES).sum::<u64>() + plots as u64 * PLOT_BYTES
}

struct Calibration<'a> {
    experiment: &'a Experiment,
    host: &'a dyn Host,
    start: Instant,
    /// Seconds of one sample a pixel by kind of work; `None` when it could not be found out.
    known: HashMap<String, Option<f64>>,
}

impl Calibration<'_> {
    fn cost(&mut self, facts: &Facts, changes: impl FnOnce() -> Vec<Change>) -> Cost {
        let by_samples = facts.samples.and_then(|samples| {
            let one = self.one_sample(facts, changes)?;
            Some(one * samples as f64)
        });
        let limit = facts.seconds;
        // A target may be reached at any time.
        let seconds = match (by_samples, limit) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Cost {
            samples: facts.samples.map(|n| n.saturating_mul(facts.pixels())),
            seconds,
            bytes: facts.pixels() * (4 * facts.channels + 3 + 4),
        }
    }

    fn one_sample(&mut self, facts: &Facts, changes: impl FnOnce() -> Vec<Change>) -> Option<f64> {
        if let Some(known) = self.known.get(&facts.work) {
            return *known;
        }
        if self.start.elapsed().as_secs_f64() > CALIBRATION_SECONDS || self.host.stopped() {
            return None;
        }
        let opened = session::open(self.experiment, changes(), self.host);
        let seconds = opened.ok().and_then(|mut pipeline| {
            // The first pass also warms caches up, so the second is believed.
            session::probe(&mut pipeline).ok()?;
            Some(session::probe(&mut pipeline).ok()?.seconds)
        });
        self.known.insert(facts.work.clone(), seconds);
        seconds
    }
}
