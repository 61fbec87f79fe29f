//! The usual strip of a paper: a picture with marked parts, then the parts by contender with their
//! errors below, the reference last. As files, on the page, and for LaTeX ([`super::tex`]).

use super::markup::{data_uri, escape};
use super::palette::colour;
use super::tex;
use crate::analysis::{Analysis, Group};
use crate::folder::{FIGURE, Folder, TEX};
use crate::metrics::{PixelError, Scale, error_map};
use crate::pictures::{cut, enlarged};
use crate::plan::Plan;
use crate::run::{Outcome, write_text};
use crate::seen::tone_map;
use crate::stats::mean;
use crate::words;
use sr_film::{DisplayImage, Image, develop, png_bytes, read_image, write_atomically};
use sr_pipeline::settings::PostSettings;
use std::fmt::Write;

/// Ends of the colours of error crops: (x − r)² / (r² + offset), magma over the logarithm.
pub(super) const ERRORS: [f32; 2] = [1e-4, 1.0];
/// Pixels that a crop and a whole picture have at least, so that readers of PDF do not blur them.
const CROP_WIDTH: u32 = 240;
const WHOLE_WIDTH: u32 = 800;

/// The strip of one group.
pub(super) struct Strip {
    pub heading: String,
    /// The marked picture, when parts of it are shown.
    pub whole: Option<File>,
    /// Contenders, and the reference last.
    pub columns: Vec<Column>,
}

/// What one contender shows.
pub(super) struct Column {
    pub label: String,
    /// Its metrics, a text each: `relMSE 0.031`.
    pub errors: Vec<String>,
    pub crops: Vec<File>,
    /// Of the same parts; none for the reference.
    pub maps: Vec<File>,
}

/// A picture that was written.
pub(super) struct File {
    /// Relative to the experiment's folder; letters of ASCII, digits, hyphens.
    pub name: String,
    png: Vec<u8>,
}

/// Writes `figure/` and `figure.tex`, and gives the page's part; empty without pictures.
pub(super) fn write(
    plan: &Plan,
    outcome: &Outcome,
    analysis: &Analysis,
    folder: &Folder,
) -> Result<String, String> {
    folder.make_figure()?;
    let mut strips = Vec::new();
    for (number, group) in analysis.groups.iter().enumerate() {
        let prefix = format!("{FIGURE}/{}", number + 1);
        strips.extend(strip(plan, outcome, group, &prefix, folder)?);
    }
    write_text(&folder.file(TEX), &tex::document(plan, &strips))?;
    let shown = strips.iter().filter(|s| s.whole.is_some());
    Ok(shown.map(html).collect())
}

fn strip(
    plan: &Plan,
    outcome: &Outcome,
    group: &Group,
    prefix: &str,
    folder: &Folder,
) -> Result<Option<Strip>, String> {
    let mut columns = Vec::new();
    let mut last = None;
    for (place, contender) in group.contenders.iter().enumerate() {
        let point = contender.point;
        let Some(done) = outcome.shown(plan, point) else {
            continue;
        };
        let path = folder.run(&plan.runs[done.run].id, ".exr");
        let image = read_image(&path).map_err(|e| e.to_string())?;
        let reference = outcome.reference(point).cloned();
        let name = format!("{prefix}-{}-{}", place + 1, ascii(&contender.label));
        let part = Part::new(plan, point, &name, folder);
        columns.push(Column {
            label: contender.label.clone(),
            errors: errors(plan, outcome, point),
            crops: part.crops(&image)?,
            maps: match &reference {
                Some(reference) => part.maps(&image, &reference.image)?,
                None => Vec::new(),
            },
        });
        last = Some((point, image, reference));
    }
    let Some((point, image, reference)) = last else {
        return Ok(None);
    };
    if let Some(reference) = &reference {
        let name = format!("{prefix}-reference");
        let part = Part::new(plan, point, &name, folder);
        columns.push(Column {
            label: "reference".into(),
            errors: Vec::new(),
            crops: part.crops(&reference.image)?,
            maps: Vec::new(),
        });
    }
    let image = reference.as_ref().map_or(&image, |r| &r.image);
    let name = format!("{prefix}-whole");
    let whole = Part::new(plan, point, &name, folder);
    Ok(Some(Strip {
        heading: group.heading.clone(),
        whole: match plan.experiment.show.insets.is_empty() {
            true => None,
            false => Some(whole.marked(image)?),
        },
        columns,
    }))
}

fn errors(plan: &Plan, outcome: &Outcome, point: usize) -> Vec<String> {
    let text = |metric: &crate::Metric| {
        let found = mean(&outcome.errors(plan, point, *metric))?;
        Some(format!("{} {}", metric.title(), words::interval(&found)))
    };
    plan.experiment.metrics.iter().filter_map(text).collect()
}

/// Letters that every TeX and every file system takes.
fn ascii(label: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let text: String = label.chars().take(40).map(plain).collect();
    text.trim_matches('-').to_owned()
}

/// Parts of one picture on their way into files.
struct Part<'a> {
    /// What is cut out; nothing means the whole picture.
    insets: &'a [[u32; 4]],
    post: &'a PostSettings,
    name: &'a str,
    folder: &'a Folder,
}

impl<'a> Part<'a> {
    fn new(plan: &'a Plan, point: usize, name: &'a str, folder: &'a Folder) -> Self {
        Self {
            insets: &plan.experiment.show.insets,
            post: &plan.facts[point].post,
            name,
            folder,
        }
    }

    fn crops(&self, image: &Image) -> Result<Vec<File>, String> {
        self.cut(&self.developed(image), "")
    }

    fn maps(&self, image: &Image, reference: &Image) -> Result<Vec<File>, String> {
        let map = error_map(image, reference, PixelError::SquaredRelative);
        let map = map.map_err(|e| e.to_string())?;
        self.cut(
            &map.false_colour(Scale::Log(ERRORS[0], ERRORS[1])),
            "-error",
        )
    }

    fn developed(&self, image: &Image) -> DisplayImage {
        develop(image, self.post.exposure, tone_map(self.post))
    }

    fn cut(&self, image: &DisplayImage, end: &str) -> Result<Vec<File>, String> {
        let whole = [[0, 0, image.width, image.height]];
        let insets = if self.insets.is_empty() {
            &whole
        } else {
            self.insets
        };
        let insets = insets.iter().enumerate();
        insets
            .map(|(i, inset)| {
                let part = grown(&cut(image, *inset), CROP_WIDTH);
                self.file(&format!("-inset{}{end}.png", i + 1), &part)
            })
            .collect()
    }

    /// The whole picture, each part in a frame of its colour.
    fn marked(&self, image: &Image) -> Result<File, String> {
        let mut picture = grown(&self.developed(image), WHOLE_WIDTH);
        let factor = picture.width / image.width;
        let line = (picture.width / 200).max(1);
        for (i, inset) in self.insets.iter().enumerate() {
            frame(&mut picture, inset.map(|v| v * factor), line, colour(i));
        }
        self.file(".png", &picture)
    }

    fn file(&self, end: &str, image: &DisplayImage) -> Result<File, String> {
        let name = format!("{}{end}", self.name);
        let path = self.folder.file(&name);
        let png = png_bytes(image).map_err(|e| format!("{}: {e}", path.display()))?;
        let written = write_atomically(&path, |file| {
            use std::io::Write;
            file.write_all(&png)
                .map_err(|source| sr_film::ImageError::Io {
                    path: path.clone(),
                    source,
                })
        });
        written.map_err(|e| e.to_string())?;
        Ok(File { name, png })
    }
}

/// At least `width` wide, by a whole factor.
fn grown(image: &DisplayImage, width: u32) -> DisplayImage {
    enlarged(image, width.div_ceil(image.width.max(1)))
}

/// A frame just inside of x0, y0, x1, y1.
fn frame(image: &mut DisplayImage, [x0, y0, x1, y1]: [u32; 4], line: u32, colour: [u8; 3]) {
    for y in y0..y1.min(image.height) {
        for x in x0..x1.min(image.width) {
            let depth = (x - x0).min(y - y0).min(x1 - 1 - x).min(y1 - 1 - y);
            if depth < line {
                image.pixels[(y * image.width + x) as usize] = colour;
            }
        }
    }
}

fn html(strip: &Strip) -> String {
    let mut text = String::new();
    if !strip.heading.is_empty() {
        let _ = writeln!(text, "<h3>{}</h3>", escape(&strip.heading));
    }
    let picture = |file: &File, alt: &str| {
        let uri = data_uri("image/png", &file.png);
        format!("<img alt=\"{}\" src=\"{uri}\">", escape(alt))
    };
    text.push_str("<div class=\"strip\">\n");
    if let Some(whole) = &strip.whole {
        let img = picture(whole, "the whole picture, its parts marked");
        let _ = writeln!(text, "<div class=\"whole\">{img}</div>");
    }
    text.push_str("<div class=\"wide\">\n<table class=\"crops\">\n<tbody>\n");
    let parts = strip.columns.first().map_or(0, |c| c.crops.len());
    for part in 0..parts {
        let [r, g, b] = colour(part);
        let style = format!("style=\"--frame: rgb({r} {g} {b})\"");
        let row = |files: fn(&Column) -> &[File]| {
            let cells = strip.columns.iter().map(|c| match files(c).get(part) {
                Some(file) => format!("<td>{}</td>", picture(file, &c.label)),
                None => "<td></td>".to_owned(),
            });
            cells.collect::<String>()
        };
        let _ = writeln!(text, "<tr {style}>{}</tr>", row(|c| &c.crops));
        if strip.columns.iter().any(|c| !c.maps.is_empty()) {
            let _ = writeln!(text, "<tr class=\"errors\">{}</tr>", row(|c| &c.maps));
        }
    }
    let names = strip.columns.iter().map(|c| {
        let errors: String = c
            .errors
            .iter()
            .map(|e| format!("<br>{}", escape(e)))
            .collect();
        format!(
            "<th scope=\"col\">{}<span>{errors}</span></th>",
            escape(&c.label)
        )
    });
    let _ = writeln!(text, "<tr>{}</tr>", names.collect::<String>());
    text + "</tbody>\n</table>\n</div>\n</div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_lies_inside_of_its_part() {
        let mut image = DisplayImage {
            width: 8,
            height: 6,
            pixels: vec![[0; 3]; 48],
        };
        frame(&mut image, [1, 1, 6, 5], 1, [9; 3]);
        let inked = |x: usize, y: usize| image.pixels[8 * y + x] == [9; 3];
        let border = (1..6).all(|x| inked(x, 1) && inked(x, 4))
            && (1..5).all(|y| inked(1, y) && inked(5, y));
        assert!(border);
        assert_eq!(image.pixels.iter().filter(|p| **p == [9; 3]).count(), 14);
    }

    #[test]
    fn names_of_files_are_plain() {
        assert_eq!(ascii("light, α = 0.5 %"), "light------0-5");
        assert_eq!(ascii("äß"), "");
    }
}
