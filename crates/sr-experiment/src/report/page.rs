//! The frame of the page: head, header, sections, data and scripts, all in one file.

use super::markup::escape;
use std::fmt::Write;

const STYLE: &str = include_str!("../../assets/report.css");
const PLOT_STYLE: &str = include_str!("../../assets/uplot/uPlot.min.css");
const PLOT_SCRIPT: &str = include_str!("../../assets/uplot/uPlot.iife.min.js");
const PLOT_LICENSE: &str = include_str!("../../assets/uplot/LICENSE");

/// In the order in which they need one another.
const SCRIPTS: [&str; 13] = [
    include_str!("../../assets/base.js"),
    include_str!("../../assets/theme.js"),
    include_str!("../../assets/tables.js"),
    include_str!("../../assets/plots.js"),
    include_str!("../../assets/viewer/data.js"),
    include_str!("../../assets/viewer/colour.js"),
    include_str!("../../assets/viewer/maps.js"),
    include_str!("../../assets/viewer/camera.js"),
    include_str!("../../assets/viewer/panes.js"),
    include_str!("../../assets/viewer/readout.js"),
    include_str!("../../assets/viewer/controls.js"),
    include_str!("../../assets/viewer/keys.js"),
    include_str!("../../assets/start.js"),
];

/// Of them those that a page without pictures and live plots needs, and its beginning.
const PLAIN: [&str; 4] = [
    include_str!("../../assets/base.js"),
    include_str!("../../assets/theme.js"),
    include_str!("../../assets/tables.js"),
    include_str!("../../assets/plain.js"),
];

/// What a page does beside being read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scripts {
    /// Colours and tables.
    Plain,
    /// Plots with values and the viewer of pictures, too.
    All,
}

/// What makes a page.
pub struct Page<'a> {
    /// Its heading.
    pub title: &'a str,
    /// Paragraphs between empty lines.
    pub note: &'a str,
    /// Name and heading of each section.
    pub links: Vec<(&'a str, &'a str)>,
    /// The sections.
    pub body: String,
    /// What it does.
    pub scripts: Scripts,
    /// JSON by the name of its element.
    pub data: Vec<(&'a str, String)>,
    /// Planes of pictures as text.
    pub planes: &'a [String],
}

impl Page<'_> {
    /// The whole file.
    pub fn html(&self) -> String {
        let title = escape(self.title);
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <title>{title}</title>\n<style>\n{PLOT_STYLE}{STYLE}</style>\n</head>\n<body>\n\
             <header>\n<h1>{title}</h1>\n<nav>"
        );
        for (id, heading) in &self.links {
            let _ = write!(page, "<a href=\"#{id}\">{}</a>", escape(heading));
        }
        page.push_str("</nav>\n</header>\n<main>\n");
        for paragraph in self.note.split("\n\n").filter(|p| !p.trim().is_empty()) {
            let _ = writeln!(page, "<p class=\"note\">{}</p>", escape(paragraph.trim()));
        }
        page += &self.body;
        let version = env!("CARGO_PKG_VERSION");
        let _ = writeln!(
            page,
            "</main>\n<footer>Made by Steradian {version}</footer>"
        );
        for (id, json) in &self.data {
            let _ = writeln!(
                page,
                "<script type=\"application/json\" id=\"{id}\">{json}</script>"
            );
        }
        for (number, plane) in self.planes.iter().enumerate() {
            let _ = writeln!(
                page,
                "<script type=\"text/plain\" id=\"plane-{number}\">{plane}</script>"
            );
        }
        if self.scripts == Scripts::All {
            let _ = write!(
                page,
                "<script>\n/*\n{PLOT_LICENSE}*/\n{PLOT_SCRIPT}</script>\n"
            );
        }
        page.push_str("<script>\n(() => {\n\"use strict\";\n");
        let scripts: &[&str] = match self.scripts {
            Scripts::Plain => &PLAIN,
            Scripts::All => &SCRIPTS,
        };
        scripts.iter().for_each(|script| page.push_str(script));
        page + "})();\n</script>\n</body>\n</html>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A script must not end its element, and a page must not ask for anything.
    #[test]
    fn assets_stay_inside_and_load_nothing() {
        for text in SCRIPTS
            .into_iter()
            .chain(PLAIN)
            .chain([PLOT_SCRIPT, STYLE, PLOT_STYLE])
        {
            assert!(!text.contains("</"), "{}", &text[..80]);
            for word in ["@import", "fetch(", "XMLHttpRequest", "url(", "import("] {
                assert!(!text.contains(word), "{word} in {}", &text[..80]);
            }
        }
    }
}
