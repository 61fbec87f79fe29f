//! Files that cannot be read, and files that were changed at random.

use super::*;

#[test]
fn files_that_cannot_be_read_are_told_where_they_are_asked_for() {
    let got = load(
        &[
            (
                "c.ron",
                "(scene: \"b.scene.ron\", overrides: {\"entities.x.Sphere\": ()})",
            ),
            ("a.scene.ron", "()"),
        ],
        &[],
    );
    assert_eq!(
        got.said,
        [
            "c.ron:1:9: error: scene: `b.scene.ron`: there is no such file; did you mean \
          `a.scene.ron`?"
        ]
    );
    let got = load(
        &[
            ("c.ron", "(scene: \"d.ron\")"),
            ("d.ron", "(scene: \"c.ron\")"),
        ],
        &[],
    );
    assert_eq!(
        got.said,
        ["c.ron:1:9: error: scene: `d.ron` is a run configuration and no scene"]
    );
    let got = load(&[("c.ron", "(scene: \"a.png\")")], &[]);
    assert_eq!(
        got.said,
        [
            "c.ron:1:9: error: scene: `a.png` is of no kind that can be rendered; give a run \
          configuration (.ron), a scene (.scene.ron) or a model (.gltf, .glb, .obj)"
        ]
    );
    let mut got = load(&[("a.txt", "()")], &[]);
    let expected = "error: `a.txt` is of no kind that can be rendered";
    assert!(got.said[0].starts_with(expected), "{:#?}", got.said);
    let missing = got
        .world
        .resource::<LoadRequest>()
        .path
        .with_file_name("b.ron");
    got.world.resource_mut::<LoadRequest>().path = missing.clone();
    got.world.resource_mut::<Diagnostics>().0.clear();
    assert!(sr_scene::stage::run(&mut got.world, Load).is_err());
    let said = got.world.resource::<Diagnostics>().0[0].to_string();
    let expected = format!("error: `{}`: there is no such file", missing.display());
    assert!(said.starts_with(&expected), "{said}");
    let got = load_bytes(&[("a.scene.ron", b"(\n  \xff)")], &[]);
    assert_eq!(
        got.said,
        ["a.scene.ron:2:3: error: the file is no UTF-8 text"]
    );
    let got = load(
        &[
            ("c.ron", "(scene: \"a.scene.ron\", film: (widht: 1))"),
            ("a.scene.ron", "("),
        ],
        &[],
    );
    assert_eq!(
        got.said,
        [
            "c.ron:1:31: error: film.widht: unknown field of FilmSettings; did you mean `width`?",
            "a.scene.ron:1:1: error: what opens here is never closed by `)`",
        ]
    );
}

/// Slips of the pen in whole scenes never panic, whatever they lead to.
#[test]
fn mutated_scenes_end_with_errors_and_never_panic() {
    let text = r#"(film: (width: 9), entities: {"b": {"Sphere": (radius: 0.3), "LocalTransform": (translate: (0.4, 0.3, 0.3)), "MaterialRef": "g"}, "g": {"Conductor": (alpha: 0.25), "Emission": (radiance: 3)}, "c": {"PerspectiveCamera": (hfov_deg: 30.7), "LookAt": (from: (0, 0.75, 4.8)), "ChildOf": "b"}}, overrides: {"entities.b.MaterialRef": "g", "materials.g.Conductor.eta[0]": 2})"#;
    let words: Vec<&str> = text.split_inclusive([' ', '(', ')', ':', '"']).collect();
    let mut failed = 0;
    for i in 0..words.len() {
        for change in 0..3 {
            let mut words = words.clone();
            match change {
                0 => drop(words.remove(i)),
                1 => words.insert(i, words[i]),
                _ => {
                    let other = words.len() - 1 - i;
                    words.swap(i, other);
                }
            }
            let got = load(&[("a.scene.ron", &words.concat())], &[]);
            // A panic would fail the stage without a word.
            let has_errors = got.said.iter().any(|s| s.contains("error: "));
            assert_ne!(got.ok, has_errors, "{}", words.concat());
            failed += usize::from(!got.ok);
        }
    }
    assert!(failed > words.len(), "most changes are mistakes: {failed}");
}
