//! `check`: suites, experiments with `stability`, and what goes wrong with them.

use crate::support::Work;

/// A closed sphere of albedo ρ that glows: its radiance is 1/(1 − ρ).
pub const SPHERE: &str = r#"(
    film: (width: 4, height: 4),
    entities: {
        "wall": {"Lambert": (reflectance: 0.5), "Emission": (radiance: 1, two_sided: true)},
        "sphere": {"Sphere": (radius: 1), "MaterialRef": "wall"},
        "eye": {"PerspectiveCamera": (), "LookAt": (from: (0, 0, 0.5), to: (0, 0, 0)), "ActiveCamera": ()},
    },
)
"#;

fn work(stability: &str) -> Work {
    let work = Work::new();
    work.write("sphere.scene.ron", SPHERE);
    let text = format!(
        r#"(
    title: "Closed <sphere>",
    base: "sphere.scene.ron",
    set: {{"integrator": PathBsdf(max_depth: 60, roulette_from: None), "budget.samples": 4}},
    axes: {{"entities.wall.Lambert.reflectance": [0.25, 0.5, 0.75]}},
    stability: {stability},
)
"#
    );
    work.write("mine.exp.ron", &text);
    work
}

#[test]
fn an_experiment_that_holds_is_reported_in_text_json_and_on_a_page() {
    let work = work(
        "(parameter: \"albedo\", truth: Mean([1.3333333, 2, 4]), bound: 1e-4, holds: (0, 0.8))",
    );
    let run = work.done(&["check", "mine.exp.ron", "-o", "c"]);
    assert!(run.out.contains("holds   mine "), "{run:?}");
    assert!(
        run.out.contains("1 bound checked") && run.out.contains("all hold"),
        "{run:?}"
    );
    let json = work.json("c/check.json");
    let sweep = &json["suites"][0]["sweeps"][0];
    assert_eq!(
        (&json["version"], &json["verdict"]),
        (&1.into(), &"holds".into())
    );
    assert_eq!(sweep["points"].as_array().unwrap().len(), 3);
    assert_eq!(sweep["parameter"], "albedo");
    let page = String::from_utf8(work.read("c/report.html")).unwrap();
    assert!(page.contains("Closed &lt;sphere&gt;") && page.contains("<svg"));
    // Again into the same folder; not into one with something else.
    work.done(&["check", "mine.exp.ron", "-o", "c", "--quiet"]);
    std::fs::create_dir(work.path("d")).unwrap();
    work.write("d/letter.txt", "");
    let run = work.run(&["check", "mine.exp.ron", "-o", "d"]);
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.err.contains("check.json"), "{run:?}");
}

#[test]
fn a_broken_bound_is_status_1_and_says_where() {
    let work = work("(truth: Mean([1.3333333, 2, 5]), bound: 0.01)");
    let run = work.run(&["check", "mine.exp.ron"]);
    assert_eq!(run.status, 1, "{run:?}");
    assert!(run.out.contains("BROKEN  mine"), "{run:?}");
    assert!(
        run.out.contains("mean 4.000000, should be 5.000000"),
        "{run:?}"
    );
    let json = work.run(&["check", "mine.exp.ron", "--json"]);
    assert_eq!(json.status, 1);
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["verdict"], "broken");
    // Where it is not promised it may be wrong, and is told.
    let text = "(truth: Mean([1.3333333, 2, 5]), bound: 0.01, holds: (0, 0.6))";
    let run = self::work(text).done(&["check", "mine.exp.ron"]);
    assert!(run.out.contains("fails at 0.75"), "{run:?}");
}

#[test]
fn the_first_is_the_truth_when_nothing_else_is() {
    let work = work("(truth: First, bound: 0.01)");
    let run = work.run(&["check", "mine.exp.ron"]);
    assert_eq!(run.status, 1, "other albedos are other pictures: {run:?}");
    assert!(run.out.contains("should be 1.333333"), "{run:?}");
}

#[test]
fn mistakes_in_stability_have_places_and_advice() {
    for (text, wanted) in [
        ("(bound: 0.1)", "`truth`"),
        ("(truth: First)", "`bound`"),
        ("(truth: Mean([1, 2]), bound: 0.1)", "3 numbers above 0"),
        ("(truth: First, bound: -1)", "a relative error"),
        ("(truth: First, bound: 1, holds: (2, 1))", "rising"),
        ("(truth: First, bound: 1, hold: (0, 1))", "`holds`"),
    ] {
        let run = work(text).run(&["check", "mine.exp.ron"]);
        assert_eq!(run.status, 2, "{text}: {run:?}");
        assert!(run.err.contains("mine.exp.ron:6:"), "{text}: {run:?}");
        assert!(run.err.contains(wanted), "{text}: {run:?}");
    }
    let work = work("(truth: First, bound: 1)");
    work.write("none.exp.ron", "(base: \"tiny.ron\")");
    let run = work.run(&["check", "none.exp.ron"]);
    assert_eq!(run.status, 2);
    assert!(run.err.contains("has no `stability`"), "{run:?}");
}

#[test]
fn suites_are_known_by_name() {
    let work = Work::new();
    let run = work.run(&["check", "sum"]);
    assert_eq!(run.status, 2);
    assert!(run.err.contains("did you mean `sums`"), "{run:?}");
    let run = work.done(&["check", "sums"]);
    assert!(run.out.starts_with("sums: "), "{run:?}");
    assert!(run.out.contains("holds   equal_samples"), "{run:?}");
    assert_eq!(work.files().len(), 2, "nothing is written without -o");
}
