use super::*;

fn said(text: &str) -> Vec<String> {
    let got = load(&[("a.scene.ron", text)], &[]);
    assert_eq!(got.ok, !got.said.iter().any(|s| s.contains(" error: ")));
    got.said
}

/// Takes the mark `¦` out of a text of one line, and says where it stood.
fn take_mark(text: &str) -> (String, String) {
    let column = text.chars().position(|c| c == '¦').expect("a mark") + 1;
    (text.replace('¦', ""), format!("1:{column}"))
}

/// Eleven mistakes in two files.
#[test]
fn all_mistakes_of_all_files_come_in_one_go() {
    let config = r#"(
    scene: "a.scene.ron",
    film: (width: 100, widht: 200),
    sampler: (seed: -1),
    camra: "main",
    integrator: Path(max_depth: 2.5),
)
"#;
    let scene = r#"(
    models: [(name: "box", path: "bx.obj")],
    entities: {
        "gold": {"Conductor": (alhpa: 0.1)},
        "ball": {"Sphere": (radius: "big"), "MaterialRef": "glod"},
        "lamp": {"PointLigth": ()},
        "wall": {"Quad": (width: -1), "MaterialRef": "box/wall"},
    },
    overrides: {
        "entities.bal.Sphere.radius": 1,
        "materials.box/wall.Lambert.reflectance": 0.5,
    },
)
"#;
    let files = [("c.ron", config), ("a.scene.ron", scene), ("box.obj", "")];
    let got = load(&files, &[]);
    assert!(!got.ok);
    assert_eq!(
        got.said,
        [
            "c.ron:3:24: error: film.widht: unknown field of FilmSettings; did you mean `width`?",
            "c.ron:4:21: error: sampler.seed: -1 is out of range: 0 to 18446744073709551615",
            "c.ron:5:5: error: camra: unknown field; did you mean `camera`?",
            "c.ron:6:33: error: integrator.max_depth: expected a whole number, found 2.5",
            "a.scene.ron:2:34: error: models.box.path: `bx.obj`: there is no such file; did you \
             mean `box.obj`?",
            "a.scene.ron:4:32: error: entities.gold.Conductor.alhpa: unknown field of Conductor; \
             did you mean `alpha`?",
            "a.scene.ron:5:37: error: entities.ball.Sphere.radius: expected a number, found the \
             text \"big\"",
            "a.scene.ron:5:60: error: entities.ball.MaterialRef: there is no entity `glod`; did \
             you mean `gold`?",
            "a.scene.ron:6:18: error: entities.lamp.PointLigth: there is no component \
             `PointLigth`; did you mean `PointLight`?",
            "a.scene.ron:7:34: error: entities.wall.Quad.width: -1 must be finite and above 0",
            "a.scene.ron:10:9: error: entities.bal.Sphere.radius: there is no entity `bal`; did \
             you mean `ball`?",
        ]
    );
}

#[test]
fn what_does_not_fit_together_is_told() {
    let lit = r#""m": {"Lambert": ()}, "s": {"Sphere": (), "MaterialRef": "m"}, "#;
    for (entities, expected) in [
        (
            r#""a": {"Lambert": (reflectance: ¦2)}, "s": {"Sphere": (), "MaterialRef": "a"}"#,
            "error: entities.a.Lambert.reflectance: each channel must be between 0 and 1",
        ),
        (
            r#""a": {"Lambert": (), ¦"Mirror": ()}, "s": {"Sphere": (), "MaterialRef": "a"}"#,
            "error: entities.a.Mirror: the material is a Lambert already; a material has one lobe",
        ),
        (
            r#""a": {¦"Emission": ()}, "s": {"Sphere": (), "MaterialRef": "a"}"#,
            "error: entities.a.Emission: a material that glows needs a lobe too; add `\"Lambert\": (reflectance: 0)` for a black one",
        ),
        (
            r#""a": {"PointLight": ()}, "s": {"Sphere": (), ¦"MaterialRef": "a"}"#,
            "error: entities.s.MaterialRef: `a` is no material: it has no lobe; a lobe is a component such as `Lambert` or `Dielectric`",
        ),
        (
            r#""s": {"Sphere": (), ¦"Lambert": ()}"#,
            "error: entities.s.Lambert: the lobe stands on the shape and not on a material; make the material an entity of its own and name it in `MaterialRef`",
        ),
        (
            r#""s": {"Sphere": (), ¦"Quad": (), "MaterialRef": "m"}, "m": {"Lambert": ()}"#,
            "error: entities.s.Quad: one thing has several shapes: Sphere, Quad; make an entity of each, with `ChildOf` to keep them together",
        ),
        (
            r#""c": {¦"PerspectiveCamera": (hfov_deg: 40, vfov_deg: 30)}"#,
            "error: entities.c.PerspectiveCamera: both `hfov_deg` and `vfov_deg` are given; give one, the other follows from the picture",
        ),
        (
            r#""c": {"PerspectiveCamera": (hfov_deg: ¦180)}"#,
            "error: entities.c.PerspectiveCamera.hfov_deg: 180 must be between 0.000014 and 179.99998",
        ),
        (
            r#""c": {"PerspectiveCamera": (vfov_deg: ¦179.9999999999999)}"#,
            "error: entities.c.PerspectiveCamera.vfov_deg: 179.9999999999999 must be between 0.000014 and 179.99998",
        ),
        (
            r#""c": {"Orthographic": (), ¦"LocalTransform": (), "LookAt": ()}"#,
            "error: entities.c.LocalTransform: `LookAt` and `LocalTransform` both place the entity; keep one; to move the camera besides, put it under a parent entity with the `LocalTransform`",
        ),
        (
            r#""c": {"Orthographic": (height: ¦-1)}"#,
            "error: entities.c.Orthographic.height: -1 must be finite and above 0",
        ),
        (
            r#""c": {"Orthographic": (), ¦"LookAt": (from: (0, 1, 0), to: (0, 2, 0))}"#,
            "error: entities.c.LookAt: `from`, `to` and `up` do not span a frame; `to` must differ from `from`, and `up` from the view direction",
        ),
        (
            r#""c": {¦"Orthographic": (), "PerspectiveCamera": ()}"#,
            "error: entities.c.Orthographic: a camera has one projection: `PerspectiveCamera` or `Orthographic`",
        ),
        (
            r#""c": {"Orthographic": (), "ActiveCamera": ()}, "d": {"Orthographic": (), ¦"ActiveCamera": ()}"#,
            "error: entities.d.ActiveCamera: `c` is the active camera already; a scene has one",
        ),
        (
            r#""c": {¦"ActiveCamera": ()}"#,
            "error: entities.c.ActiveCamera: what is marked as the active camera is no camera; give it a `PerspectiveCamera` or an `Orthographic`",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (aperture_radius: ¦-1)}"#,
            "error: entities.c.ThinLens.aperture_radius: -1 must be finite and at least 0",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (aperture_radius: 1, focus_distance: ¦0)}"#,
            "error: entities.c.ThinLens.focus_distance: 0 must be finite and above 0",
        ),
        (
            r#""c": {"Orthographic": (), ¦"ThinLens": (aperture_radius: 1)}"#,
            "error: entities.c.ThinLens: an aperture needs something to be in focus; give `focus_distance` in metres, or `focus`: `Entity(\"name\")` or `At((x, y))`",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (focus_distance: 1, focus: ¦At((1, 1)))}"#,
            "error: entities.c.ThinLens.focus: both `focus` and `focus_distance` are given; give one",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (focus_distance: 1, blades: ¦2)}"#,
            "error: entities.c.ThinLens.blades: 2 corners make no polygon; 3 or more make one, 0 is round",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (focus_distance: 1, rotation_deg: ¦inf)}"#,
            "error: entities.c.ThinLens.rotation_deg: must be finite",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (aperture_radius: 1, focus: ¦Entity("m"))}"#,
            "error: entities.c.ThinLens.focus: `m` is a material, which is nowhere; name a shape, a model, or anything that is placed",
        ),
        (
            r#""c": {"Orthographic": (), "ThinLens": (aperture_radius: 1, focus: Entity(¦"ball"))}, "bal": {"Sphere": ()}"#,
            "error: entities.c.ThinLens.focus[0]: there is no entity `ball`; did you mean `bal`?",
        ),
        (
            r#""x": {¦"ThinLens": ()}"#,
            "warning: entities.x.ThinLens: there is no camera to have this lens",
        ),
        (
            r#""l": {"SpotLight": (inner_deg: ¦50)}"#,
            "error: entities.l.SpotLight.inner_deg: 50 must be between 0 and `outer_deg`, 45",
        ),
        (
            r#""l": {"SpotLight": (outer_deg: ¦91)}"#,
            "error: entities.l.SpotLight.outer_deg: 91 must be above 0 and at most 90",
        ),
        (
            r#""l": {"PointLight": (intensity: ¦(1, -1, 1))}"#,
            "error: entities.l.PointLight.intensity: each channel must be finite and at least 0",
        ),
        (
            r#""l": {"Environment": (radiance: ¦inf)}"#,
            "error: entities.l.Environment.radiance: each channel must be finite and at least 0",
        ),
        (
            r#""x": {"LocalTransform": (scale: ¦(1, 0, 1))}"#,
            "error: entities.x.LocalTransform.scale: a scale of 0 leaves nothing",
        ),
        (
            r#""x": {¦"ChildOf": "y"}, "y": {"ChildOf": "x"}"#,
            "error: entities.x.ChildOf: the entity is its own ancestor",
        ),
        (
            r#""x": {¦"ChildOf": "x"}"#,
            "error: entities.x.ChildOf: the entity is its own parent",
        ),
        (
            r#""t": {¦"TriangleMesh": (positions: [0], indices: [(0, 0, 1)])}"#,
            "error: entities.t.TriangleMesh: index 1 of 1 vertices",
        ),
        (
            r#"¦"m2": {"Mirror": ()}"#,
            "notice: entities.m2: no shape has this material",
        ),
        (
            r#""x": {¦"MaterialRef": "m"}"#,
            "warning: entities.x.MaterialRef: there is no shape to have this material",
        ),
    ] {
        let needs_lit = entities.contains("\"m\"") && !entities.contains("Quad");
        let text = if needs_lit {
            format!("(entities: {{{entities}, {}}})", lit.trim_end_matches(", "))
        } else {
            format!("(entities: {{{entities}}})")
        };
        let (text, at) = take_mark(&text);
        assert_eq!(
            said(&text),
            [format!("a.scene.ron:{at}: {expected}")],
            "{text}"
        );
    }
}

#[test]
fn settings_out_of_range_are_told_with_their_place() {
    for (section, expected) in [
        (
            "film: (width: ¦0)",
            "error: film.width: 0 must be between 1 and 65536",
        ),
        (
            "film: (width: ¦65536, height: 65536)",
            "error: film.width: a film of 4294967296 pixels needs 672.0 GiB of memory, the limit is 32 GiB: render a smaller picture, or several crops",
        ),
        (
            "film: (crop: ¦(0, 0, 0, 5))",
            "error: film.crop: the crop is empty; write (x0, y0, x1, y1) with x0 < x1 and y0 < y1",
        ),
        (
            "film: (crop: ¦(0, 0, 481, 5))",
            "error: film.crop: the crop leaves the picture of 480×360",
        ),
        (
            "film: (layers: ¦[Ids, Ids])",
            "error: film.layers[1]: the layer Ids is there already",
        ),
        (
            "film: (clamp: ¦0)",
            "error: film.clamp: 0 must be finite and above 0; leave it out, or write None, to clamp nothing",
        ),
        (
            "film: (clamp: ¦inf)",
            "error: film.clamp: inf must be finite and above 0; leave it out, or write None, to clamp nothing",
        ),
        (
            "film: (filter: Box(radius: ¦0))",
            "error: film.filter.radius: 0 must be above 0 and at most 64 pixels",
        ),
        (
            "film: (filter: Gaussian(radius: 1, sigma: ¦0))",
            "error: film.filter.sigma: 0 must be finite and above 0",
        ),
        (
            "film: (filter: ¦Gaussian(radius: 1))",
            "error: film.filter: `Gaussian` needs the field `sigma`",
        ),
        (
            "sampler: (replicas: ¦3)",
            "error: sampler.replicas: 3 must be one of 1, 2, 4, 8 and 16",
        ),
        (
            "sampler: (replicas: ¦32)",
            "error: sampler.replicas: 32 must be one of 1, 2, 4, 8 and 16",
        ),
        (
            "budget: (samples: ¦0)",
            "error: budget.samples: a picture needs samples",
        ),
        (
            "budget: (seconds: ¦-1)",
            "error: budget.seconds: -1 must be finite and above 0",
        ),
        (
            "adaptive: (rule: Folds), sampler: (replicas: ¦2)",
            "error: sampler.replicas: 2 is too few for adaptive sampling with `Sobol`: it takes 4; leave it out, which means 8, or write 4, 8 or 16",
        ),
        (
            "adaptive: (rule: ¦Fold)",
            "error: adaptive.rule: there is no `Fold` here; did you mean `Folds`?",
        ),
        (
            "adaptive: (tolerance: ¦0)",
            "error: adaptive.tolerance: 0 must be finite and above 0",
        ),
        (
            "adaptive: (confidence: ¦95)",
            "error: adaptive.confidence: 95 must be between 0.5 and 0.9999",
        ),
        (
            "adaptive: (batch: ¦0)",
            "error: adaptive.batch: 0 must be between 1 and 65536",
        ),
        (
            "adaptive: (block: ¦3)",
            "error: adaptive.block: 3 must be one of 1, 2, 4, 8 and 16",
        ),
        (
            "adaptive: (floor: ¦-1)",
            "error: adaptive.floor: -1 must be finite and not below 0",
        ),
        (
            "post: (exposure: ¦inf)",
            "error: post.exposure: must be finite",
        ),
        (
            "integrator: ¦Bogus(a: 1)",
            "error: integrator: there is no integrator `Bogus`; valid here: Direct, Path",
        ),
        (
            "integrator: ¦\"Path\"",
            "error: integrator: expected an integrator, found the text \"Path\"; write its name and settings, such as `Path(max_depth: 5)`",
        ),
        (
            "camera: ¦{\"LookAt\": ()}",
            "error: camera: the camera has no projection; add `\"PerspectiveCamera\": (hfov_deg: 40)` or `\"Orthographic\": (…)`",
        ),
    ] {
        let config = format!("(scene: \"a.scene.ron\", {section})");
        let (config, at) = take_mark(&config);
        let got = load(&[("c.ron", &config), ("a.scene.ron", "()")], &[]);
        let errors: Vec<&String> = got.said.iter().filter(|s| s.contains(" error: ")).collect();
        assert!(!got.ok, "{section}");
        assert_eq!(
            errors.first(),
            Some(&&format!("c.ron:{at}: {expected}")),
            "{:#?}",
            got.said
        );
    }
}

#[test]
fn one_mistake_is_told_once() {
    for (config, said) in [
        (
            "film: (width: -3, height: \"tall\", crop: (0, 0, 900, 900))",
            &["film.width: -3 is out", "film.height: expected"][..],
        ),
        (
            "film: (filter: Gaussian(radius: 1.5))",
            &["film.filter: `Gaussian` needs the field `sigma`"],
        ),
        (
            "camera: {\"PerspectiveCamera\": (hfov_deg: \"wide\")}",
            &["camera.PerspectiveCamera.hfov_deg: expected a number"],
        ),
        // Two mistakes in one section are two all the same.
        (
            "film: (width: -3, filter: Box(radius: 0))",
            &["film.width: -3 is out", "film.filter.radius: 0 must be"],
        ),
    ] {
        let config = format!("(scene: \"a.scene.ron\", {config})");
        let got = load(&[("c.ron", &config), ("a.scene.ron", "()")], &[]);
        let told = got
            .said
            .iter()
            .zip(said)
            .all(|(got, say)| got.contains(say));
        assert!(told && got.said.len() == said.len(), "{:#?}", got.said);
    }
    // By whatever path it was reached.
    let scene = r#"(entities: {"c": {"PerspectiveCamera": (), "ActiveCamera": ()}})"#;
    for path in ["camera", "entities.c"] {
        let set = format!("{path}.PerspectiveCamera.vfov_deg=wide");
        let got = load(&[("a.scene.ron", scene)], &[&set]);
        assert_eq!(got.said.len(), 1, "{:#?}", got.said);
    }
}

#[test]
fn what_is_there_but_no_file_gets_no_other_name() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.scene.ron"), "()").unwrap();
    let path = folder.path().join("in.ron");
    let said = || {
        let mut world = new_world();
        let path = path.clone();
        let overrides = Vec::new();
        world.insert_resource(LoadRequest {
            path,
            overrides,
            ..Default::default()
        });
        assert!(sr_scene::stage::run(&mut world, Load).is_err());
        world.resource::<Diagnostics>().0[0].to_string()
    };
    std::fs::create_dir(&path).unwrap();
    let expected = format!("error: `{}`: is not a file", path.display());
    assert_eq!(said(), expected);
    std::fs::remove_dir(&path).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere", &path).unwrap();
        let expected = format!("error: `{}`: there is no such file", path.display());
        assert_eq!(said(), expected);
    }
}

#[test]
fn an_override_of_a_parent_cannot_name_the_thing_itself() {
    let scene = r#"(entities: {"a": {"LocalTransform": ()}})"#;
    let got = load(&[("a.scene.ron", scene)], &["entities.a.ChildOf=a"]);
    assert_eq!(
        got.said,
        ["--set: error: entities.a.ChildOf: the entity is its own parent"]
    );
}

#[test]
fn a_film_counts_as_what_it_keeps() {
    let pictures = |film: &str| {
        let config = format!("(scene: \"a.scene.ron\", {film})");
        load(&[("c.ron", &config), ("a.scene.ron", "()")], &[]).ok
    };
    // 14000² · 56 · (2 + 1) bytes are 30.7 GiB; more layers, replicas or pixels pass 32 GiB.
    assert!(pictures("film: (width: 14000, height: 14000)"));
    assert!(!pictures("film: (width: 15000, height: 14000)"));
    let layers = "film: (width: 14000, height: 14000, layers: [Normal, Depth, Albedo])";
    assert!(!pictures(layers));
    let size = "film: (width: 14000, height: 14000)";
    assert!(!pictures(&format!("{size}, sampler: (replicas: 4)")));
    // Of a picture too large to keep, a part can be kept.
    assert!(pictures(
        "film: (width: 65536, height: 65536, crop: (0, 0, 99, 99))"
    ));
}
