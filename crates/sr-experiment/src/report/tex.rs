//! `figure.tex`: the strips for LaTeX, with graphicx and tabular alone.

use super::figure::{ERRORS, Strip};
use crate::folder::TEX;
use crate::plan::Plan;
use std::fmt::Write;

/// The whole file: a figure a strip.
pub(super) fn document(plan: &Plan, strips: &[Strip]) -> String {
    let e = &plan.experiment;
    let mut text = format!(
        "% Made by Steradian {}. Needs \\usepackage{{graphicx}}; paths are relative to this file's folder:\n\
         % \\graphicspath{{{{path/to/this/folder/}}}}, then \\input{{path/to/this/folder/{TEX}}}.\n",
        env!("CARGO_PKG_VERSION"),
    );
    for strip in strips {
        figure(&mut text, strip, &e.title);
    }
    text
}

fn figure(text: &mut String, strip: &Strip, title: &str) {
    let columns = strip.columns.len().max(1);
    let parts = strip.columns.first().map_or(0, |c| c.crops.len());
    // What the marked picture leaves; a little of each column is its gap.
    let whole = if strip.whole.is_some() { 0.32 } else { 0.0 };
    let width = (0.985 - whole) / columns as f64 - 0.005;
    text.push_str("\\begin{figure*}\n  \\centering\\footnotesize\n  \\setlength{\\tabcolsep}{0.0025\\linewidth}%\n");
    if let Some(file) = &strip.whole {
        let _ = writeln!(
            text,
            "  \\begin{{tabular}}{{@{{}}c@{{}}}}\n    \\includegraphics[width={whole}\\linewidth]{{{}}}\n  \\end{{tabular}}%",
            file.name
        );
    }
    let _ = writeln!(text, "  \\begin{{tabular}}{{{}}}", "c".repeat(columns));
    let cell = |name: &str| format!("\\includegraphics[width={width:.4}\\linewidth]{{{name}}}");
    for part in 0..parts {
        let crops = strip.columns.iter().map(|c| c.crops.get(part));
        row(
            text,
            crops.map(|f| f.map_or_else(String::new, |f| cell(&f.name))),
        );
        if strip.columns.iter().any(|c| !c.maps.is_empty()) {
            let maps = strip.columns.iter().map(|c| c.maps.get(part));
            row(
                text,
                maps.map(|f| f.map_or_else(String::new, |f| cell(&f.name))),
            );
        }
    }
    row(text, strip.columns.iter().map(|c| escape(&c.label)));
    let metrics = strip
        .columns
        .iter()
        .map(|c| c.errors.len())
        .max()
        .unwrap_or(0);
    for metric in 0..metrics {
        let errors = strip.columns.iter().map(|c| c.errors.get(metric));
        row(
            text,
            errors.map(|e| e.map_or_else(String::new, |e| escape(e))),
        );
    }
    let mut caption = escape(title);
    if !strip.heading.is_empty() {
        let _ = write!(caption, ", {}", escape(&strip.heading));
    }
    let mapped = strip.columns.iter().any(|c| !c.maps.is_empty());
    if mapped {
        let [low, high] = ERRORS;
        let _ = write!(
            caption,
            ". Below each picture its squared relative error, from {low} (black) to {high} (yellow)"
        );
    }
    let _ = writeln!(
        text,
        "  \\end{{tabular}}\n  \\caption{{{caption}.}}\n\\end{{figure*}}"
    );
}

fn row(text: &mut String, cells: impl Iterator<Item = String>) {
    let cells: Vec<String> = cells.collect();
    let _ = writeln!(text, "    {} \\\\", cells.join(" & "));
}

/// Text as it reads. Letters beyond ASCII are left to LaTeX, which takes UTF-8; the signs and Greek
/// letters that captions have become mathematics, since not every font has them.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '|' => out.push_str("\\textbar{}"),
            '"' => out.push_str("''"),
            '{' | '}' | '$' | '&' | '#' | '_' | '%' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            '−' => out.push_str("$-$"),
            '–' => out.push_str("--"),
            '²' => out.push_str("$^2$"),
            '°' => out.push_str("$^\\circ$"),
            c => match SIGNS.iter().find(|(sign, _)| *sign == c) {
                Some((_, command)) => {
                    let _ = write!(out, "$\\{command}$");
                }
                None => out.push(c),
            },
        }
    }
    out
}

const SIGNS: [(char, &str); 20] = [
    ('×', "times"),
    ('±', "pm"),
    ('≈', "approx"),
    ('·', "cdot"),
    ('≤', "le"),
    ('≥', "ge"),
    ('→', "to"),
    ('∞', "infty"),
    ('…', "ldots"),
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('η', "eta"),
    ('θ', "theta"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('σ', "sigma"),
    ('φ', "phi"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_text_to_tex() {
        assert_eq!(
            escape("50 % of {a_b} & $x^2$ # \\input ~"),
            "50 \\% of \\{a\\_b\\} \\& \\$x\\textasciicircum{}2\\$ \\# \\textbackslash{}input \\textasciitilde{}"
        );
        assert_eq!(
            escape("α ≈ 3 ± 1 ×\n"),
            "$\\alpha$ $\\approx$ 3 $\\pm$ 1 $\\times$ "
        );
        assert_eq!(escape("é"), "é");
    }
}
