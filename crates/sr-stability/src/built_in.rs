//! The experiment files of the built-in suites, inside of the program: a check needs no clone.

use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A file of `configs/stability` and its text.
type File = (&'static str, &'static str);

macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../../configs/stability/", $path)))),*]
    };
}

/// What the experiments are made over.
const SCENES: &[File] = files![
    "closed_sphere.scene.ron",
    "paths/strategies.scene.ron",
    "scale/glass.scene.ron",
    "scale/room.scene.ron",
];

/// The experiments; the folder is the suite.
pub const EXPERIMENTS: &[File] = files![
    "paths/albedo.exp.ron",
    "paths/depth.exp.ron",
    "paths/roulette.exp.ron",
    "paths/stiff_albedo.exp.ron",
    "paths/strategies.exp.ron",
    "scale/flat.exp.ron",
    "scale/glass.exp.ron",
    "scale/offset.exp.ron",
    "scale/scale.exp.ron",
    "sums/samples.exp.ron",
];

/// The files in a temporary folder that goes when this does.
pub(crate) struct Unpacked {
    folder: TempDir,
}

impl Unpacked {
    /// Writes them.
    pub fn new() -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|e| format!("no temporary folder: {e}"))?;
        for (path, text) in SCENES.iter().chain(EXPERIMENTS) {
            write(&folder.path().join(path), text)?;
        }
        Ok(Self { folder })
    }

    /// The experiments of a suite.
    pub fn experiments(&self, suite: &str) -> Vec<PathBuf> {
        let of_suite = |path: &Path| path.parent() == Some(Path::new(suite));
        let paths = EXPERIMENTS.iter().map(|(path, _)| Path::new(path));
        let of_suite = paths.filter(|path| of_suite(path));
        of_suite.map(|path| self.folder.path().join(path)).collect()
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    let fail = |e: std::io::Error| format!("{}: {e}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fail)?;
    }
    fs::write(path, text).map_err(fail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_repository_is_built_in() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs/stability");
        let mut found = Vec::new();
        let mut folders = vec![root.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                match path.is_dir() {
                    true => folders.push(path),
                    false => found.push(path.strip_prefix(&root).unwrap().to_owned()),
                }
            }
        }
        found.sort();
        let mut known: Vec<PathBuf> = Vec::new();
        known.extend(SCENES.iter().chain(EXPERIMENTS).map(|(p, _)| p.into()));
        known.sort();
        assert_eq!(found, known);
    }
}
