//! The report of a check: one page with a table of verdicts and a plot for each sweep.

mod json;
mod plot;
pub mod words;

use crate::{Checked, Sweep, Verdict};
use sr_experiment::Machine;
use sr_experiment::report::{Page, Scripts, escape, section};
use sr_experiment::units::{counted, duration};
use std::fmt::Write;

/// What was checked, with what, and what came of it.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The suites, in order.
    pub checked: &'a [Checked],
    /// The command line.
    pub command: &'a str,
    /// The machine.
    pub machine: &'a Machine,
}

impl Report<'_> {
    /// How many sweeps there are of a verdict.
    fn count(&self, verdict: Verdict) -> usize {
        let sweeps = self.checked.iter().flat_map(|c| &c.sweeps);
        sweeps.filter(|s| s.verdict() == verdict).count()
    }

    /// The worst of all.
    pub fn verdict(&self) -> Verdict {
        let all = self.checked.iter().map(Checked::verdict);
        all.max().unwrap_or(Verdict::Broken)
    }

    /// What came of it, in a sentence.
    pub fn summary(&self) -> String {
        let [holds, unclear, broken] =
            [Verdict::Holds, Verdict::Unclear, Verdict::Broken].map(|v| self.count(v) as u64);
        let seconds: f64 = self.checked.iter().map(|c| c.seconds).sum();
        let all = counted(holds + unclear + broken, "bound");
        let mut text = format!("{all} checked in {}: ", duration(seconds));
        text += &match (unclear, broken) {
            (0, 0) => "all hold".to_owned(),
            (0, n) => format!("{n} broken"),
            (n, 0) => format!("{n} unclear, none broken"),
            (u, b) => format!("{b} broken, {u} unclear"),
        };
        text
    }

    /// The whole file.
    ///
    /// # Errors
    /// A plot that cannot be drawn.
    pub fn html(&self) -> Result<String, String> {
        let mut sections = vec![("verdict".to_owned(), "Verdict".to_owned(), self.table())];
        for checked in self.checked {
            let body = suite(checked)?;
            sections.push((anchor(&checked.suite), checked.suite.clone(), body));
        }
        let repeat = repeat(self.command, self.machine);
        sections.push(("repeat".into(), "To repeat it".into(), repeat));
        let page = Page {
            title: "Numerical stability",
            note: "Error against stiffness: each plot drives one parameter from the easy to the extreme. The shaded range is \
                   what the bound (dashed) is promised for; outside of it the curve shows where the numbers end, and a red line \
                   where the bound first fails. Blue is what the renderer computes in f32, orange the same formulas in f64.",
            links: sections
                .iter()
                .map(|(id, heading, _)| (id.as_str(), heading.as_str()))
                .collect(),
            body: sections
                .iter()
                .map(|(id, heading, body)| section(id, heading, body))
                .collect(),
            scripts: Scripts::Plain,
            data: Vec::new(),
            planes: &[],
        };
        Ok(page.html())
    }

    /// The plots as SVG files, each with its name: `suite.sweep.svg`.
    ///
    /// # Errors
    /// A plot that cannot be drawn.
    pub fn plots(&self) -> Result<Vec<(String, String)>, String> {
        let mut all = Vec::new();
        for checked in self.checked {
            for sweep in &checked.sweeps {
                // Names of sweeps are words with underscores, those of suites may be paths.
                let name = format!("{}.{}.svg", anchor(&checked.suite), sweep.name);
                all.push((name, plot::svg(sweep)?));
            }
        }
        Ok(all)
    }

    fn table(&self) -> String {
        let won = match self.verdict() {
            Verdict::Holds => " won",
            Verdict::Unclear | Verdict::Broken => "",
        };
        let mut text = format!(
            "<p class=\"verdict{won}\">{}.</p>\n<div class=\"wide\"><table class=\"sortable\">\n<thead><tr><th>suite</th>\
             <th>sweep</th><th>verdict</th><th>largest error</th><th>bound</th><th>promised for</th><th>beyond</th></tr></thead>\n<tbody>\n",
            escape(&self.summary())
        );
        for checked in self.checked {
            for sweep in &checked.sweeps {
                text += &row(checked, sweep);
            }
        }
        text + "</tbody></table></div>\n"
    }
}

/// By what, how and where.
pub(crate) fn repeat(command: &str, machine: &Machine) -> String {
    format!(
        "<dl class=\"facts\">\n<dt>version</dt><dd><code>Steradian {}</code></dd>\n<dt>command</dt><dd><code>{}</code></dd>\n\
         <dt>machine</dt><dd><code>{}</code></dd>\n</dl>\n",
        env!("CARGO_PKG_VERSION"),
        escape(command),
        escape(&machine.to_string()),
    )
}

/// A name for links.
fn anchor(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    name.chars().map(letter).collect()
}

fn row(checked: &Checked, sweep: &Sweep) -> String {
    let verdict = sweep.verdict();
    let class = match verdict {
        Verdict::Holds => "good",
        Verdict::Unclear | Verdict::Broken => "bad",
    };
    let error = sweep.worst().map_or(f64::INFINITY, |p| p.error);
    format!(
        "<tr><td>{}</td><td><a href=\"#{}\">{}</a></td><td class=\"{class}\">{}</td><td data-value=\"{error:e}\">{}</td>\
         <td data-value=\"{:e}\">{}</td><td>{} {}</td><td>{}</td></tr>\n",
        escape(&checked.suite),
        anchor(&format!("{}-{}", checked.suite, sweep.name)),
        escape(&sweep.name),
        words::verdict(verdict),
        words::number(error),
        sweep.bound,
        words::number(sweep.bound),
        escape(&sweep.parameter),
        words::range(sweep),
        words::limit(sweep).unwrap_or_default(),
    )
}

/// A suite's sweeps, each with its plot.
fn suite(checked: &Checked) -> Result<String, String> {
    let mut text = format!(
        "<p>{} <span class=\"small\">{}</span></p>\n<div class=\"plots\">\n",
        escape(&checked.about),
        duration(checked.seconds)
    );
    for sweep in &checked.sweeps {
        let worst = sweep.worst().map_or_else(String::new, |p| {
            format!(
                "Largest error {} at {} {}: {}.",
                words::number(p.error),
                sweep.parameter,
                words::number(p.at),
                p.worst
            )
        });
        let _ = writeln!(
            text,
            "<figure class=\"plot\" id=\"{}\">\n<figcaption>{}: {}</figcaption>\n<p>{}</p>\n<div class=\"static\">{}</div>\n\
             <p class=\"small\">{}</p>\n</figure>",
            anchor(&format!("{}-{}", checked.suite, sweep.name)),
            escape(&sweep.name),
            words::verdict(sweep.verdict()),
            escape(&sweep.about),
            plot::plot(sweep)?,
            escape(&worst),
        );
    }
    Ok(text + "</div>\n")
}
