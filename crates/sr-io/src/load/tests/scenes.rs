use super::*;
use sr_scene::components::{
    ActiveCamera, Conductor, Emission, Lambert, LocalTransform, LookAt, MaterialRef,
    PerspectiveCamera, Rgb, SourceSpan, Sphere,
};
use sr_scene::settings::{
    AccelQuality, Budget, CompileSettings, FilmSettings, LayerName, LightSelectionName,
    PixelFilter, PostSettings, Precision, SamplerName, SamplerSettings, SceneFilm, ToneMapName,
};

const SCENE: &str = r#"(
    film: (width: 200, height: 100),
    entities: {
        "ball": {"Sphere": (radius: 0.3), "LocalTransform": (translate: (0.4, 0.3, 0.3), scale: 2), "MaterialRef": "gold"},
        "gold": {"Conductor": (alpha: 0.25), "Emission": (radiance: 3)},
        "camera": {"PerspectiveCamera": (hfov_deg: 30.7), "LookAt": (from: (0, 0.75, 4.8), to: (0, 0.75, 0)), "ActiveCamera": ()},
        "child": {"ChildOf": "ball", "Sphere": (), "MaterialRef": "gold"},
    },
)"#;

#[test]
fn a_scene_becomes_entities_with_components() {
    let mut got = load(&[("a.scene.ron", SCENE)], &[]).clean();
    assert_eq!(got.get::<Sphere>("ball").radius, 0.3);
    let local = got.get::<LocalTransform>("ball");
    assert_eq!((local.translate, local.scale), ([0.4, 0.3, 0.3], [2.0; 3]));
    let gold = got.entity("gold");
    assert_eq!(got.get::<MaterialRef>("ball").0, gold);
    assert_eq!(got.get::<Conductor>("gold").alpha, Some(0.25));
    assert_eq!(got.get::<Conductor>("gold").eta, Conductor::default().eta);
    assert_eq!(got.get::<Emission>("gold").radiance, Rgb::splat(3.0));
    assert_eq!(got.get::<PerspectiveCamera>("camera").hfov_deg, Some(30.7));
    assert_eq!(got.get::<LookAt>("camera").to, [0.0, 0.75, 0.0]);
    assert!(got.has::<ActiveCamera>("camera"));
    let ball = got.entity("ball");
    assert_eq!(got.get::<ChildOf>("child").parent(), ball);
    let span = got.get::<SourceSpan>("gold");
    assert_eq!((span.line, span.column), (5, 9));
    let film = got.resource::<SceneFilm>();
    assert_eq!((film.width, film.height), (Some(200), Some(100)));
    assert_eq!(got.settings::<PathSettings>(), PathSettings::default());
}

#[test]
fn entities_come_into_being_in_the_order_of_the_file() {
    let mut got = load(&[("a.scene.ron", SCENE)], &[]).clean();
    let names = ["ball", "gold", "camera", "child"];
    let entities = names.map(|n| got.entity(n));
    assert!(entities.is_sorted_by_key(|e| e.index()), "{entities:?}");
}

#[test]
fn a_configuration_fills_every_section() {
    let config = r#"(
        scene: "s/a.scene.ron",
        integrator: Direct(strategy: Light),
        sampler: (kind: Independent, seed: 7, replicas: 4),
        film: (width: 20, filter: Gaussian(radius: 1.5, sigma: 0.5), crop: (0, 0, 10, 10), layers: [Normal, Depth], precision: Half, clamp: 10),
        budget: (samples: 16, seconds: 2, target_error: 1e-3, pass_samples: 4),
        post: (exposure: 1.5, tone_map: AgX),
        compile: (accel: Fast, light_selection: Uniform),
        camera: {"PerspectiveCamera": (vfov_deg: 50), "LookAt": (from: (0, 0, 9))},
        overrides: {"entities.gold.Conductor.alpha": 0.5},
    )"#;
    let mut got = load(&[("c.ron", config), ("s/a.scene.ron", SCENE)], &[]).clean();
    let film = got.resource::<FilmSettings>();
    let expected = FilmSettings {
        width: Some(20),
        height: None,
        filter: PixelFilter::Gaussian {
            radius: 1.5,
            sigma: 0.5,
        },
        crop: Some([0, 0, 10, 10]),
        layers: vec![LayerName::Normal, LayerName::Depth],
        precision: Precision::Half,
        clamp: Some(10.0),
    };
    assert_eq!(film, expected);
    assert_eq!(film.size(got.resource::<SceneFilm>()), [20, 100]);
    let expected = SamplerSettings {
        kind: SamplerName::Independent,
        seed: 7,
        replicas: 4,
    };
    assert_eq!(got.resource::<SamplerSettings>(), expected);
    let expected = Budget {
        samples: Some(16),
        seconds: Some(2.0),
        target_error: Some(1e-3),
        pass_samples: Some(4),
    };
    assert_eq!(got.resource::<Budget>(), expected);
    let expected = PostSettings {
        exposure: 1.5,
        tone_map: ToneMapName::AgX,
    };
    assert_eq!(got.resource::<PostSettings>(), expected);
    let expected = CompileSettings {
        accel: AccelQuality::Fast,
        light_selection: LightSelectionName::Uniform,
    };
    assert_eq!(got.resource::<CompileSettings>(), expected);
    assert_eq!(got.settings::<DirectSettings>().strategy, Strategy::Light);
    assert_eq!(got.get::<Conductor>("gold").alpha, Some(0.5));
    assert!(
        !got.has::<ActiveCamera>("camera"),
        "the configuration's takes its place"
    );
    assert!(got.has::<ActiveCamera>("camera#2"));
    assert_eq!(
        got.get::<PerspectiveCamera>("camera#2").vfov_deg,
        Some(50.0)
    );
}

#[test]
fn a_camera_without_tag_is_active_and_of_several_the_first() {
    let one = r#"(entities: {"a": {"Orthographic": (width: 2)}})"#;
    assert!(
        load(&[("a.scene.ron", one)], &[])
            .clean()
            .has::<ActiveCamera>("a")
    );
    let two = r#"(entities: {"z": {"PerspectiveCamera": ()}, "a": {"PerspectiveCamera": ()}})"#;
    let mut got = load(&[("a.scene.ron", two)], &[]);
    assert!(got.ok && got.has::<ActiveCamera>("z") && !got.has::<ActiveCamera>("a"));
    assert_eq!(
        got.said,
        [
            "a.scene.ron:1:13: notice: camera: no camera is marked as `ActiveCamera`, so the first \
          of 2 is taken: z; the others are a"
        ]
    );
    let by_name = r#"(scene: "a.scene.ron", camera: "a")"#;
    let mut got = load(&[("c.ron", by_name), ("a.scene.ron", two)], &[]).clean();
    assert!(got.has::<ActiveCamera>("a") && !got.has::<ActiveCamera>("z"));
}

#[test]
fn a_scene_without_camera_is_left_without() {
    let scene = r#"(entities: {"a": {"Sphere": (), "MaterialRef": "m"}, "m": {"Lambert": 
        (reflectance: 0.2)}})"#;
    let mut got = load(&[("a.scene.ron", scene)], &[]).clean();
    let mut active = got.world.query_filtered::<(), With<ActiveCamera>>();
    assert_eq!(active.iter(&got.world).count(), 0);
    assert_eq!(got.get::<Lambert>("m").reflectance, Rgb::splat(0.2));
}

#[test]
fn a_second_load_replaces_the_first() {
    let mut got = load(
        &[("a.scene.ron", SCENE)],
        &["film.width=9", "integrator=Direct"],
    )
    .clean();
    let path = got.world.resource::<LoadRequest>().path.clone();
    got.world.insert_resource(LoadRequest {
        path,
        ..Default::default()
    });
    assert!(sr_scene::stage::run(&mut got.world, Load).is_ok());
    assert_eq!(got.resource::<FilmSettings>().width, None);
    assert_eq!(got.settings::<PathSettings>(), PathSettings::default());
    assert_eq!(
        got.get::<Sphere>("ball").radius,
        0.3,
        "and there is only one"
    );
}
