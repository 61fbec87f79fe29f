//! The folder of an experiment: what is where, and that nothing of somebody else's is lost.

use std::fs;
use std::path::{Path, PathBuf};

/// Rows of data; its presence makes a folder one of ours.
pub const JSON: &str = "results.json";
/// Rows of data for spreadsheets.
pub const CSV: &str = "results.csv";
/// All pictures in one.
pub const SHEET: &str = "sheet.png";
/// The page.
pub const PAGE: &str = "report.html";
/// Plots as files.
pub const PLOTS: &str = "plots";
/// Crops for papers.
pub const FIGURE: &str = "figure";
/// The crops as a figure for LaTeX.
pub const TEX: &str = "figure.tex";
/// Pictures of single runs.
pub const RUNS: &str = "runs";
/// Maps of where pictures differ.
pub const DIFFERENCES: &str = "differences";
/// References that were rendered.
pub const REFERENCES: &str = "references";

/// Where an experiment's files go.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Looks whether an experiment may write there; touches nothing.
    ///
    /// # Errors
    /// When it is a file, or has things in it and is no experiment's: a phrase.
    pub fn check(path: &Path) -> Result<Self, String> {
        check_folder(path, JSON, "experiment")?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// Makes what is missing of it.
    pub(crate) fn make(&self) -> Result<(), String> {
        make(&self.path.join(RUNS))
    }

    pub(crate) fn make_references(&self) -> Result<(), String> {
        make(&self.path.join(REFERENCES))
    }

    pub(crate) fn make_plots(&self) -> Result<(), String> {
        make(&self.path.join(PLOTS))
    }

    pub(crate) fn make_figure(&self) -> Result<(), String> {
        make(&self.path.join(FIGURE))
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file of the experiment as a whole.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// A file of a run.
    pub fn run(&self, id: &str, end: &str) -> PathBuf {
        // Not `with_extension`, which takes `alpha-0.05` for a name with one.
        self.path.join(RUNS).join(format!("{id}{end}"))
    }

    pub(crate) fn reference(&self, key: &str) -> PathBuf {
        self.path.join(REFERENCES).join(format!("{key}.exr"))
    }

    /// A map of where two pictures differ; its folder is made.
    pub(crate) fn difference(&self, name: &str) -> Result<PathBuf, String> {
        let folder = self.path.join(DIFFERENCES);
        make(&folder)?;
        Ok(folder.join(format!("{name}.png")))
    }

    /// A file of a plot.
    pub(crate) fn plot(&self, name: &str) -> PathBuf {
        self.path.join(PLOTS).join(name)
    }

    /// As links and rows name it.
    pub fn relative(&self, path: &Path) -> String {
        let relative = path.strip_prefix(&self.path).unwrap_or(path);
        let parts: Vec<_> = relative.iter().map(|p| p.to_string_lossy()).collect();
        parts.join("/")
    }

    /// What a run wrote beside its picture: `<id>_<what>.png`, with the what, sorted.
    pub fn further_pictures(&self, id: &str) -> Vec<(String, PathBuf)> {
        let entries = fs::read_dir(self.path.join(RUNS)).into_iter().flatten();
        let mut found: Vec<(String, PathBuf)> = entries
            .filter_map(|entry| {
                let path = entry.ok()?.path();
                let name = path.file_name()?.to_str()?;
                let what = name.strip_prefix(id)?.strip_prefix('_')?;
                let what = what.strip_suffix(".png")?.to_owned();
                Some((what, path))
            })
            .collect();
        found.sort();
        found
    }

    /// Removes what an earlier experiment wrote beside a run's picture: this one may write less.
    pub(crate) fn clear_further_pictures(&self, id: &str) {
        for (_, path) in self.further_pictures(id) {
            // What stays is shown once too often; no more.
            let _ = fs::remove_file(path);
        }
    }
}

/// Looks whether results may be written to a folder: it is not there yet, is empty, or has the file `mark` of an
/// earlier one of its `kind`. Touches nothing.
///
/// # Errors
/// A phrase that says why not.
pub fn check_folder(path: &Path, mark: &str, kind: &str) -> Result<(), String> {
    let refuse = |cause: &str| Err(format!("cannot write to `{}`: {cause}", path.display()));
    let Ok(meta) = fs::metadata(path) else {
        let parents = path.ancestors().skip(1);
        let mut there = parents.filter(|p| p.as_os_str().is_empty() || p.exists());
        return match there.next() {
            Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
                refuse(&format!("{} is no folder", parent.display()))
            }
            _ => Ok(()),
        };
    };
    if !meta.is_dir() {
        return refuse("it is no folder");
    }
    let mut entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(error) => return refuse(&error.to_string()),
    };
    if entries.next().is_some() && !path.join(mark).is_file() {
        return refuse(&format!(
            "there are things in it, but no {mark} of an earlier {kind}; name a new folder"
        ));
    }
    Ok(())
}

fn make(path: &Path) -> Result<(), String> {
    fs::create_dir_all(path).map_err(|e| format!("cannot make the folder {}: {e}", path.display()))
}
