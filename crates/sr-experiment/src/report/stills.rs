//! The pictures as they are, with captions: for paper, and where no script runs.

use super::markup::{data_uri, escape};
use crate::folder::Folder;
use crate::grid::groups;
use crate::pictures::{self, Picture};
use crate::plan::Plan;
use crate::run::Outcome;
use crate::words;
use std::fmt::Write;

/// Every point's picture with what stands beside it.
pub(super) fn stills(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Result<String, String> {
    let (groups, columns) = groups(plan);
    let mut text = String::new();
    for group in &groups {
        if !group.heading.is_empty() {
            let _ = writeln!(text, "<h3>{}</h3>", escape(&group.heading));
        }
        let _ = writeln!(text, "<div class=\"grid\" style=\"--columns: {columns}\">");
        for (labels, point) in &group.cells {
            let caption = words::caption(plan, outcome, *point, labels);
            let pictures = pictures::of_point(plan, outcome, *point, folder);
            figure(&mut text, &pictures, &caption)?;
        }
        text.push_str("</div>\n");
    }
    Ok(text)
}

/// Attached pictures; empty when there are none.
pub(super) fn attached(plan: &Plan) -> Result<String, String> {
    let attached = pictures::attached(plan);
    if attached.is_empty() {
        return Ok(String::new());
    }
    let mut text = String::from("<div class=\"grid\" style=\"--columns: 2\">\n");
    for (picture, caption) in attached {
        figure(&mut text, &[picture], &[caption])?;
    }
    Ok(text + "</div>\n")
}

fn figure(text: &mut String, pictures: &[Picture], caption: &[String]) -> Result<(), String> {
    text.push_str("<figure>\n<div class=\"pictures\">");
    for picture in pictures {
        let _ = write!(
            text,
            "<img alt=\"{}\" title=\"{}\" src=\"{}\">",
            escape(&caption.join(", ")),
            escape(&picture.what),
            data_uri("image/png", &picture.png()?),
        );
    }
    let lines: Vec<String> = caption.iter().map(|l| escape(l)).collect();
    let _ = writeln!(
        text,
        "</div>\n<figcaption>{}</figcaption>\n</figure>",
        lines.join("<br>")
    );
    Ok(())
}

/// Folded up once the viewer shows them.
pub(super) fn folded(stills: &str) -> String {
    format!(
        "<details id=\"stills\" open>\n<summary>All pictures as they were developed</summary>\n{stills}</details>\n"
    )
}
