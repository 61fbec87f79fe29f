//! `compare`, and `compare --same`.

use crate::support::Work;
use serde_json::Value;

/// `a.exr` and `b.exr` with other seeds, `c.exr` smaller, `d.exr` with another lamp.
fn rendered() -> Work {
    let work = Work::new();
    for (name, more) in [
        ("a.exr", ["--seed", "1"]),
        ("b.exr", ["--seed", "2"]),
        ("c.exr", ["--width", "8"]),
        ("d.exr", ["--set", "entities.glow.Emission.radiance=6"]),
    ] {
        let line = ["render", "tiny.ron", "--spp", "64", "-o", name];
        work.done(&[&line[..], &more[..]].concat());
    }
    work
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn compare_measures_and_explains() {
    let work = Work::new();
    work.done(&["render", "tiny.ron", "-o", "a.exr"]);
    work.done(&["render", "tiny.ron", "-o", "b.exr", "--seed", "1"]);
    work.done(&["render", "tiny.ron", "-o", "c.exr", "--width", "8"]);
    let same: Value =
        serde_json::from_str(&work.done(&["compare", "a.exr", "a.exr", "--json"]).out).unwrap();
    assert_eq!((&same["mse"], &same["relmse"]), (&0.0.into(), &0.0.into()));
    let text = work.done(&["compare", "a.exr", "b.exr"]).out;
    for metric in [
        "MSE", "relMSE", "MAPE", "SMAPE", "+ 0.01", "trimmed", "error ", "HDR-FLIP",
    ] {
        assert!(text.contains(metric), "no {metric} in\n{text}");
    }
    let run = work.run(&["compare", "a.exr", "c.exr"]);
    assert_eq!(run.status, 2);
    assert!(
        run.err.contains("16 × 12") && run.err.contains("8 × 12"),
        "{run:?}"
    );
}

/// Width and height of a PNG, by its header.
fn png_size(bytes: &[u8]) -> (u32, u32) {
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn compare_takes_off_the_references_noise_and_draws_maps() {
    let work = rendered();
    work.done(&[
        "render", "tiny.ron", "--spp", "4", "-o", "few.exr", "--seed", "3",
    ]);
    let found = json(&work.done(&["compare", "few.exr", "a.exr", "--json"]).out);
    assert_eq!(found["version"], 1);
    let number = |v: &Value| v.as_f64().unwrap();
    let debiased = number(&found["debiased"]["mse"]);
    assert!(
        debiased > 0.0 && debiased < number(&found["mse"]),
        "{found}"
    );
    assert!(number(&found["flip"]["mean"]) > 0.0 && found["flip"]["range"] == "hdr");
    // Of equals the reference is not the better one.
    let found = json(&work.done(&["compare", "b.exr", "a.exr", "--json"]).out);
    assert!(found["debiased"].is_null());
    let why = found["not_debiased"].as_str().unwrap();
    assert!(why.contains("the reference is not good enough"), "{why}");
    // PNG files have no variance, and are what a display shows.
    let found = json(&work.done(&["compare", "few.png", "a.png", "--json"]).out);
    assert_eq!(found["flip"]["range"], "ldr");
    assert!(
        found["not_debiased"]
            .as_str()
            .unwrap()
            .contains("no channels Variance.R")
    );
    for kind in ["flip", "squared", "relative", "signed"] {
        let line = [
            "compare", "few.exr", "a.exr", "-o", "map.png", "--map", kind,
        ];
        work.done(&line);
        assert_eq!(png_size(&work.read("map.png")), (16, 12));
    }
}

#[test]
fn the_same_is_status_0_and_different_is_status_1() {
    let work = rendered();
    let same = work.done(&["compare", "--same", "a.exr", "b.exr"]);
    assert!(same.out.starts_with("THE SAME"), "{same:?}");
    assert!(
        same.out.contains("64.0 and 64.0 a pixel") && same.err.is_empty(),
        "{same:?}"
    );
    let other = work.run(&["compare", "--same", "a.exr", "d.exr", "-o", "map.png"]);
    assert_eq!((other.status, other.err.as_str()), (1, ""), "{other:?}");
    assert!(other.out.starts_with("DIFFERENT"), "{other:?}");
    assert_eq!(png_size(&work.read("map.png")), (16, 12));
    let other = work.run(&["compare", "--same", "a.exr", "d.exr", "--json"]);
    let verdict = json(&other.out);
    assert_eq!(
        (&verdict["version"], &verdict["answer"]),
        (&1.into(), &"different".into())
    );
    assert_eq!(verdict["samples_a"], 64.0);
}

#[test]
fn shared_seeds_are_told() {
    let work = rendered();
    work.done(&[
        "render", "tiny.ron", "--spp", "32", "--seed", "1", "-o", "e.exr",
    ]);
    let run = work.done(&["compare", "--same", "a.exr", "e.exr"]);
    assert!(
        run.err.contains("both were rendered with seed 1"),
        "{run:?}"
    );
    let run = work.done(&["compare", "--same", "a.exr", "a.exr"]);
    assert!(
        run.err.contains("compares a picture with itself"),
        "{run:?}"
    );
    assert!(run.err.contains("equal in every bit"), "{run:?}");
}

#[test]
fn what_compare_cannot_do_is_refused_by_name() {
    let work = rendered();
    work.done(&["render", "tiny.ron", "--spp", "1", "-o", "one.exr"]);
    let before = work.files();
    for (line, parts) in [
        (
            &["--same", "a.exr", "c.exr"][..],
            &["16 × 12", "8 × 12"][..],
        ),
        (
            &["--same", "a.png", "b.png"],
            &["a.png", "--same needs renders"],
        ),
        (&["--same", "a.exr", "none.exr"], &["none.exr"]),
        (
            &["--same", "a.exr", "one.exr"],
            &["variance of 192 pixels is not known"],
        ),
        (
            &["a.exr", "b.exr", "-o", "map.exr"],
            &["map.exr", "written as .png"],
        ),
        (
            &["a.png", "b.png", "-o", "./a.png"],
            &["one of the pictures"],
        ),
        (
            &["a.exr", "b.exr", "-o", "none/map.png"],
            &["no such folder"],
        ),
        (&["a.exr", "b.exr", "--map", "signed"], &["--output"]),
        (&["a.exr", "b.exr", "--ppd", "1e9"], &["between 1 and 1000"]),
    ] {
        let run = work.run(&[&["compare"], line].concat());
        assert_eq!(run.status, 2, "{line:?}\n{run:?}");
        for part in parts {
            assert!(run.err.contains(part), "no {part} in\n{run:?}");
        }
    }
    assert_eq!(work.files(), before);
}
