//! The report of an examination: lines, JSON and a page.

use super::found::{BrightSample, Condition, Health, Kurtosis, Paths, Rejected};
use super::words::{condition, details, example, lines, percent, subject, summary};
use crate::report::{repeat, words::number};
use Column::{Number, Text};
use serde::Serialize;
use sr_experiment::report::{Page, Scripts, data_uri, escape, section};
use sr_experiment::units::grouped;
use sr_experiment::{Machine, Scale};
use sr_film::png_bytes;
use std::fmt::Write;

const VERSION: u32 = 1;

/// What was examined, with what, and what came of it.
#[derive(Clone, Copy, Debug)]
pub struct SceneReport<'a> {
    /// The file.
    pub scene: &'a str,
    /// What was found.
    pub health: &'a Health,
    /// The command line.
    pub command: &'a str,
    /// The machine.
    pub machine: &'a Machine,
}

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    condition: Condition,
    summary: String,
    scene: &'a str,
    health: &'a Health,
    command: &'a str,
    machine: &'a Machine,
}

/// Cells of a table, as HTML.
type Row = Vec<String>;

impl SceneReport<'_> {
    /// For a terminal.
    pub fn lines(&self) -> Vec<String> {
        let heading = format!("{}: {}", self.scene, subject(self.health));
        let found = lines(self.health);
        std::iter::once(heading).chain(found).collect()
    }

    /// What came of it, in a sentence.
    pub fn summary(&self) -> String {
        summary(self.health)
    }

    /// As JSON. What is not finite is `null` there.
    ///
    /// # Errors
    /// Numbers that JSON cannot hold.
    pub fn json(&self) -> Result<String, String> {
        let document = Document {
            version: VERSION,
            condition: self.health.condition(),
            summary: self.summary(),
            scene: self.scene,
            health: self.health,
            command: self.command,
            machine: self.machine,
        };
        serde_json::to_string_pretty(&document).map_err(|e| format!("cannot write JSON: {e}"))
    }

    /// The whole file.
    ///
    /// # Errors
    /// A picture that cannot be encoded.
    pub fn html(&self) -> Result<String, String> {
        let h = self.health;
        let mut sections = vec![("findings", "Findings", self.findings())];
        if h.rejected.count > 0 {
            sections.push(("rejected", "Rejected samples", rejected(&h.rejected)));
        }
        let worst = &h.brightest.worst;
        if !worst.is_empty() {
            sections.push(("brightest", "The brightest samples", brightest(worst)));
        }
        sections.push(("kurtosis", "Kurtosis of pixels", kurtosis(h)?));
        if let Some(paths) = &h.paths {
            sections.push(("paths", "How paths ended", ends(paths)));
            sections.push(("light", "Light by bounces", light(paths)));
        }
        let again = repeat(self.command, self.machine);
        sections.push(("repeat", "To repeat it", again));
        let page = Page {
            title: &format!("Health of {}", self.scene),
            note: "What the samples of one scene look like, one by one: whether the film takes them, how much of the light is in \
                   few of them, how uneven those of a pixel are, and how paths ended.",
            links: sections.iter().map(|(id, name, _)| (*id, *name)).collect(),
            body: sections
                .iter()
                .map(|(id, name, body)| section(id, name, body))
                .collect(),
            scripts: Scripts::Plain,
            data: Vec::new(),
            planes: &[],
        };
        Ok(page.html())
    }

    fn findings(&self) -> String {
        let health = self.health;
        let won = match health.condition() {
            Condition::Ok => " won",
            Condition::Look | Condition::Broken => "",
        };
        let mut text = format!(
            "<p class=\"verdict{won}\">{}.</p>\n<p>{}</p>\n<div class=\"wide\"><table>\n<tbody>\n",
            escape(&self.summary()),
            escape(&subject(health)),
        );
        for f in &health.findings {
            let class = match f.condition {
                Condition::Ok => "good",
                Condition::Look => "text",
                Condition::Broken => "bad",
            };
            let advice = f.advice.iter().map(|a| escape(a));
            let details = details(health, f).into_iter().map(|d| escape(&d));
            let command = example(health, f).map(|c| format!("<code>{}</code>", escape(c)));
            let below: Vec<String> = advice.chain(details).chain(command).collect();
            let _ = writeln!(
                text,
                "<tr><td class=\"{class}\">{}</td><td class=\"text\">{}</td><td class=\"text\">{}<br><span class=\"small\">{}</span></td></tr>",
                condition(f.condition),
                f.name,
                escape(&f.text),
                below.join("<br>"),
            );
        }
        text += "</tbody></table></div>\n";
        for why in &health.left_out {
            let _ = writeln!(text, "<p class=\"note\">Left out: {}.</p>", escape(why));
        }
        text
    }
}

/// A column of a table.
enum Column {
    Number(&'static str),
    Text(&'static str),
}

fn table(columns: &[Column], rows: impl IntoIterator<Item = Row>) -> String {
    let cell = |tag: &str, column: &Column, text: &str| match column {
        Number(_) => format!("<{tag}>{text}</{tag}>"),
        Text(_) => format!("<{tag} class=\"text\">{text}</{tag}>"),
    };
    let heading = |column: &Column| match column {
        Number(name) | Text(name) => cell("th", column, name),
    };
    let head: String = columns.iter().map(heading).collect();
    let mut text = format!(
        "<div class=\"wide\"><table class=\"sortable\">\n<thead><tr>{head}</tr></thead>\n<tbody>\n"
    );
    for row in rows {
        let cells = columns.iter().zip(&row);
        let cells: String = cells.map(|(column, c)| cell("td", column, c)).collect();
        let _ = writeln!(text, "<tr>{cells}</tr>");
    }
    text + "</tbody></table></div>\n"
}

/// Text that may be missing.
fn maybe(text: &Option<String>) -> String {
    text.as_deref().map_or_else(String::new, escape)
}

fn command(replay: &Option<String>, otherwise: &str) -> String {
    format!(
        "<code>{}</code>",
        escape(replay.as_deref().unwrap_or(otherwise))
    )
}

fn rejected(rejected: &Rejected) -> String {
    let head = [
        Number("samples"),
        Text("cause"),
        Number("bounces"),
        Text("material"),
        Text("first wrong"),
        Text("example"),
    ];
    let rows = rejected.kinds.iter().map(|k| {
        let defect = k.first_defect.as_ref();
        vec![
            grouped(k.count),
            escape(&k.cause),
            k.bounces.to_string(),
            maybe(&k.material),
            defect.map_or_else(String::new, |d| {
                format!("{}, at vertex {}", escape(&d.what), d.vertex)
            }),
            command(&k.replay, &k.example),
        ]
    });
    table(&head, rows)
}

fn brightest(worst: &[BrightSample]) -> String {
    let head = [
        Number("luminance"),
        Number("of its pixel"),
        Text("light"),
        Text("way"),
        Text("example"),
    ];
    let rows = worst.iter().map(|b| {
        vec![
            number(b.luminance),
            percent(b.of_pixel),
            b.kind.map_or("", |k| k.describe()).to_owned(),
            maybe(&b.route),
            command(&b.replay, &b.example),
        ]
    });
    table(&head, rows)
}

fn kurtosis(health: &Health) -> Result<String, String> {
    let Kurtosis { pixels, worst, .. } = &health.kurtosis;
    let most = health.samples as f32;
    let png = png_bytes(&health.map.false_colour(Scale::Log(1.0, most)))?;
    let mut text = format!(
        "<figure>\n<img style=\"width: {}px; image-rendering: pixelated\" alt=\"kurtosis of each pixel\" src=\"{}\">\n<figcaption>\
         From 1 (black) to {} (light yellow, where one sample is unlike all others) on a logarithmic scale; 3 is noise of normal \
         shape; green pixels have no noise. {} pixels have some.</figcaption>\n</figure>\n",
        health.size[0].clamp(320, 960),
        data_uri("image/png", &png),
        health.samples,
        grouped(*pixels),
    );
    let rows = worst.iter().map(|p| {
        vec![
            format!("{},{}", p.pixel[0], p.pixel[1]),
            number(p.kurtosis),
            number(p.mean),
        ]
    });
    text += &table(
        &[Text("pixel"), Number("kurtosis"), Number("mean luminance")],
        rows,
    );
    Ok(text)
}

fn ends(paths: &Paths) -> String {
    let head = [
        Text("why"),
        Number("paths"),
        Number("of all"),
        Number("throughput left"),
        Number("bounces"),
    ];
    let rows = paths.ends.iter().map(|e| {
        vec![
            escape(e.text),
            grouped(e.count),
            percent(e.share),
            percent(e.throughput),
            number(e.mean_bounces),
        ]
    });
    table(&head, rows)
}

fn light(paths: &Paths) -> String {
    let row = |l: &super::found::BounceLight| vec![l.bounces.to_string(), percent(l.share)];
    table(
        &[Number("bounces"), Number("of all light")],
        paths.light.iter().map(row),
    )
}
