//! `plan`, `list`, help.

use crate::support::Work;

#[test]
fn plan_tells_what_runs_and_what_is_left_out_and_writes_nothing() {
    let work = Work::new();
    let before = work.files();
    let run = work.done(&["plan", "tiny.ron", "--spp", "8", "--crop", "0,0,8,6"]);
    let (head, left_out) = run.out.split_once("left out").unwrap();
    let (head, runs) = head.split_once("runs").unwrap();
    for part in [
        "1 sphere, 2 quads",
        "16 × 12 pixels",
        "0,0,8,6 (48 pixels)",
        "8 samples a pixel, 384 in all",
        "Path(max_depth: Some(1)",
        "Sobol, seed 0, 2 replicas",
    ] {
        assert!(head.contains(part), "no {part} in\n{head}");
    }
    assert!(runs.contains("feature: spheres"));
    assert!(left_out.contains("feature: triangles"));
    assert_eq!(work.files(), before);
}

/// Rows of `list settings`: path and default, with the integrator that they belong to.
fn listed_settings(text: &str) -> Vec<(Option<String>, String, String)> {
    let mut integrator = None;
    let mut rows = Vec::new();
    for line in text.lines() {
        let Some(row) = line.strip_prefix("  ") else {
            let name = line.split_once("while it is `").map(|(_, name)| name);
            integrator = name.map(|n| n.trim_end_matches('`').to_owned());
            continue;
        };
        let columns: Vec<&str> = row
            .split("  ")
            .map(str::trim)
            .filter(|c| !c.is_empty())
            .collect();
        rows.push((
            integrator.clone(),
            columns[0].to_owned(),
            columns[2].to_owned(),
        ));
    }
    rows
}

#[test]
fn every_listed_setting_takes_its_listed_default() {
    let work = Work::new();
    let text = work.done(&["list", "settings"]).out;
    let (settings, entities) = text.split_once("entities.<name>").unwrap();
    let rows = listed_settings(settings);
    assert!(rows.len() > 20, "{text}");
    assert!(entities.contains("Sphere.radius"));
    let mut integrators: Vec<_> = rows.iter().filter_map(|r| r.0.clone()).collect();
    integrators.dedup();
    assert!(integrators.len() >= 4, "{integrators:?}");
    for integrator in &integrators {
        let mut line = vec![
            "plan".to_owned(),
            "tiny.ron".into(),
            "--integrator".into(),
            integrator.clone(),
        ];
        for (of, path, default) in &rows {
            if of.is_none() || of.as_ref() == Some(integrator) {
                line.extend(["--set".to_owned(), format!("{path}={default}")]);
            }
        }
        work.done(&line.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

#[test]
fn lists_come_from_the_registries() {
    let work = Work::new();
    for (what, names) in [
        (
            "integrators",
            &["Path ", "PathBsdf", "Direct", "Aov", "max_depth"][..],
        ),
        (
            "materials",
            &[
                "Lambert",
                "Dielectric",
                "Conductor",
                "alpha",
                "Microfacet roughness",
                "RoughDielectric",
                "OrenNayar",
                "Johnson and Christy 1972",
            ],
        ),
        (
            "lights",
            &[
                "PointLight",
                "SpotLight",
                "DirectionalLight",
                "Environment",
                "Emission",
            ],
        ),
        ("samplers", &["Sobol", "Independent", "The default."]),
        ("features", &["triangles", "environment"]),
    ] {
        let text = work.done(&["list", what]).out;
        for name in names {
            assert!(text.contains(name), "no {name} in\n{text}");
        }
    }
}

#[test]
fn help_and_version_are_no_failures() {
    let work = Work::new();
    let version = work.done(&["--version"]).out;
    assert_eq!(
        version,
        format!("steradian {}\n", env!("CARGO_PKG_VERSION"))
    );
    let help = work.done(&["render", "--help"]).out;
    for option in [
        "--output",
        "--set",
        "--spp",
        "--time",
        "--target-error",
        "--max-depth",
        "--width",
        "--height",
        "--integrator",
        "--threads",
        "--seed",
        "--crop",
        "--stats",
        "--quiet",
    ] {
        assert!(help.contains(option), "no {option} in\n{help}");
    }
}

/// A reader that has seen enough, such as `head`, is no failure.
#[test]
fn a_closed_pipe_is_no_failure() {
    let work = Work::new();
    let mut child = work
        .command(&["list", "settings"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = crate::support::Run::of(child.wait_with_output().unwrap());
    assert_eq!((run.status, run.err.as_str()), (0, ""));
}
