//! `--convergence` against its documentation, and what becomes of it when things go wrong.

use crate::support::{Run, Work};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Lines of the file: values by column.
fn rows(text: &[u8]) -> Vec<BTreeMap<String, String>> {
    let text = String::from_utf8(text.to_vec()).unwrap();
    assert!(text.ends_with("\r\n"), "{text}");
    let mut lines = text.split_terminator("\r\n");
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), names.len(), "{line}");
        let pairs = names.iter().zip(cells);
        pairs.map(|(n, c)| ((*n).into(), c.into())).collect()
    };
    lines.map(row).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    let text = &row[column];
    text.parse()
        .unwrap_or_else(|e| panic!("{column}: {text}: {e}"))
}

#[test]
fn the_columns_are_those_of_the_documentation() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.png",
        "--convergence",
        "c.csv",
    ]);
    let page = include_str!("../../../../docs/convergence.md");
    // The first table of the page.
    let documented: Vec<&str> = page
        .lines()
        .take_while(|line| *line != "## The progress line")
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once('`')?.0))
        .collect();
    let text = String::from_utf8(work.read("c.csv")).unwrap();
    assert_eq!(text.lines().next().unwrap(), documented.join(","));
}

#[test]
fn a_line_a_doubling_and_the_last_as_the_statistics_have_it() {
    let work = Work::new();
    let run = work.done(&[
        "render",
        "tiny.ron",
        "--spp",
        "100",
        "-o",
        "a.png",
        "--convergence",
        "c.csv",
        "--stats",
        "s.json",
    ]);
    assert!(run.out.contains("wrote a.png, s.json, c.csv"), "{run:?}");
    let rows = rows(&work.read("c.csv"));
    let samples: Vec<f64> = rows.iter().map(|r| number(r, "samples")).collect();
    assert_eq!(samples, [2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 100.0]);
    for column in ["passes", "seconds", "rays"] {
        let values = rows.iter().map(|r| number(r, column));
        assert!(values.is_sorted_by(|a, b| a < b), "{column}");
    }
    for row in &rows {
        assert_eq!(number(row, "samples_mean"), number(row, "samples"));
        assert_eq!(number(row, "samples_total"), 192.0 * number(row, "samples"));
        assert_eq!(
            (row["error_source"].as_str(), &*row["rejected"]),
            ("estimate", "0")
        );
        assert!(number(row, "mse") > 0.0);
    }
    let (s, last) = (work.json("s.json"), &rows[6]);
    // serde_json may read a number one unit in the last place off.
    let is_logged = |value: &Value, column: &str| {
        let (told, logged) = (value.as_f64().expect("a number"), number(last, column));
        assert!(
            (told - logged).abs() <= 4.0 * f64::EPSILON * logged,
            "{column}: {told}"
        );
    };
    is_logged(&s["error"]["relmse"], "relmse");
    is_logged(&s["error"]["mse"], "mse");
    is_logged(&s["error"]["std_error"], "relmse_estimate_std_error");
    is_logged(&s["seconds"]["integrate"], "seconds");
    assert_eq!(s["passes"].as_f64(), Some(number(last, "passes")));
}

/// One sample has no variance; a picture of one sample has a line all the same.
#[test]
fn an_error_that_is_not_known_is_empty() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "--spp",
        "1",
        "-o",
        "a.png",
        "--convergence",
        "c.csv",
    ]);
    let rows = rows(&work.read("c.csv"));
    assert_eq!(rows.len(), 1);
    assert_eq!((&*rows[0]["error_source"], &*rows[0]["mse"]), ("none", ""));
}

/// The error at a number of samples does not depend on what ends the render or how it is cut.
#[test]
fn errors_at_common_sample_counts_are_the_same_bits() {
    let work = Work::new();
    let log = |args: &[&str]| {
        let line = [
            "render",
            "tiny.ron",
            "-o",
            "a.png",
            "--convergence",
            "c.csv",
        ];
        work.done(&[&line[..], args].concat());
        let rows = rows(&work.read("c.csv")).into_iter();
        let pair = |r: BTreeMap<String, String>| (r["samples"].clone(), r["relmse"].clone());
        rows.map(pair).collect::<BTreeMap<_, _>>()
    };
    let plain = log(&["--spp", "64"]);
    for other in [
        log(&[
            "--spp",
            "64",
            "--threads",
            "1",
            "--set",
            "budget.pass_samples=3",
        ]),
        log(&["--spp", "64", "--time", "1h"]),
        log(&["--spp", "64", "--target-error", "1e-30"]),
    ] {
        assert_eq!(other, plain);
    }
}

#[test]
fn an_adaptive_render_tells_its_mean_samples() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "--spp",
        "256",
        "--adaptive",
        "0.1",
        "-o",
        "a.png",
        "--convergence",
        "c.csv",
    ]);
    let rows = rows(&work.read("c.csv"));
    let last = rows.last().unwrap();
    assert!(number(last, "samples_mean") < number(last, "samples"));
    let total = 192.0 * number(last, "samples_mean");
    assert!((total - number(last, "samples_total")).abs() < 1e-6);
}

/// Starts a render that only a signal or its time ends, and waits for the first lines.
fn started(work: &Work, args: &[&str], log: &Path) -> std::process::Child {
    let mut command = work.command(args);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = child.spawn().unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    let lines = || std::fs::read_to_string(log).map_or(0, |t| t.lines().count());
    while lines() < 3 && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[test]
fn a_render_that_is_killed_leaves_whole_lines() {
    let work = Work::new();
    let args = [
        "render",
        "tiny.ron",
        "--time",
        "1h",
        "-o",
        "a.png",
        "--convergence",
        "c.csv",
    ];
    let mut child = started(&work, &args, &work.path("c.csv"));
    child.kill().unwrap();
    child.wait().unwrap();
    let rows = rows(&work.read("c.csv"));
    assert!(rows.len() >= 2 && number(rows.last().unwrap(), "relmse") > 0.0);
    assert!(!work.path("a.png").exists());
}

/// The folder of the log goes away: the render goes on, and says so at its end.
#[test]
fn a_log_that_cannot_be_written_costs_no_picture() {
    let work = Work::new();
    std::fs::create_dir(work.path("log")).unwrap();
    let args = [
        "render",
        "tiny.ron",
        "--time",
        "2s",
        "-o",
        "a.png",
        "--convergence",
        "log/c.csv",
    ];
    let child = started(&work, &args, &work.path("log/c.csv"));
    // A line may be written right now.
    while work.path("log").exists() {
        let _ = std::fs::remove_dir_all(work.path("log"));
    }
    let run = Run::of(child.wait_with_output().unwrap());
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.err.contains("log/c.csv"), "{run:?}");
    assert!(work.path("a.png").exists());
}
