//! When a render ends.

use crate::support::Work;

#[test]
fn a_budget_on_the_command_line_replaces_that_of_the_file() {
    let work = Work::new();
    let config = crate::support::CONFIG.replace("samples: 4", "seconds: 3600, target_error: 1e-30");
    work.write("long.ron", &config);
    work.done(&[
        "render", "long.ron", "--spp", "3", "-o", "a.png", "--stats", "s.json",
    ]);
    let s = work.json("s.json");
    assert_eq!(
        (&s["stop"], &s["samples_per_pixel"]),
        (&"samples".into(), &3.into())
    );
}

#[test]
fn a_time_budget_ends_in_time() {
    let work = Work::new();
    let run = work.done(&[
        "render", "tiny.ron", "--time", "300ms", "-o", "a.png", "--stats", "s.json",
    ]);
    let s = work.json("s.json");
    assert_eq!(s["stop"], "seconds");
    // More than the file's four samples, and over time by no more than a busy machine explains.
    assert!(s["samples_per_pixel"].as_u64().unwrap() > 4);
    assert!(s["seconds"]["integrate"].as_f64().unwrap() < 3.0, "{s}");
    let over = s["seconds"]["integrate"].as_f64().unwrap() - 0.3;
    let told = s["seconds"]["over_budget"].as_f64().unwrap();
    assert!((told - over).abs() < 1e-9, "{told} {over}");
    assert!(run.out.contains("(time is up; "), "{run:?}");
    assert!(run.out.contains(" the time budget)"), "{run:?}");
}

/// The first pass is always taken, and may be all that there is.
#[test]
fn a_time_budget_that_was_overrun_is_told_whatever_ended_the_render() {
    let work = Work::new();
    let run = work.done(&[
        "render", "tiny.ron", "--time", "1e-9", "--spp", "2", "-o", "a.png", "--stats", "s.json",
    ]);
    let s = work.json("s.json");
    assert_eq!(s["stop"], "samples");
    assert!(s["seconds"]["over_budget"].as_f64().unwrap() > 0.0, "{s}");
    assert!(run.out.contains(" over the time budget)"), "{run:?}");
}

#[test]
fn a_target_error_ends_a_render_that_reached_it() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "--target-error",
        "1e-3",
        "-o",
        "a.png",
        "--stats",
        "s.json",
    ]);
    let s = work.json("s.json");
    assert_eq!(s["stop"], "target_error");
    assert!(s["error"]["relmse"].as_f64().unwrap() <= 1e-3);
}

/// Waits until the program has taken over the signal, then sends it.
#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_a_render_with_what_is_there() {
    use crate::support::Run;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    const SIGINT_BIT: u64 = 1 << 1;
    let catches_sigint = |pid: u32| {
        let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
        let caught = status.lines().find_map(|l| l.strip_prefix("SigCgt:"));
        let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        caught.is_some_and(|mask| mask & SIGINT_BIT != 0)
    };
    let work = Work::new();
    let child = work
        .command(&[
            "render", "tiny.ron", "--time", "1h", "-o", "a.exr", "--stats", "s.json",
        ])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now() + Duration::from_secs(60);
    while !catches_sigint(child.id()) && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(10));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let run = Run::of(child.wait_with_output().unwrap());
    assert_eq!(run.status, 0, "{run:?}");
    assert!(run.out.contains("interrupted"), "{run:?}");
    assert_eq!(work.json("s.json")["stop"], "interrupted");
    assert!(work.path("a.exr").exists() && work.path("a.png").exists());
}
