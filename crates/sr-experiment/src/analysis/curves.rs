//! Error against samples and seconds, as means over the seeds.

use crate::measure::LogPoint;
use crate::metric::Metric;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::stats::{CurveError, Mean, Run, Slope, mean, slope};
use serde::Serialize;

/// The error of one contender in one metric.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// Log points that all seeds have.
    pub points: Vec<CurvePoint>,
    /// d ln(error) / d ln(samples).
    pub slope_samples: Option<Slope>,
    /// d ln(error) / d ln(seconds).
    pub slope_seconds: Option<Slope>,
    /// Why there is no slope.
    pub no_slope: Option<String>,
}

/// A log point over the seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CurvePoint {
    /// Samples a pixel.
    pub samples: Mean,
    /// Seconds of integration.
    pub seconds: Mean,
    /// The error.
    pub error: Mean,
}

/// Log points of several seeds that belong together.
pub(super) struct Common<'a> {
    /// By seed, then by log point.
    seeds: Vec<Vec<&'a LogPoint>>,
}

impl<'a> Common<'a> {
    /// Those of a point: at equal samples, or where log points are by the clock at equal marks.
    pub fn of(plan: &Plan, outcome: &'a Outcome, point: usize) -> Self {
        let done = outcome.done.iter();
        let logs = done.filter(|d| plan.runs[d.run].point == point);
        let logs: Vec<&[LogPoint]> = logs.map(|d| d.log.as_slice()).collect();
        let shortest = logs.iter().map(|l| l.len()).min().unwrap_or(0);
        let by_mark = !plan.experiment.log_seconds.is_empty();
        let kept = |log: &'a [LogPoint]| -> Vec<&'a LogPoint> {
            if by_mark {
                return log[..shortest].iter().collect();
            }
            let at = |l: &[LogPoint], n| l.iter().any(|p| p.samples == n);
            let common = |p: &&LogPoint| logs.iter().all(|l| at(l, p.samples));
            log.iter().filter(common).collect()
        };
        Self {
            seeds: logs.iter().map(|l| kept(l)).collect(),
        }
    }

    /// Runs for the statistics, of what is known at every log point.
    pub fn runs(&self, x: fn(&LogPoint) -> f64, metric: Metric) -> Vec<Run> {
        let run = |log: &Vec<&LogPoint>| Run {
            x: log.iter().map(|p| x(p)).collect(),
            error: log
                .iter()
                .map(|p| p.metric(metric).unwrap_or(f64::NAN))
                .collect(),
        };
        self.seeds.iter().map(run).collect()
    }

    /// `None` when no log point has the metric.
    pub fn curve(&self, metric: Metric) -> Option<Curve> {
        let length = self.seeds.first()?.len();
        let point = |k: usize| {
            let of = |value: &dyn Fn(&LogPoint) -> Option<f64>| {
                let values = self.seeds.iter().map(|log| value(log[k]));
                mean(&values.collect::<Option<Vec<f64>>>()?)
            };
            Some(CurvePoint {
                samples: of(&|p| Some(p.samples as f64))?,
                seconds: of(&|p| Some(p.seconds))?,
                error: of(&|p| p.metric(metric))?,
            })
        };
        let points: Vec<CurvePoint> = (0..length).filter_map(point).collect();
        if points.is_empty() {
            return None;
        }
        let fit = |x: fn(&LogPoint) -> f64| slope(&without_first(self.runs(x, metric)));
        let (samples, seconds) = (fit(samples), fit(seconds));
        Some(Curve {
            points,
            no_slope: samples.as_ref().err().map(CurveError::to_string),
            slope_samples: samples.ok(),
            slope_seconds: seconds.ok(),
        })
    }
}

/// An error that is not known has no part in a slope: the first log point has too few samples for an
/// estimate where there is no reference.
fn without_first(mut runs: Vec<Run>) -> Vec<Run> {
    let unknown = |r: &Run| r.error.iter().take_while(|e| e.is_nan()).count();
    let skip = runs.iter().map(unknown).max().unwrap_or(0);
    for run in &mut runs {
        let skip = skip.min(run.x.len());
        run.x.drain(..skip);
        run.error.drain(..skip);
    }
    runs
}

pub(super) fn samples(point: &LogPoint) -> f64 {
    point.samples as f64
}

pub(super) fn seconds(point: &LogPoint) -> f64 {
    point.seconds
}
