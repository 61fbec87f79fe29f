//! The experiment file, `*.exp.ron`: what is compared, how often, against what, and how it is
//! shown. docs/experiments.md is its contract.
//!
//! Values by path are kept as trees that know their places. What is wrong with them is found when a
//! run is loaded with them, by the same code and with the same words as in any other file.

mod axes;
mod measuring;
mod read;
mod show;
mod stability;

use crate::metric::Metric;
use sr_io::Change;
use sr_io::document::OverrideEntry;
use sr_io::reflect::Origin;
use std::path::PathBuf;

pub use read::{EXTENSION, read};
pub use show::{Caption, Piece, Placeholder};
pub use stability::{Stability, Truth};

/// One experiment file.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The file.
    pub origin: Origin,
    /// As it is written, for the record.
    pub text: String,
    /// What it is called; the file's name unless given.
    pub title: String,
    /// What it is about.
    pub note: String,
    /// The configuration, scene or model that everything starts from.
    pub base: PathBuf,
    /// Changes for all runs.
    pub set: Vec<OverrideEntry>,
    /// What varies, in the order of the file; all combinations are run.
    pub axes: Vec<Axis>,
    /// Ways of rendering that are compared; the innermost axis. Empty or several.
    pub methods: Vec<Setting>,
    /// What the others are compared with: a method, by number, or without methods a value of the
    /// last axis. The first unless somebody says.
    pub baseline: Option<usize>,
    /// The error whose time is told, in the first metric.
    pub target: Option<f64>,
    /// Log points by seconds of integration, rising; without them at doublings of the samples.
    pub log_seconds: Vec<f64>,
    /// Seeds of the sampler; none means the base's own, once.
    pub seeds: Vec<u64>,
    /// When a run ends; the fields of a configuration's section `budget`.
    pub budget: Option<OverrideEntry>,
    /// What the pictures should be.
    pub reference: Option<ReferenceSpec>,
    /// Errors that captions and tables show; rows of data have all.
    pub metrics: Vec<Metric>,
    /// How it is shown.
    pub show: Show,
    /// Pictures shown beside the experiment's own.
    pub attach: Vec<Attachment>,
    /// What makes it a check of numerical stability, for `steradian check`.
    pub stability: Option<Stability>,
}

/// Something that varies.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Its name in rows of data: the path, or `zip.` and the name of a zip.
    pub name: String,
    /// Its name in captions.
    pub short: String,
    /// The values, in order; at least one.
    pub settings: Vec<Setting>,
}

/// One value of an axis, or one method.
#[derive(Clone, Debug)]
pub struct Setting {
    /// What it is called.
    pub label: String,
    /// What it changes.
    pub changes: Vec<OverrideEntry>,
}

/// Where the reference comes from.
#[derive(Clone, Debug)]
pub enum ReferenceSpec {
    /// A picture, one for all runs.
    File {
        /// The file.
        path: PathBuf,
        /// Where it is named.
        change: OverrideEntry,
    },
    /// Rendered with these changes after those of the axes; methods play no part.
    Render(Vec<OverrideEntry>),
}

/// How pictures are shown.
#[derive(Clone, Debug, Default)]
pub struct Show {
    /// `post.exposure` and `post.tone_map` of every run, before the axes.
    pub post: Vec<OverrideEntry>,
    /// Only this part of each picture is shown: x0, y0, x1, y1, half-open.
    pub crop: Option<[u32; 4]>,
    /// Where the crop is written.
    pub crop_at: Option<OverrideEntry>,
    /// Parts that are shown enlarged and become the crops of the figure, as `crop`.
    pub insets: Vec<[u32; 4]>,
    /// Where each of them is written.
    pub insets_at: Vec<OverrideEntry>,
    /// Pictures side by side, at most.
    pub columns: Option<u32>,
    /// What stands below each picture.
    pub caption: Caption,
}

/// A picture beside the experiment's own.
#[derive(Clone, Debug)]
pub struct Attachment {
    /// EXR, PNG or HDR.
    pub path: PathBuf,
    /// What stands below it.
    pub caption: String,
    /// Stops by which an EXR or HDR is exposed, if not as the experiment's pictures are.
    pub exposure: Option<f32>,
    /// Where the file is named.
    pub change: OverrideEntry,
}

impl Experiment {
    /// A change of this file, for the reader of runs.
    pub(crate) fn change(&self, entry: &OverrideEntry) -> Change {
        Change {
            origin: self.origin.clone(),
            entry: entry.clone(),
        }
    }

    /// What is compared: the methods, or without methods the values of the last axis.
    pub fn contenders(&self) -> &[Setting] {
        match (self.methods.as_slice(), self.axes.last()) {
            ([], Some(axis)) => &axis.settings,
            (methods, _) => methods,
        }
    }

    /// The file's name without `.exp.ron`.
    pub fn stem(&self) -> String {
        stem(&self.origin)
    }
}

/// `a/alpha.exp.ron` and `a/alpha.ron` are called `alpha`.
fn stem(origin: &Origin) -> String {
    let name = origin.name.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let lower = name.to_lowercase();
    let cut = [EXTENSION, ".ron"]
        .into_iter()
        .find(|end| lower.ends_with(end))
        .map_or(name.len(), |end| name.len() - end.len());
    match name.get(..cut) {
        Some(stem) if !stem.is_empty() => stem.to_owned(),
        _ => "experiment".to_owned(),
    }
}

#[cfg(test)]
mod tests;

/// For tests of other modules.
#[cfg(test)]
pub(crate) mod tests_support {
    use super::*;

    /// An experiment over a base that is there, called `alpha`, from its other fields.
    pub(crate) fn experiment(fields: &str) -> Experiment {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("base.ron"), "").unwrap();
        let text = format!("(base: \"base.ron\", {fields})");
        read::parse(&folder.path().join("alpha.exp.ron"), &text).unwrap()
    }
}
