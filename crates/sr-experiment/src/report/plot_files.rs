//! `plots/`: each plot as SVG and PNG, and its numbers as CSV, for papers.

use super::panel::Panel;
use super::plot;
use crate::folder::Folder;
use crate::run::write_text;
use sr_film::write_png;

/// Writes the files, and gives the SVG texts for the page.
pub(super) fn write(panels: &[Panel], folder: &Folder) -> Result<Vec<String>, String> {
    folder.make_plots()?;
    let one = |panel: &Panel| {
        let file = |end: &str| folder.plot(&format!("{}{end}", panel.id));
        let svg = plot::svg(panel)?;
        write_text(&file(".svg"), &svg)?;
        write_png(file(".png"), &plot::picture(panel)?).map_err(|e| e.to_string())?;
        write_text(&file(".csv"), &panel.csv())?;
        Ok(svg)
    };
    panels.iter().map(one).collect()
}
