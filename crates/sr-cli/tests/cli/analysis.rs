//! What an experiment says of its runs together.

use crate::support::Work;
use serde_json::Value;

fn group(work: &Work) -> Value {
    let json = work.json("e/results.json");
    let groups = json["analysis"]["groups"].as_array().unwrap();
    assert_eq!(groups.len(), 1);
    groups[0].clone()
}

/// Twice the work for the same picture, and a picture that is wrong: a reflectance of 0.55 for one of
/// 0.6.
const METHODS: &str = r#"(
    base: "tiny.ron",
    set: {"sampler.kind": Independent, "film.width": 64, "film.height": 48},
    methods: {
        "right": {"budget.samples": 256},
        "wasteful": {"integrator": Direct(strategy: Hemisphere), "budget.samples": 256},
        "wrong": {"entities.grey.Lambert.reflectance": 0.55, "budget.samples": 256},
    },
    seeds: 4,
    baseline: "wasteful",
    metrics: [RelMse, Flip],
    reference: (samples: 4096, set: {"sampler.kind": Sobol}),
)
"#;

#[test]
fn the_analysis_tells_who_wins_and_who_is_wrong() {
    let work = Work::new();
    work.write("e.exp.ron", METHODS);
    let run = work.done(&["experiment", "e.exp.ron", "-o", "e"]);
    let group = group(&work);
    let contenders = group["contenders"].as_array().unwrap();
    let labels: Vec<&str> = contenders
        .iter()
        .map(|c| c["label"].as_str().unwrap())
        .collect();
    assert_eq!(labels, ["right", "wasteful", "wrong"]);
    assert_eq!(
        (&group["baseline"], &group["comparable"]),
        (&1.into(), &true.into())
    );

    // Independent samples: an error as 1/samples, with room for four seeds.
    for (i, contender) in contenders.iter().take(2).enumerate() {
        let curve = &contender["curves"]["Mse"];
        assert_eq!(curve["points"].as_array().unwrap().len(), 8, "{contender}");
        let slope = curve["slope_samples"]["slope"].as_f64().unwrap();
        assert!((slope + 1.0).abs() < 0.1, "{} falls as {slope}", labels[i]);
        assert!(contender["efficiency"]["value"].as_f64().unwrap() > 0.0);
    }
    // 16 times the variance and more, whatever the clock does: it is there at its first log point, or
    // long before the other.
    let speed_up = contenders[0]["speed_up"]["value"].as_f64();
    let at_once = contenders[0]["reached"]["kind"] == "before";
    assert!(at_once || speed_up.unwrap() > 2.0, "{contenders:?}");

    let wrong = &contenders[2];
    assert_eq!(wrong["bias"]["answer"], "different", "{wrong}");
    let share = wrong["bias"]["share"].as_f64().unwrap();
    assert!(share > 0.5 && share < 1.05, "{share}");
    assert!(wrong["bias"]["brightness"].as_f64().unwrap() < -0.02);
    let map = wrong["bias"]["map"].as_str().unwrap();
    assert!(work.path(&format!("e/{map}")).is_file());
    let flattening = &wrong["curves"]["RelMse"]["slope_samples"]["flattening"];
    assert_eq!(flattening["found"], true, "{flattening}");
    assert_eq!(contenders[0]["bias"]["answer"], "same", "{contenders:?}");
    let pair = |a: u64, b: u64| {
        let pairs = group["pairs"].as_array().unwrap();
        let found = pairs.iter().find(|p| p["a"] == a && p["b"] == b);
        found.unwrap()["answer"].as_str().unwrap().to_owned()
    };
    assert_eq!(pair(0, 2), "different");
    assert_ne!(pair(0, 1), "different");

    for told in [
        "right wins: ",
        "wrong is biased: ",
        "wrong's error flattens",
    ] {
        assert!(run.out.contains(told), "no `{told}`: {}", run.out);
    }
}

#[test]
fn a_poor_reference_is_refused() {
    let work = Work::new();
    let text = r#"(
        base: "tiny.ron",
        methods: {"a": {}, "b": {"sampler.kind": Independent}},
        set: {"budget.samples": 256},
        seeds: 3,
        reference: (samples: 16, set: {"sampler.kind": Independent}),
    )"#;
    work.write("e.exp.ron", text);
    let run = work.done(&["experiment", "e.exp.ron", "-o", "e"]);
    assert!(
        run.out
            .contains("Which is sooner cannot be said: at relMSE "),
        "{run:?}"
    );
    assert!(
        run.err.contains("the reference is not good enough"),
        "{run:?}"
    );
    assert!(group(&work)["winner"].is_null());
    // Higher up it is good enough.
    work.write(
        "e.exp.ron",
        &text.replace("seeds: 3", "seeds: 3, target: 0.5"),
    );
    let run = work.done(&["experiment", "e.exp.ron", "-o", "e"]);
    assert!(!run.out.contains("cannot be said"), "{run:?}");
}

#[test]
fn log_points_can_be_at_marks_of_time() {
    let work = Work::new();
    let text = r#"(
        base: "tiny.ron",
        set: {"film.width": 32, "film.height": 24},
        seeds: 2,
        budget: (seconds: 0.4),
        log: (seconds: [0.1, 0.2]),
    )"#;
    work.write("e.exp.ron", text);
    work.done(&["experiment", "e.exp.ron", "-o", "e"]);
    let json = work.json("e/results.json");
    let rows = json["rows"].as_array().unwrap();
    let seconds: Vec<f64> = rows
        .iter()
        .map(|r| r["seconds"].as_f64().unwrap())
        .collect();
    assert_eq!(rows.len(), 6, "{seconds:?}");
    for run in seconds.chunks(3) {
        assert!(
            run[0] >= 0.1 && run[1] >= 0.2 && run[2] > run[1],
            "{seconds:?}"
        );
    }
    assert!(json["runs"][0]["over_seconds"].is_number());
    let points = group(&work)["contenders"][0]["curves"]["RelMse"]["points"].clone();
    assert_eq!(points.as_array().unwrap().len(), 3);
}

#[test]
fn pictures_of_different_things_are_not_compared() {
    let work = Work::new();
    let text = r#"(
        base: "tiny.ron",
        axes: {"entities.grey.Lambert.reflectance": [0.2, 0.8]},
        seeds: 2,
        reference: (samples: 64),
    )"#;
    work.write("e.exp.ron", text);
    let run = work.done(&["experiment", "e.exp.ron", "-o", "e"]);
    let group = group(&work);
    assert_eq!(group["comparable"], false);
    assert_eq!(group["pairs"].as_array().unwrap().len(), 0);
    assert!(!run.out.contains("wins"), "{}", run.out);
}
