use super::*;
use sr_scene::diagnostics::Diagnostic;
use std::path::Path;

fn read(name: &str, text: &str) -> (Option<Document>, Vec<String>) {
    let mut diagnostics: Vec<Diagnostic> = Vec::new();
    let document = parse(Path::new(name), text, &mut diagnostics);
    (
        document,
        diagnostics.iter().map(ToString::to_string).collect(),
    )
}

#[test]
fn the_kind_follows_from_fields_and_extension() {
    let kind = |name: &str, text: &str| match read(name, text).0 {
        Some(Document::Scene(_)) => "scene",
        Some(Document::Config(_)) => "config",
        None => "none",
    };
    assert_eq!(kind("a.ron", "(scene: \"b\")"), "config");
    assert_eq!(kind("a.ron", "(entities: {})"), "scene");
    assert_eq!(kind("a.scene.ron", "()"), "scene");
    assert_eq!(kind("a.scene.ron", "(film: (width: 1))"), "scene");
    assert_eq!(kind("a.ron", "(film: (width: 1))"), "config");
    assert_eq!(kind("a.ron", "(scene: \"b\", entities: {})"), "none");
    assert_eq!(kind("a.scene.ron", "(scene: \"b\")"), "none");
}

#[test]
fn a_file_that_is_both_says_which_fields_make_it_so() {
    let (_, complaints) = read("a.ron", "(\n models: [],\n sampler: (),\n)");
    assert_eq!(
        complaints,
        [
            "a.ron:3:2: error: sampler: `sampler` belongs to a run configuration and `models` to a \
          scene: one file cannot be both; keep the scene in a `.scene.ron` file and name it in \
          `scene`"
        ]
    );
}

#[test]
fn all_mistakes_of_a_scenes_frame_come_in_one_go() {
    let text = r#"(
        models: [
            (path: "a.glb"),
            (pth: "b.glb"),
            (name: "c"),
            (name: "a", path: "d/e.obj"),
        ],
        entites: {},
        entities: {"x": {"Sphere": (), "Sphere": ()}, "x": {}, "a": {}, 3: {}, "y": 4},
        overrides: [],
    )"#;
    let (document, complaints) = read("dir/s.scene.ron", text);
    assert_eq!(
        complaints,
        [
            "dir/s.scene.ron:8:9: error: entites: unknown field; did you mean `entities`?",
            "dir/s.scene.ron:4:14: error: models[1].pth: unknown field; did you mean `path`?",
            "dir/s.scene.ron:5:13: error: models[2]: a model needs a `path`",
            "dir/s.scene.ron:9:55: error: entities.x: the name is there already",
            "dir/s.scene.ron:9:73: error: entities: expected a name as a text, found the number 3",
            "dir/s.scene.ron:9:40: error: entities.x.Sphere: the name is there already",
            "dir/s.scene.ron:9:85: error: entities.y: expected components as `{\"Component\": (…), \
             …}`, found the number 4",
            "dir/s.scene.ron:10:20: error: overrides: expected paths and values as `{\"path\": \
             value, …}`, found a list of 0",
            "dir/s.scene.ron:6:13: error: models: another model is called `a` already; give it a \
             `name` of its own",
            "dir/s.scene.ron:9:64: error: entities.a: a model has this name already",
        ]
    );
    let Some(Document::Scene(scene)) = document else {
        panic!("a scene")
    };
    assert_eq!(scene.models[0].path, Path::new("dir/a.glb"));
    assert_eq!(scene.models[0].name, "a");
}

#[test]
fn a_configuration_needs_a_scene_and_nothing_else() {
    assert!(read("a.ron", "(scene: \"b.scene.ron\")").1.is_empty());
    assert_eq!(
        read("a.ron", "(budget: (), budget: (), scene: 3, seed: 1)").1,
        [
            "a.ron:1:14: error: budget: the field is set twice",
            "a.ron:1:36: error: seed: unknown field; valid here: scene, camera, \
             integrator, sampler, film, budget, adaptive, post, compile, overrides",
            "a.ron:1:33: error: scene: expected a text, found the number 3",
        ]
    );
    assert_eq!(
        read("a.ron", "()").1,
        [
            "a.ron:1:1: error: scene: a configuration needs a scene; add `scene: \
          \"path/to/a.scene.ron\"`"
        ]
    );
    assert_eq!(
        read("a.ron", "(scene: \"b\"").1,
        ["a.ron:1:1: error: what opens here is never closed by `)`"]
    );
}
