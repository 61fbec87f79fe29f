//! Several seeds: their mean, and how well it is known.

use serde::Serialize;
use sr_stats::student_quantile;

/// Part of the intervals that hold what they are intervals of.
pub const CONFIDENCE: f64 = 0.95;

/// A mean with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The arithmetic mean.
    pub mean: f64,
    /// Half the width of the 95 % interval of the mean, by Student's t (Student 1908): exact for
    /// values that are normally distributed. `None` for a single value.
    pub half_width: Option<f64>,
    /// How many values there are.
    pub count: usize,
}

/// `None` without values.
pub fn mean(values: &[f64]) -> Option<Mean> {
    let n = values.len() as f64;
    if values.is_empty() {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let half_width = (values.len() > 1).then(|| {
        let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
        let std_error = (squares / (n - 1.0) / n).sqrt();
        student_quantile(0.5 + 0.5 * CONFIDENCE, n - 1.0) * std_error
    });
    Some(Mean {
        mean,
        half_width,
        count: values.len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_students() {
        // t of 0.975 with 2 degrees of freedom is 4.30265 (Fisher and Yates, table III); the
        // standard error of 1, 2, 3 is 1/√3.
        let found = mean(&[1.0, 2.0, 3.0]).unwrap();
        let half = found.half_width.unwrap();
        assert!((half - 4.302_652_73 / 3f64.sqrt()).abs() < 1e-6, "{half}");
        assert_eq!((found.mean, found.count), (2.0, 3));
    }

    #[test]
    fn one_value_has_no_interval_and_none_no_mean() {
        assert_eq!(mean(&[4.0]).unwrap().half_width, None);
        assert_eq!(mean(&[]), None);
    }
}
