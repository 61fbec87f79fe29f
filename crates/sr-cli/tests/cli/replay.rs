//! `render --replay`.

use crate::support::Work;
use serde_json::Value;
use sr_pipeline::film_kernel::read_image;

/// Through glass onto the floor.
const GLASS: &str = r#"(
    entities: {
        "grey": {"Lambert": (reflectance: 0.6)},
        "glass": {"Dielectric": ()},
        "glow": {"Lambert": (reflectance: 0.5), "Emission": (radiance: 5)},
        "floor": {"Quad": (width: 4, height: 4), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "grey"},
        "lamp": {"Quad": (width: 1, height: 1), "LocalTransform": (translate: (0, 2, 0), rotate_deg: (90, 0, 0)), "MaterialRef": "glow"},
        "ball": {"Sphere": (radius: 0.5), "LocalTransform": (translate: (0, 0.5, 0)), "MaterialRef": "glass"},
        "eye": {"PerspectiveCamera": (hfov_deg: 45), "LookAt": (from: (0, 1.5, 4), to: (0, 0.5, 0)), "ActiveCamera": ()},
    },
)
"#;

fn work() -> Work {
    let work = Work::new();
    work.write("glass.scene.ron", GLASS);
    work
}

const SMALL: [&str; 7] = [
    "render",
    "glass.scene.ron",
    "--width",
    "16",
    "--height",
    "12",
    "--seed=3",
];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.into_iter().chain(more.iter().copied()).collect()
}

#[test]
fn a_replay_tells_every_vertex_and_writes_nothing() {
    let work = work();
    let files = work.files();
    let run = work.done(&with(&["--replay", "8,6,71"]));
    assert_eq!(work.files(), files);
    for part in [
        "sample 71 of pixel 8,6 of 16 × 12: Path, seed 3",
        "number     filter: 0.",
        "vertex 1: `ball` (glass.scene.ron:8:9) of `glass` (glass.scene.ron:4:9)",
        "scatter    delta transmission: wi (",
        "vertex 2: `ball`",
        "number     direction at depth 1: ",
        "weight (0.44444445, 0.44444445, 0.44444445), pdf 0.9572205, eta 1.5, beta (0.4",
        "end        ",
        "\nradiance (",
        "\nthe film adds it",
    ] {
        assert!(run.out.contains(part), "no {part} in\n{}", run.out);
    }
    assert!(run.err.is_empty(), "{}", run.err);
}

#[test]
fn json_holds_the_bits_of_the_picture() {
    let work = work();
    work.done(&with(&[
        "--spp",
        "1",
        "-o",
        "a.exr",
        "--set",
        "film.precision=Float",
    ]));
    let image = read_image(work.path("a.exr")).unwrap();
    for (x, y) in [(8, 6), (3, 10), (15, 11), (8, 0)] {
        let run = work.done(&with(&["--replay", &format!("{x},{y},0"), "--json"]));
        let told: Value = serde_json::from_str(&run.out).unwrap();
        let pixel = image.pixel(x, y).to_array();
        for (a, b) in told["radiance"].as_array().unwrap().iter().zip(pixel) {
            assert_eq!(a.as_f64().unwrap() as f32, b, "{x},{y}");
        }
        assert_eq!(told["version"], 1);
        assert_eq!(told["refused"], Value::Null);
        let steps = told["steps"].as_array().unwrap();
        assert_eq!(steps.last().unwrap()["event"], "end");
        let documented = include_str!("../../../../docs/replay.md");
        for step in steps {
            let name = step["event"].as_str().unwrap();
            assert!(documented.contains(&format!("| `{name}` |")), "{name}");
        }
    }
}

#[test]
fn a_clamp_is_told() {
    let work = work();
    let run = work.done(&with(&["--replay", "8,0,0", "--set", "film.clamp=1e-3"]));
    let clamped = run
        .out
        .contains("\nfilm.clamp makes (0.001, 0.001, 0.001) of it");
    assert!(clamped || run.out.contains("radiance (0.0,"), "{}", run.out);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let work = work();
    for (more, part) in [
        (
            &["--replay", "16,0,0"][..],
            "there is no pixel 16,0: the picture has 16 × 12 pixels, 0,0 to 15,11",
        ),
        (&["--replay", "1,2"], "expected x,y,sample"),
        (&["--replay", "1,2,3", "-o", "a.exr"], "cannot be used with"),
        (
            &["--replay", "1,2,3", "--stats", "a.json"],
            "cannot be used with",
        ),
        (
            &["--replay", "1,2,3", "--convergence", "a.csv"],
            "cannot be used with",
        ),
        (&["--json"], "--replay <X,Y,SAMPLE>"),
    ] {
        let run = work.run(&with(more));
        assert_eq!(run.status, 2, "{more:?}");
        assert!(run.err.contains(part), "{more:?}: {}", run.err);
    }
}
