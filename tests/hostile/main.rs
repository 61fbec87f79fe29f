//! Files that mean harm: each reader ends with a result or with errors, soon, without a panic, and
//! with no more memory than its promise ([`sr_tests::fuzz::Allowance`]).
//!
//! The seeds are `tests/fuzz/corpus` and whatever was found before, `tests/fuzz/found`. A case that
//! breaks a promise is written to a file whose name is in the message; it belongs into `found`.
//! A case that never ends, or exhausts the stack, ends the test with it.

#![allow(
    clippy::print_stderr,
    clippy::print_stdout,
    reason = "what a run came to is worth reading when it passes, too"
)]

mod watch;

use sr_stats::SplitMix;
use sr_tests::fuzz::mutate::mutate;
use sr_tests::fuzz::{Fate, TARGETS, Target, files, target};
use std::sync::mpsc;
use std::time::Duration;
use watch::{LIMIT, Seen, complaint, processor_time, watch};

/// A case that takes so long will not end: even a machine with much else to do is not a hundred times slower
/// than [`LIMIT`], which is processor time.
const NEVER: Duration = Duration::from_secs(400);

/// What a run over many cases came to.
#[derive(Debug, Default)]
struct Tally {
    cases: usize,
    read: usize,
    contained: usize,
    peak: u64,
    /// Largest (peak − what is free) a byte of input.
    per_byte: f64,
    slowest: Duration,
    total: Duration,
}

/// Watches a case and fails with its name when it breaks a promise.
fn check(target: &Target, name: &str, input: &[u8], tally: &mut Tally) -> Fate {
    let seen = watch(target, input);
    if let Some(why) = complaint(target, input, &seen) {
        let file = format!(
            "{}-{}",
            target.name,
            name.replace(|c: char| !c.is_alphanumeric(), "_")
        );
        let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
        std::fs::write(&path, input).expect("a place for what was found");
        panic!(
            "{} {name} {why}\nthe input is in {}",
            target.name,
            path.display()
        );
    }
    let beyond = seen.peak.saturating_sub(target.allowance.free) as f64;
    tally.cases += 1;
    tally.contained += usize::from(!seen.panics.is_empty());
    tally.peak = tally.peak.max(seen.peak);
    tally.per_byte = tally.per_byte.max(beyond / input.len().max(1) as f64);
    tally.slowest = tally.slowest.max(seen.time);
    tally.total += seen.time;
    let fate = seen.fate.unwrap_or(Fate::Refused(String::new()));
    tally.read += usize::from(fate == Fate::Read);
    fate
}

/// Runs the seeds as they are, then so many damaged ones; at least so many of those must still be read,
/// or little behind the first check was tested.
fn survive(name: &str, cases: usize, at_least: usize) {
    let (alive, watched) = mpsc::channel::<()>();
    std::thread::spawn(move || {
        loop {
            match watched.recv_timeout(NEVER) {
                Ok(()) => {}
                Err(mpsc::RecvTimeoutError::Disconnected) => return,
                Err(mpsc::RecvTimeoutError::Timeout) => {
                    eprintln!("a case does not end");
                    std::process::abort();
                }
            }
        }
    });
    let target = target(name);
    let mut tally = Tally::default();
    let mut seeds = Vec::new();
    for (file, bytes) in files("corpus", name) {
        let fate = check(target, &file, &bytes, &mut tally);
        assert_eq!(fate, Fate::Read, "the seed {name}/{file}");
        seeds.push(bytes);
    }
    assert!(!seeds.is_empty());
    for (file, bytes) in files("found", name) {
        check(target, &file, &bytes, &mut tally);
        seeds.push(bytes);
    }
    let mut random = SplitMix::new(20_261_124);
    let mut damaged = Tally::default();
    for case in 0..cases {
        alive.send(()).expect("the watching thread lives");
        let input = mutate(target, &seeds, &mut random);
        check(target, &format!("case {case}"), &input, &mut damaged);
    }
    println!("{name}: {damaged:?}");
    assert!(
        damaged.read >= at_least,
        "only {} of {cases} were read",
        damaged.read
    );
}

#[test]
fn damaged_scenes_do_no_harm() {
    survive("scene", 5000, 250);
}

#[test]
fn damaged_configurations_do_no_harm() {
    survive("config", 5000, 250);
}

#[test]
fn damaged_experiments_do_no_harm() {
    survive("experiment", 8000, 400);
}

#[test]
fn damaged_gltf_does_no_harm() {
    survive("gltf", 18_000, 600);
}

#[test]
fn damaged_obj_does_no_harm() {
    survive("obj", 12_000, 600);
}

#[test]
fn damaged_material_libraries_do_no_harm() {
    survive("mtl", 12_000, 600);
}

#[test]
fn damaged_collada_does_no_harm() {
    survive("collada", 5000, 250);
}

#[test]
fn damaged_pictures_do_no_harm() {
    survive("picture", 12_000, 600);
}

/// A target whose body is broken in one way.
fn broken(run: fn(&[u8]) -> Fate) -> Target {
    Target {
        run,
        ..copy(target("mtl"))
    }
}

fn copy(target: &Target) -> Target {
    Target { ..*target }
}

#[test]
fn a_reader_that_breaks_a_promise_is_found_out() {
    let why = |run| {
        let target = broken(run);
        complaint(&target, b"1234", &watch(&target, b"1234"))
    };
    assert_eq!(why(|_| Fate::Read), None);
    let panics = why(|bytes| panic!("{} bytes", bytes.len()));
    assert!(panics.is_some_and(|w| w.contains("4 bytes")));
    let caught = why(|bytes| {
        let result = std::panic::catch_unwind(|| assert!(bytes.is_empty()));
        if result.is_ok() {
            Fate::Read
        } else {
            Fate::Refused(String::new())
        }
    });
    assert!(caught.is_some_and(|w| w.starts_with("panics")));
    let greedy = why(|bytes| {
        let much = std::hint::black_box(vec![1u8; bytes.len() << 20]);
        if much.is_empty() {
            Fate::Refused(String::new())
        } else {
            Fate::Read
        }
    });
    assert!(greedy.is_some_and(|w| w.starts_with("allocates")));
    let target = broken(|_| {
        let start = processor_time();
        while processor_time() - start < Duration::from_millis(20) {}
        Fate::Read
    });
    let seen = watch(&target, b"");
    assert!(seen.time >= Duration::from_millis(20));
    let time = LIMIT + Duration::from_millis(1);
    let slow = complaint(&target, b"", &Seen { time, ..seen });
    assert!(slow.is_some_and(|w| w.starts_with("takes")));
}

#[test]
fn every_target_has_a_program_and_seeds() {
    let programs = sr_tests::repository().join("tests/fuzz/fuzz_targets");
    for target in TARGETS {
        let program = programs.join(target.name).with_extension("rs");
        let text = std::fs::read_to_string(&program).unwrap_or_default();
        let call = format!("target(\"{}\")", target.name);
        assert!(
            text.contains(&call),
            "{} does not run its target",
            program.display()
        );
        assert!(!files("corpus", target.name).is_empty());
    }
    let count = std::fs::read_dir(programs).expect("programs").count();
    assert_eq!(count, TARGETS.len(), "a program without a target");
}
