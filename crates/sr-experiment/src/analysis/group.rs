//! Contenders, group by group.

use super::curves::{Common, Curve};
use super::pictures::{Map, Pictures};
use super::race::{self, Reached};
use super::{Contender, Group, verdict};
use crate::folder::Folder;
use crate::metric::Metric;
use crate::metrics::NOISE_LIMIT;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::units::three_digits;
use crate::words;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The points of a group, each with its number among the contenders.
pub(super) struct Members {
    heading: String,
    points: Vec<(usize, usize)>,
}

/// Points that differ in their method alone, or without methods in the last axis.
pub(super) fn members(plan: &Plan, outcome: &Outcome) -> Vec<Members> {
    let mut groups: Vec<(Vec<usize>, Members)> = Vec::new();
    for (number, point) in plan.points.iter().enumerate() {
        if outcome.ends(plan, number).next().is_none() {
            continue;
        }
        let mut axes = point.settings.clone();
        let contender = match point.method {
            Some(method) => method,
            None => axes.pop().unwrap_or(0),
        };
        match groups.iter_mut().find(|(of, _)| *of == axes) {
            Some((_, members)) => members.points.push((contender, number)),
            None => {
                let common = 0..axes.len();
                let labels = common.map(|a| words::axis_label(plan, number, a));
                let heading = labels.collect::<Vec<_>>().join(", ");
                let points = vec![(contender, number)];
                groups.push((axes, Members { heading, points }));
            }
        }
    }
    groups.into_iter().map(|(_, members)| members).collect()
}

pub(super) fn analyse(plan: &Plan, outcome: &Outcome, folder: &Folder, members: Members) -> Group {
    let e = &plan.experiment;
    let metric = e.metrics.first().copied().unwrap_or(Metric::RelMse);
    let points: Vec<usize> = members.points.iter().map(|(_, p)| *p).collect();
    let baseline = e.baseline.unwrap_or(0);
    let baseline = members.points.iter().position(|(c, _)| *c == baseline);
    let mut group = Group {
        heading: members.heading,
        comparable: points.len() > 1 && comparable(plan, outcome, &points),
        metric,
        baseline: baseline.unwrap_or(0),
        target: None,
        refused: None,
        winner: None,
        contenders: points
            .iter()
            .map(|p| contender(plan, outcome, *p))
            .collect(),
        pairs: Vec::new(),
        verdict: Vec::new(),
    };
    judge(&mut group, plan, outcome, folder);
    race(&mut group, plan, outcome);
    group.verdict = verdict::words(&group);
    group
}

/// Methods are ways to the same picture. Values of an axis are that when they share a reference, or
/// when somebody has named a baseline among them.
fn comparable(plan: &Plan, outcome: &Outcome, points: &[usize]) -> bool {
    if !plan.experiment.methods.is_empty() || plan.experiment.baseline.is_some() {
        return true;
    }
    let first = outcome.reference(points[0]);
    let shared = |p: &usize| match (first, outcome.reference(*p)) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    };
    points.iter().all(shared)
}

fn contender(plan: &Plan, outcome: &Outcome, point: usize) -> Contender {
    let log = Common::of(plan, outcome, point);
    let curve = |m: Metric| Some((m, log.curve(m)?));
    let curves: BTreeMap<Metric, Curve> = Metric::ALL.into_iter().filter_map(curve).collect();
    let labels = words::labels(plan, point);
    let label = match plan.points[point].method {
        Some(_) => labels.first(),
        None => labels.last(),
    };
    Contender {
        point,
        id: plan.points[point].id.clone(),
        label: label
            .cloned()
            .unwrap_or_else(|| plan.points[point].id.clone()),
        runs: outcome.ends(plan, point).count(),
        curves,
        efficiency: None,
        reached: None,
        speed_up: None,
        bias: None,
        notes: Vec::new(),
    }
}

/// Asks of each contender whether it is biased, and of each pair whether it is the same.
fn judge(group: &mut Group, plan: &Plan, outcome: &Outcome, folder: &Folder) {
    let n = group.contenders.len();
    let pictures: Vec<_> = group
        .contenders
        .iter()
        .map(|c| Pictures::read(plan, outcome, c.point, folder))
        .collect();
    for (contender, pictures) in group.contenders.iter_mut().zip(&pictures) {
        let ends = outcome.ends(plan, contender.point);
        let seconds: Vec<f64> = ends.map(|e| e.seconds).collect();
        let efficiency = pictures.as_ref().ok().and_then(|p| p.efficiency(&seconds));
        contender.efficiency = efficiency;
        let Some(reference) = outcome.reference(contender.point) else {
            continue;
        };
        let map = Map {
            folder,
            name: format!("{}_reference", contender.id),
        };
        let error = contender.last(Metric::Mse).map(|m| m.mean);
        let found = pictures
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|p| p.bias(reference, n, error, map));
        match found {
            Ok(bias) => contender.bias = Some(bias),
            Err(cause) => contender.notes.push(format!("no test for bias: {cause}")),
        }
    }
    if !group.comparable {
        return;
    }
    let all = (0..n).flat_map(|a| (a + 1..n).map(move |b| [a, b]));
    for [a, b] in all {
        let (Ok(first), Ok(second)) = (&pictures[a], &pictures[b]) else {
            continue;
        };
        let [one, other] = [a, b].map(|i| group.contenders[i].id.clone());
        let map = Map {
            folder,
            name: format!("{one}_{other}"),
        };
        match first.pair(second, [a, b], n * (n - 1) / 2, map) {
            Ok(pair) => group.pairs.push(pair),
            Err(cause) => {
                let note = format!("not compared with {other}: {cause}");
                group.contenders[a].notes.push(note);
            }
        }
    }
}

/// Words for a target at which too much of what is measured is the reference's own error.
fn refusal(group: &Group, outcome: &Outcome, target: f64) -> Option<String> {
    let own = |c: &Contender| {
        let facts = &outcome.reference(c.point)?.facts;
        match group.metric {
            Metric::RelMse => facts.relmse,
            Metric::Mse => facts.mse,
            _ => None,
        }
    };
    let own = group.contenders.iter().filter_map(own).fold(0.0, f64::max);
    (own > NOISE_LIMIT * (own + target)).then(|| {
        format!(
            "Which is sooner cannot be said: at {} {}, {:.0} % of what is measured would be the reference's \
             own error; give it more samples, or set a target above {}.",
            group.metric.title(),
            three_digits(target),
            100.0 * own / (own + target),
            three_digits(own * (1.0 / NOISE_LIMIT - 1.0)),
        )
    })
}

/// Finds out when each reaches the target, and who is first.
fn race(group: &mut Group, plan: &Plan, outcome: &Outcome) {
    if !group.comparable {
        return;
    }
    let metric = group.metric;
    let target = plan.experiment.target;
    group.target = target.or_else(|| race::common_target(&group.contenders, metric));
    // Errors at the end that are not above the reference's own leave nothing.
    let Some(target) = group.target else {
        group.refused = refusal(group, outcome, 0.0);
        return;
    };
    group.refused = refusal(group, outcome, target);
    if group.refused.is_some() {
        return;
    }
    for contender in &mut group.contenders {
        let log = Common::of(plan, outcome, contender.point);
        match Reached::new(&log, metric, target) {
            Ok(reached) => contender.reached = Some(reached),
            Err(cause) => contender
                .notes
                .push(format!("no time to the target: {cause}")),
        }
    }
    let base = group.contenders[group.baseline].reached;
    for contender in &mut group.contenders {
        contender.speed_up = contender
            .reached
            .zip(base)
            .and_then(|(own, base)| own.ratio(&base));
    }
    group.winner = race::first_two(&group.contenders).and_then(|(first, next)| {
        let Some(next) = next else {
            return Some(first);
        };
        let [a, b] = [first, next].map(|i| group.contenders[i].reached);
        match a.zip(b) {
            Some((Reached::Before { .. }, Reached::After { .. })) => Some(first),
            Some((a, b)) => a.ratio(&b)?.low.filter(|low| *low > 1.0).map(|_| first),
            None => None,
        }
    });
}
