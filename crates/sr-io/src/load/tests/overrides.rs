use super::*;
use sr_scene::components::{
    ActiveCamera, Conductor, Emission, Focus, Lambert, LocalTransform, LookAt, MaterialRef, Mirror,
    PerspectiveCamera, Rgb, Sphere, ThinLens,
};
use sr_scene::settings::{
    AccelQuality, Budget, CompileSettings, FilmSettings, PixelFilter, PostSettings, SamplerName,
    SamplerSettings, ToneMapName,
};

const SCENE: &str = r#"(
    entities: {
        "ball": {"Sphere": (radius: 1), "MaterialRef": "gold"},
        "gold": {"Conductor": (alpha: 0.25)},
        "red.dark/matte": {"Lambert": (reflectance: (0.5, 0, 0))},
        "red": {"Lambert": ()},
        "group": {"LocalTransform": ()},
        "a": {"ChildOf": "group", "Sphere": (), "MaterialRef": "red"},
        "b": {"ChildOf": "a", "Sphere": (), "MaterialRef": "red.dark/matte"},
        "camera": {"PerspectiveCamera": (hfov_deg: 30), "ActiveCamera": ()},
    },
    overrides: {"entities.gold.Conductor.alpha": 0.3, "entities.ball.Sphere.radius": 2},
)"#;

const CONFIG: &str = r#"(
    scene: "a.scene.ron",
    integrator: Path(max_depth: 3),
    overrides: {"entities.gold.Conductor.alpha": 0.4},
)"#;

fn with(sets: &[&str]) -> Loaded {
    load(&[("c.ron", CONFIG), ("a.scene.ron", SCENE)], sets)
}

#[test]
fn the_command_line_comes_after_the_configuration_and_that_after_the_scene() {
    let mut got = with(&[]).clean();
    assert_eq!(got.get::<Conductor>("gold").alpha, Some(0.4));
    assert_eq!(got.get::<Sphere>("ball").radius, 2.0);
    let sets = [
        "entities.gold.Conductor.alpha=0.5",
        "entities.gold.Conductor.alpha=0.6",
    ];
    assert_eq!(
        with(&sets).clean().get::<Conductor>("gold").alpha,
        Some(0.6)
    );
}

#[test]
fn set_reaches_every_section() {
    let mut got = with(&[
        "film.width=11",
        "film.filter=Tent(radius: 2)",
        "film.filter.radius=3",
        "film.crop=(1, 2, 3, 4)",
        "film.crop[3]=5",
        "film.layers=[Ids]",
        "sampler.kind=Independent",
        "sampler=(seed: 9)",
        "budget.samples=5",
        "budget.seconds=None",
        "post.tone_map=PbrNeutral",
        "compile.accel=High",
        "integrator.max_depth=7",
        "camera.PerspectiveCamera.hfov_deg=31",
        "camera.LocalTransform.translate[2]=4",
        "entities.gold.Conductor.k=2",
        "entities.gold.Conductor.eta=(1, 2, 3)",
        "entities.gold.Conductor.eta[1]=5",
        "entities.ball.LocalTransform.scale=3",
        "materials.red.Lambert.reflectance=0.25",
    ])
    .clean();
    let film = got.resource::<FilmSettings>();
    assert_eq!(film.width, Some(11));
    assert_eq!(film.filter, PixelFilter::Tent { radius: 3.0 });
    assert_eq!(film.crop, Some([1, 2, 3, 5]));
    assert_eq!(film.layers.len(), 1);
    let sampler = got.resource::<SamplerSettings>();
    assert_eq!((sampler.kind, sampler.seed), (SamplerName::Independent, 9));
    assert_eq!(got.resource::<Budget>().samples, Some(5));
    assert_eq!(
        got.resource::<PostSettings>().tone_map,
        ToneMapName::PbrNeutral
    );
    assert_eq!(got.resource::<CompileSettings>().accel, AccelQuality::High);
    assert_eq!(got.settings::<PathSettings>().max_depth, Some(7));
    assert_eq!(got.get::<PerspectiveCamera>("camera").hfov_deg, Some(31.0));
    assert_eq!(
        got.get::<LocalTransform>("camera").translate,
        [0.0, 0.0, 4.0]
    );
    assert_eq!(got.get::<Conductor>("gold").eta, Some(Rgb([1.0, 5.0, 3.0])));
    assert_eq!(got.get::<LocalTransform>("ball").scale, [3.0; 3]);
    assert_eq!(got.get::<Lambert>("red").reflectance, Rgb::splat(0.25));
}

#[test]
fn whole_values_keep_what_they_do_not_name() {
    let mut got = with(&[
        "entities.gold.Conductor=(eta: 3, k: 2)",
        "integrator=Direct(strategy: Light)",
        "integrator=Direct(lights: 4)",
    ])
    .clean();
    assert_eq!(got.get::<Conductor>("gold").alpha, Some(0.4));
    assert_eq!(got.get::<Conductor>("gold").eta, Some(Rgb::splat(3.0)));
    let expected = DirectSettings {
        strategy: Strategy::Light,
        lights: 4,
    };
    assert_eq!(got.settings::<DirectSettings>(), expected);
}

#[test]
fn names_may_hold_dots_and_the_longest_that_fits_is_meant() {
    let mut got = with(&["materials.red.dark/matte.Lambert.reflectance=0.75"]).clean();
    assert_eq!(
        got.get::<Lambert>("red.dark/matte").reflectance,
        Rgb::splat(0.75)
    );
    assert_eq!(
        got.get::<Lambert>("red").reflectance,
        Lambert::default().reflectance
    );
    let ambiguous = r#"(entities: {"m": {"Lambert": ()}, "m.Lambert": {"Lambert": ()}})"#;
    let got = load(
        &[("a.scene.ron", ambiguous)],
        &["entities.m.Lambert=(reflectance: 0)"],
    );
    assert!(
        got.said.contains(
            &"--set: error: entities.m.Lambert: the path may mean any of m.Lambert, m; rename \
              one of them"
                .to_owned()
        ),
        "{:#?}",
        got.said
    );
}

#[test]
fn another_lobe_takes_the_place_of_the_one_that_was_there() {
    let sets = [r#"materials.gold={"Mirror": (reflectance: 0.5), "Emission": ()}"#];
    let mut got = with(&sets).clean();
    assert!(got.has::<Mirror>("gold") && !got.has::<Conductor>("gold"));
    assert!(got.has::<Emission>("gold"));
    let mut got = with(&["entities.gold.Mirror.reflectance=0.25"]);
    assert!(got.ok && !got.has::<Conductor>("gold"));
    assert_eq!(got.get::<Mirror>("gold").reflectance, Rgb::splat(0.25));
    assert_eq!(
        got.said,
        ["--set: notice: entities.gold.Mirror: the material was Conductor and is Mirror now"]
    );
}

#[test]
fn a_material_of_a_group_goes_to_all_shapes_below() {
    let mut got = with(&["entities.group.MaterialRef=gold"]);
    let gold = got.entity("gold");
    assert_eq!(got.get::<MaterialRef>("a").0, gold);
    assert_eq!(got.get::<MaterialRef>("b").0, gold);
    assert!(!got.has::<MaterialRef>("group"));
    assert!(got.ok);
    let mut got = with(&["entities.a.MaterialRef=\"gold\""]);
    assert_eq!(got.get::<MaterialRef>("a").0, gold);
    assert_ne!(
        got.get::<MaterialRef>("b").0,
        gold,
        "a shape speaks for itself"
    );
    let got = with(&["entities.camera.MaterialRef=gold"]);
    assert_eq!(
        got.said,
        [
            "--set: error: entities.camera.MaterialRef: there is no shape here or below that could \
          have a material"
        ]
    );
}

#[test]
fn the_camera_can_be_another_one() {
    let sets = ["entities.other.PerspectiveCamera=()", "camera=other"];
    let scene = SCENE.replace(
        "\"group\":",
        "\"other\": {\"PerspectiveCamera\": ()}, \"group\":",
    );
    let mut got = load(&[("a.scene.ron", &scene)], &sets).clean();
    assert!(got.has::<ActiveCamera>("other") && !got.has::<ActiveCamera>("camera"));
    let sets = ["entities.other.ActiveCamera=()"];
    let mut got = load(&[("a.scene.ron", &scene)], &sets).clean();
    assert!(got.has::<ActiveCamera>("other") && !got.has::<ActiveCamera>("camera"));
    let sets = [
        r#"camera={"Orthographic": (width: 3)}"#,
        "camera.Orthographic.width=4",
    ];
    let mut got = with(&sets).clean();
    assert!(got.has::<ActiveCamera>("camera#2") && !got.has::<ActiveCamera>("camera"));
}

/// A focus takes the place of one that was given in the other way; the rest of the lens stays.
#[test]
fn a_lens_is_focused_in_one_way() {
    let given = "camera.ThinLens=(aperture_radius: 0.1, focus_distance: 3, blades: 6)";
    let mut got = with(&[given, r#"camera.ThinLens.focus=Entity("ball")"#]).clean();
    let ball = got.entity("ball");
    let lens = got.get::<ThinLens>("camera");
    assert_eq!(lens.focus, Some(Focus::Entity(ball)));
    assert_eq!((lens.focus_distance, lens.blades), (None, 6));
    let sets = [
        given,
        "camera.ThinLens.focus=At((3, 4))",
        "camera.ThinLens.focus_distance=inf",
    ];
    let lens = with(&sets).clean().get::<ThinLens>("camera");
    assert_eq!(
        (lens.focus, lens.focus_distance),
        (None, Some(f64::INFINITY))
    );
}

#[test]
fn the_scene_can_be_another_one() {
    let other = (
        "b.scene.ron",
        r#"(entities: {"gold": {"Conductor": ()}, "x": {"Sphere": (), "MaterialRef": "gold"}})"#,
    );
    let files = [("c.ron", CONFIG), ("a.scene.ron", SCENE), other];
    let got = load(&files, &["scene=b.scene.ron"]);
    // A path of the command line starts where the user stands.
    assert!(got.said[0].starts_with("--set: error: scene: `b.scene.ron`: there is no such file"));
    assert_eq!(got.said.len(), 1, "{:#?}", got.said);
}

#[test]
fn mistakes_in_paths_and_values_name_the_nearest() {
    for (text, expected) in [
        (
            "film.widht=3",
            "film.widht: unknown field of FilmSettings; did you mean `width`?",
        ),
        (
            "flim.width=3",
            "flim.width: no path starts with `flim`; did you mean `film`?",
        ),
        (
            "width=3",
            "width: no path starts with `width`; valid here: entities, materials, camera, integrator, film, sampler, budget, adaptive, post, compile",
        ),
        (
            "film.width=-3",
            "film.width: -3 is out of range: 0 to 4294967295",
        ),
        (
            "film..width=3",
            "film..width: a name is missing after a `.`",
        ),
        (
            "film.width=(1",
            "film.width: `(1` is no RON at column 1: what opens here is never closed by `)`",
        ),
        (
            "film.width=wide",
            "film.width: expected a whole number, found the name `wide`",
        ),
        (
            "sampler.kind=Sobl",
            "sampler.kind: there is no `Sobl` here; did you mean `Sobol`?",
        ),
        (
            "integrator=Paht",
            "integrator: there is no integrator `Paht`; did you mean `Path`?",
        ),
        (
            "integrator.depth=3",
            "integrator.depth: unknown field of PathSettings; valid here: max_depth",
        ),
        (
            "entities.godl.Conductor.alpha=1",
            "entities.godl.Conductor.alpha: there is no entity `godl`; did you mean `gold`?",
        ),
        (
            "entities.gold.Conducter.alpha=1",
            "entities.gold.Conducter: there is no component `Conducter`; did you mean `Conductor`?",
        ),
        (
            "entities.gold.Conductor.alhpa=1",
            "entities.gold.Conductor.alhpa: unknown field of Conductor; did you mean `alpha`?",
        ),
        (
            "entities.gold.Conductor.eta[3]=1",
            "entities.gold.Conductor.eta[3]: the last index is 2",
        ),
        (
            "entities.gold=3",
            "entities.gold: expected components, found the number 3; write `{\"Component\": (…), …}`, or name one in the path",
        ),
        (
            "entities=3",
            "entities: a name is missing after `entities.`",
        ),
        (
            "materials.ball.Lambert=()",
            "materials.ball.Lambert: there is no material `ball`; `entities.ball` is there",
        ),
        (
            "entities.ball.MaterialRef=glod",
            "entities.ball.MaterialRef: there is no entity `glod`; did you mean `gold`?",
        ),
        (
            "camera=gold",
            "camera: there is no camera `gold`; valid here: camera",
        ),
        (
            "camera=3",
            "camera: expected a camera, found the number 3; write the name of a camera, or components as `{\"Component\": (…), …}`",
        ),
        (
            "camera.PerspectiveCamera.fov=3",
            "camera.PerspectiveCamera.fov: unknown field of PerspectiveCamera; valid here: hfov_deg, vfov_deg",
        ),
    ] {
        let got = with(&[text]);
        let expected = format!("--set: error: {expected}");
        // Other steps may add to it: a shape without material, say.
        assert_eq!(got.said.first(), Some(&expected), "{text}: {:#?}", got.said);
        assert!(!got.ok);
    }
}

#[test]
fn invalid_values_point_at_whoever_set_them() {
    let got = with(&["entities.gold.Conductor.alpha=1.5", "film.width=0"]);
    assert_eq!(
        got.said,
        [
            "--set: error: entities.gold.Conductor.alpha: must be between 0 and 1",
            "--set: error: film.width: 0 must be between 1 and 65536",
        ]
    );
    let got = with(&["camera.PerspectiveCamera.hfov_deg=200"]);
    assert_eq!(
        got.said,
        [
            "--set: error: entities.camera.PerspectiveCamera.hfov_deg: 200 must be between 0.000014 and 179.99998"
        ]
    );
}

#[test]
fn one_placement_makes_way_for_the_other() {
    let scene = r#"(entities: {"c": {"Orthographic": (), "LookAt": (from: (0, 0, 5))}})"#;
    let placed = ["entities.c.LocalTransform=(translate: (1, 2, 3))"];
    let mut got = load(&[("a.scene.ron", scene)], &placed).clean();
    assert!(!got.has::<LookAt>("c"));
    let there_and_back = [placed[0], "camera.LookAt=(from: (0, 0, 7))"];
    let mut got = load(&[("a.scene.ron", scene)], &there_and_back).clean();
    assert!(!got.has::<LocalTransform>("c"));
    assert_eq!(got.get::<LookAt>("c").from, [0.0, 0.0, 7.0]);
    // A field alone would leave the other placement without effect.
    let field = ["camera.LocalTransform.translate=(1, 2, 3)"];
    let got = load(&[("a.scene.ron", scene)], &field);
    assert!(
        got.said[0].contains("both place the entity"),
        "{:#?}",
        got.said
    );
}
