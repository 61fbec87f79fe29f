//! `--stats` against its documentation.

use crate::support::Work;
use serde_json::Value;
use std::collections::BTreeSet;

/// The keys of the table in docs/stats.md.
fn documented() -> BTreeSet<String> {
    let page = include_str!("../../../../docs/stats.md");
    page.lines()
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once('`')?.0.to_owned()))
        .collect()
}

/// Every key of an object, with those of objects inside; lists count by their first item.
fn keys(value: &Value, prefix: &str, all: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                let path = format!("{prefix}{name}");
                match value {
                    Value::Object(_) => keys(value, &format!("{path}."), all),
                    Value::Array(_) => keys(value, &format!("{path}[]."), all),
                    _ => {}
                }
                all.insert(path);
            }
        }
        Value::Array(items) => {
            if let Some(first) = items.first() {
                keys(first, prefix, all);
            }
        }
        _ => {}
    }
}

#[test]
fn the_keys_are_those_of_the_documentation() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.png",
        "--stats",
        "s.json",
        "--spp",
        "96",
        "--adaptive",
        "0.1",
        "--set",
        "film.clamp=0.5",
    ]);
    let mut written = BTreeSet::new();
    keys(&work.json("s.json"), "", &mut written);
    let documented = documented();
    assert!(documented.len() > 30);
    // Groups are documented by their members, and a clean render has no rejected samples.
    let groups = ["seconds", "rays", "scene"];
    let undocumented: Vec<_> = written
        .difference(&documented)
        .filter(|k| !groups.contains(&k.as_str()))
        .collect();
    assert!(undocumented.is_empty(), "{undocumented:?}");
    let missing: Vec<_> = documented
        .difference(&written)
        .filter(|k| !k.starts_with("rejected[]"))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_figures_agree_with_one_another() {
    let work = Work::new();
    work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.exr",
        "--stats",
        "s.json",
        "--threads",
        "2",
    ]);
    let s = work.json("s.json");
    let number = |path: &str| {
        let value = path.split('.').fold(&s, |v, key| &v[key]);
        value.as_f64().unwrap_or_else(|| panic!("{path}: {value}"))
    };
    assert_eq!(s["version"], 1);
    assert_eq!(number("samples"), 16.0 * 12.0 * 4.0);
    assert_eq!(number("samples_per_pixel"), 4.0);
    assert_eq!(number("rays.camera"), number("samples"));
    let rays = number("rays.camera") + number("rays.bounce") + number("rays.shadow");
    let rate = number("rays_per_second") * number("seconds.integrate");
    assert!((rate / rays - 1.0).abs() < 1e-9, "{rate} {rays}");
    assert!(number("peak_memory_bytes") > 1e6);
    assert!(number("error.relmse") > 0.0);
    assert_eq!(s["stop"], "samples");
    assert_eq!(s["adaptive"], Value::Null);
    assert_eq!(s["threads"], 2);
    assert_eq!(s["integrator"], "Path");
    assert_eq!(s["seed"], 0);
    assert_eq!(s["rejected"], Value::Array(Vec::new()));
    for (key, count) in [
        ("triangles", 0),
        ("spheres", 1),
        ("quads", 2),
        ("shapes", 3),
        ("lights", 1),
    ] {
        assert_eq!(s["scene"][key], count, "{key}");
    }
    assert_eq!(
        s["config_hash"],
        work.provenance("a.exr")["config_hash"].as_str()
    );
    let left_out = s["left_out"].as_array().unwrap();
    assert!(left_out.iter().any(|l| l["what"] == "feature: triangles"));
}

#[test]
fn what_cannot_be_told_is_null() {
    let work = Work::new();
    work.done(&[
        "render", "tiny.ron", "--spp", "1", "-o", "a.png", "--stats", "s.json",
    ]);
    // One sample has no variance.
    assert_eq!(work.json("s.json")["error"], Value::Null);
}
