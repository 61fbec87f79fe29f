//! Error against one parameter, and what it says.

use serde::Serialize;

/// Error against one stiffness parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sweep {
    /// Unique in its suite, as `ggx_d`.
    pub name: String,
    /// What is measured against which truth.
    pub about: String,
    /// What runs from easy to extreme, as `cos θ`; drawn on a logarithmic axis where all values are positive.
    pub parameter: String,
    /// What `error` is, as `relative error of D`.
    pub error: String,
    /// The largest error that is promised within `holds`.
    pub bound: f64,
    /// From where to where, ends included, the bound is promised.
    pub holds: [f64; 2],
    /// In the order in which they were measured; some may lie outside of `holds`.
    pub points: Vec<Point>,
}

/// The error at one value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// The parameter's value, as it rounds to what the renderer gets.
    pub at: f64,
    /// The largest error that was found there; infinite where something was not finite.
    pub error: f64,
    /// The same of the `f64` instance of the kernel, where there is one.
    pub oracle: Option<f64>,
    /// Four standard errors of `error` where it is a mean over samples, otherwise 0.
    pub half_width: f64,
    /// The input that had the largest error, so that it can be found again.
    pub worst: String,
}

/// Whether a bound holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// At each point that it is promised for.
    Holds,
    /// Somewhere the error's uncertainty reaches over the bound.
    Unclear,
    /// Somewhere the error lies over the bound by more than its uncertainty, or nothing was measured.
    Broken,
}

/// Where, beyond the range of the promise, the error first exceeds the bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Below the range, if at all among what was measured.
    pub below: Option<f64>,
    /// Above the range.
    pub above: Option<f64>,
}

impl Point {
    /// Without an oracle and without chance.
    pub fn new(at: f64, error: f64, worst: impl Into<String>) -> Self {
        Self {
            at,
            error: if error.is_nan() { f64::INFINITY } else { error },
            oracle: None,
            half_width: 0.0,
            worst: worst.into(),
        }
    }

    /// With the error of the `f64` kernel.
    pub fn with_oracle(self, error: f64) -> Self {
        Self {
            oracle: Some(error),
            ..self
        }
    }

    /// With four standard errors.
    pub fn with_half_width(self, half_width: f64) -> Self {
        Self { half_width, ..self }
    }

    fn verdict(&self, bound: f64) -> Verdict {
        if self.error - self.half_width > bound || !self.error.is_finite() {
            Verdict::Broken
        } else if self.error + self.half_width <= bound {
            Verdict::Holds
        } else {
            Verdict::Unclear
        }
    }
}

impl Sweep {
    /// Whether the bound holds where it is promised.
    pub fn verdict(&self) -> Verdict {
        let promised = self.promised().map(|p| p.verdict(self.bound));
        promised.max().unwrap_or(Verdict::Broken)
    }

    /// The points that the bound is promised for.
    pub fn promised(&self) -> impl Iterator<Item = &Point> {
        let [low, high] = self.holds;
        self.points
            .iter()
            .filter(move |p| (low..=high).contains(&p.at))
    }

    /// The promised point with the largest error.
    pub fn worst(&self) -> Option<&Point> {
        self.promised().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// Where it begins to fail.
    pub fn limit(&self) -> Limit {
        let [low, high] = self.holds;
        let failing = || {
            self.points
                .iter()
                .filter(|p| p.verdict(self.bound) == Verdict::Broken)
        };
        let at = |p: &Point| p.at;
        Limit {
            below: failing().map(at).filter(|x| *x < low).reduce(f64::max),
            above: failing().map(at).filter(|x| *x > high).reduce(f64::min),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(points: Vec<Point>) -> Sweep {
        Sweep {
            name: "x".into(),
            about: String::new(),
            parameter: "x".into(),
            error: "error".into(),
            bound: 1.0,
            holds: [1.0, 10.0],
            points,
        }
    }

    #[test]
    fn the_worst_promised_point_decides() {
        let point = |at, error, half| Point::new(at, error, "").with_half_width(half);
        let of = |points: &[Point]| sweep(points.to_vec()).verdict();
        assert_eq!(
            of(&[point(1.0, 0.5, 0.0), point(0.5, 9.0, 0.0)]),
            Verdict::Holds
        );
        assert_eq!(
            of(&[point(1.0, 0.5, 0.6), point(10.0, 0.1, 0.0)]),
            Verdict::Unclear
        );
        assert_eq!(
            of(&[point(2.0, 1.5, 0.6), point(3.0, 2.0, 0.9)]),
            Verdict::Broken
        );
        assert_eq!(of(&[point(2.0, f64::NAN, f64::INFINITY)]), Verdict::Broken);
        assert_eq!(
            of(&[point(0.5, 0.0, 0.0)]),
            Verdict::Broken,
            "nothing was measured"
        );
    }

    #[test]
    fn limits_are_the_nearest_failures_outside_of_the_promise() {
        let at = |x, error| Point::new(x, error, "");
        let found = sweep(vec![
            at(0.1, 5.0),
            at(0.5, 3.0),
            at(0.7, 0.2),
            at(2.0, 0.1),
            at(20.0, 0.1),
        ]);
        let wanted = Limit {
            below: Some(0.5),
            above: None,
        };
        assert_eq!(found.limit(), wanted);
    }
}
