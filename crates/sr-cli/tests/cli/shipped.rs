//! The experiments that come with Steradian: planned as they are written, and made at the size of a stamp.

use crate::support::Work;
use std::path::{Path, PathBuf};

/// Stamps of 16 × 12 pixels and 2 samples. (By time no two machines would do the same.)
const TINY: [&str; 8] = [
    "--set",
    "film.width=16",
    "--set",
    "film.height=12",
    "--set",
    "budget.samples=2",
    "--set",
    "budget.seconds=None",
];

/// The experiments of a folder of `configs`.
fn experiments(folder: &str) -> Vec<PathBuf> {
    let configs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../configs");
    let mut files: Vec<PathBuf> = std::fs::read_dir(configs.join(folder))
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|f| f.to_string_lossy().ends_with(".exp.ron"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{folder} has no experiment");
    files
}

/// A copy of one for stamps: without the parts for the strip, which lie outside of them. What it names stays
/// where it is.
fn stamp(work: &Work, file: &Path) {
    let folder = file.parent().unwrap().display();
    let mut text = std::fs::read_to_string(file).unwrap();
    for field in ["base: \"", "\"scene\": \""] {
        text = text.replace(field, &format!("{field}{folder}/"));
    }
    if let Some((before, after)) = text.split_once(", insets: [") {
        let (_, rest) = after.split_once(']').unwrap();
        text = format!("{before}{rest}");
    }
    work.write("stamp.exp.ron", &text);
}

/// As they are written; the classic assignment's, of larger pictures, as stamps.
#[test]
fn every_experiment_can_be_planned() {
    let work = Work::new();
    for (folder, size) in [("figures", &[][..]), ("quick", &[]), ("seeds", &TINY)] {
        for file in experiments(folder) {
            let run = work.done(&[&["plan", file.to_str().unwrap()], size].concat());
            assert!(run.out.contains(" runs, about "), "{file:?}\n{run:?}");
            // Of two samples nothing can be adaptive, which one of the seeds is warned of.
            let warned = run.err.contains("warning");
            assert!(folder == "seeds" || !warned, "{file:?}\n{run:?}");
        }
    }
    assert!(work.files().keys().all(|f| f.starts_with("tiny")));
}

/// Each method of each figure runs, is measured against the reference and gets its row of seeds; and what
/// the file says of itself is there for those who read it.
#[test]
fn every_figure_can_be_made() {
    let work = Work::new();
    for file in [experiments("figures"), experiments("quick")].concat() {
        stamp(&work, &file);
        let line = ["experiment", "stamp.exp.ron", "-o", "e", "--quiet"];
        work.done(&[&line[..], &TINY].concat());
        let json = work.json("e/results.json");
        assert_eq!(json["complete"], true, "{file:?}");
        assert_eq!(json["failed"].as_array().unwrap().len(), 0, "{file:?}");
        assert!(json["note"].as_str().unwrap().len() > 200, "{file:?}");
        for row in json["rows"].as_array().unwrap() {
            assert_eq!(row["error_source"], "reference", "{file:?}");
            assert_eq!(row["rejected"], 0, "{file:?}");
        }
        for point in json["summary"].as_array().unwrap() {
            let seeds = point["seconds"]["count"].as_u64().unwrap();
            assert!((3..=5).contains(&seeds), "{file:?}: {seeds} seeds");
        }
    }
}
