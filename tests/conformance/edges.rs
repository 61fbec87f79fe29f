//! Scenes with little in them: no panic, and the picture that follows.

use sr_tests::Scene;

fn mean_of(scene: &str) -> f64 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("edge.scene.ron");
    std::fs::write(&path, scene).expect("a file in a temporary folder");
    let mut scene = Scene::load(&path, &[("film.width", "8"), ("film.height", "8")]);
    let rendered = scene.render(4, 1);
    assert_eq!(rendered.report.tiles.rejects.total(), 0);
    rendered.mean().0
}

#[test]
fn an_empty_scene_shows_the_white_environment() {
    assert_eq!(mean_of("(entities: {})"), 1.0);
    assert_eq!(mean_of("()"), 1.0);
}

#[test]
fn an_environment_alone_is_seen() {
    assert_eq!(
        mean_of("(entities: {\"sky\": {\"Environment\": (radiance: 0.25)}})"),
        0.25
    );
}

/// A light that is turned off is still the author's light.
#[test]
fn dark_lights_leave_the_scene_dark() {
    let quad = "\"wall\": {\"Quad\": (width: 4, height: 4), \"MaterialRef\": \"m\"}, \
                \"m\": {\"Lambert\": (reflectance: 0.5)}";
    for light in [
        "\"sky\": {\"Environment\": (radiance: 0)}",
        "\"lamp\": {\"PointLight\": (intensity: 0)}",
        "\"off\": {\"Lambert\": (), \"Emission\": (strength: 0)}, \
         \"bulb\": {\"Sphere\": (radius: 0.1), \"MaterialRef\": \"off\"}",
    ] {
        assert_eq!(
            mean_of(&format!("(entities: {{{quad}, {light}}})")),
            0.0,
            "{light}"
        );
    }
}

/// A shape that f32 cannot hold is an error that names it, and no reason to lose the others.
#[test]
#[should_panic(expected = "Quad")]
fn a_shape_beyond_f32_is_refused() {
    mean_of("(entities: {\"wall\": {\"Quad\": (width: 1e200, height: 1)}})");
}
