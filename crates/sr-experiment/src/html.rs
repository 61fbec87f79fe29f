//! `index.html`: the contact sheet as a page that needs no other file and no network.

use crate::folder::{CSV, Folder, JSON};
use crate::grid::groups;
use crate::measure::ErrorSource;
use crate::metric::Metric;
use crate::pictures::{self, Picture};
use crate::plan::Plan;
use crate::run::Outcome;
use crate::stats::mean;
use crate::units::{counted, duration, grouped, three_digits};
use crate::words;
use base64::Engine;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");

/// The whole page.
pub(crate) fn page(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Result<String, String> {
    let e = &plan.experiment;
    let title = escape(&e.title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    for paragraph in e.note.split("\n\n").filter(|p| !p.trim().is_empty()) {
        let _ = writeln!(page, "<p>{}</p>", escape(paragraph.trim()));
    }
    state(&mut page, plan, outcome);
    pictures_of(&mut page, plan, outcome, folder)?;
    table(&mut page, plan, outcome);
    references(&mut page, plan, outcome);
    let _ = write!(
        page,
        "<h2>Data</h2>\n<p><a href=\"{CSV}\">{CSV}</a> and <a href=\"{JSON}\">{JSON}</a> beside this \
         page hold every log point and every run's configuration.</p>\n\
         <h2>The experiment</h2>\n<pre>{}</pre>\n<footer>Steradian {}</footer>\n</body>\n</html>\n",
        escape(&e.text),
        env!("CARGO_PKG_VERSION"),
    );
    Ok(page)
}

/// What is missing, and what to beware of.
fn state(page: &mut String, plan: &Plan, outcome: &Outcome) {
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
    for line in lines {
        let _ = writeln!(page, "<p class=\"warning\">{}</p>", escape(&line));
    }
}

fn pictures_of(
    page: &mut String,
    plan: &Plan,
    outcome: &Outcome,
    folder: &Folder,
) -> Result<(), String> {
    let (groups, columns) = groups(plan);
    for group in &groups {
        if !group.heading.is_empty() {
            let _ = writeln!(page, "<h2>{}</h2>", escape(&group.heading));
        }
        let _ = writeln!(page, "<div class=\"grid\" style=\"--columns: {columns}\">");
        for (labels, point) in &group.cells {
            let caption = words::caption(plan, outcome, *point, labels);
            let pictures = pictures::of_point(plan, outcome, *point, folder);
            figure(page, &pictures, &caption)?;
        }
        page.push_str("</div>\n");
    }
    let attached = pictures::attached(plan);
    if !attached.is_empty() {
        page.push_str("<h2>Beside</h2>\n<div class=\"grid\" style=\"--columns: 2\">\n");
        for (picture, caption) in attached {
            figure(page, &[picture], &[caption])?;
        }
        page.push_str("</div>\n");
    }
    Ok(())
}

fn figure(page: &mut String, pictures: &[Picture], caption: &[String]) -> Result<(), String> {
    page.push_str("<figure>\n<div class=\"pictures\">");
    for picture in pictures {
        let png = base64::engine::general_purpose::STANDARD.encode(picture.png()?);
        let _ = write!(
            page,
            "<img alt=\"{}\" title=\"{}\" src=\"data:image/png;base64,{png}\">",
            escape(&caption.join(", ")),
            escape(&picture.what),
        );
    }
    let lines: Vec<String> = caption.iter().map(|l| escape(l)).collect();
    let _ = writeln!(
        page,
        "</div>\n<figcaption>{}</figcaption>\n</figure>",
        lines.join("<br>")
    );
    Ok(())
}

/// A line a point: means over its seeds.
fn table(page: &mut String, plan: &Plan, outcome: &Outcome) {
    let e = &plan.experiment;
    page.push_str("<h2>Results</h2>\n<div class=\"wide\">\n<table>\n<thead><tr>");
    let mut heads: Vec<String> = Vec::new();
    if !e.methods.is_empty() {
        heads.push("method".into());
    }
    heads.extend(e.axes.iter().map(|a| a.short.clone()));
    heads.extend(["seeds", "samples", "seconds", "rays"].map(String::from));
    heads.extend(e.metrics.iter().map(|m| m.title().to_owned()));
    heads.push("rejected".into());
    for head in &heads {
        let _ = write!(page, "<th scope=\"col\">{}</th>", escape(head));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for point in 0..plan.points.len() {
        let cells = cells(plan, outcome, point);
        let cells: Vec<String> = cells
            .iter()
            .map(|c| format!("<td>{}</td>", escape(c)))
            .collect();
        let _ = writeln!(page, "<tr>{}</tr>", cells.concat());
    }
    page.push_str("</tbody>\n</table>\n</div>\n");
    let _ = writeln!(page, "<p class=\"small\">{}</p>", escape(&explain(outcome)));
}

fn cells(plan: &Plan, outcome: &Outcome, point: usize) -> Vec<String> {
    let (e, p) = (&plan.experiment, &plan.points[point]);
    let method = p.method.map(|m| e.methods[m].label.clone());
    let axes = e
        .axes
        .iter()
        .zip(&p.settings)
        .map(|(a, v)| a.settings[*v].label.clone());
    let mut cells: Vec<String> = method.into_iter().chain(axes).collect();
    let ends: Vec<_> = outcome.ends(plan, point).collect();
    let average = |value: fn(&crate::LogPoint) -> f64| {
        mean(&ends.iter().map(|e| value(e)).collect::<Vec<f64>>()).map(|m| m.mean)
    };
    cells.push(ends.len().to_string());
    cells.push(average(|e| e.samples as f64).map_or("–".into(), |n| grouped(n as u64)));
    cells.push(average(|e| e.seconds).map_or("–".into(), duration));
    cells.push(average(|e| e.rays as f64).map_or("–".into(), |n| grouped(n as u64)));
    cells.extend(e.metrics.iter().map(|metric: &Metric| {
        let found = mean(&outcome.errors(plan, point, *metric));
        found.map_or("–".into(), |m| words::interval(&m))
    }));
    cells.push(average(|e| e.rejected as f64).map_or("–".into(), |n| grouped(n as u64)));
    cells
}

/// What the numbers of the table are.
fn explain(outcome: &Outcome) -> String {
    let mut text = String::from(
        "Seconds are those of integration alone. Several seeds: the mean, ± half of its 95 % interval \
         by Student's t.",
    );
    let source = outcome
        .done
        .first()
        .and_then(|d| d.log.last())
        .map(|l| l.error_source);
    text += match source {
        Some(ErrorSource::Reference) => {
            " Errors are against the reference, less the reference's own where it is known (relMSE and \
             MSE)."
        }
        _ => {
            " There is no reference: errors are the pictures' own estimates from the variance of \
             their pixels, which know of noise only, not of bias."
        }
    };
    text
}

fn references(page: &mut String, plan: &Plan, outcome: &Outcome) {
    let points = 0..plan.points.len();
    let mut all: Vec<_> = points.filter_map(|p| outcome.reference(p)).collect();
    all.dedup_by(|a, b| a.facts.file == b.facts.file);
    if all.is_empty() {
        return;
    }
    page.push_str("<h2>Reference</h2>\n<ul>\n");
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
        let _ = writeln!(page, "<li>{}</li>", escape(&parts.join(", ")));
    }
    page.push_str("</ul>\n");
}

/// Text for HTML, in and out of attributes.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // HTML has no place for these, escaped or not.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_become_markup() {
        assert_eq!(
            escape("<img src=x onerror='a()'> & \"q\"\u{1b}"),
            "&lt;img src=x onerror=&#39;a()&#39;&gt; &amp; &quot;q&quot;\u{fffd}"
        );
    }
}
