//! The analysis in words.

use super::race::{Reached, first_two};
use super::{Contender, Group, Interval};
use crate::same::Answer;
use crate::units::{duration, three_digits};

/// Sentences, the most important first.
pub(super) fn words(group: &Group) -> Vec<String> {
    let mut sentences = Vec::new();
    sentences.extend(group.refused.clone());
    sentences.extend(first(group));
    sentences.extend(group.contenders.iter().filter_map(never));
    sentences.extend(group.contenders.iter().filter_map(biased));
    sentences.extend(answered(group, Answer::Same, "No bias was found in"));
    let unclear =
        "Heavy tails (a few bright samples make up the noise) leave open whether there is bias in";
    sentences.extend(answered(group, Answer::Unclear, unclear));
    sentences.extend(group.contenders.iter().filter_map(|c| flat(group, c)));
    sentences.extend(pairs(group));
    sentences
}

/// Who is first, and by how much.
fn first(group: &Group) -> Option<String> {
    let target = format!("{} {}", group.metric.title(), three_digits(group.target?));
    let (first, next) = first_two(&group.contenders)?;
    let a = &group.contenders[first];
    let reached = a.reached?;
    let after = match reached {
        Reached::Before { seconds } => {
            format!("before its first log point at {}", duration(seconds))
        }
        _ => format!("after {}", duration(reached.seconds()?)),
    };
    let Some(next) = next else {
        return Some(format!(
            "{} is the only one to reach {target}, {after}.",
            a.label
        ));
    };
    let b = &group.contenders[next];
    let times = duration(b.reached?.seconds()?);
    if let (Reached::Before { .. }, Some(Reached::Before { .. })) = (reached, b.reached) {
        let (a, b) = (&a.label, &b.label);
        return Some(format!(
            "{a} and {b} reach {target} before their first log points."
        ));
    }
    let Some(ratio) = reached.ratio(&b.reached?) else {
        let at_least = three_digits(b.reached?.seconds()? / reached.seconds()?);
        return Some(format!(
            "{} wins: it reaches {target} {after}, at least {at_least} times as fast as {}, the next, \
             which takes {times}.",
            a.label, b.label
        ));
    };
    Some(match (ratio.low, group.winner) {
        (_, Some(_)) => format!(
            "{} wins: it reaches {target} {after}, {} times as fast as {}, the next.",
            a.label,
            interval(&ratio),
            b.label
        ),
        (None, _) => format!(
            "{} reaches {target} {after}, {} times as fast as {}; whether that is chance takes several \
             seeds to tell.",
            a.label,
            interval(&ratio),
            b.label
        ),
        _ => format!(
            "{} and {} cannot be told apart: they reach {target} {after} and after {times}, a ratio of {}.",
            a.label,
            b.label,
            interval(&ratio)
        ),
    })
}

fn never(contender: &Contender) -> Option<String> {
    let Some(Reached::Never { last }) = contender.reached else {
        return None;
    };
    let last = three_digits(last);
    Some(format!("{} ends before that, at {last}.", contender.label))
}

fn biased(contender: &Contender) -> Option<String> {
    let bias = contender
        .bias
        .as_ref()
        .filter(|b| b.answer == Answer::Different)?;
    let mut text = format!(
        "{} is biased: what it converges to is not the reference (p {})",
        contender.label,
        probability(bias.p_value)
    );
    if bias.brightness.abs() > bias.brightness_half_width {
        let (by, half) = (bias.brightness.abs(), bias.brightness_half_width);
        let which = if bias.brightness < 0.0 {
            "darker"
        } else {
            "brighter"
        };
        text += &format!(
            ", {:.2} ± {:.2} % {which} on the whole",
            100.0 * by,
            100.0 * half
        );
    }
    if let Some(share) = bias.share.filter(|s| *s > 0.005) {
        let share = 100.0 * share.min(1.0);
        text += &format!("; {share:.0} % of its MSE is squared bias");
    }
    Some(text + ".")
}

/// The contenders of one answer.
fn answered(group: &Group, answer: Answer, words: &str) -> Option<String> {
    let right = group
        .contenders
        .iter()
        .filter(|c| c.bias.as_ref().is_some_and(|b| b.answer == answer));
    let labels: Vec<&str> = right.map(|c| c.label.as_str()).collect();
    (!labels.is_empty()).then(|| format!("{words} {}.", list(&labels)))
}

fn flat(group: &Group, contender: &Contender) -> Option<String> {
    let curve = contender.curves.get(&group.metric)?;
    let flattening = curve.slope_samples?.flattening.filter(|f| f.found)?;
    Some(format!(
        "{}'s error flattens: it falls with samples to the power of {:.2} at first and of {:.2} at last (p {}). \
         That is what a bias looks like, or a reference that is not good enough.",
        contender.label,
        flattening.early,
        flattening.late,
        probability(flattening.p_value)
    ))
}

/// What all pairs say together; biased ones have been told.
fn pairs(group: &Group) -> Vec<String> {
    let label = |i: usize| group.contenders[i].label.as_str();
    let told = |i: usize| group.contenders[i].is_biased();
    let different = group.pairs.iter().filter(|p| p.answer == Answer::Different);
    let mut sentences: Vec<String> = different
        .filter(|p| !told(p.a) && !told(p.b))
        .map(|p| {
            let (a, b) = (label(p.a), label(p.b));
            let p = probability(p.p_value);
            format!("{a} and {b} converge to different pictures (p {p}).")
        })
        .collect();
    if !group.pairs.is_empty() && group.pairs.iter().all(|p| p.answer == Answer::Same) {
        sentences
            .push("All converge to the same picture, as far as their noise lets one see.".into());
    }
    sentences
}

/// `3.4 (3.1 to 3.8)`.
fn interval(ratio: &Interval) -> String {
    let value = three_digits(ratio.value);
    match (ratio.low, ratio.high) {
        (Some(low), Some(high)) => {
            format!("{value} ({} to {})", three_digits(low), three_digits(high))
        }
        _ => value,
    }
}

/// `0.03`, `2e-7`, `below 1e-12`.
fn probability(p: f64) -> String {
    match p {
        p if p < 1e-12 => "below 1e-12".into(),
        p if p < 0.001 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

/// `a, b and c`.
fn list(labels: &[&str]) -> String {
    match labels {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}
