//! The largest of many errors.

use crate::Point;

/// Collects errors at one value of the parameter, and keeps the largest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Worst {
    error: f64,
    oracle: Option<f64>,
    half_width: f64,
    input: String,
}

impl Worst {
    /// One error, and the input that had it.
    pub fn see(&mut self, error: f64, input: impl FnOnce() -> String) {
        self.see_mean(error, 0.0, input);
    }

    /// A mean over samples, with four standard errors.
    pub fn see_mean(&mut self, error: f64, half_width: f64, input: impl FnOnce() -> String) {
        // NaN counts as the worst.
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if self.input.is_empty() || error + half_width > self.error + self.half_width {
            self.error = error;
            self.half_width = half_width;
            self.input = input();
        }
    }

    /// An error of the `f64` kernel.
    pub fn see_oracle(&mut self, error: f64) {
        let largest = self.oracle.unwrap_or(0.0);
        self.oracle = Some(if error <= largest { largest } else { error });
    }

    /// One more of what is counted.
    pub fn count(&mut self, input: impl FnOnce() -> String) {
        if self.error == 0.0 {
            self.input = input();
        }
        self.error += 1.0;
    }

    /// The point of the sweep at `at`.
    pub fn at(self, at: f64) -> Point {
        let point = Point::new(at, self.error, self.input).with_half_width(self.half_width);
        match self.oracle {
            Some(oracle) => point.with_oracle(oracle),
            None => point,
        }
    }
}

/// |a − b| relative to the truth `b`; 0 where both are the same, infinite where only the truth is 0.
pub(crate) fn relative(a: f64, b: f64) -> f64 {
    if a == b { 0.0 } else { ((a - b) / b).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_and_its_input_are_kept() {
        let mut worst = Worst::default();
        worst.see(0.0, || "a".into());
        worst.see(2.0, || "b".into());
        worst.see(1.0, || "c".into());
        assert_eq!(worst.clone().at(0.5), Point::new(0.5, 2.0, "b"));
        worst.see(f64::NAN, || "d".into());
        worst.see(3.0, || "e".into());
        assert_eq!(worst.at(0.5), Point::new(0.5, f64::INFINITY, "d"));
    }

    #[test]
    fn what_is_counted_names_the_first() {
        let mut worst = Worst::default();
        for x in ["a", "b"] {
            worst.count(|| x.into());
        }
        assert_eq!(worst.at(1.0), Point::new(1.0, 2.0, "a"));
    }
}
