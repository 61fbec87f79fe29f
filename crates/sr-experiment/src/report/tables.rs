//! The tables of a report: what each point came to, and what it took.

use super::markup::escape;
use super::table::{Cell, Table};
use crate::analysis::{Analysis, Contender, Group, Interval, Reached};
use crate::measure::{ErrorSource, LogPoint};
use crate::plan::Plan;
use crate::run::{Done, Outcome};
use crate::stats::mean;
use crate::units::{duration, grouped, three_digits};
use crate::words;
use std::fmt::Write;

/// Errors, slopes and speed-ups: a line a point, means over its seeds.
pub(super) fn results(plan: &Plan, outcome: &Outcome, analysis: &Analysis) -> String {
    let e = &plan.experiment;
    let mut heads = names(plan);
    heads.extend(["seeds", "samples", "seconds"].map(String::from));
    heads.extend(e.metrics.iter().map(|m| m.title().to_owned()));
    heads.push("slope".into());
    heads.push("efficiency".into());
    heads.push("target".into());
    heads.push("time to it".into());
    heads.push("speed-up".into());
    heads.push("rejected".into());
    let mut table = Table::new(heads);
    for point in 0..plan.points.len() {
        table.row(result(plan, outcome, analysis, point));
    }
    let explained = escape(&explain(outcome));
    table.html("results") + &format!("<p class=\"small\">{explained}</p>\n")
}

/// What tells a point from the others.
fn names(plan: &Plan) -> Vec<String> {
    let e = &plan.experiment;
    let method = (!e.methods.is_empty()).then(|| "method".to_owned());
    let names = method
        .into_iter()
        .chain(e.axes.iter().map(|a| a.short.clone()));
    let names: Vec<String> = names.collect();
    match names.is_empty() {
        true => vec!["run".into()],
        false => names,
    }
}

fn labels(plan: &Plan, point: usize) -> Vec<Cell> {
    let (e, p) = (&plan.experiment, &plan.points[point]);
    let method = p.method.map(|m| Cell::text(&e.methods[m].label));
    let axes = e.axes.iter().zip(&p.settings);
    let axes = axes.map(|(a, v)| Cell::label(&a.settings[*v].label));
    let cells: Vec<Cell> = method.into_iter().chain(axes).collect();
    match cells.is_empty() {
        true => vec![Cell::text(&p.id)],
        false => cells,
    }
}

fn result(plan: &Plan, outcome: &Outcome, analysis: &Analysis, point: usize) -> Vec<Cell> {
    let e = &plan.experiment;
    let ends: Vec<&LogPoint> = outcome.ends(plan, point).collect();
    let average = |value: fn(&LogPoint) -> f64| {
        mean(&ends.iter().map(|e| value(e)).collect::<Vec<f64>>()).map(|m| m.mean)
    };
    let whole = |n: f64| grouped(n.round() as u64);
    let mut cells = labels(plan, point);
    cells.push(Cell::number(Some(ends.len() as f64), whole));
    cells.push(Cell::number(average(|e| e.samples as f64), whole));
    cells.push(Cell::number(average(|e| e.seconds), duration));
    cells.extend(e.metrics.iter().map(|metric| {
        let found = mean(&outcome.errors(plan, point, *metric));
        Cell::number(found.map(|m| m.mean), |_| {
            found.map_or_else(String::new, |m| words::interval(&m))
        })
    }));
    cells.extend(judged(plan, analysis, point));
    cells.push(Cell::number(average(|e| e.rejected as f64), whole));
    cells
}

/// Slope, efficiency, target, time to it and speed-up, as far as they are known.
fn judged(plan: &Plan, analysis: &Analysis, point: usize) -> [Cell; 5] {
    let in_group = |g: &&Group| g.contenders.iter().any(|c| c.point == point);
    let group = analysis.groups.iter().find(in_group);
    let contender = group.and_then(|g| g.contenders.iter().find(|c| c.point == point));
    let target = group.and_then(|g| g.target);
    let metric = plan.experiment.metrics.first();
    let slope = |c: &Contender| c.curves.get(metric?)?.slope_samples;
    let slope = contender.and_then(slope);
    let interval = |of: fn(&Contender) -> Option<Interval>, text: fn(f64) -> String| {
        let found = contender.and_then(of);
        Cell::number(found.map(|i| i.value), |_| {
            found.map_or_else(String::new, |i| interval(&i, text))
        })
    };
    [
        Cell::number(slope.map(|s| s.slope), |_| {
            let text = slope.as_ref().map(super::panel::slope_text);
            text.unwrap_or_default().replacen("slope ", "", 1)
        }),
        interval(|c| c.efficiency, three_digits),
        Cell::number(target, three_digits),
        reached(contender),
        interval(|c| c.speed_up, |x| format!("{} ×", three_digits(x))),
    ]
}

/// Seconds to the target, or why there are none.
fn reached(contender: Option<&Contender>) -> Cell {
    let reached = contender.and_then(|c| c.reached);
    let key = reached.map(|r| r.seconds().unwrap_or(f64::MAX));
    Cell::number(key, |seconds| match reached {
        Some(Reached::After { seconds, .. }) => interval(&seconds, duration),
        Some(Reached::Before { .. }) => format!("below {}", duration(seconds)),
        _ => "not reached".into(),
    })
}

/// `3.1 × (2.8 × to 3.4 ×)`.
fn interval(interval: &Interval, text: fn(f64) -> String) -> String {
    let value = text(interval.value);
    match (interval.low, interval.high) {
        (Some(low), Some(high)) => format!("{value} ({} to {})", text(low), text(high)),
        (Some(low), None) => format!("{value} (at least {})", text(low)),
        (None, Some(high)) => format!("{value} (at most {})", text(high)),
        (None, None) => value,
    }
}

/// What the numbers of the table are.
fn explain(outcome: &Outcome) -> String {
    let mut text = String::from(
        "Seconds are those of integration alone. Several seeds: the mean, ± half of its 95 % interval \
         by Student's t.",
    );
    let end = outcome.done.first().and_then(|d| d.log.last());
    text += match end.map(|l| l.error_source) {
        Some(ErrorSource::Reference) => {
            " Errors are against the reference, less the reference's own where it is known (relMSE and \
             MSE)."
        }
        _ => {
            " There is no reference: errors are the pictures' own estimates from the variance of \
             their pixels, which know of noise only, not of bias."
        }
    };
    text + " The slope is that of the first metric against samples in logarithms: −1 is plain Monte \
            Carlo. Efficiency is 1/(variance × seconds)."
}

/// Rays, rates and seconds by stage: a line a point, means over its seeds.
pub(super) fn statistics(plan: &Plan, outcome: &Outcome) -> String {
    let mut heads = names(plan);
    let columns = [
        "rays",
        "rays/s",
        "samples/s",
        "load",
        "compile",
        "integrate",
        "measure",
        "post",
        "budget",
        "over or under",
    ];
    heads.extend(columns.map(String::from));
    let mut table = Table::new(heads);
    for point in 0..plan.points.len() {
        let done = outcome.done.iter();
        let done: Vec<&Done> = done.filter(|d| plan.runs[d.run].point == point).collect();
        let mut cells = labels(plan, point);
        cells.extend(statistic(&done, plan.facts[point].seconds));
        table.row(cells);
    }
    table.html("statistics")
        + "<p class=\"small\">Rates are over the seconds of integration, the only ones on the clock: \
           loading, compiling, measuring and writing are not. A run ends between passes, so it ends a \
           little before or after the seconds that it may take.</p>\n"
        + &left_out(plan)
}

fn statistic(done: &[&Done], budget: Option<f64>) -> Vec<Cell> {
    let average = |value: &dyn Fn(&Done) -> Option<f64>| {
        let all: Vec<f64> = done.iter().filter_map(|d| value(d)).collect();
        mean(&all).map(|m| m.mean)
    };
    let rate = |of: fn(&LogPoint) -> u64| {
        average(&|d| {
            let end = d.log.last()?;
            let rate = of(end) as f64 / end.seconds;
            rate.is_finite().then_some(rate)
        })
    };
    let seconds = |of: fn(&Done) -> f64| Cell::number(average(&|d| Some(of(d))), duration);
    let over = average(&|d| d.over_seconds);
    vec![
        Cell::number(average(&|d| Some(d.log.last()?.rays as f64)), rounded),
        Cell::number(rate(|l| l.rays), rounded),
        Cell::number(rate(|l| l.samples_total), rounded),
        seconds(|d| d.seconds.load),
        seconds(|d| d.seconds.compile),
        seconds(|d| d.seconds.integrate),
        seconds(|d| d.seconds.measure),
        seconds(|d| d.seconds.post),
        Cell::number(budget, duration),
        Cell::number(over, |s| {
            let sign = if s < 0.0 { "−" } else { "+" };
            format!("{sign}{}", duration(s.abs()))
        }),
    ]
}

/// `314`, `3.14 k`, `31.4 M`.
fn rounded(n: f64) -> String {
    for (unit, name) in [(1e9, " G"), (1e6, " M"), (1e3, " k")] {
        if n >= unit {
            return format!("{}{name}", three_digits(n / unit));
        }
    }
    three_digits(n)
}

/// What runs did not do, and why; once for all points that leave out the same.
fn left_out(plan: &Plan) -> String {
    let mut kinds: Vec<(&[sr_pipeline::PlanItem], Vec<String>)> = Vec::new();
    for (point, facts) in plan.facts.iter().enumerate() {
        let name = words::labels(plan, point).join(", ");
        match kinds
            .iter_mut()
            .find(|(items, _)| **items == *facts.left_out)
        {
            Some((_, names)) => names.push(name),
            None => kinds.push((&facts.left_out, vec![name])),
        }
    }
    let mut text = String::from(
        "<details class=\"left-out\">\n<summary>What was left out, and why</summary>\n",
    );
    let several = kinds.len() > 1;
    for (items, names) in kinds {
        if several {
            let _ = writeln!(text, "<h3>{}</h3>", escape(&names.join("; ")));
        }
        text.push_str("<dl>\n");
        for item in items {
            let (what, why) = (escape(&item.what), escape(&item.reason));
            let _ = writeln!(text, "<dt>{what}</dt><dd>{why}</dd>");
        }
        text.push_str("</dl>\n");
    }
    text + "</details>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_may_be_open() {
        let of = |low, high| {
            interval(
                &Interval {
                    value: 3.0,
                    low,
                    high,
                },
                |x| format!("{x} ×"),
            )
        };
        assert_eq!(of(Some(2.0), Some(4.0)), "3 × (2 × to 4 ×)");
        assert_eq!(of(Some(2.0), None), "3 × (at least 2 ×)");
        assert_eq!(of(None, None), "3 ×");
    }

    #[test]
    fn rates_are_rounded_to_three_digits() {
        assert_eq!(rounded(31_415_926.0), "31.4 M");
        assert_eq!(rounded(3141.0), "3.14 k");
        assert_eq!(rounded(314.0), "314");
    }
}
