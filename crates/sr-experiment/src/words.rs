//! Names of runs, captions.

use crate::document::{Piece, Placeholder};
use crate::measure::{ErrorSource, LogPoint};
use crate::plan::Plan;
use crate::run::{Done, Outcome};
use crate::stats::{Mean, mean};
use crate::units::{counted, duration, grouped, three_digits};

/// What a person calls a run: `[3/12] mis, alpha = 0.05, seed 0`.
pub fn run(plan: &Plan, number: usize) -> String {
    let run = &plan.runs[number];
    let mut parts = labels(plan, run.point);
    if plan.experiment.seeds.len() > 1 {
        parts.extend(run.seed.map(|s| format!("seed {s}")));
    }
    if parts.is_empty() {
        parts.push(run.id.clone());
    }
    format!("[{}/{}] {}", number + 1, plan.runs.len(), parts.join(", "))
}

/// What tells a point from the others: method, then the value of each axis.
pub(crate) fn labels(plan: &Plan, point: usize) -> Vec<String> {
    let (e, p) = (&plan.experiment, &plan.points[point]);
    let method = p.method.map(|m| e.methods[m].label.clone());
    let axes = (0..e.axes.len()).map(|a| axis_label(plan, point, a));
    method.into_iter().chain(axes).collect()
}

/// `alpha = 0.05`, and the label alone where it says enough.
pub(crate) fn axis_label(plan: &Plan, point: usize, axis: usize) -> String {
    let settings = &plan.experiment.axes[axis];
    let label = &settings.settings[plan.points[point].settings[axis]].label;
    let is_zip = settings.name.starts_with("zip.");
    match label.starts_with(|c: char| c.is_ascii_digit() || c == '-') || !is_zip {
        true => format!("{} = {label}", settings.short),
        false => label.clone(),
    }
}

/// The line that tells of a run that is done.
pub(crate) fn done(plan: &Plan, done: &Done) -> String {
    let mut parts = Vec::new();
    if let Some(end) = done.log.last() {
        parts.push(samples(plan, done.run, end));
        parts.push(duration(end.seconds));
        for metric in &plan.experiment.metrics {
            if let Some(value) = end.metric(*metric) {
                let sign = if end.error_source == ErrorSource::Estimate {
                    "≈"
                } else {
                    "="
                };
                parts.push(format!("{} {sign} {}", metric.title(), three_digits(value)));
            }
        }
    }
    format!("{}: {}", run(plan, done.run), parts.join(", "))
}

/// Samples a pixel, and their mean where not every pixel has as many.
fn samples(plan: &Plan, run: usize, end: &LogPoint) -> String {
    let most = counted(end.samples, "sample");
    let pixels = plan.facts[plan.runs[run].point].pixels();
    if end.samples_total == end.samples * pixels {
        return most;
    }
    let mean = end.samples_total as f64 / pixels as f64;
    format!("{most} at most, mean {mean:.0}")
}

/// What stands below the picture of a point, line by line. `labels` are those that its place does
/// not tell.
pub(crate) fn caption(
    plan: &Plan,
    outcome: &Outcome,
    point: usize,
    labels: &[String],
) -> Vec<String> {
    let Some(shown) = outcome.shown(plan, point) else {
        let labels = labels.join(", ");
        return vec![labels, "not done".into()];
    };
    let end = shown.log.last();
    let pieces = &plan.experiment.show.caption.0;
    let text: String = pieces
        .iter()
        .map(|piece| match piece {
            Piece::Text(text) => text.clone(),
            Piece::Value(Placeholder::Labels) => labels.join(", "),
            Piece::Value(Placeholder::Method) => {
                let method = plan.points[point].method;
                method.map_or_else(String::new, |m| plan.experiment.methods[m].label.clone())
            }
            Piece::Value(Placeholder::Samples) => {
                end.map_or_else(String::new, |e| samples(plan, shown.run, e))
            }
            Piece::Value(Placeholder::Seconds) => {
                let all: Vec<f64> = outcome.ends(plan, point).map(|e| e.seconds).collect();
                mean(&all).map_or_else(String::new, |m| duration(m.mean))
            }
            Piece::Value(Placeholder::Error) => errors(plan, outcome, point),
            Piece::Value(Placeholder::Rays) => end.map_or_else(String::new, |e| grouped(e.rays)),
            Piece::Value(Placeholder::Seed) => shown.seed.to_string(),
            Piece::Value(Placeholder::Axis(axis)) => {
                let settings = &plan.experiment.axes[*axis].settings;
                settings[plan.points[point].settings[*axis]].label.clone()
            }
        })
        .collect();
    let lines = text.lines().map(str::trim).filter(|l| !l.is_empty());
    lines.map(str::to_owned).collect()
}

/// A line a metric.
fn errors(plan: &Plan, outcome: &Outcome, point: usize) -> String {
    let source = outcome.ends(plan, point).map(|e| e.error_source).next();
    let sign = match source {
        Some(ErrorSource::Estimate) => "≈",
        _ => "",
    };
    let line = |metric: &crate::Metric| {
        let found = mean(&outcome.errors(plan, point, *metric))?;
        Some(format!("{} {sign}{}", metric.title(), interval(&found)))
    };
    let lines: Vec<String> = plan.experiment.metrics.iter().filter_map(line).collect();
    lines.join("\n")
}

/// `0.0314 ± 0.002`, `(3.14 ± 0.2)e-5`: the half width in the unit of the mean.
pub(crate) fn interval(mean: &Mean) -> String {
    let Some(half) = mean.half_width else {
        return three_digits(mean.mean);
    };
    let one_digit = |x: f64| {
        let decimals = if x > 0.0 { -x.log10().floor() } else { 0.0 };
        format!("{x:.*}", decimals.clamp(0.0, 9.0) as usize)
    };
    let size = mean.mean.abs().max(half);
    if size == 0.0 || (0.01..1000.0).contains(&size) {
        return format!("{} ± {}", three_digits(mean.mean), one_digit(half));
    }
    let exponent = size.log10().floor() as i32;
    let unit = 10f64.powi(exponent);
    format!(
        "({:.2} ± {})e{exponent}",
        mean.mean / unit,
        one_digit(half / unit)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_has_the_unit_of_its_mean() {
        let text = |mean, half_width| {
            interval(&Mean {
                mean,
                half_width,
                count: 2,
            })
        };
        assert_eq!(text(0.0314, Some(0.0021)), "0.0314 ± 0.002");
        assert_eq!(text(14.1, Some(38.0)), "14.1 ± 38");
        assert_eq!(text(3.14e-5, Some(2.1e-6)), "(3.14 ± 0.2)e-5");
        assert_eq!(text(5.5e-4, Some(3e-3)), "(0.55 ± 3)e-3");
        assert_eq!(text(3.14e-5, None), "3.14e-5");
        assert_eq!(text(0.0, Some(0.0)), "0 ± 0");
    }
}
