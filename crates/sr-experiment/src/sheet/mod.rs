//! `sheet.png`: all pictures of an experiment with their captions, readable as it is.

mod canvas;
mod text;

use crate::folder::Folder;
use crate::grid::groups;
use crate::pictures::{self, Picture};
use crate::plan::Plan;
use crate::run::Outcome;
use crate::words;
use canvas::{Canvas, fit};
use sr_film::DisplayImage;
use text::Face;

/// Pixels that the pictures of a row share, so that a sheet fits a screen.
const WIDTH: u32 = 1760;
/// A picture is shown no narrower: captions need the room.
const NARROWEST: u32 = 220;
/// And no wider.
const WIDEST: u32 = 560;
/// Between pictures, and around all.
const GAP: u32 = 16;
/// Grey of the text that matters, and of the rest.
const INK: [u8; 2] = [20, 90];

struct Faces {
    title: Face,
    head: Face,
    text: Face,
    caption: Face,
}

/// Something with its place.
enum Item {
    Text(usize, String, u8),
    Picture(DisplayImage),
}

/// What is drawn, with left and top.
#[derive(Default)]
struct Layout {
    items: Vec<(Item, u32, u32)>,
    width: u32,
    y: u32,
}

/// A picture with what stands beside it, side by side, and its caption.
struct Cell {
    pictures: Vec<DisplayImage>,
    caption: Vec<String>,
}

/// Draws the sheet.
pub(crate) fn draw(
    plan: &Plan,
    outcome: &Outcome,
    folder: &Folder,
) -> Result<DisplayImage, String> {
    let faces = Faces {
        title: Face::new(30.0, true)?,
        head: Face::new(21.0, true)?,
        text: Face::new(18.0, false)?,
        caption: Face::new(17.0, false)?,
    };
    let (groups, columns) = groups(plan);
    let columns = columns as u32;
    let cell = cell_width(plan, (WIDTH / columns).clamp(NARROWEST, WIDEST));
    let points = groups
        .iter()
        .flat_map(|g| &g.cells)
        .map(|(_, point)| *point);
    // Where one picture has another beside it, all are drawn as small, so that sizes compare.
    let beside = points.map(|p| pictures::of_point(plan, outcome, p, folder).len());
    let share = cell / (beside.max().unwrap_or(1) as u32).max(1);
    let mut layout = Layout {
        width: (columns * (cell + GAP) + GAP).max(2 * NARROWEST),
        y: GAP,
        ..Default::default()
    };
    layout.head(plan, outcome, &faces);
    for group in &groups {
        layout.y += GAP / 2;
        if !group.heading.is_empty() {
            layout.paragraph(&faces, HEAD, &group.heading, INK[0]);
        }
        let cells: Result<Vec<Cell>, String> = group
            .cells
            .iter()
            .map(|(labels, point)| {
                let pictures = pictures::of_point(plan, outcome, *point, folder);
                let caption = words::caption(plan, outcome, *point, labels);
                Cell::new(&pictures, caption, share)
            })
            .collect();
        layout.rows(&faces, cells?, columns, cell);
    }
    let attached = pictures::attached(plan);
    if !attached.is_empty() {
        let width = (layout.width - GAP) / 2 - GAP;
        let cells: Result<Vec<Cell>, String> = attached
            .into_iter()
            .map(|(picture, caption)| Cell::new(&[picture], vec![caption], width))
            .collect();
        layout.y += GAP / 2;
        layout.rows(&faces, cells?, 2, width);
    }
    Ok(layout.draw(&faces))
}

/// No wider than the widest picture becomes by a whole factor, so that no gap is left beside it.
fn cell_width(plan: &Plan, limit: u32) -> u32 {
    let crop = plan.experiment.show.crop.map(|[x0, _, x1, _]| x1 - x0);
    let widths = plan.facts.iter().map(|f| crop.unwrap_or(f.size[0]));
    match widths.max() {
        Some(widest) if widest > 0 && widest < limit => limit / widest * widest,
        _ => limit,
    }
    .max(NARROWEST)
}

const TITLE: usize = 0;
const HEAD: usize = 1;
const TEXT: usize = 2;
const CAPTION: usize = 3;

impl Faces {
    fn get(&self, face: usize) -> &Face {
        match face {
            TITLE => &self.title,
            HEAD => &self.head,
            TEXT => &self.text,
            _ => &self.caption,
        }
    }
}

impl Cell {
    /// Pictures side by side, none wider than `width`.
    fn new(pictures: &[Picture], caption: Vec<String>, width: u32) -> Result<Self, String> {
        let fitted = pictures
            .iter()
            .map(|p| Ok(fit(&p.display()?, width.max(1))));
        Ok(Self {
            pictures: fitted.collect::<Result<_, String>>()?,
            caption,
        })
    }
}

impl Layout {
    fn head(&mut self, plan: &Plan, outcome: &Outcome, faces: &Faces) {
        self.paragraph(faces, TITLE, &plan.experiment.title, INK[0]);
        if !plan.experiment.note.is_empty() {
            self.paragraph(faces, TEXT, &plan.experiment.note, INK[1]);
        }
        if outcome.done.len() < plan.runs.len() {
            let text = format!(
                "{} of {} runs are done.",
                outcome.done.len(),
                plan.runs.len()
            );
            self.paragraph(faces, TEXT, &text, INK[0]);
        }
        for warning in &outcome.warnings {
            self.paragraph(faces, TEXT, warning, INK[0]);
        }
    }

    /// Text over the whole width, or over as much of it as can be read comfortably.
    fn paragraph(&mut self, faces: &Faces, face: usize, text: &str, ink: u8) {
        const LONGEST_LINE: u32 = 1100;
        let width = (self.width - 2 * GAP).min(LONGEST_LINE);
        self.text(faces, face, text, [GAP, width], ink);
        self.y += GAP / 2;
    }

    fn text(&mut self, faces: &Faces, face: usize, text: &str, [x, width]: [u32; 2], ink: u8) {
        let typeface = faces.get(face);
        for line in typeface.wrap(text, width as f32) {
            self.items.push((Item::Text(face, line, ink), x, self.y));
            self.y += typeface.line();
        }
    }

    /// Cells from left to right, `columns` of them a row; captions below their pictures.
    fn rows(&mut self, faces: &Faces, cells: Vec<Cell>, columns: u32, width: u32) {
        let mut cells = cells.into_iter().peekable();
        while cells.peek().is_some() {
            let row: Vec<Cell> = cells.by_ref().take(columns as usize).collect();
            let heights = row.iter().flat_map(|c| c.pictures.iter().map(|p| p.height));
            let top = self.y;
            let below = top + heights.max().unwrap_or(0) + GAP / 4;
            let mut end = below;
            let places = (0..).map(|i| GAP + i * (width + GAP));
            for (cell, x) in row.into_iter().zip(places) {
                let mut left = x;
                for picture in cell.pictures {
                    let next = left + picture.width;
                    self.items.push((Item::Picture(picture), left, top));
                    left = next;
                }
                self.y = below;
                for (line, ink) in cell.caption.iter().zip(INK.into_iter().chain([INK[1]; 16])) {
                    self.text(faces, CAPTION, line, [x, width], ink);
                }
                end = end.max(self.y);
            }
            self.y = end + GAP;
        }
    }

    fn draw(self, faces: &Faces) -> DisplayImage {
        let mut canvas = Canvas::new(self.width, self.y + GAP);
        for (item, x, y) in &self.items {
            match item {
                Item::Text(face, text, ink) => {
                    canvas.text(faces.get(*face), text, *x, *y, *ink);
                }
                Item::Picture(picture) => canvas.picture(picture, *x, *y),
            }
        }
        canvas.finish()
    }
}
