//! Bad usage and bad input: status 2, everything that is wrong, nothing touched.

use crate::support::Work;

/// Arguments after `render`, and what the error must say.
const CASES: &[(&[&str], &str)] = &[
    (&[], "<FILE>"),
    (&["none.ron"], "no such file; did you mean `tiny.ron`?"),
    (&["tiny.ron", "--sp", "3"], "--spp"),
    (&["tiny.ron", "--spp", "0"], "--spp"),
    (&["tiny.ron", "--time", "3d"], "no unit of time"),
    (&["tiny.ron", "--target-error", "0"], "above 0"),
    (&["tiny.ron", "--threads", "0"], "--threads"),
    (&["tiny.ron", "--width", "0"], "--width"),
    (&["tiny.ron", "--set", "film.width"], "PATH=VALUE"),
    (&["tiny.ron", "--crop", "5,0,5,9"], "nothing is inside"),
    (
        &["tiny.ron", "--crop", "0,0,99,99"],
        "--crop: error: film.crop: ",
    ),
    (
        &["tiny.ron", "--integrator", "pth"],
        "--integrator: error: integrator: there is no integrator `pth`; did you mean `Path`?",
    ),
    (
        &["tiny.ron", "--integrator", "direct", "--max-depth", "3"],
        "--max-depth: error: integrator.max_depth: unknown field",
    ),
    (
        &["tiny.ron", "--set", "film.widht=3"],
        "--set: error: film.widht: unknown field of FilmSettings; did you mean `width`?",
    ),
    (
        &["tiny.ron", "--set", "entities.bal.Sphere.radius=3"],
        "there is no entity `bal`; did you mean `ball`?",
    ),
    (
        &[
            "tiny.ron",
            "--set",
            "integrator=Path(max_depth: None, roulette_from: None)",
        ],
        "such paths hardly end",
    ),
    (
        &["tiny.ron", "--integrator", "Aov(max_depth: 0)"],
        "`max_depth` must be at least 1",
    ),
    (
        &["tiny.ron", "--integrator", "Direct(light_samples: 0)"],
        "`light_samples` is 0 and must be between 1 and 65536",
    ),
    (
        &["tiny.ron", "--set", "compile.light_selection=Spacial"],
        "did you mean `Spatial`?",
    ),
    (&["tiny.ron", "-o", "a.jpg"], "not as .jpg"),
    (
        &["tiny.ron", "-o", "no/such/a.exr"],
        "there is no folder no/such",
    ),
    (
        &["tiny.ron", "-o", "tiny.ron/a.exr"],
        "tiny.ron is no folder",
    ),
    (
        &["tiny.ron", "--stats", "no/s.json"],
        "there is no folder no",
    ),
    (&["tiny.ron", "--stats", "tiny.ron"], "it is the input"),
    (&["tiny.ron", "--stats", "."], "no name of a file"),
    // What the input leads to, and anything else that is not what it would become.
    (
        &["tiny.ron", "--stats", "tiny.scene.ron"],
        "cannot write tiny.scene.ron: it exists and is no .json file",
    ),
    (
        &["tiny.ron", "--convergence", "tiny.scene.ron"],
        "cannot write tiny.scene.ron: it exists and is no .csv file",
    ),
    (
        &["tiny.ron", "--convergence", "no/c.csv"],
        "there is no folder no",
    ),
    (
        &["tiny.ron", "--convergence", "s.json"],
        "s.json is to be written twice",
    ),
    (
        &["tiny.ron", "-o", "missing/"],
        "cannot write to `missing/`: there is no such folder",
    ),
    (&["tiny.ron", "-o", ".png"], "a name is missing"),
    (
        &["tiny.ron", "--width", "65536", "--height", "65536"],
        "--width: error: film.width: a film of 4294967296 pixels",
    ),
    (
        &["tiny.ron", "-o", "a.png", "--stats", "a.png"],
        "written twice",
    ),
];

#[test]
fn bad_usage_and_input_end_with_2_say_why_and_touch_nothing() {
    for (args, message) in CASES {
        let work = Work::new();
        for old in ["a.exr", "a.png", "s.json"] {
            work.write(old, "old");
        }
        let before = work.files();
        // The defaults come first, so that a case may name its own output.
        let has = |option| args.contains(&option);
        let mut line = vec!["render"];
        line.extend_from_slice(args);
        if !has("-o") {
            line.extend(["-o", "a.exr"]);
        }
        if !has("--stats") {
            line.extend(["--stats", "s.json"]);
        }
        let run = work.run(&line);
        assert_eq!(run.status, 2, "{args:?}\n{run:?}");
        assert!(run.err.contains(message), "{args:?}\n{}", run.err);
        assert!(!run.err.contains("panicked"), "{args:?}\n{}", run.err);
        assert_eq!(run.out, "", "{args:?}");
        assert_eq!(work.files(), before, "{args:?}");
    }
}

#[test]
fn all_problems_come_in_one_go_each_with_its_place() {
    let work = Work::new();
    work.write(
        "bad.scene.ron",
        r#"(
    entities: {
        "grey": {"Lambert": (reflectence: 0.5)},
        "ball": {"Sphere": (radius: -1), "MaterialRef": "gray"},
        "eye": {"PerspectiveCamra": ()},
    },
)
"#,
    );
    work.write(
        "bad.ron",
        r#"(
    scene: "bad.scene.ron",
    film: (widht: 16, height: "tall"),
    budgets: (samples: 4),
)
"#,
    );
    let run = work.run(&["render", "bad.ron"]);
    assert_eq!(run.status, 2);
    for place in [
        "bad.scene.ron:3:30: error: entities.grey.Lambert.reflectence: ",
        "bad.scene.ron:4:37: error: entities.ball.Sphere.radius: ",
        "bad.scene.ron:4:57: error: entities.ball.MaterialRef: ",
        "bad.scene.ron:5:17: error: entities.eye.PerspectiveCamra: ",
        "bad.ron:3:12: error: film.widht: ",
        "bad.ron:3:31: error: film.height: ",
        "bad.ron:4:5: error: budgets: ",
        "did you mean `reflectance`?",
        "did you mean `grey`?",
        "did you mean `PerspectiveCamera`?",
        "did you mean `width`?",
        "did you mean `budget`?",
        "\nerror: the input has ",
    ] {
        assert!(run.err.contains(place), "no {place} in\n{}", run.err);
    }
    // The folder for pictures is not made for nothing.
    assert!(!work.path("out").exists());
}

#[test]
fn plan_and_compare_refuse_bad_input_too() {
    let work = Work::new();
    for args in [
        &["plan", "none.ron"][..],
        &["plan", "tiny.ron", "--set", "film.widht=3"],
        &["compare", "tiny.ron", "tiny.ron"],
        &["compare", "none.exr", "none.exr"],
        &["list", "everything"],
        &["paint"],
        &[],
    ] {
        let run = work.run(args);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{args:?}\n{run:?}");
        assert!(!run.err.is_empty(), "{args:?}");
    }
}
