//! Error against samples or time: the log points of several runs.

use std::fmt;

/// Log points of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Samples or seconds at each, rising and positive.
    pub x: Vec<f64>,
    /// The error at each, positive: MSE, relMSE or any other.
    pub error: Vec<f64>,
}

/// Why a curve says nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveError {
    /// There are no runs.
    NoRuns,
    /// The runs have different numbers of log points, or x and error have.
    LengthsDiffer,
    /// Fewer log points than it takes.
    TooFewPoints {
        /// How many it takes.
        needed: usize,
    },
    /// An x or an error is not positive and finite, which has no logarithm, or x does not rise.
    NotPositive,
    /// The error asked for was not reached: no run went on for long enough.
    NotReached {
        /// The mean error at the last log point.
        last: f64,
    },
    /// The error was below the one asked for already at the first log point.
    AlreadyBelow {
        /// The mean error at the first log point.
        first: f64,
    },
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRuns => f.write_str("there are no runs"),
            Self::LengthsDiffer => f.write_str("the runs have different numbers of log points"),
            Self::TooFewPoints { needed } => write!(f, "it takes {needed} log points"),
            Self::NotPositive => f.write_str(
                "an error, a time or a number of samples is not positive, or they do not rise",
            ),
            Self::NotReached { last } => {
                write!(
                    f,
                    "not reached: the error is {last:.3e} at the last log point"
                )
            }
            Self::AlreadyBelow { first } => {
                write!(
                    f,
                    "reached before the first log point, where the error is {first:.3e}"
                )
            }
        }
    }
}

impl std::error::Error for CurveError {}

/// A point of a curve in logarithms: (ln x, ln error).
pub(super) type Point = (f64, f64);

/// Checks that runs have one length, of `needed` points at least, and logarithms.
pub(super) fn check(runs: &[Run], needed: usize) -> Result<(), CurveError> {
    let first = runs.first().ok_or(CurveError::NoRuns)?;
    for run in runs {
        if run.x.len() != first.x.len() || run.error.len() != first.x.len() {
            return Err(CurveError::LengthsDiffer);
        }
        let mut values = run.x.iter().chain(&run.error);
        let rises = run.x.windows(2).all(|w| w[0] < w[1]);
        if !values.all(|v| v.is_finite() && *v > 0.0) || !rises {
            return Err(CurveError::NotPositive);
        }
    }
    if first.x.len() < needed {
        return Err(CurveError::TooFewPoints { needed });
    }
    Ok(())
}

/// The curve of the means over some runs, by index, in logarithms. Means are taken before
/// logarithms: the mean of unbiased squared errors is unbiased, the mean of their logarithms is
/// not.
pub(super) fn mean_curve(runs: &[Run], chosen: &[usize]) -> Vec<Point> {
    let n = chosen.len() as f64;
    let mean = |of: &dyn Fn(&Run) -> f64| chosen.iter().map(|&i| of(&runs[i])).sum::<f64>() / n;
    (0..runs[chosen[0]].x.len())
        .map(|k| (mean(&|r| r.x[k]).ln(), mean(&|r| r.error[k]).ln()))
        .collect()
}

/// The slope of the line of least squares.
pub(super) fn fitted_slope(points: &[Point]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (mut xx, mut xy) = (0.0, 0.0);
    for (x, y) in points {
        xx += (x - mx) * (x - mx);
        xy += (x - mx) * (y - my);
    }
    xy / xx
}

/// All runs once.
pub(super) fn all(runs: &[Run]) -> Vec<usize> {
    (0..runs.len()).collect()
}
