//! Reports of experiments in a real browser: `tests/browser/report.mjs` uses one as a person would.
//!
//! Where node, Chromium or the script's package is missing, the test says that it is skipped; with
//! `STERADIAN_BROWSER=required` it fails instead. `STERADIAN_DUMP` names a folder for screenshots.

use crate::support::Work;
use serde_json::json;
use sr_pipeline::film_kernel::{Image, read_image};
use std::path::{Path, PathBuf};
use std::process::Command;

const EXPERIMENT: &str = r#"(
    title: "Two ways to <find> a lamp",
    note: "One by luck.",
    base: "tiny.ron",
    methods: {
        "path & light": {"integrator": Path(max_depth: 1)},
        "by luck": {"integrator": Direct(strategy: Hemisphere)},
    },
    seeds: 2,
    budget: (samples: 32),
    metrics: [RelMse, Mape],
    reference: (integrator: Path(max_depth: 1), samples: 512),
    show: (insets: [(2, 2, 8, 8)]),
)
"#;

/// Node, Chromium and the folder of the script, or what is missing.
fn tools() -> Result<(PathBuf, PathBuf), String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/browser");
    if !folder.join("node_modules/playwright-core").is_dir() {
        return Err(format!("run `npm ci` in {}", folder.display()));
    }
    let runs = |program: &Path| {
        let output = Command::new(program).arg("--version").output();
        output.is_ok_and(|o| o.status.success())
    };
    if !runs(Path::new("node")) {
        return Err("node is missing".into());
    }
    let candidates = [
        "/usr/bin/chromium",
        "/usr/bin/chromium-browser",
        "/usr/bin/google-chrome",
    ];
    let own = std::env::var_os("STERADIAN_CHROMIUM").map(PathBuf::from);
    let candidates = own.into_iter().chain(candidates.map(PathBuf::from));
    let found = candidates.into_iter().find(|c| runs(c));
    let chromium = found.ok_or("Chromium is missing (STERADIAN_CHROMIUM may name it)")?;
    Ok((folder, chromium))
}

fn expected(label: &str, image: &Image) -> serde_json::Value {
    let rgb: Vec<[f32; 3]> = image.pixels.iter().map(|p| p.to_array()).collect();
    json!({"label": label, "width": image.width, "height": image.height, "rgb": rgb})
}

#[test]
fn a_report_can_be_used_in_a_browser_and_shows_the_numbers_of_the_files() {
    let (folder, chromium) = match tools() {
        Ok(tools) => tools,
        Err(missing) => {
            let required = std::env::var("STERADIAN_BROWSER").is_ok_and(|v| v == "required");
            assert!(!required, "the browser's test cannot run: {missing}");
            eprintln!("skipped: {missing}");
            return;
        }
    };
    let work = Work::new();
    work.write("b.exp.ron", EXPERIMENT);
    work.done(&["experiment", "b.exp.ron", "-o", "e", "--quiet"]);
    let results = work.json("e/results.json");
    let reference = results["references"][0]["file"]
        .as_str()
        .unwrap()
        .to_owned();
    let pictures: Vec<serde_json::Value> = [
        ("path & light", "runs/path-light-seed-0.exr"),
        ("by luck", "runs/by-luck-seed-0.exr"),
        ("reference", reference.as_str()),
    ]
    .iter()
    .map(|(label, file)| expected(label, &read_image(work.path(&format!("e/{file}"))).unwrap()))
    .collect();
    work.write("expected.json", &json!({"pictures": pictures}).to_string());
    let mut command = Command::new("node");
    command.arg("report.mjs").current_dir(folder);
    command.args([
        work.path("e/report.html"),
        work.path("expected.json"),
        chromium,
    ]);
    command.args(std::env::var_os("STERADIAN_DUMP"));
    let output = command.output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}\n{errors}");
    assert!(told.matches("ok: ").count() >= 15, "{told}");
}
