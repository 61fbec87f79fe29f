//! Logarithmic axes: where they begin and end, what is marked, and how it is written.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// An axis over decimal logarithms.
#[derive(Clone)]
pub struct Axis {
    /// From its lower to its upper end.
    pub range: Range<f64>,
    /// What is marked.
    pub ticks: Vec<f64>,
}

/// Part of the axis that stays free beyond its values at either end.
const MARGIN: f64 = 0.06;
/// Decades that an axis has at least, so that equal values do not fill it with their noise.
const SHORTEST: f64 = 0.4;
/// Marks that fit.
const MOST_TICKS: i64 = 8;

/// What is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marks {
    /// Powers of ten, and round numbers between them where there is room.
    Decades,
    /// Powers of two, at which samples are logged.
    Doublings,
}

/// An axis that holds the values, which are positive and finite.
pub fn axis(marks: Marks, values: impl Iterator<Item = f64>) -> Axis {
    let logs = values.map(f64::log10).filter(|l| l.is_finite());
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), l| {
        (a.min(l), b.max(l))
    });
    let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
    let lacking = 0.5 * (SHORTEST - (high - low)).max(0.0);
    let span = high - low + 2.0 * lacking;
    let range = low - lacking - MARGIN * span..high + lacking + MARGIN * span;
    let ticks = match marks {
        Marks::Decades => decades(&range),
        Marks::Doublings => doublings(&range),
    };
    Axis { range, ticks }
}

fn doublings(range: &Range<f64>) -> Vec<f64> {
    let octave = 2f64.log10();
    let [first, last] = [range.start, range.end].map(|log| log / octave);
    let (first, last) = (first.ceil() as i64, last.floor() as i64);
    let stride = (last - first) / (MOST_TICKS + 2) + 1;
    let all = (first..=last).filter(|e| e.rem_euclid(stride) == 0);
    all.map(|e| e as f64 * octave).collect()
}

fn decades(range: &Range<f64>) -> Vec<f64> {
    let multiples: &[f64] = match range.end - range.start {
        d if d < 0.7 => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
        d if d < 1.3 => &[1.0, 2.0, 3.0, 5.0],
        d if d < 2.5 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    };
    let (first, last) = (range.start.floor() as i64, range.end.ceil() as i64);
    let stride = ((last - first) / MOST_TICKS + 1).max(1);
    let exponents = (first..=last).filter(|e| e.rem_euclid(stride) == 0);
    let all = exponents.flat_map(|e| multiples.iter().map(move |m| e as f64 + m.log10()));
    all.filter(|t| range.contains(t)).collect()
}

impl Axis {
    /// Where a value is drawn; what is too small for the axis lies at its end.
    pub fn place(&self, value: f64) -> f64 {
        // Also for what has no logarithm.
        if value > 0.0 {
            value.log10().clamp(self.range.start, self.range.end)
        } else {
            self.range.start
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let part = (value - self.range.start) / (self.range.end - self.range.start);
        limit.0 + (part * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(log: &f64) -> String {
        label(*log)
    }
}

/// `0.02`, `1000`, `2·10⁻⁴`, of a decimal logarithm.
fn label(log: f64) -> String {
    // A mark at 10³ may come as 2.9999….
    let exponent = (log + 1e-9).floor();
    if (-3.0..5.0).contains(&exponent) {
        // Four digits are all of a power of two up to 8192; zeros at the end say nothing.
        let text = format!("{:.*}", (3.0 - exponent).max(0.0) as usize, 10f64.powf(log));
        let cut = text.trim_end_matches('0').trim_end_matches('.');
        return if text.contains('.') { cut.into() } else { text };
    }
    let multiple = (10f64.powf(log - exponent) * 10.0).round() / 10.0;
    let power = superscript(exponent as i64);
    match multiple == 1.0 {
        true => format!("10{power}"),
        false => format!("{multiple}·10{power}"),
    }
}

fn superscript(n: i64) -> String {
    let sign = |c| if c == '-' { '⁻' } else { c };
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let raised = |c: char| match c.to_digit(10) {
        Some(d) => digits.chars().nth(d as usize).unwrap_or(c),
        None => sign(c),
    };
    n.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_few_and_inside_whatever_the_values() {
        for (low, high) in [
            (1.0, 1.0),
            (1.0, 1.2),
            (3e-4, 8e-2),
            (1e-30, 1e30),
            (2.0, 1024.0),
            (f64::MIN_POSITIVE, f64::MAX),
        ] {
            for marks in [Marks::Decades, Marks::Doublings] {
                let found = axis(marks, [low, high].into_iter());
                let count = found.ticks.len();
                assert!((1..=14).contains(&count), "{low} to {high}: {count}");
                assert!(found.ticks.iter().all(|t| found.range.contains(t)));
                assert!(found.place(low) > found.range.start);
                assert!(found.place(high) < found.range.end);
                assert_eq!(found.place(-1.0), found.range.start);
            }
        }
        assert!(
            axis(Marks::Decades, std::iter::empty())
                .range
                .start
                .is_finite()
        );
        let samples = axis(Marks::Doublings, [2.0, 64.0].into_iter());
        let marks: Vec<f64> = samples
            .ticks
            .iter()
            .map(|t| 10f64.powf(*t).round())
            .collect();
        assert_eq!(marks, [2.0, 4.0, 8.0, 16.0, 32.0, 64.0]);
    }

    #[test]
    fn marks_are_written_as_people_write_them() {
        let text = |x: f64| label(x.log10());
        assert_eq!(text(0.02), "0.02");
        assert_eq!(text(1000.0), "1000");
        assert_eq!(text(1.5), "1.5");
        assert_eq!(text(0.0015), "0.0015");
        assert_eq!(text(4096.0), "4096");
        assert_eq!(text(65536.0), "65536");
        assert_eq!(text(0.125), "0.125");
        assert_eq!(text(2e-4), "2·10⁻⁴");
        assert_eq!(text(1e12), "10¹²");
    }
}
