//! A stranger's binary with the same command line: this very test, started again by itself with
//! arguments. It has no test harness, so that panics are reported as the command line does it.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use sr_pipeline::accel::Ray;
use sr_pipeline::prelude::*;
use std::process::{Command, ExitCode, Output};

/// White wherever there is something, or a panic, or not a number.
struct Silhouette {
    settings: SilhouetteSettings,
}

#[derive(Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default)]
struct SilhouetteSettings {
    /// Fails on purpose.
    panics: bool,
    /// What is there is not a number.
    nan: bool,
}

impl Integrator for Silhouette {
    const NAME: &'static str = "Silhouette";
    const SUMMARY: &'static str = "white wherever there is something";
    const USES: SceneFeatures = SceneFeatures::ALL;
    type Settings = SilhouetteSettings;
}

impl RayIntegrator for Silhouette {
    fn prepare(settings: &SilhouetteSettings, _: &RenderScene) -> Result<Self, String> {
        Ok(Self {
            settings: settings.clone(),
        })
    }

    fn li<C: RayContext>(&self, ray: &Ray, context: &mut C) -> Vec3 {
        assert!(!self.settings.panics, "out of paper");
        let Some(point) = context.closest(ray) else {
            return Vec3::ZERO;
        };
        context.at(1, &point);
        let u = context.sampler().d1(Dim::user(0));
        let white = if self.settings.nan { f32::NAN } else { 1.0 };
        Vec3::splat(if u < 1.0 { white } else { 0.0 })
    }
}

fn silhouette(pipeline: &mut Pipeline) {
    pipeline.add_ray_integrator::<Silhouette>();
}

fn main() -> ExitCode {
    if std::env::var_os("STERADIAN_STRANGER").is_some() {
        return sr_cli::run(std::env::args_os(), &[&silhouette]);
    }
    // What a harness would be asked, such as `--list`, has no answer here.
    if std::env::args().any(|a| a == "--list") {
        return ExitCode::SUCCESS;
    }
    its_integrator_is_listed_and_rendered_by_name();
    a_panic_in_a_stage_is_an_error_with_the_stages_name();
    what_is_not_a_number_is_found_named_and_replayed();
    what_is_not_a_number_is_found_by_a_check();
    a_run_that_panics_leaves_the_others_of_its_experiment_alone();
    ExitCode::SUCCESS
}

fn stranger(folder: &tempfile::TempDir, args: &[&str]) -> Output {
    Command::new(std::env::current_exe().unwrap())
        .args(args)
        .current_dir(folder.path())
        .env("STERADIAN_STRANGER", "1")
        .env_remove("RUST_BACKTRACE")
        .output()
        .unwrap()
}

fn scene() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scene = r#"(entities: {
        "grey": {"Lambert": ()},
        "ball": {"Sphere": (radius: 1), "MaterialRef": "grey"},
        "eye": {"PerspectiveCamera": (hfov_deg: 90), "LookAt": (from: (0, 0, 2)), "ActiveCamera": ()},
    })"#;
    std::fs::write(folder.path().join("ball.scene.ron"), scene).unwrap();
    folder
}

fn its_integrator_is_listed_and_rendered_by_name() {
    let folder = scene();
    let listed = stranger(&folder, &["list", "integrators"]);
    let listed = String::from_utf8(listed.stdout).unwrap();
    assert!(
        listed.contains("White wherever there is something."),
        "{listed}"
    );
    let line =
        "render ball.scene.ron -o a.exr --integrator silhouette --width 8 --height 8 --spp 1";
    let run = stranger(&folder, &line.split(' ').collect::<Vec<_>>());
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let image = sr_pipeline::film_kernel::read_image(folder.path().join("a.exr")).unwrap();
    assert_eq!(
        (image.pixel(4, 4), image.pixel(0, 0)),
        (Vec3::ONE, Vec3::ZERO)
    );
}

fn a_panic_in_a_stage_is_an_error_with_the_stages_name() {
    let folder = scene();
    let old = folder.path().join("a.exr");
    std::fs::write(&old, "old").unwrap();
    let line = "render ball.scene.ron -o a.exr --integrator Silhouette(panics:true) --spp 1";
    let run = stranger(&folder, &line.split(' ').collect::<Vec<_>>());
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    for part in [
        "error: stage Render failed in ",
        "Silhouette",
        "out of paper",
        "stranger.rs",
    ] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
    assert!(!text.contains("thread '"), "the panic was dumped:\n{text}");
    assert_eq!(std::fs::read_to_string(old).unwrap(), "old");
}

fn what_is_not_a_number_is_found_named_and_replayed() {
    let folder = scene();
    let line = "render ball.scene.ron -o a.png --stats s.json --spp 2 --width 8 --height 8 \
                --set integrator=Silhouette(nan:true)";
    let run = stranger(&folder, &line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let text = String::from_utf8(run.stderr).unwrap();
    assert!(
        text.contains("not finite after 1 bounce on `grey`"),
        "{text}"
    );
    // The first word is the program's name, which is here this test's.
    let command = text
        .lines()
        .find(|l| l.contains("--replay"))
        .unwrap()
        .trim();
    assert!(
        command.contains(
            " render ball.scene.ron --width 8 --height 8 \
             --set 'integrator=Silhouette(nan:true)' --replay "
        ),
        "{command}"
    );
    let stats = std::fs::read_to_string(folder.path().join("s.json")).unwrap();
    assert!(
        stats.contains(&format!("\"replay\": \"{command}\"")),
        "{stats}"
    );
    let words: Vec<&str> = command
        .split(' ')
        .skip(1)
        .map(|w| w.trim_matches('\''))
        .collect();
    let run = stranger(&folder, &words);
    let told = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{told}");
    for part in [
        "number     user 0: ",
        "vertex 1: `ball` (ball.scene.ron:3:",
        "of `grey` (ball.scene.ron:2:",
        "at         1 bounce",
        "radiance (NaN, NaN, NaN)",
        "the film refuses it: not finite",
    ] {
        assert!(told.contains(part), "no {part} in\n{told}");
    }
}

fn what_is_not_a_number_is_found_by_a_check() {
    let folder = scene();
    let line = "check ball.scene.ron --set film.width=8 --set film.height=8 \
                --set integrator=Silhouette(nan:true)";
    let run = stranger(&folder, &line.split_whitespace().collect::<Vec<_>>());
    let text = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    for part in [
        "BROKEN  rejected",
        "not finite after 1 bounce on `grey`",
        " --set 'integrator=Silhouette(nan:true)' --replay ",
        "left out",
    ] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
}

fn a_run_that_panics_leaves_the_others_of_its_experiment_alone() {
    let folder = scene();
    let experiment = r#"(
        base: "ball.scene.ron",
        set: {"film.width": 8, "film.height": 8},
        budget: (samples: 2),
        methods: {
            "bad": {"integrator": Silhouette(panics: true)},
            "good": {"integrator": Silhouette()},
        },
    )"#;
    std::fs::write(folder.path().join("s.exp.ron"), experiment).unwrap();
    let run = stranger(&folder, &["experiment", "s.exp.ron", "-o", "e"]);
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    for part in [
        "[1/2] bad: stage Render failed in ",
        "out of paper",
        "[2/2] good: 2 samples, ",
        "error: 1 run of 2 failed; the others are in e",
    ] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
    let file = |name: &str| folder.path().join("e").join(name);
    assert!(file("runs/good.png").exists() && !file("runs/bad.png").exists());
    let page = std::fs::read_to_string(file("report.html")).unwrap();
    assert!(
        page.contains("out of paper") && page.contains("not done"),
        "{page}"
    );
}
