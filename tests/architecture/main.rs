//! The borders between crates, and the order within schedules.

use sr_pipeline::{Compile, Load, Measure, Post, Render};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Which crates of ours, and which others that matter to the borders, a crate may see.
/// `ARCHITECTURE.md` says why.
const ARROWS: &[(&str, &[&str])] = &[
    ("sr-stats", &[]),
    ("sr-math", &["glam"]),
    ("sr-sampling", &["sr-math", "glam"]),
    ("sr-bsdf", &["sr-math", "glam"]),
    ("sr-light", &["sr-math", "glam"]),
    ("sr-accel", &["sr-math", "glam", "obvhs", "rayon"]),
    ("sr-film", &["sr-math", "glam", "image", "exr"]),
    (
        "sr-render",
        &[
            "sr-math",
            "sr-sampling",
            "sr-bsdf",
            "sr-light",
            "sr-accel",
            "sr-film",
            "glam",
        ],
    ),
    (
        "sr-scene",
        &[
            "sr-math",
            "sr-render",
            "glam",
            "rayon",
            "bevy_ecs",
            "bevy_reflect",
        ],
    ),
    (
        "sr-io",
        &[
            "sr-scene",
            "glam",
            "sr-render",
            "bevy_ecs",
            "bevy_reflect",
            "gltf",
            "tobj",
            "ron",
        ],
    ),
    (
        "sr-pipeline",
        &[
            "sr-scene",
            "sr-render",
            "sr-film",
            "sr-stats",
            "glam",
            "rayon",
            "bevy_ecs",
            "bevy_reflect",
        ],
    ),
    ("sr-integrators", &["sr-pipeline"]),
    (
        "sr-experiment",
        &["sr-pipeline", "sr-io", "sr-film", "sr-stats", "glam"],
    ),
    (
        "sr-stability",
        &[
            "sr-pipeline",
            "sr-scene",
            "sr-io",
            "sr-integrators",
            "sr-experiment",
            "sr-film",
            "sr-stats",
            "glam",
            "rayon",
        ],
    ),
    (
        "sr-cli",
        &[
            "sr-pipeline",
            "sr-scene",
            "sr-io",
            "sr-integrators",
            "sr-experiment",
            "sr-stability",
            "sr-film",
        ],
    ),
    ("sr-tools", &["sr-film", "sr-light", "sr-sampling", "glam"]),
    ("example-ambient-occlusion", &["sr-pipeline"]),
    ("example-light-tracer", &["sr-pipeline"]),
];

/// Crates outside the workspace that only some may see.
const GUARDED: &[&str] = &[
    "glam",
    "obvhs",
    "rayon",
    "image",
    "exr",
    "bevy_ecs",
    "bevy_reflect",
    "gltf",
    "tobj",
    "ron",
];

/// Normal dependencies of each workspace member.
fn members() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
            "--locked",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo metadata runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    let text = |v: &serde_json::Value| v.as_str().expect("a name").to_owned();
    packages
        .iter()
        .map(|package| {
            let dependencies = package["dependencies"].as_array().expect("dependencies");
            let normal = dependencies.iter().filter(|d| d["kind"].is_null());
            (
                text(&package["name"]),
                normal.map(|d| text(&d["name"])).collect(),
            )
        })
        .collect()
}

#[test]
fn dependencies_never_point_sideways_or_up() {
    let members = members();
    for (name, dependencies) in &members {
        // The tests see everything.
        if name == "sr-tests" {
            continue;
        }
        let allowed = ARROWS.iter().find(|(n, _)| n == name);
        let (_, allowed) = allowed.unwrap_or_else(|| panic!("{name} has no place in ARROWS"));
        for dependency in dependencies {
            let matters =
                members.contains_key(dependency) || GUARDED.contains(&dependency.as_str());
            assert!(
                !matters || allowed.contains(&dependency.as_str()),
                "{name} must not depend on {dependency}"
            );
        }
    }
}

/// Kernels are below the line: nothing that they build with, however far down, is of bevy.
#[test]
fn kernels_build_without_ecs() {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "-p",
            "sr-render",
            "-e",
            "normal,build",
            "--prefix",
            "none",
        ])
        .args(["--offline", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo tree runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let tree = String::from_utf8_lossy(&output.stdout);
    assert!(
        tree.lines().any(|l| l.starts_with("obvhs ")),
        "not the tree: {tree}"
    );
    let bevy: Vec<&str> = tree.lines().filter(|l| l.starts_with("bevy_")).collect();
    assert!(bevy.is_empty(), "{bevy:?}");
}

/// Two systems of one schedule that touch the same data have an order between them: bevy_ecs
/// refuses to build the schedule otherwise.
/// Where `unsafe` is: kernels for an instruction set, each with an oracle in safe Rust. The lint `unsafe_code`
/// is denied elsewhere, so that what is looked for is who allows it.
const UNSAFE: &[&str] = &["crates/sr-accel/src/lanes/avx2.rs"];

#[test]
fn unsafe_code_is_where_it_is_listed_and_every_block_has_its_argument() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let found: Vec<String> = rust_files(root.as_ref())
        .filter_map(|path| {
            let text = std::fs::read_to_string(&path).expect("a source file");
            // Not this line.
            let allows = text
                .lines()
                .any(|l| l.trim_start().starts_with("unsafe_code"));
            allows.then(|| {
                path.strip_prefix(root)
                    .expect("below")
                    .display()
                    .to_string()
            })
        })
        .collect();
    assert_eq!(found, UNSAFE);
    for path in UNSAFE {
        let text = std::fs::read_to_string(format!("{root}/{path}")).expect("listed");
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for (i, line) in lines
            .iter()
            .enumerate()
            .filter(|(_, l)| l.contains("unsafe {"))
        {
            let comment = lines[..i].iter().rev().take_while(|l| l.starts_with("//"));
            let argued = comment.clone().any(|l| l.contains("SAFETY:"));
            assert!(argued, "{path}:{}: `{line}` has no SAFETY comment", i + 1);
        }
    }
}

/// The source files of our crates, in order.
fn rust_files(root: &Path) -> impl Iterator<Item = PathBuf> {
    let mut pending = vec![root.join("crates"), root.join("tools"), root.join("tests")];
    let mut out = Vec::new();
    while let Some(folder) = pending.pop() {
        for entry in std::fs::read_dir(&folder)
            .expect("a folder of ours")
            .flatten()
        {
            let path = entry.path();
            let name = entry.file_name();
            if path.is_dir() && name != "target" && name != "node_modules" {
                pending.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                out.push(path);
            }
        }
    }
    out.sort();
    out.into_iter()
}

#[test]
fn ambiguity_is_an_error_in_every_schedule_and_none_has_any() {
    use sr_pipeline::bevy_ecs::prelude::*;
    use sr_pipeline::bevy_ecs::schedule::{LogLevel, ScheduleLabel, Schedules};
    let mut pipeline = sr_tests::pipeline(1);
    sr_io::install(&mut pipeline.world);
    let labels = [
        Load.intern(),
        Compile.intern(),
        Render.intern(),
        Measure.intern(),
        Post.intern(),
    ];
    assert_eq!(
        pipeline.world.resource::<Schedules>().iter().count(),
        labels.len()
    );
    for label in labels {
        pipeline
            .world
            .schedule_scope(label, |world: &mut World, schedule| {
                let level = schedule.get_build_settings().ambiguity_detection;
                assert!(matches!(level, LogLevel::Error), "{label:?}");
                if let Err(error) = schedule.initialize(world) {
                    panic!("{label:?}: {error:?}");
                }
            });
    }
}
