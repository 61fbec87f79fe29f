//! The report: `report.html`, one page that needs no other file and no network, with plots, figure
//! crops and numbers as files beside it for papers.
//!
//! Reports of other kinds are made of the same parts, which are public for that.
//!
//! Everything is on the page without any script: verdict, drawn plots, tables, pictures. Scripts
//! (`assets/`) put in their place what can be handled: plots with values, the viewer over the
//! pictures' real numbers, tables that sort.

mod figure;
mod markup;
mod page;
mod palette;
mod panel;
mod planes;
mod plot;
mod plot_files;
mod plots;
mod repeat;
mod stills;
mod svg;
mod table;
mod tables;
mod tex;
mod ticks;
mod verdict;
mod viewer;
mod views;

use crate::folder::{Folder, PAGE};
use crate::plan::Plan;
use crate::results::Results;
use crate::run::{Outcome, write_text};

pub use markup::{data_uri, escape, json, section};
pub use page::{Page, Scripts};
pub use plot::{FONT, GRID, INK, font};
pub use svg::inline;
pub use ticks::{Axis, Marks, axis};

/// Writes the page and the files beside it.
pub(crate) fn write(plan: &Plan, outcome: &Outcome, folder: &Folder) -> Result<(), String> {
    let analysis = &outcome.analysis;
    let panels = panel::panels(plan, analysis);
    let svgs = plot_files::write(&panels, folder)?;
    let strips = figure::write(plan, outcome, analysis, folder)?;
    let views = views::views(plan, outcome, analysis, folder)?;
    let stills = stills::stills(plan, outcome, folder)?;
    let attached = stills::attached(plan)?;
    let mut sections = vec![(
        "verdict",
        "Verdict",
        verdict::verdict(plan, outcome, analysis, folder)?,
    )];
    if !panels.is_empty() {
        sections.push((
            "plots",
            "Error against time and samples",
            plots::plots(&panels, &svgs),
        ));
    }
    sections.push((
        "pictures",
        "Pictures",
        viewer::viewer(&views) + &stills::folded(&stills),
    ));
    if !strips.is_empty() {
        sections.push(("strip", "Closer", strips));
    }
    if !attached.is_empty() {
        sections.push(("beside", "Beside", attached));
    }
    sections.push(("table", "Results", tables::results(plan, outcome, analysis)));
    sections.push(("cost", "What it took", tables::statistics(plan, outcome)));
    sections.push(("repeat", "To repeat it", repeat::repeat(plan, outcome)));
    let page = Page {
        title: &plan.experiment.title,
        note: &plan.experiment.note,
        links: sections
            .iter()
            .map(|(id, heading, _)| (*id, *heading))
            .collect(),
        body: sections
            .iter()
            .map(|(id, h, body)| section(id, h, body))
            .collect(),
        scripts: Scripts::All,
        data: vec![
            ("data-results", json(&Results::new(plan, outcome, folder))?),
            ("data-panels", json(&panels)?),
            ("data-views", json(&views)?),
        ],
        planes: &views.planes,
    };
    write_text(&folder.file(PAGE), &page.html())
}
