//! What the runs of an experiment say: which method is sooner where it should be, by how much and how
//! certainly; how fast errors fall; what is biased; which methods give the same picture.
//!
//! Methods at equal values of the axes are a [`Group`] of contenders for one picture. Figures are those of
//! [`stats`](crate::stats) over the seeds, pictures are judged by [`same`](crate::same).

mod curves;
mod group;
mod pictures;
mod race;
mod verdict;

pub use curves::Curve;
pub use pictures::{Bias, Pair};
pub use race::Reached;

use crate::folder::Folder;
use crate::metric::Metric;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::same::Answer;
use crate::stats::{LogEstimate, Mean};
use serde::Serialize;
use std::collections::BTreeMap;

/// The analysis of an experiment.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Analysis {
    /// Contenders that belong together, in the order of the points.
    pub groups: Vec<Group>,
}

/// Methods at equal values of the axes; without methods the values of the last axis.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// What the contenders have in common: labels of the axes; empty for a single group.
    pub heading: String,
    /// Whether they are to give the same picture, so that it makes sense to say which is sooner.
    pub comparable: bool,
    /// The metric of target and speed-ups: the experiment's first.
    pub metric: Metric,
    /// The contender, by number, with which the others are compared.
    pub baseline: usize,
    /// The error whose time is told: the experiment's, or else what the best but one comes to of those that
    /// are not biased.
    pub target: Option<f64>,
    /// Why there is no comparison at that target: the reference is not good enough.
    pub refused: Option<String>,
    /// The contender that reaches the target first, unless that may be chance.
    pub winner: Option<usize>,
    /// Those of which something is done.
    pub contenders: Vec<Contender>,
    /// All pairs, where the pictures are to be the same.
    pub pairs: Vec<Pair>,
    /// The above in words, the most important first.
    pub verdict: Vec<String>,
}

/// One of those that are compared.
#[derive(Clone, Debug, Serialize)]
pub struct Contender {
    /// Its point in the plan, by number.
    #[serde(skip)]
    pub point: usize,
    /// The `id` of its runs without the seed.
    pub id: String,
    /// Its name among the others.
    pub label: String,
    /// Runs, which differ in their seeds.
    pub runs: usize,
    /// Its error by metric: those that have values.
    pub curves: BTreeMap<Metric, Curve>,
    /// 1 / (variance · seconds), with the variance of the pixels relative to the reference as in relMSE. It
    /// knows nothing of bias.
    pub efficiency: Option<Interval>,
    /// Seconds to the target.
    pub reached: Option<Reached>,
    /// Seconds of the baseline to the target over its own, so that more is better.
    pub speed_up: Option<Interval>,
    /// Whether it differs from the reference by more than noise.
    pub bias: Option<Bias>,
    /// Why something above is not known.
    pub notes: Vec<String>,
}

/// A positive figure with its 95 % interval, where that is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// The lower end.
    pub low: Option<f64>,
    /// The upper end.
    pub high: Option<f64>,
}

impl From<LogEstimate> for Interval {
    fn from(estimate: LogEstimate) -> Self {
        let interval = estimate.interval();
        Self {
            value: estimate.value,
            low: interval.map(|i| i.0),
            high: interval.map(|i| i.1),
        }
    }
}

impl Analysis {
    /// The verdicts of all groups, each line with its group's heading.
    pub fn words(&self) -> impl Iterator<Item = String> {
        self.groups.iter().flat_map(|g| {
            g.verdict.iter().map(|sentence| match g.heading.as_str() {
                "" => sentence.clone(),
                heading => format!("{heading}: {sentence}"),
            })
        })
    }
}

impl Contender {
    /// Its error at the end of its runs, over the seeds.
    pub fn last(&self, metric: Metric) -> Option<&Mean> {
        Some(&self.curves.get(&metric)?.points.last()?.error)
    }

    /// Whether it was found to be biased.
    pub fn is_biased(&self) -> bool {
        let answer = self.bias.as_ref().map(|b| b.answer);
        answer == Some(Answer::Different)
    }
}

/// Looks at everything that is done. Maps of where pictures differ are written to the folder.
pub(crate) fn analyse(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Analysis {
    let groups = group::members(plan, outcome).into_iter();
    Analysis {
        groups: groups
            .map(|members| group::analyse(plan, outcome, folder, members))
            .collect(),
    }
}
