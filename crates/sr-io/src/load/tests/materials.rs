//! What the fields of a material may be together.

use super::*;
use sr_scene::components::{Conductor, RoughDielectric};

/// The problems of a scene whose ball is of this material, without place and path.
fn problems(lobe: &str) -> Vec<String> {
    let scene = format!(
        r#"(entities: {{
            "m": {{{lobe}}},
            "ball": {{"Sphere": (), "MaterialRef": "m"}},
            "camera": {{"PerspectiveCamera": ()}},
            "sky": {{"Environment": ()}},
        }})"#
    );
    let got = load(&[("a.scene.ron", &scene)], &[]);
    let message = |line: &String| {
        let at = line.find("entities.m").expect("it is about the material");
        line[at + "entities.m.".len()..].to_owned()
    };
    got.said.iter().map(message).collect()
}

#[test]
fn what_belongs_together_is_accepted() {
    for lobe in [
        r#""Conductor": ()"#,
        r#""Conductor": (metal: "au", alpha: 0)"#,
        r#""Conductor": (metal: "Gold", alpha_x: 0.1, alpha_y: 0.4, rotation_deg: 30, ndf: Ggx)"#,
        r#""Conductor": (eta: (1, 2, 3), k: 2, fresnel: Approximate, sampling: Cosine)"#,
        r#""Conductor": (metal: "W", compensate: true, sampling: Ndf)"#,
        r#""RoughDielectric": (ior: 1, alpha: 0.5)"#,
        r#""RoughDielectric": (ior: 1.33, alpha_x: 0.1, alpha_y: 0.4, compensate: true)"#,
        r#""OrenNayar": (reflectance: 1, sigma_deg: 90)"#,
    ] {
        assert_eq!(problems(lobe), [""; 0], "{lobe}");
    }
}

#[test]
fn what_excludes_each_other_is_told() {
    for (lobe, expected) in [
        (
            r#""Conductor": (metal: "god")"#,
            "Conductor.metal: there is no metal `god`; did you mean `gold`?",
        ),
        (
            r#""Conductor": (metal: "Unobtainium")"#,
            "Conductor.metal: there is no metal `Unobtainium`; valid here: Ag, Al, Au, Co, Cr, Cu, Fe, Hg, \
             K, Na, Ni, Pd, Pt, Rh, Ti, V, W",
        ),
        (
            r#""Conductor": (metal: "Au", k: 2)"#,
            "Conductor.metal: a named metal has its index and cannot stand beside `eta` and `k`; set the \
             ones that you do not mean to None",
        ),
        (
            r#""Conductor": (eta: 2)"#,
            "Conductor.eta: needs `k` beside it",
        ),
        (
            r#""Conductor": (k: 2)"#,
            "Conductor.k: needs `eta` beside it",
        ),
        (
            r#""Conductor": (eta: (0, 1, 1), k: 2)"#,
            "Conductor.eta: each channel must be above 0",
        ),
        (
            r#""Conductor": (alpha: 0.1, alpha_x: 0.2)"#,
            "Conductor.alpha: is the roughness in every direction and cannot stand beside `alpha_x` and \
             `alpha_y`; set the ones that you do not mean to None",
        ),
        (
            r#""RoughDielectric": (alpha_y: 0.2)"#,
            "RoughDielectric.alpha_y: needs `alpha_x` beside it",
        ),
        (
            r#""RoughDielectric": (alpha_x: 0.2, alpha_y: 1.5)"#,
            "RoughDielectric.alpha_y: must be between 0 and 1",
        ),
        (
            r#""RoughDielectric": (rotation_deg: inf)"#,
            "RoughDielectric.rotation_deg: must be finite",
        ),
        (
            r#""OrenNayar": (sigma_deg: 91)"#,
            "OrenNayar.sigma_deg: must be between 0 and 90",
        ),
    ] {
        assert_eq!(problems(lobe), [expected], "{lobe}");
    }
}

/// The axis of an experiment and an override of the command line reach what the scene did not name.
#[test]
fn overrides_reach_fields_that_nobody_has_set() {
    let scene = r#"(entities: {
        "m": {"Conductor": (metal: "Ag")},
        "g": {"RoughDielectric": ()},
        "ball": {"Sphere": (), "MaterialRef": "m"},
        "other": {"Sphere": (), "MaterialRef": "g"},
        "camera": {"PerspectiveCamera": ()},
        "sky": {"Environment": ()},
    })"#;
    let sets = [
        "entities.m.Conductor.alpha=0.05",
        "entities.m.Conductor.metal=Ti",
        "entities.m.Conductor.compensate=true",
        "entities.g.RoughDielectric.sampling=Ndf",
        "entities.g.RoughDielectric.alpha=None",
        "entities.g.RoughDielectric=(alpha_x: 0.2, alpha_y: 0.3)",
    ];
    let mut got = load(&[("a.scene.ron", scene)], &sets).clean();
    let metal = got.get::<Conductor>("m");
    assert_eq!(metal.alpha, Some(0.05));
    assert_eq!(metal.metal.as_deref(), Some("Ti"));
    assert!(metal.compensate);
    assert_eq!(got.get::<RoughDielectric>("g").alpha_y, Some(0.3));
}
