//! The plan of an experiment as text.

use crate::units;
use sr_experiment::{Cost, Costs, Plan, name_of_run};
use std::fmt::Write;

/// Every run and reference with its cost, and the sum.
pub fn plan(plan: &Plan, costs: &Costs) -> String {
    let mut rows: Vec<[String; 4]> = Vec::new();
    let references = plan.references.iter().zip(&costs.references).enumerate();
    for (number, (reference, cost)) in references {
        let n = plan.references.len();
        let of = units::counted(reference.points.len() as u64, "point");
        let name = format!("reference {} of {n}, for {of}", number + 1);
        rows.push(row(name, cost));
    }
    for (number, cost) in costs.runs.iter().enumerate() {
        rows.push(row(name_of_run(plan, number), cost));
    }
    let width = |column: usize| {
        let all = rows.iter().map(|r| r[column].chars().count());
        all.max().unwrap_or(0)
    };
    let widths = [width(0), width(1), width(2), width(3)];
    let mut text = format!("{}\n\n", plan.experiment.title);
    for [name, samples, seconds, bytes] in &rows {
        let [a, b, c, d] = widths;
        let _ = writeln!(text, "{name:a$}  {samples:>b$}  {seconds:>c$}  {bytes:>d$}");
    }
    let time = match costs.seconds() {
        Some(seconds) => format!("about {}", units::about(seconds)),
        None => "an unknown time".into(),
    };
    let _ = write!(
        text,
        "\n{}, {time} of integration, about {} on disk",
        units::counted(plan.runs.len() as u64, "run"),
        units::bytes(costs.bytes()),
    );
    text
}

fn row(name: String, cost: &Cost) -> [String; 4] {
    [
        name,
        match cost.samples {
            Some(samples) => units::counted(samples, "sample"),
            None => "samples as time allows".into(),
        },
        cost.seconds
            .map_or("unknown".into(), |s| format!("≈ {}", units::duration(s))),
        format!("≤ {}", units::bytes(cost.bytes)),
    ]
}
