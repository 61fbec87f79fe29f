//! Experiments that were ended before their end, by force or by a disk that is full.

use crate::support::{Run, Work};
use serde_json::Value;
use sr_pipeline::film_kernel::read_image;

/// Six runs, the `long` ones of a second or so.
const EXPERIMENT: &str = r#"(
    base: "tiny.ron",
    methods: {
        "short": {"budget.samples": 8},
        "long": {"budget.samples": 600},
    },
    seeds: 3,
    reference: (samples: 64),
)
"#;

const IDS: [&str; 6] = [
    "short-seed-0",
    "long-seed-0",
    "short-seed-1",
    "long-seed-1",
    "short-seed-2",
    "long-seed-2",
];

fn work() -> Work {
    let work = Work::new();
    work.write("tiny.exp.ron", EXPERIMENT);
    work
}

/// Rows of data, without what the clock says.
fn rows(work: &Work, folder: &str) -> Vec<Value> {
    let mut json = work.json(&format!("{folder}/results.json"));
    let rows = json["rows"].as_array_mut().unwrap();
    for row in rows.iter_mut() {
        row.as_object_mut().unwrap().remove("seconds");
    }
    rows.clone()
}

/// Runs that are done, as the file tells them.
fn runs(work: &Work, folder: &str) -> Vec<Value> {
    let json = work.json(&format!("{folder}/results.json"));
    json["runs"].as_array().unwrap().clone()
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_experiment_goes_on_and_ends_as_if_nothing_had_been() {
    use std::process::Stdio;
    use std::time::{Duration, Instant};
    let work = work();
    let mut child = work
        .command(&["experiment", "tiny.exp.ron", "-o", "killed"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    let is_half_done = || {
        let text = std::fs::read(work.path("killed/results.csv")).unwrap_or_default();
        String::from_utf8_lossy(&text).contains("short-seed-1,")
    };
    while !is_half_done() && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let before = runs(&work, "killed");
    assert!((3..6).contains(&before.len()), "{}", before.len());

    let run = work.done(&["experiment", "tiny.exp.ron", "-o", "killed", "--resume"]);
    let told = format!("{} of 6 runs are done already", before.len());
    assert!(run.err.contains(&told), "{run:?}");
    assert!(
        !run.err.contains("[1/6]") && run.err.contains("[6/6]"),
        "{run:?}"
    );
    // What was done is as it was, with the seconds that it took.
    let after = runs(&work, "killed");
    let ids: Vec<&str> = after.iter().map(|r| r["id"].as_str().unwrap()).collect();
    assert_eq!(
        (ids.as_slice(), &after[..before.len()]),
        (&IDS[..], &before[..])
    );

    work.done(&["experiment", "tiny.exp.ron", "-o", "whole"]);
    assert_eq!(rows(&work, "killed"), rows(&work, "whole"));
    for id in IDS {
        let [a, b] = ["killed", "whole"].map(|folder| {
            let image = read_image(work.path(&format!("{folder}/runs/{id}.exr"))).unwrap();
            let bits = image.pixels.iter().map(|p| p.to_array().map(f32::to_bits));
            bits.collect::<Vec<_>>()
        });
        assert!(a == b, "{id}");
    }
}

/// Resumes, which must be refused with words, and touch nothing.
fn refused(work: &Work) -> Run {
    let before = work.files();
    let run = work.run(&["experiment", "tiny.exp.ron", "-o", "e", "--resume"]);
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.err.contains("cannot resume `e`: "), "{run:?}");
    assert!(work.files() == before, "files have changed");
    run
}

#[test]
fn a_changed_experiment_is_not_resumed() {
    let work = Work::new();
    let with = |samples: u32, more: &str| {
        let text = format!(r#"(base: "tiny.ron", budget: (samples: {samples}), {more})"#);
        work.write("tiny.exp.ron", &text);
    };
    with(4, "seeds: 2");
    work.done(&["experiment", "tiny.exp.ron", "-o", "e"]);
    with(8, "seeds: 2");
    let told = refused(&work).err;
    assert!(
        told.contains("the configuration of `tiny-seed-0` has changed")
            && told.contains("-    budget: (samples: Some(4)")
            && told.contains("+    budget: (samples: Some(8)"),
        "{told}"
    );
    let told = work.run(&[
        "experiment",
        "tiny.exp.ron",
        "-o",
        "e",
        "--resume",
        "--threads",
        "7",
    ]);
    assert!(
        told.status == 2 && told.err.contains("another machine") && told.err.contains("7 threads"),
        "{told:?}"
    );
    with(4, "seeds: [7, 8]");
    assert!(refused(&work).err.contains("it has the run `tiny-seed-0`"));
    with(4, "seeds: 2");
    let scene = crate::support::SCENE.replace("radiance: 5", "radiance: 6");
    work.write("tiny.scene.ron", &scene);
    assert!(
        refused(&work)
            .err
            .contains("first sample a pixel comes out differently")
    );
    std::fs::write(work.path("e/results.json"), "{\"version\": 1, ").unwrap();
    assert!(
        refused(&work)
            .err
            .contains("its results.json cannot be understood")
    );
}

#[test]
fn an_experiment_that_has_grown_keeps_what_is_done() {
    let work = Work::new();
    work.write("tiny.exp.ron", r#"(base: "tiny.ron", seeds: 2)"#);
    // Nothing to go on with is no error, so that one command serves both times.
    work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--resume"]);
    let before = runs(&work, "e");
    work.write("tiny.exp.ron", r#"(base: "tiny.ron", seeds: 3)"#);
    work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--resume"]);
    let after = runs(&work, "e");
    assert_eq!((after.len(), &after[..2]), (3, &before[..]));
    // A picture that is gone is made again.
    std::fs::remove_file(work.path("e/runs/tiny-seed-1.exr")).unwrap();
    let run = work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--resume"]);
    assert!(run.err.contains("2 of 3 runs are done already"), "{run:?}");
    assert!(work.path("e/runs/tiny-seed-1.exr").exists());
}

/// Runs with files of at most a million bytes or so, as on a disk that is full.
#[cfg(target_os = "linux")]
fn cramped(work: &Work, args: &str) -> Run {
    let binary = env!("CARGO_BIN_EXE_steradian");
    let script = format!("trap '' XFSZ; ulimit -f 2000; exec {binary} {args}");
    let output = std::process::Command::new("sh")
        .args(["-c", &script])
        .current_dir(work.path(""))
        .output();
    Run::of(output.unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_costs_the_runs_that_do_not_fit_and_no_others() {
    let work = Work::new();
    let experiment = r#"(
        base: "tiny.ron",
        set: {"budget.samples": 2, "film.height": 60},
        axes: {"film.width": [4, 6000, 8]},
    )"#;
    work.write("e.exp.ron", experiment);
    let run = cramped(&work, "experiment e.exp.ron -o e");
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.err.contains("warning: [2/3] width = 6000: "), "{run:?}");
    assert!(
        run.err.contains("1 run of 3 failed; the others are in e"),
        "{run:?}"
    );
    let json = work.json("e/results.json");
    assert_eq!(runs(&work, "e").len(), 2);
    assert_eq!(json["failed"][0]["id"], "width-6000");
    assert!(work.path("e/runs/width-8.exr").exists());
    assert!(!work.path("e/runs/width-6000.exr").exists());
    // With space there is nothing to lose.
    let run = work.done(&["experiment", "e.exp.ron", "-o", "e", "--resume"]);
    assert!(run.err.contains("2 of 3 runs are done already"), "{run:?}");
    assert_eq!(work.json("e/results.json")["complete"], true);
}

#[cfg(target_os = "linux")]
#[test]
fn a_reference_that_fails_costs_its_own_runs() {
    let work = Work::new();
    let experiment = r#"(
        base: "tiny.ron",
        set: {"budget.samples": 2, "film.height": 60},
        axes: {"film.width": [6000, 8]},
        reference: (samples: 2),
    )"#;
    work.write("e.exp.ron", experiment);
    let run = cramped(&work, "experiment e.exp.ron -o e");
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.err.contains("warning: reference 1 of 2: "), "{run:?}");
    assert!(
        run.err
            .contains("[1/2] width = 6000: it has no reference: "),
        "{run:?}"
    );
    assert_eq!(runs(&work, "e")[0]["id"], "width-8");
}

/// Waits until something is done, then sends a signal.
#[cfg(target_os = "linux")]
fn signalled(work: &Work, signal: &str) -> Run {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    work.write(
        "long.exp.ron",
        r#"(base: "tiny.ron", zip: {"t": {
            "short": {"budget.samples": 2}, "long": {"budget.seconds": 3600},
        }})"#,
    );
    let child = work
        .command(&["experiment", "long.exp.ron", "-o", "e"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let is_done = || {
        let text = std::fs::read(work.path("e/results.csv")).unwrap_or_default();
        String::from_utf8_lossy(&text).contains("t-short,")
    };
    let patience = Instant::now() + Duration::from_secs(60);
    while !is_done() && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(10));
    }
    let sent = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    Run::of(child.wait_with_output().unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_leaves_what_is_done_and_says_so() {
    let work = Work::new();
    let run = signalled(&work, "-INT");
    assert_eq!(run.status, 1, "{run:?}");
    assert!(
        run.err
            .contains("interrupted: 1 of 2 runs are done; they are in e"),
        "{run:?}"
    );
    assert_eq!(work.json("e/results.json")["complete"], false);
    assert!(work.path("e/report.html").exists() && work.path("e/sheet.png").exists());
    assert!(work.path("e/runs/t-short.exr").exists() && !work.path("e/runs/t-long.exr").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_experiment_leaves_no_half_files() {
    let work = Work::new();
    signalled(&work, "-KILL");
    // What is there can be read.
    assert_eq!(rows(&work, "e").len(), 1);
    read_image(work.path("e/runs/t-short.exr")).unwrap();
    read_image(work.path("e/runs/t-short.png")).unwrap();
    assert!(!work.path("e/runs/t-long.exr").exists());
    assert!(!work.path("e/report.html").exists());
}
