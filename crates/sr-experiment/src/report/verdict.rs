//! What the experiment found, in words, before anything else: the analysis' sentences, what is the
//! same and what is biased, and what a reader must beware of.

use super::markup::{data_uri, escape};
use crate::analysis::{Analysis, Group};
use crate::folder::Folder;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::same::Answer;
use crate::units::counted;
use crate::words;
use std::fmt::Write;

/// The section's contents.
pub(super) fn verdict(
    plan: &Plan,
    outcome: &Outcome,
    analysis: &Analysis,
    folder: &Folder,
) -> Result<String, String> {
    let mut text = state(plan, outcome);
    for group in &analysis.groups {
        text.push_str("<div class=\"group\">\n");
        if !group.heading.is_empty() {
            let _ = writeln!(text, "<h3>{}</h3>", escape(&group.heading));
        }
        sentences(&mut text, group);
        text += &differences(group, folder)?;
        text.push_str("</div>\n");
    }
    Ok(text)
}

/// What is missing, and what to beware of.
fn state(plan: &Plan, outcome: &Outcome) -> String {
    let (done, all) = (outcome.done.len(), plan.runs.len());
    let mut lines = Vec::new();
    if done < all {
        lines.push(format!(
            "{done} of {} are done.",
            counted(all as u64, "run")
        ));
    }
    let failed = outcome.failed.iter();
    lines.extend(failed.map(|f| format!("{} failed: {}", words::run(plan, f.run), f.cause)));
    lines.extend(outcome.warnings.iter().cloned());
    let mut text = String::new();
    for line in lines {
        let _ = writeln!(text, "<p class=\"warning\">{}</p>", escape(&line));
    }
    text
}

/// The first sentence is the verdict, the others its reasons.
fn sentences(text: &mut String, group: &Group) {
    let mut all = group.verdict.iter().map(|s| escape(s));
    let won = if group.winner.is_some() { " won" } else { "" };
    if let Some(first) = all.next() {
        let _ = writeln!(text, "<p class=\"verdict{won}\">{first}</p>");
    }
    let rest: Vec<String> = all.map(|s| format!("<li>{s}</li>")).collect();
    if !rest.is_empty() {
        let _ = writeln!(text, "<ul>{}</ul>", rest.concat());
    }
}

/// What was found out about expected pictures, with maps of where they differ: of each contender
/// against the reference, and of pairs.
fn differences(group: &Group, folder: &Folder) -> Result<String, String> {
    let name = |n: usize| group.contenders[n].label.as_str();
    let of_references = group.contenders.iter().filter_map(|c| {
        let bias = c.bias.as_ref()?;
        let title = format!("{} against the reference", c.label);
        Some((title, bias.answer, &bias.text, &bias.map))
    });
    let of_pairs = group.pairs.iter().map(|p| {
        let title = format!("{} against {}", name(p.a), name(p.b));
        (title, p.answer, &p.text, &p.map)
    });
    let all: Vec<_> = of_references.chain(of_pairs).collect();
    if all.is_empty() {
        return Ok(String::new());
    }
    let different = all.iter().filter(|(_, a, ..)| *a == Answer::Different);
    let title = match (different.count(), all.len()) {
        (0, _) => "The same expected picture? No difference was found".to_owned(),
        (n, all) => {
            format!("The same expected picture? {n} of {all} comparisons found a difference")
        }
    };
    let mut text = format!("<details class=\"pairs\">\n<summary>{title}</summary>\n");
    for (title, answer, words, map) in all {
        let class = match answer {
            Answer::Same => "same",
            Answer::Different => "different",
            Answer::Unclear => "unclear",
        };
        let title = escape(&title);
        let _ = writeln!(text, "<div class=\"pair {class}\">\n<div><h4>{title}</h4>");
        let _ = writeln!(text, "<p>{}</p></div>", escape(words.trim()));
        if let Some(map) = map {
            let path = folder.file(map);
            let png = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
            let _ = writeln!(
                text,
                "<img class=\"map\" alt=\"where {title} differs\" src=\"{}\">",
                data_uri("image/png", &png)
            );
        }
        text.push_str("</div>\n");
    }
    Ok(text
        + "<p class=\"small\">Maps show the difference of each tile in standard errors: red where the first \
           is brighter, blue where the second is.</p>\n</details>\n")
}
