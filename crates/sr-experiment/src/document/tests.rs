use super::read::parse;
use super::*;

/// A folder with files that experiments may name.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["base.ron", "other.ron", "map.png"] {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    folder
}

fn read_text(text: &str) -> Result<Experiment, Vec<String>> {
    let folder = folder();
    let path = folder.path().join("alpha.exp.ron");
    let place = format!("{}/", folder.path().display());
    parse(&path, text).map_err(|problems| {
        let text = |d: &sr_pipeline::diagnostics::Diagnostic| d.to_string().replace(&place, "");
        problems.iter().map(text).collect()
    })
}

fn complaints(text: &str) -> Vec<String> {
    read_text(text).expect_err("it was wrong")
}

#[test]
fn a_whole_experiment_is_read() {
    let e = read_text(
        r#"(
            title: "Roughness",
            note: "What alpha does.",
            base: "base.ron",
            set: {"film.width": 32},
            axes: {
                "entities.gold.Conductor.alpha": [0.005, 0.25],
                "integrator.strategy": {"by light": Light, "by lobe": Bsdf},
            },
            zip: {"lens": {"open": {"camera.ThinLens.aperture_radius": 0.1, "film.height": 9}}},
            methods: {"a": {"integrator": Path()}, "b": {"integrator": Direct(), "sampler.kind": Sobol}},
            seeds: [3, 5],
            budget: (seconds: 2),
            reference: (integrator: Path(max_depth: 1), samples: 4096, set: {"sampler.replicas": 16}),
            metrics: [RelMse, Smape],
            log: (seconds: [0.5, 2]),
            target: 0.01,
            show: (exposure: 1, tone_map: AgX, crop: (0, 0, 8, 8), insets: [(1, 2, 3, 4), (0, 0, 2, 2)], columns: 2, caption: "α {alpha}: {error}"),
            attach: [(file: "map.png", caption: "density", exposure: -5.5), (file: "map.png")],
        )"#,
    )
    .unwrap();
    assert_eq!(
        (e.title.as_str(), e.stem().as_str()),
        ("Roughness", "alpha")
    );
    let axes: Vec<(&str, &str, Vec<&str>)> = e
        .axes
        .iter()
        .map(|a| {
            let labels = a.settings.iter().map(|s| s.label.as_str()).collect();
            (a.name.as_str(), a.short.as_str(), labels)
        })
        .collect();
    assert_eq!(
        axes,
        [
            (
                "entities.gold.Conductor.alpha",
                "alpha",
                vec!["0.005", "0.25"]
            ),
            (
                "integrator.strategy",
                "strategy",
                vec!["by light", "by lobe"]
            ),
            ("zip.lens", "lens", vec!["open"]),
        ]
    );
    assert_eq!(e.axes[2].settings[0].changes.len(), 2);
    assert_eq!(e.methods[1].changes[1].path, "sampler.kind");
    assert_eq!(e.seeds, [3, 5]);
    assert_eq!(e.metrics, [Metric::RelMse, Metric::Smape]);
    assert_eq!(
        (e.log_seconds.as_slice(), e.target),
        (&[0.5, 2.0][..], Some(0.01))
    );
    let Some(ReferenceSpec::Render(changes)) = &e.reference else {
        panic!("{:?}", e.reference);
    };
    let paths: Vec<&str> = changes.iter().map(|c| c.path.as_str()).collect();
    assert_eq!(paths, ["integrator", "budget.samples", "sampler.replicas"]);
    assert_eq!(e.show.post.len(), 2);
    assert_eq!(e.show.crop, Some([0, 0, 8, 8]));
    assert_eq!(e.show.insets, [[1, 2, 3, 4], [0, 0, 2, 2]]);
    assert_eq!(
        e.show.caption.0,
        [
            Piece::Text("α ".into()),
            Piece::Value(Placeholder::Axis(0)),
            Piece::Text(": ".into()),
            Piece::Value(Placeholder::Error),
        ]
    );
    assert_eq!(e.attach[0].caption, "density");
    let exposures: Vec<_> = e.attach.iter().map(|a| a.exposure).collect();
    assert_eq!(exposures, [Some(-5.5), None]);
}

#[test]
fn little_is_needed() {
    let e = read_text(r#"(base: "base.ron")"#).unwrap();
    assert_eq!(e.title, "alpha");
    assert!(e.axes.is_empty() && e.methods.is_empty() && e.seeds.is_empty());
    assert_eq!(e.metrics, [Metric::RelMse]);
    assert_eq!(
        read_text(r#"(base: "base.ron", seeds: 3)"#).unwrap().seeds,
        [0, 1, 2]
    );
}

#[test]
fn axes_that_end_alike_keep_as_much_as_tells_them_apart() {
    let e = read_text(
        r#"(base: "base.ron", axes: {"entities.a.Sphere.radius": [1], "entities.b.Sphere.radius": [1], "film.width": [1]})"#,
    );
    let short: Vec<String> = e.unwrap().axes.into_iter().map(|a| a.short).collect();
    assert_eq!(short, ["a.Sphere.radius", "b.Sphere.radius", "width"]);
}

#[test]
fn each_mistake_is_told_with_its_place() {
    for (text, expected) in [
        ("()", "1:1: error: base: an experiment needs a base"),
        (
            "(base: \"bse.ron\")",
            "1:8: error: base: `bse.ron`: there is no such file; did you mean `base.ron`?",
        ),
        (
            "(base: 3)",
            "1:8: error: base: expected a text, found the number 3",
        ),
        (
            "(base: \"base.ron\", axs: {})",
            "1:20: error: axs: unknown field; did you mean `axes`?",
        ),
        (
            "(base: \"base.ron\", axes: [])",
            "1:26: error: axes: expected paths and their values",
        ),
        (
            "(base: \"base.ron\", axes: {\"a.b\": 3})",
            "1:34: error: axes.a.b: expected values as",
        ),
        (
            "(base: \"base.ron\", axes: {\"a.b\": []})",
            "1:34: error: axes.a.b: there is no value",
        ),
        (
            "(base: \"base.ron\", axes: {\"a.b\": [1, 1]})",
            "1:38: error: axes.a.b: the value 1 is there already",
        ),
        (
            "(base: \"base.ron\", axes: {\"a\": [1], \"a\": [2]})",
            "1:37: error: axes.a: the name is there already",
        ),
        (
            "(base: \"base.ron\", zip: {\"z\": [1]})",
            "1:31: error: zip.z: expected names and changes",
        ),
        (
            "(base: \"base.ron\", zip: {\"z\": {\"l\": 1}})",
            "1:37: error: zip.z.l: expected paths and values",
        ),
        (
            "(base: \"base.ron\", methods: {})",
            "1:29: error: methods: there is no value",
        ),
        (
            "(base: \"base.ron\", methods: {\"m\": {\"a\": 1, \"a\": 2}})",
            "1:44: error: methods.m.a: the name is there already",
        ),
        (
            "(base: \"base.ron\", seeds: 0)",
            "1:27: error: seeds: expected a number of seeds from 1",
        ),
        (
            "(base: \"base.ron\", seeds: 2.5)",
            "1:27: error: seeds: expected a number of seeds from 1",
        ),
        (
            "(base: \"base.ron\", seeds: [1, -1])",
            "1:27: error: seeds: expected a number of seeds from 1",
        ),
        (
            "(base: \"base.ron\", seeds: [4, 4])",
            "1:31: error: seeds: seed 4 is there already",
        ),
        (
            "(base: \"base.ron\", reference: ())",
            "1:31: error: reference: a reference needs a file or a budget",
        ),
        (
            "(base: \"base.ron\", reference: (file: \"no.exr\"))",
            "1:38: error: reference.file: `no.exr`: there is no such file",
        ),
        (
            "(base: \"base.ron\", reference: (file: \"map.png\", samples: 4))",
            "1:49: error: reference.samples: a file is not rendered",
        ),
        (
            "(base: \"base.ron\", reference: (samplse: 4))",
            "did you mean `samples`?",
        ),
        (
            "(base: \"base.ron\", metrics: [RelMsee])",
            "1:30: error: metrics: there is no metric `RelMsee`; did you mean `RelMse`?",
        ),
        (
            "(base: \"base.ron\", metrics: [Mse, Mse])",
            "1:35: error: metrics: `Mse` is there already",
        ),
        (
            "(base: \"base.ron\", metrics: Mse)",
            "1:29: error: metrics: expected a list",
        ),
        (
            "(base: \"base.ron\", methods: {\"mis\": {}}, baseline: \"miss\")",
            "1:52: error: baseline: there is no method `miss`; did you mean `mis`?",
        ),
        (
            "(base: \"base.ron\", axes: {\"a\": [1]}, baseline: \"2\")",
            "1:48: error: baseline: there is no value of the last axis `2`",
        ),
        (
            "(base: \"base.ron\", target: 0)",
            "1:28: error: target: expected an error above 0",
        ),
        (
            "(base: \"base.ron\", log: (seconds: [1, 1]))",
            "1:35: error: log.seconds: expected rising seconds above 0",
        ),
        (
            "(base: \"base.ron\", show: (crop: (0, 0, 8)))",
            "1:33: error: show.crop: expected pixels",
        ),
        (
            "(base: \"base.ron\", show: (crop: (8, 0, 8, 9)))",
            "1:33: error: show.crop: nothing is inside",
        ),
        (
            "(base: \"base.ron\", show: (insets: (0, 0, 8, 8)))",
            "1:35: error: show.insets: expected up to 8 crops as",
        ),
        (
            "(base: \"base.ron\", show: (insets: [(0, 0, 8, 8), (0, 3, 8, 3)]))",
            "1:50: error: show.insets[1]: nothing is inside",
        ),
        (
            "(base: \"base.ron\", show: (columns: 0))",
            "1:36: error: show.columns: expected a whole number above 0",
        ),
        (
            "(base: \"base.ron\", show: (caption: \"{alhpa}\"), axes: {\"x.alpha\": [1]})",
            "1:36: error: show.caption: a caption knows no `{alhpa}`; did you mean `alpha`?",
        ),
        (
            "(base: \"base.ron\", show: (caption: \"{error\"))",
            "a `{` is never closed",
        ),
        (
            "(base: \"base.ron\", attach: [(caption: \"c\")])",
            "1:29: error: attach[0]: an attachment needs a `file`",
        ),
        (
            "(base: \"base.ron\", attach: [(file: \"map.png\", exposure: 31)])",
            "1:57: error: attach[0].exposure: expected a number of stops",
        ),
        (
            "(base: \"base.ron\", attach: [(file: \"mop.png\")])",
            "1:36: error: attach[0].file: `mop.png`: there is no such file; did you mean `map.png`?",
        ),
        (
            "(base: \"base.ron\", axes: {\"a\": [1, 2]}, seeds: 9999)",
            "1:1: error: axes: these are 19998 runs",
        ),
        ("(base: \"base.ron\",, )", "alpha.exp.ron:1:19: error: "),
    ] {
        let got = complaints(text);
        assert_eq!(got.len(), 1, "{text}\n{got:?}");
        assert!(got[0].contains(expected), "{text}\n{}\n{expected}", got[0]);
        assert!(got[0].starts_with("alpha.exp.ron:1:"), "{}", got[0]);
    }
}

#[test]
fn all_mistakes_come_in_one_go() {
    let got = complaints(
        "(\n title: 3,\n base: \"base.ron\",\n seeds: 0,\n metrics: [Flop],\n show: (colums: 3),\n)",
    );
    let lines = |prefix: &str| got.iter().filter(|g| g.contains(prefix)).count();
    assert_eq!(got.len(), 4, "{got:?}");
    for place in [":2:9: ", ":4:9: ", ":5:12: ", ":6:9: "] {
        assert_eq!(lines(place), 1, "{place} in {got:?}");
    }
}

#[test]
fn a_missing_experiment_has_the_nearest_name() {
    let folder = folder();
    let problems = read(&folder.path().join("bas.ron")).unwrap_err();
    assert!(
        problems[0].to_string().contains("base.ron`?"),
        "{problems:?}"
    );
    assert!(
        read(folder.path()).unwrap_err()[0]
            .to_string()
            .contains("is not a file")
    );
}

/// Would take hours if each were compared with all before it, or each end of a path with those of others.
#[test]
fn long_lists_and_paths_take_linear_time() {
    let list = |text: &dyn Fn(usize) -> String| -> String { (0..300_000).map(text).collect() };
    let seeds = list(&|i| format!("{i},"));
    let text = format!("(base: \"base.ron\", seeds: [{seeds}])");
    assert!(complaints(&text)[0].contains("at most 10000"));
    let text = format!("(base: \"base.ron\", axes: {{\"film.width\": [{seeds}]}})");
    assert!(complaints(&text)[0].contains("at most 10000"));
    let axes = list(&|i| format!("\"film.a{i}\": [1],"));
    let text = format!("(base: \"base.ron\", axes: {{{axes}}})");
    assert!(complaints(&text)[0].contains("at most 64"));
    let end = ".b".repeat(300_000);
    let text = format!("(base: \"base.ron\", axes: {{\"c{end}\": [1], \"d{end}\": [2]}})");
    let experiment = read_text(&text).unwrap();
    assert_eq!(experiment.axes[0].short, format!("c{end}"));
}
