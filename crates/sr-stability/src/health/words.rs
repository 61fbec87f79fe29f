//! Findings for a terminal.

use super::found::{Condition, Finding, Health};
use crate::report::words::number;
use sr_experiment::units::{counted, duration};

/// `0.5 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// As it is printed.
pub(super) fn condition(condition: Condition) -> &'static str {
    match condition {
        Condition::Ok => "ok",
        Condition::Look => "look",
        Condition::Broken => "BROKEN",
    }
}

/// What was looked at.
pub(super) fn subject(health: &Health) -> String {
    let [width, height] = health.size;
    let part = match health.step {
        1 => String::new(),
        n => format!(" (one of each {n} × {n})"),
    };
    format!(
        "{}, {} of {width} × {height}{part}, {} each, seed {}, {}",
        health.integrator,
        counted(health.pixels, "pixel"),
        counted(health.samples, "sample"),
        health.seed,
        duration(health.seconds),
    )
}

/// In a sentence.
pub(super) fn summary(health: &Health) -> String {
    let count = |c| health.findings.iter().filter(|f| f.condition == c).count() as u64;
    match (count(Condition::Broken), count(Condition::Look)) {
        (0, 0) => "healthy".to_owned(),
        (0, n) => format!("{} worth a look", counted(n, "finding")),
        (b, 0) => format!("{b} broken"),
        (b, n) => format!("{b} broken, {} worth a look", counted(n, "finding")),
    }
}

/// The command that shows what a finding speaks of.
pub(super) fn example<'a>(health: &'a Health, finding: &Finding) -> Option<&'a String> {
    match (finding.name, finding.condition) {
        (_, Condition::Ok) => None,
        ("rejected", _) => health.rejected.kinds.first()?.replay.as_ref(),
        ("brightest", _) => health.brightest.worst.first()?.replay.as_ref(),
        _ => None,
    }
}

/// What else there is to a finding, a sentence each.
pub(super) fn details(health: &Health, finding: &Finding) -> Vec<String> {
    match (finding.name, &health.oracle) {
        // The first sentence is in the finding itself.
        ("oracle", Some(oracle)) => oracle.words().split_off(1),
        _ => Vec::new(),
    }
}

/// Some lines a finding.
pub(super) fn lines(health: &Health) -> Vec<String> {
    let mut lines = Vec::new();
    for f in &health.findings {
        lines.push(format!(
            "  {:8}{:12}{}",
            condition(f.condition),
            f.name,
            f.text
        ));
        lines.extend(f.advice.iter().map(|a| format!("{:22}{a}", "")));
        lines.extend(details(health, f).iter().map(|d| format!("{:22}{d}", "")));
        lines.extend(example(health, f).map(|c| format!("{:22}{c}", "")));
    }
    let left_out = health.left_out.iter();
    lines.extend(left_out.map(|why| format!("  {:10}{why}", "left out")));
    lines
}
