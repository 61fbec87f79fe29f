//! `experiment`, from a file to rows of data, pictures, a sheet and a page.

use crate::support::Work;
use serde_json::Value;
use sr_pipeline::film_kernel::{read_attributes, read_image};
use std::collections::BTreeSet;

/// Four runs of the tiny scene, 16 × 12 pixels.
const EXPERIMENT: &str = r#"(
    title: "Tiny <b>",
    note: "What two ways of rendering do.",
    base: "tiny.ron",
    set: {"entities.glow.Emission.strength": 2},
    axes: {"budget.samples": [2, 8]},
    methods: {
        "path": {"integrator": Path(max_depth: 1)},
        "light, only": {"integrator": Direct(strategy: Light)},
    },
    metrics: [RelMse, Mape],
    reference: (integrator: Path(max_depth: 1), samples: 256),
)
"#;

fn work() -> Work {
    let work = Work::new();
    work.write("tiny.exp.ron", EXPERIMENT);
    work
}

fn rows(json: &Value) -> &Vec<Value> {
    json["rows"].as_array().unwrap()
}

#[test]
fn an_experiment_writes_pictures_rows_sheet_and_page() {
    let work = work();
    let run = work.done(&["experiment", "tiny.exp.ron", "-o", "e"]);
    assert!(run.out.contains("wrote e: open e/report.html"), "{run:?}");
    assert!(
        run.err
            .contains("[4/4] light, only, samples = 8: 8 samples, "),
        "{run:?}"
    );
    let ids = [
        "path-samples-2",
        "light-only-samples-2",
        "path-samples-8",
        "light-only-samples-8",
    ];
    for id in ids {
        let image = read_image(work.path(&format!("e/runs/{id}.exr"))).unwrap();
        assert_eq!((image.width, image.height), (16, 12));
        assert!(work.path(&format!("e/runs/{id}.png")).exists());
    }
    let json = work.json("e/results.json");
    assert_eq!(
        (&json["version"], &json["complete"]),
        (&1.into(), &true.into())
    );
    let ran: Vec<&str> = json["runs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["id"].as_str().unwrap())
        .collect();
    assert_eq!(ran, ids);
    // Log points are the powers of two: 2 for the short runs, 2, 4 and 8 for the long.
    let samples: Vec<u64> = rows(&json)
        .iter()
        .map(|r| r["samples"].as_u64().unwrap())
        .collect();
    assert_eq!(samples, [2, 2, 2, 4, 8, 2, 4, 8]);
    for row in rows(&json) {
        assert_eq!(row["error_source"], "reference");
        for key in [
            "seconds",
            "rays",
            "mse",
            "relmse",
            "mape",
            "smape",
            "relmse_debiased",
        ] {
            assert!(row[key].as_f64().unwrap() > 0.0, "{key} of {row}");
        }
        assert_eq!(
            row["samples_total"].as_u64(),
            row["samples"].as_u64().map(|n| n * 16 * 12)
        );
        assert_eq!(
            row["axes"]["budget.samples"],
            row["run"].as_str().unwrap().rsplit('-').next().unwrap()
        );
    }
    // One scene and one depth: a reference for all, and for both methods.
    let references = json["references"].as_array().unwrap();
    assert_eq!(
        (references.len(), &references[0]["samples"]),
        (1, &256.into())
    );
    assert_eq!(references[0]["points"].as_array().unwrap().len(), 4);

    let csv = String::from_utf8(work.read("e/results.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 1 + rows(&json).len());
    assert!(
        lines[0].starts_with("run,scene,method,budget.samples,integrator,seed,last,"),
        "{csv}"
    );
    assert!(
        lines[2].starts_with(
            "light-only-samples-2,tiny.scene.ron,\"light, only\",2,Direct,0,true,1,2,384,"
        ),
        "{csv}"
    );
    let columns = lines[0].split(',').count();
    assert_eq!(lines[1].split(',').count(), columns, "{csv}");

    let page = String::from_utf8(work.read("e/report.html")).unwrap();
    for part in [
        "Tiny &lt;b&gt;",
        "light, only",
        "data:image/png;base64,",
        "<table id=\"results\"",
        "relMSE",
        "strategy: Light",
    ] {
        assert!(page.contains(part), "no {part}");
    }
    assert!(!page.contains("<b>"), "{page}");
    // uPlot's home page, in its banner, and no address that a browser would ask for.
    assert_eq!(page.matches("http").count(), 1);
    for name in [
        "1-relmse_time",
        "1-mape_samples",
        "2-relmse_samples",
        "2-mape_time",
    ] {
        for end in ["svg", "png", "csv"] {
            assert!(
                work.path(&format!("e/plots/{name}.{end}")).exists(),
                "{name}.{end}"
            );
        }
    }
    let sheet = read_image(work.path("e/sheet.png")).unwrap();
    assert!(
        sheet.width > 440 && sheet.height > 200,
        "{} × {}",
        sheet.width,
        sheet.height
    );
}

#[test]
fn its_pictures_are_those_of_a_render_with_the_same_settings() {
    let work = work();
    work.done(&["experiment", "tiny.exp.ron", "-o", "e"]);
    work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.exr",
        "--spp",
        "8",
        "--integrator",
        "direct",
        "--set",
        "integrator.strategy=Light",
        "--set",
        "entities.glow.Emission.strength=2",
    ]);
    let experiment = read_image(work.path("e/runs/light-only-samples-8.exr")).unwrap();
    assert_eq!(experiment, read_image(work.path("a.exr")).unwrap());
    assert_eq!(
        work.read("e/runs/light-only-samples-8.png"),
        work.read("a.png")
    );
    let hash = |name: &str| {
        let all = read_attributes(work.path(name)).unwrap();
        all.into_iter()
            .find(|(n, _)| n == "steradian.config_hash")
            .unwrap()
            .1
    };
    assert_eq!(hash("e/runs/light-only-samples-8.exr"), hash("a.exr"));
}

#[test]
fn two_experiments_have_the_same_errors_and_the_second_takes_the_reference_from_the_first() {
    let work = work();
    let figures = || {
        let json = work.json("e/results.json");
        let of_row = |r: &Value| {
            (
                r["run"].clone(),
                r["samples"].clone(),
                r["relmse"].clone(),
                r["rays"].clone(),
            )
        };
        let figures: Vec<_> = rows(&json).iter().map(of_row).collect();
        (figures, json["references"][0]["from_cache"] == true)
    };
    work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--threads", "1"]);
    let (first, cached) = figures();
    assert!(!cached);
    work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--threads", "2"]);
    assert_eq!(figures(), (first.clone(), true));
    // Another scene in the same file is another reference.
    work.write(
        "tiny.scene.ron",
        &crate::support::SCENE.replace("radius: 0.5", "radius: 0.6"),
    );
    work.done(&["experiment", "tiny.exp.ron", "-o", "e"]);
    let (other, cached) = figures();
    assert!(!cached && other != first);
}

#[test]
fn several_seeds_have_a_mean_with_an_interval() {
    let work = Work::new();
    work.write(
        "s.exp.ron",
        r#"(base: "tiny.ron", seeds: 3, budget: (samples: 16))"#,
    );
    work.done(&["experiment", "s.exp.ron", "-o", "e", "--quiet"]);
    let json = work.json("e/results.json");
    let last: Vec<&Value> = rows(&json).iter().filter(|r| r["last"] == true).collect();
    let errors: Vec<f64> = last.iter().map(|r| r["relmse"].as_f64().unwrap()).collect();
    assert_eq!(errors.len(), 3);
    assert!(errors[0] != errors[1] && last[0]["error_source"] == "estimate");
    let summary = &json["summary"][0]["errors"]["RelMse"];
    let mean = errors.iter().sum::<f64>() / 3.0;
    assert!((summary["mean"].as_f64().unwrap() / mean - 1.0).abs() < 1e-12);
    assert!(summary["half_width"].as_f64().unwrap() > 0.0);
    assert!(work.path("e/runs/s-seed-2.exr").exists());
}

#[test]
fn the_keys_are_those_of_the_documentation() {
    let work = work();
    work.done(&["experiment", "tiny.exp.ron", "-o", "e", "--quiet"]);
    let page = include_str!("../../../../docs/experiments.md");
    let documented: BTreeSet<&str> = page
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once('`')?.0))
        .collect();
    let json = work.json("e/results.json");
    let mut written: BTreeSet<String> = json.as_object().unwrap().keys().cloned().collect();
    for list in ["runs", "references", "summary", "rows"] {
        let keys = json[list][0].as_object().unwrap().keys();
        written.extend(keys.map(|k| format!("{list}[].{k}")));
    }
    for key in written {
        assert!(
            documented.contains(key.as_str()),
            "{key} is not in docs/experiments.md"
        );
    }
}

/// A file, and what the error must say.
const WRONG: &[(&str, &str)] = &[
    (
        r#"(base: "tiny.ron", set: {"film.widht": 3})"#,
        "x.exp.ron:1:26: error: film.widht: unknown field",
    ),
    (
        r#"(base: "tiny.ron", axes: {"integrator.max_dept": [1]})"#,
        "did you mean `max_depth`?",
    ),
    (
        r#"(base: "tiny.ron", axes: {"budget.samples": [4, -1]})"#,
        "x.exp.ron:1:49: error: budget.samples: ",
    ),
    (
        r#"(base: "tiny.ron", methods: {"m": {"integrator": Pth()}})"#,
        "x.exp.ron:1:50: error: integrator: there is no integrator `Pth`; did you mean `Path`?",
    ),
    (
        r#"(base: "tiny.ron", zip: {"z": {"l": {"entities.bal.Sphere.radius": 1}}})"#,
        "there is no entity `bal`; did you mean `ball`?",
    ),
    (
        r#"(base: "tiny.ron", show: (exposure: "x"))"#,
        "post.exposure: expected a number",
    ),
    (
        r#"(base: "tiny.ron", show: (crop: (0, 0, 17, 4)))"#,
        "x.exp.ron:1:33: error: show.crop: it is not inside the pictures of 16 × 12",
    ),
    (
        r#"(base: "tiny.ron", show: (insets: [(0, 0, 4, 4), (0, 0, 4, 13)]))"#,
        "x.exp.ron:1:50: error: show.insets[1]: it is not inside the pictures of 16 × 12",
    ),
    (
        r#"(base: "tiny.ron", reference: (file: "wide.png"))"#,
        "x.exp.ron:1:38: error: reference.file: the reference has 8 × 2 pixels, the pictures have 16 × 12",
    ),
    (
        r#"(base: "tiny.ron", reference: (file: "tiny.ron"))"#,
        "x.exp.ron:1:38: error: reference.file: ",
    ),
    (
        r#"(base: "tiny.ron", attach: [(file: "tiny.ron")])"#,
        "x.exp.ron:1:36: error: attach[0].file: ",
    ),
    (
        r#"(base: "tiny.ron", reference: (samples: 4, integrator: Nope))"#,
        "there is no integrator `Nope`",
    ),
    (r#"(base: "tiny.exp.ron")"#, "tiny.exp.ron"),
    (r#"(bas: "tiny.ron")"#, "did you mean `base`?"),
    ("(", "x.exp.ron:1:1: error: "),
];

#[test]
fn bad_input_ends_with_2_says_where_and_touches_nothing() {
    let work = work();
    let image = sr_pipeline::film_kernel::Image::filled(8, 2, sr_pipeline::glam::Vec3::ONE);
    let image = sr_pipeline::film_kernel::develop(&image, 0.0, Default::default());
    sr_pipeline::film_kernel::write_png(work.path("wide.png"), &image).unwrap();
    std::fs::create_dir(work.path("e")).unwrap();
    work.write("e/results.json", "old");
    for (text, message) in WRONG {
        work.write("x.exp.ron", text);
        let before = work.files();
        for command in [
            &["experiment", "x.exp.ron", "-o", "e"][..],
            &["plan", "x.exp.ron"],
        ] {
            let run = work.run(command);
            assert_eq!((run.status, run.out.as_str()), (2, ""), "{text}\n{run:?}");
            assert!(run.err.contains(message), "{text}\n{}", run.err);
            assert!(!run.err.contains("panicked"), "{}", run.err);
        }
        assert_eq!(work.files(), before, "{text}");
    }
}

#[test]
fn problems_of_all_points_come_in_one_go_each_once() {
    let work = Work::new();
    work.write(
        "x.exp.ron",
        r#"(
    base: "tiny.ron",
    set: {"film.widht": 3},
    axes: {"entities.ball.Sphere.radius": [1, -1, "x"]},
    methods: {"m": {"integrator": Direct(strategi: Light)}},
)"#,
    );
    let run = work.run(&["experiment", "x.exp.ron", "-o", "e"]);
    for place in [
        "x.exp.ron:3:11: ",
        "x.exp.ron:4:47: ",
        "x.exp.ron:4:51: ",
        "x.exp.ron:5:42: ",
    ] {
        assert_eq!(run.err.matches(place).count(), 1, "{place} in\n{}", run.err);
    }
    assert!(
        run.err.ends_with("error: the input has 4 errors\n"),
        "{}",
        run.err
    );
    assert!(!work.path("e").exists());
}

#[test]
fn a_folder_of_somebody_elses_is_left_alone() {
    let work = work();
    std::fs::create_dir(work.path("mine")).unwrap();
    work.write("mine/report.html", "precious");
    let before = work.files();
    for (folder, message) in [
        ("mine", "there are things in it, but no results.json"),
        ("tiny.ron", "it is no folder"),
        ("tiny.ron/e", "tiny.ron is no folder"),
    ] {
        let run = work.run(&["experiment", "tiny.exp.ron", "-o", folder]);
        assert_eq!(run.status, 2, "{run:?}");
        assert!(run.err.contains(message), "{}", run.err);
        assert_eq!(work.files(), before);
    }
    let run = work.run(&["render", "tiny.exp.ron", "-o", "a.exr"]);
    assert_eq!(run.status, 2);
    assert!(
        run.err.contains("run `steradian experiment` with it"),
        "{}",
        run.err
    );
}

#[test]
fn plan_tells_the_runs_and_their_cost_and_writes_nothing() {
    let work = work();
    let before = work.files();
    let run = work.done(&["plan", "tiny.exp.ron", "--set", "film.width=32"]);
    for part in [
        "reference 1 of 1, for 4 points",
        "[1/4] path, samples = 2",
        "3,072 samples",
        "4 runs, about ",
        " on disk",
    ] {
        assert!(run.out.contains(part), "no {part} in\n{}", run.out);
    }
    assert_eq!(work.files(), before);
}

#[test]
fn crops_and_attachments_are_shown() {
    let work = Work::new();
    let image = sr_pipeline::film_kernel::Image::filled(8, 2, sr_pipeline::glam::Vec3::ONE);
    sr_pipeline::film_kernel::write_image_exr(
        work.path("map.exr"),
        &image,
        sr_pipeline::film_kernel::Precision::Float,
        &[],
    )
    .unwrap();
    work.write(
        "x.exp.ron",
        r#"(base: "tiny.ron", show: (crop: (2, 1, 8, 5), caption: "so {samples}"),
            attach: [(file: "map.exr", caption: "the map")])"#,
    );
    work.done(&["experiment", "x.exp.ron", "-o", "e"]);
    let whole = read_image(work.path("e/runs/x.png")).unwrap();
    let crop = read_image(work.path("e/runs/x_crop.png")).unwrap();
    assert_eq!((crop.width, crop.height), (6, 4));
    assert_eq!(crop.pixel(3, 2), whole.pixel(5, 3));
    let page = String::from_utf8(work.read("e/report.html")).unwrap();
    assert_eq!(page.matches("<img ").count(), 2);
    assert!(
        page.contains("so 4 samples") && page.contains("the map"),
        "{page}"
    );
}

#[test]
fn insets_become_crops_and_a_figure_for_latex() {
    let work = Work::new();
    work.write(
        "x.exp.ron",
        r#"(base: "tiny.ron", title: "50 % of a_b", methods: {"a & b": {}, "c": {"integrator": Direct()}},
            show: (insets: [(2, 1, 8, 5), (0, 0, 4, 4)]), reference: (samples: 16))"#,
    );
    work.done(&["experiment", "x.exp.ron", "-o", "e"]);
    let tex = String::from_utf8(work.read("e/figure.tex")).unwrap();
    let named: Vec<&str> = tex
        .split("]{figure/")
        .skip(1)
        .map(|rest| rest.split_once('}').unwrap().0)
        .collect();
    // The whole, two crops of three pictures, two errors of two.
    assert_eq!(named.len(), 1 + 2 * 3 + 2 * 2, "{tex}");
    for name in &named {
        read_image(work.path(&format!("e/figure/{name}"))).unwrap();
    }
    assert!(
        tex.contains("a \\& b & c & reference \\\\") && tex.contains("50 \\% of a\\_b"),
        "{tex}"
    );
    // A crop is the developed picture's part, each pixel as a square.
    let whole = read_image(work.path("e/runs/a-b.png")).unwrap();
    let crop = read_image(work.path("e/figure/1-1-a---b-inset1.png")).unwrap();
    let factor = crop.width / 6;
    assert_eq!((crop.width, crop.height), (6 * factor, 4 * factor));
    for (x, y) in [(0, 0), (3, 2), (5, 3)] {
        for corner in [0, factor - 1] {
            let shown = crop.pixel(x * factor + corner, y * factor + corner);
            assert_eq!(shown, whole.pixel(2 + x, 1 + y));
        }
    }
    let page = String::from_utf8(work.read("e/report.html")).unwrap();
    assert_eq!(page.matches("<div class=\"strip\">").count(), 1);
}
