//! `check` of one scene: its samples examined, in text, JSON and on a page.

use crate::check::SPHERE;
use crate::support::Work;
use serde_json::Value;

const KINDS: [&str; 4] = ["Findings", "brightest", "Kurtosis", "How paths ended"];

/// Twice that is infinite.
const OVERFLOW: &str = "entities.wall.Emission.radiance=3e38";

#[test]
fn a_scene_is_examined_in_text_json_and_on_a_page() {
    let work = Work::new();
    let files = work.files();
    let run = work.done(&["check", "tiny.ron"]);
    assert!(
        run.out
            .starts_with("tiny.ron: Path, 192 pixels of 16 × 12, 64 samples each, seed 0, "),
        "{run:?}"
    );
    assert!(
        run.out.contains("none of 12,288 samples was refused"),
        "{run:?}"
    );
    assert!(run.out.contains("`max_depth` 1 cuts off"), "{run:?}");
    assert_eq!(work.files(), files, "nothing is written without -o");
    let run = work.done(&["check", "tiny.scene.ron", "-o", "c", "--json"]);
    let printed: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!(printed, work.json("c/check.json"));
    assert_eq!(printed["version"], 1);
    assert_eq!(printed["health"]["rejected"]["count"], 0);
    let page = String::from_utf8(work.read("c/report.html")).unwrap();
    for part in KINDS {
        assert!(page.contains(part), "no {part}");
    }
    assert!(page.contains("src=\"data:image/png;base64,"), "the picture");
    // The folder is a check's, whatever was checked before.
    work.done(&["check", "tiny.ron", "-o", "c", "-q"]);
}

/// Every key there is stands in the contract.
#[test]
fn every_key_is_documented() {
    let documented = concat!(
        include_str!("../../../../docs/health.md"),
        include_str!("../../../../docs/stability.md")
    );
    let work = Work::new();
    work.write("sphere.scene.ron", SPHERE);
    let run = work.run(&["check", "sphere.scene.ron", "--set", OVERFLOW, "--json"]);
    assert_eq!(run.status, 1, "{run:?}");
    let healthy = work.done(&["check", "tiny.ron", "--json", "--oracle"]);
    for run in [run, healthy] {
        let mut keys = Vec::new();
        let json: Value = serde_json::from_str(&run.out).unwrap();
        let fields = json.as_object().unwrap();
        // The machine's are those of all reports.
        let ours = fields.iter().filter(|(key, _)| *key != "machine");
        for (key, value) in ours {
            keys.push(key.clone());
            collect(value, &mut keys);
        }
        for key in keys {
            assert!(documented.contains(&format!("`{key}`")), "{key}");
        }
    }
}

fn collect(value: &Value, keys: &mut Vec<String>) {
    match value {
        Value::Object(fields) => fields.iter().for_each(|(key, value)| {
            keys.push(key.clone());
            collect(value, keys);
        }),
        Value::Array(values) => values.iter().for_each(|v| collect(v, keys)),
        _ => {}
    }
}

/// Light that overflows is refused, and that is status 1; the command that is printed replays it.
#[test]
fn refused_samples_are_status_1_and_can_be_replayed() {
    let work = Work::new();
    work.write("sphere.scene.ron", SPHERE);
    let run = work.run(&["check", "sphere.scene.ron", "--set", OVERFLOW]);
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.out.contains("  BROKEN  rejected    "), "{run:?}");
    assert!(run.out.contains("on `wall`"), "{run:?}");
    let command = run.out.lines().find(|l| l.contains("--replay")).unwrap();
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let wanted = ["render", "sphere.scene.ron", "--set", OVERFLOW];
    assert_eq!(words[..4], wanted, "{command}");
    let told = work.done(&words);
    assert!(
        told.out.contains("the film refuses it: not finite"),
        "{told:?}"
    );
}

#[test]
fn set_applies_and_what_is_left_out_has_a_reason() {
    let work = Work::new();
    let sets = ["--set", "integrator=Aov()", "--set", "film.crop=(2,3,7,5)"];
    let run = work.done(&[&["check", "tiny.ron"][..], &sets].concat());
    assert!(run.out.contains("Aov, 10 pixels of 16 × 12"), "{run:?}");
    assert!(
        run.out
            .contains("  left out  the ways of light and how paths ended: "),
        "{run:?}"
    );
    let run = work.run(&["check", "tiny.ron", "--set", "film.widht=8"]);
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.err.contains("did you mean `film.width`") || run.err.contains("width"));
}

#[test]
fn the_same_paths_in_f64_are_told_when_asked_for() {
    let work = Work::new();
    let run = work.done(&["check", "tiny.ron", "--oracle", "-o", "c"]);
    assert!(
        run.out
            .contains("  ok      oracle      4096 paths were traced again in f64"),
        "{run:?}"
    );
    assert!(run.out.contains("the mean is 0."), "{run:?}");
    let json = work.json("c/check.json");
    assert_eq!(json["health"]["oracle"]["paths"], 4096);
    let page = String::from_utf8(work.read("c/report.html")).unwrap();
    assert!(page.contains("hits lie off their surface"));
    let direct = ["--oracle", "--set", "integrator=Direct()"];
    let run = work.done(&[&["check", "tiny.ron"][..], &direct].concat());
    let why = "left out  the same paths in f64: ";
    assert!(run.out.contains(why), "{run:?}");
    let run = work.run(&["check", "sums", "--oracle"]);
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.err.contains("one scene"), "{run:?}");
}

#[test]
fn what_is_neither_a_suite_nor_a_scene_is_refused() {
    let work = Work::new();
    work.write("notes.txt", "");
    for (words, parts) in [
        (
            &["pats"][..],
            &["neither a suite nor a file", "did you mean `paths`"][..],
        ),
        (
            &["missing.ron"],
            &["`missing.ron` is neither a suite nor a file"],
        ),
        (
            &["notes.txt"],
            &["nor a file that can be checked", ".scene.ron", ".glb"],
        ),
        (
            &["tiny.ron", "sums"],
            &["a scene is examined alone: `check tiny.ron`"],
        ),
        (
            &["tiny.ron", "tiny.scene.ron"],
            &["a scene is examined alone"],
        ),
    ] {
        let run = work.run(&[&["check"], words].concat());
        assert_eq!(run.status, 2, "{words:?}: {run:?}");
        for part in parts {
            assert!(
                run.err.contains(part),
                "{words:?}: no {part} in {}",
                run.err
            );
        }
    }
}
