//! What it takes to make the same experiment again: command, machine, file, configurations.

use super::markup::escape;
use crate::folder::{CSV, JSON};
use crate::machine::Machine;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::units::{counted, duration, three_digits};
use crate::words;
use std::fmt::Write;

/// The section's contents.
pub(super) fn repeat(plan: &Plan, outcome: &Outcome) -> String {
    let machine = outcome.machine.as_ref().map(Machine::to_string);
    let facts = [
        (
            "version",
            format!("Steradian {}", env!("CARGO_PKG_VERSION")),
        ),
        ("command", outcome.command.clone()),
        ("machine", machine.unwrap_or_default()),
    ];
    let mut text = String::from("<dl class=\"facts\">\n");
    for (name, value) in facts {
        let _ = writeln!(
            text,
            "<dt>{name}</dt><dd><code>{}</code></dd>",
            escape(&value)
        );
    }
    text.push_str("</dl>\n");
    text += &references(plan, outcome);
    let _ = write!(
        text,
        "<p><a href=\"{CSV}\">{CSV}</a> and <a href=\"{JSON}\">{JSON}</a> beside this page hold every log \
         point and every run's configuration; <a href=\"plots/\">plots/</a> has each plot as SVG, PNG \
         and CSV.</p>\n<details open>\n<summary>The experiment's file</summary>\n<pre>{}</pre>\n</details>\n",
        escape(&plan.experiment.text),
    );
    text + &configurations(plan, outcome)
}

/// The resolved configuration of each point's shown run.
fn configurations(plan: &Plan, outcome: &Outcome) -> String {
    let mut text = String::from(
        "<details class=\"configs\">\n<summary>Every point's whole configuration</summary>\n",
    );
    for point in 0..plan.points.len() {
        if let Some(done) = outcome.shown(plan, point) {
            let _ = writeln!(
                text,
                "<details>\n<summary>{} <code>{}</code></summary>\n<pre>{}</pre>\n</details>",
                escape(&words::run(plan, done.run)),
                escape(&done.config_hash),
                escape(&done.config)
            );
        }
    }
    text + "</details>\n"
}

fn references(plan: &Plan, outcome: &Outcome) -> String {
    let points = 0..plan.points.len();
    let mut all: Vec<_> = points.filter_map(|p| outcome.reference(p)).collect();
    all.dedup_by(|a, b| a.facts.file == b.facts.file);
    if all.is_empty() {
        return String::new();
    }
    let mut text = String::from("<h3>Reference</h3>\n<ul>\n");
    for reference in all {
        let facts = &reference.facts;
        let mut parts = vec![facts.file.clone()];
        parts.extend(facts.samples.map(|n| counted(n, "sample")));
        parts.extend(facts.seconds.map(duration));
        parts.push(match facts.relmse {
            Some(own) => format!("its own relMSE is {}", three_digits(own)),
            None => "its own error is not known, so errors near it say nothing".into(),
        });
        if facts.from_cache {
            parts.push("rendered earlier".into());
        }
        let _ = writeln!(text, "<li>{}</li>", escape(&parts.join(", ")));
    }
    text + "</ul>\n"
}
