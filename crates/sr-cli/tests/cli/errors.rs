//! The errors of experiments: what their formulas say of the pictures beside them, and the same whatever
//! the clock and the threads.

use crate::support::Work;
use serde_json::Value;
use sr_pipeline::film_kernel::{Image, read_channels, read_image};
use std::collections::BTreeMap;

/// Radiance and variance of the reference as an experiment keeps it.
fn reference(work: &Work, json: &Value) -> (Image, Vec<[f64; 3]>) {
    let path = work.path(&format!(
        "e/{}",
        json["references"][0]["file"].as_str().unwrap()
    ));
    let planes = read_channels(&path, &["Variance.R", "Variance.G", "Variance.B"])
        .unwrap()
        .planes;
    let variance = (0..planes[0].len())
        .map(|i| [0, 1, 2].map(|c| f64::from(planes[c][i])))
        .collect();
    (read_image(&path).unwrap(), variance)
}

/// The definitions of docs/conventions.md, written out once more.
fn by_hand(x: &Image, r: &Image, variance: &[[f64; 3]]) -> BTreeMap<&'static str, f64> {
    let mut sums = BTreeMap::from([
        ("mse", 0.0),
        ("relmse", 0.0),
        ("mape", 0.0),
        ("smape", 0.0),
        ("mse_debiased", 0.0),
        ("relmse_debiased", 0.0),
    ]);
    let mut add = |name: &str, value: f64| *sums.get_mut(name).unwrap() += value;
    for (i, (x, r)) in x.pixels.iter().zip(&r.pixels).enumerate() {
        for c in 0..3 {
            let (x, r) = (f64::from(x[c]), f64::from(r[c]));
            let (off, weight) = ((x - r).abs(), 1.0 / (r * r + 0.01));
            add("mse", off * off);
            add("relmse", off * off * weight);
            add("mape", off / (r.abs() + 0.01));
            add("smape", off / (x.abs() + r.abs() + 0.01));
            add("mse_debiased", off * off - variance[i][c]);
            add("relmse_debiased", (off * off - variance[i][c]) * weight);
        }
    }
    let n = 3.0 * x.pixels.len() as f64;
    sums.into_iter().map(|(name, v)| (name, v / n)).collect()
}

/// To 10⁻⁶ of their size, as everything that is written down is held to; sums of 576 terms in `f64` are
/// better by far.
#[test]
fn rows_hold_what_the_formulas_say_of_the_pictures() {
    let work = Work::new();
    work.write(
        "x.exp.ron",
        r#"(base: "tiny.ron", budget: (samples: 32), seeds: 2,
            methods: {"a": {}, "b": {"integrator": Direct(strategy: Hemisphere)}}, reference: (samples: 512))"#,
    );
    work.done(&["experiment", "x.exp.ron", "-o", "e", "--quiet"]);
    let json = work.json("e/results.json");
    let (reference, variance) = reference(&work, &json);
    let last = json["rows"].as_array().unwrap().iter();
    let last: Vec<&Value> = last.filter(|r| r["last"] == true).collect();
    assert_eq!(last.len(), 4);
    for row in last {
        let picture = format!("e/runs/{}.exr", row["run"].as_str().unwrap());
        let picture = read_image(work.path(&picture)).unwrap();
        for (name, value) in by_hand(&picture, &reference, &variance) {
            let written = row[name].as_f64().unwrap();
            assert!(
                (written / value - 1.0).abs() < 1e-6,
                "{name}: {written} {value}"
            );
        }
    }
}

/// What a row says of the picture, by run and samples.
fn errors(json: &Value) -> BTreeMap<(String, u64), Vec<Value>> {
    let rows = json["rows"].as_array().unwrap().iter();
    rows.map(|row| {
        let key = (
            row["run"].as_str().unwrap().to_owned(),
            row["samples"].as_u64().unwrap(),
        );
        let names = [
            "samples_total",
            "rays",
            "mse",
            "relmse",
            "relmse_trimmed",
            "mape",
            "smape",
            "flip",
            "mse_debiased",
            "relmse_debiased",
            "relmse_estimate",
        ];
        (key, names.map(|name| row[name].clone()).to_vec())
    })
    .collect()
}

/// A budget of time, and passes that are sized by the clock: how far a run gets differs, what it is at
/// equal samples does not, to the last bit of the text.
#[test]
fn errors_at_equal_samples_do_not_depend_on_time_or_threads() {
    let work = Work::new();
    work.write(
        "x.exp.ron",
        r#"(base: "tiny.ron", budget: (seconds: 0.25), seeds: 2, metrics: [RelMse, Flip],
            methods: {"Sobol": {}, "independent": {"sampler.kind": Independent}}, reference: (samples: 256))"#,
    );
    let mut all: Vec<BTreeMap<(String, u64), Vec<Value>>> = Vec::new();
    for (folder, more) in [
        ("a", ["--threads", "1"]),
        ("b", ["--threads", "2"]),
        ("c", ["--set", "budget.seconds=0.1"]),
    ] {
        let line = ["experiment", "x.exp.ron", "-o", folder, "--quiet"];
        work.done(&[&line[..], &more[..]].concat());
        all.push(errors(&work.json(&format!("{folder}/results.json"))));
    }
    for other in &all[1..] {
        let common: Vec<_> = all[0].keys().filter(|k| other.contains_key(k)).collect();
        // Four runs with 2, 4, 8 … samples: the tiny scene has thousands of samples in a tenth of a second.
        assert!(common.len() >= 4 * 4, "{common:?}");
        for key in common {
            assert_eq!(all[0][key], other[key], "{key:?}");
        }
    }
}
