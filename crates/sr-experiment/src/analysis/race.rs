//! Who is sooner: time to a target, speed-ups, efficiency.

use super::curves::{Common, seconds};
use super::{Contender, Interval};
use crate::metric::Metric;
use crate::stats::{CurveError, LogEstimate, time_to_error};
use serde::Serialize;

/// When a contender reaches the target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Reached {
    /// Between its log points.
    After {
        /// Seconds of integration.
        seconds: Interval,
        /// For ratios.
        #[serde(skip)]
        estimate: LogEstimate,
    },
    /// Before its first log point.
    Before {
        /// Seconds of that log point.
        seconds: f64,
    },
    /// Not at all.
    Never {
        /// Its error at the end.
        last: f64,
    },
}

impl Reached {
    /// When a contender reaches an error, and why that is not known otherwise.
    pub(super) fn new(log: &Common<'_>, metric: Metric, target: f64) -> Result<Self, CurveError> {
        let runs = log.runs(seconds, metric);
        match time_to_error(&runs, target) {
            Ok(estimate) => Ok(Self::After {
                seconds: estimate.into(),
                estimate,
            }),
            Err(CurveError::AlreadyBelow { .. }) => {
                let first = runs.iter().filter_map(|r| r.x.first());
                Ok(Self::Before {
                    seconds: first.sum::<f64>() / runs.len() as f64,
                })
            }
            Err(CurveError::NotReached { last }) => Ok(Self::Never { last }),
            Err(cause) => Err(cause),
        }
    }

    /// Its seconds, or an upper bound of them.
    pub fn seconds(&self) -> Option<f64> {
        match self {
            Self::After { seconds, .. } => Some(seconds.value),
            Self::Before { seconds } => Some(*seconds),
            Self::Never { .. } => None,
        }
    }

    /// How many times as long as `self` the other takes, where both are known.
    pub fn ratio(&self, other: &Self) -> Option<Interval> {
        match (self, other) {
            (Self::After { estimate: a, .. }, Self::After { estimate: b, .. }) => {
                Some(b.ratio(a).into())
            }
            _ => None,
        }
    }
}

/// The target of contenders that are to be compared without one of the file's: what the best but one comes
/// to, of those that are not biased, so that two reach it.
pub(super) fn common_target(contenders: &[Contender], metric: Metric) -> Option<f64> {
    let right = contenders.iter().filter(|c| !c.is_biased());
    let ends = right.filter_map(|c| c.last(metric).map(|m| m.mean));
    let mut ends: Vec<f64> = ends.filter(|e| *e > 0.0).collect();
    ends.sort_by(f64::total_cmp);
    ends.get(1).or(ends.first()).copied()
}

/// The first of those that are not biased, and the next.
pub(super) fn first_two(contenders: &[Contender]) -> Option<(usize, Option<usize>)> {
    let time = |i: &usize| contenders[*i].reached.and_then(|r| r.seconds());
    let right = (0..contenders.len()).filter(|i| !contenders[*i].is_biased());
    let mut order: Vec<usize> = right.filter(|i| time(i).is_some()).collect();
    order.sort_by(|a, b| {
        time(a)
            .partial_cmp(&time(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    Some((*order.first()?, order.get(1).copied()))
}
