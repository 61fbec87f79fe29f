//! A plot's SVG as a part of the page: in the page's ink, so that it reads on dark paper too.

use super::plot::{GRID, INK};
use plotters::style::RGBColor;

/// The file without what only a file needs; black, grey and white become variables of the page.
pub fn inline(svg: &str, label: &str) -> String {
    let start = svg.find("<svg").unwrap_or(0);
    let text = svg[start..].replacen(
        "<svg ",
        &format!("<svg role=\"img\" aria-label=\"{label}\" "),
        1,
    );
    // Inside of a page an SVG needs no name of its language.
    let text = text.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    let colours = [
        (code(INK), "currentColor"),
        (code(GRID), "var(--line)"),
        ("#FFFFFF".to_owned(), "none"),
    ];
    let quoted = |colour: &str| format!("\"{colour}\"");
    colours.iter().fold(text, |text, (from, to)| {
        text.replace(&quoted(from), &quoted(to))
    })
}

/// As plotters writes a colour.
fn code(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_has_the_pages_ink() {
        let file = "<?xml?><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2\"><rect fill=\"#FFFFFF\"/><text fill=\"#111112\"/><line stroke=\"#DEDEDF\"/></svg>";
        assert_eq!(
            inline(file, "x"),
            "<svg role=\"img\" aria-label=\"x\" width=\"2\"><rect fill=\"none\"/><text fill=\"currentColor\"/><line stroke=\"var(--line)\"/></svg>"
        );
    }
}
