//! The plots on the page: a place for the script's, with the drawn one in it until then.

use super::markup::escape;
use super::panel::Panel;
use super::svg::inline;
use std::fmt::Write;

/// The section's contents: a block a group and metric, time beside samples.
pub(super) fn plots(panels: &[Panel], svgs: &[String]) -> String {
    let mut text = String::new();
    let mut heading: Option<&str> = None;
    let all: Vec<(usize, (&Panel, &String))> = panels.iter().zip(svgs).enumerate().collect();
    for block in all.chunk_by(|(_, (a, _)), (_, (b, _))| (a.group, a.metric) == (b.group, b.metric))
    {
        let first = block[0].1.0;
        if !first.heading.is_empty() && heading != Some(&first.heading) {
            heading = Some(&first.heading);
            let _ = writeln!(text, "<h3>{}</h3>", escape(&first.heading));
        }
        text.push_str("<div class=\"plots\">\n");
        for (number, (panel, svg)) in block {
            let id = &panel.id;
            let title = format!("{} against {}", panel.metric, panel.x_title);
            let _ = writeln!(
                text,
                "<figure class=\"plot\" data-panel=\"{number}\">\n<figcaption>{} <span class=\"files\">\
                 <a href=\"plots/{id}.svg\">SVG</a> <a href=\"plots/{id}.png\">PNG</a> \
                 <a href=\"plots/{id}.csv\">CSV</a></span></figcaption>\n\
                 <div class=\"static\">{}</div>\n</figure>",
                escape(&title),
                inline(svg, &escape(&title)),
            );
        }
        text.push_str("</div>\n");
    }
    text
}
