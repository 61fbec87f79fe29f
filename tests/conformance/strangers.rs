//! The example crates, which see nothing but the seam, rendered by name from RON files.

use sr_tests::{
    Scene,
    agree::{assert_same, pictures},
    repository,
};
use std::path::PathBuf;

/// A configuration file in a folder of its own.
fn config(folder: &tempfile::TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).expect("a file in a temporary folder");
    path
}

fn with_scene(folder: &tempfile::TempDir, scene: &str, integrator: &str) -> Scene {
    let scene = repository().join("scenes").join(scene);
    let text = format!(
        "(scene: {:?}, integrator: {integrator}, film: (width: 64, height: 48))",
        scene.display().to_string()
    );
    let name = format!("{}.ron", integrator.split('(').next().unwrap_or_default());
    Scene::load(&config(folder, &name, &text), &[])
}

#[test]
fn a_light_tracer_agrees_with_path() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for scene in [
        "cornell_boxes/cornell_boxes.scene.ron",
        "lights/lights.scene.ron",
    ] {
        let mut path = with_scene(&folder, scene, "Path(max_depth: 4)");
        let mut tracer = with_scene(&folder, scene, "LightTracer(max_depth: 4)");
        let what = format!("{scene}: Path and LightTracer");
        assert_same(
            &what,
            &pictures(&mut path, 64, 1),
            &pictures(&mut tracer, 128, 2),
        );
    }
}

#[test]
fn splats_do_not_depend_on_threads_or_passes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let picture = |threads: usize, pass: &str| {
        let scene = repository().join("scenes/cornell_boxes/cornell_boxes.scene.ron");
        let text = format!(
            "(scene: {:?}, integrator: LightTracer(max_depth: 3), film: (width: 32, height: 24), \
             budget: (pass_samples: {pass}))",
            scene.display().to_string()
        );
        let path = config(&folder, "splats.ron", &text);
        let image = Scene::load_with(&path, &[], threads).render(64, 3).image;
        image
            .rgb
            .pixels
            .iter()
            .map(|p| p.to_array().map(f32::to_bits))
            .collect::<Vec<_>>()
    };
    let one = picture(1, "64");
    assert!(picture(2, "64") == one && picture(7, "4") == one);
}

#[test]
fn a_light_tracer_cannot_be_adaptive() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = repository().join("scenes/cornell_boxes/cornell_boxes.scene.ron");
    let text = format!(
        "(scene: {:?}, integrator: LightTracer(), adaptive: (rule: Folds))",
        scene.display().to_string()
    );
    let path = config(&folder, "adaptive.ron", &text);
    let mut pipeline = sr_tests::pipeline(1);
    sr_io::install(&mut pipeline.world);
    pipeline.world.insert_resource(sr_io::LoadRequest {
        path,
        ..Default::default()
    });
    pipeline.load().unwrap_or_else(|e| panic!("{e}"));
    assert!(pipeline.compile().is_err());
    let told = &pipeline
        .world
        .resource::<sr_pipeline::diagnostics::Diagnostics>()
        .0;
    let told: Vec<String> = told.iter().map(ToString::to_string).collect();
    assert!(
        told.iter()
            .any(|t| t.contains("adaptive.rule: adaptive sampling chooses")),
        "{told:?}"
    );
}

/// Everything above an open plane is open; nothing inside a closed sphere is.
#[test]
fn ambient_occlusion_knows_open_from_closed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = |shape: &str| {
        let text = format!(
            "(entities: {{\"shape\": {{{shape}}}, \"camera\": {{\"PerspectiveCamera\": (hfov_deg: 40), \
             \"LookAt\": (from: (0, 0, 4), to: (0, 0, 0)), \"ActiveCamera\": ()}}}})"
        );
        config(&folder, "shape.scene.ron", &text)
    };
    for (shape, distance, expected) in [
        ("\"Quad\": (width: 100, height: 100)", "inf", 1.0),
        ("\"Sphere\": (radius: 10)", "inf", 0.0),
        ("\"Sphere\": (radius: 10)", "1e-3", 1.0),
    ] {
        scene(shape);
        let integrator = format!("AmbientOcclusion(distance: {distance})");
        let text = format!(
            "(scene: \"shape.scene.ron\", integrator: {integrator}, film: (width: 16, height: 16))"
        );
        let path = config(&folder, "ao.ron", &text);
        let (mean, _) = Scene::load(&path, &[]).render(16, 1).mean();
        // From a point of the wall the far side is 20·cos away: nearer than 1e-3 for cosines under
        // 5e-5, which cosine-distributed directions take with probability 2.5e-9.
        assert!((mean - expected).abs() < 1e-3, "{shape} {distance}: {mean}");
    }
}
