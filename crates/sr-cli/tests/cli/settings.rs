//! Options and `--set` reach what they name, and the picture's record says so.

use crate::support::Work;
use sr_pipeline::film_kernel::read_image;

#[test]
fn set_reaches_every_section() {
    let work = Work::new();
    for (assignment, in_record) in [
        ("film.width=7", "width: Some(7)"),
        ("film.filter=Tent(radius: 1)", "filter: Tent(radius: 1.0)"),
        ("film.layers=[Normal, Ids]", "layers: [Normal, Ids]"),
        ("sampler.kind=Independent", "kind: Independent"),
        ("sampler.replicas=4", "replicas: 4"),
        ("budget.samples=3", "samples: Some(3)"),
        ("budget.pass_samples=1", "pass_samples: Some(1)"),
        (
            "adaptive.tolerance=0.2",
            "adaptive: (rule: Off, tolerance: 0.2",
        ),
        ("post.tone_map=AgX", "tone_map: AgX"),
        (
            "compile.light_selection=Uniform",
            "light_selection: Uniform",
        ),
        ("integrator.max_depth=2", "Path(max_depth: Some(2)"),
        (
            "integrator=Direct(strategy: Light)",
            "Direct(strategy: Light, light_samples: 1)",
        ),
        ("integrator.light_samples=4", "light_samples: 4)"),
        ("compile.light_selection=All", "light_selection: All"),
        (
            "camera.PerspectiveCamera.hfov_deg=30",
            "\"camera.PerspectiveCamera.hfov_deg\": 30",
        ),
        (
            "entities.ball.Sphere.radius=0.3",
            "\"entities.ball.Sphere.radius\": 0.3",
        ),
        (
            "materials.grey.Lambert.reflectance=0.1",
            "\"materials.grey.Lambert.reflectance\": 0.1",
        ),
    ] {
        work.done(&["render", "tiny.ron", "-o", "a.exr", "--set", assignment]);
        let config = &work.provenance("a.exr")["config"];
        assert!(config.contains(in_record), "{assignment}\n{config}");
    }
}

#[test]
fn every_option_ends_up_in_the_record() {
    let work = Work::new();
    let line = "render tiny.ron -o a.exr --spp 6 --time 1h --target-error 1e-9 --max-depth 2 \
                --width 20 --height 10 --adaptive 0.07 --integrator path_bsdf --threads 1 --seed 42 --crop 2,1,18,9";
    work.done(&line.split_whitespace().collect::<Vec<_>>());
    let record = work.provenance("a.exr");
    let config = &record["config"];
    for part in [
        "budget: (samples: Some(6), seconds: Some(3600.0), target_error: Some(1e-9)",
        "integrator: PathBsdf(max_depth: Some(2)",
        "width: Some(20), height: Some(10)",
        "crop: Some((2, 1, 18, 9))",
        "seed: 42, replicas: 8",
        "adaptive: (rule: Folds, tolerance: 0.07",
    ] {
        assert!(config.contains(part), "no {part} in\n{config}");
    }
    assert_eq!(record["integrator"], "PathBsdf");
    assert_eq!(record["seed"], "42");
    assert_eq!(record["threads"], "1");
    assert_eq!(record["samples"], "6");
    assert_eq!(record["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(
        record["command"],
        format!(
            "steradian {}",
            line.split_whitespace().collect::<Vec<_>>().join(" ")
        )
    );
    assert_eq!(record["config_hash"].len(), 16);
    assert!(record["seconds"].parse::<f64>().unwrap() >= 0.0);
    let image = read_image(work.path("a.exr")).unwrap();
    assert_eq!((image.width, image.height), (16, 8));
}

#[test]
fn set_wins_over_options_in_whatever_order() {
    let work = Work::new();
    let set = ["--set", "film.width=9"];
    let option = ["--width", "5"];
    for order in [[set, option], [option, set]] {
        let mut line = vec!["render", "tiny.ron", "-o", "a.exr"];
        line.extend(order.concat());
        work.done(&line);
        assert_eq!(read_image(work.path("a.exr")).unwrap().width, 9);
    }
}

#[test]
fn a_change_of_the_scene_changes_the_picture() {
    let work = Work::new();
    let mean = |args: &[&str]| {
        let mut line = vec!["render", "tiny.ron", "-o", "a.exr"];
        line.extend(args);
        work.done(&line);
        let image = read_image(work.path("a.exr")).unwrap();
        image.pixels.iter().map(|p| p.element_sum()).sum::<f32>() / image.pixels.len() as f32
    };
    let plain = mean(&[]);
    let bright = mean(&["--set", "entities.glow.Emission.strength=2"]);
    // Light is linear, the samples are the same, and the camera may see the lamp.
    assert!((bright / plain - 2.0).abs() < 1e-4, "{bright} over {plain}");
}
