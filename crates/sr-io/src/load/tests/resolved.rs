use super::*;
use crate::load::{config_hash, resolved_config};

const SCENE: &str = r#"(
    film: (width: 200, height: 100),
    entities: {"m": {"Conductor": ()}, "s": {"Sphere": (), "MaterialRef": "m"}},
)"#;

#[test]
fn a_resolved_configuration_describes_the_same_run() {
    let config = r#"(
        scene: "a.scene.ron",
        integrator: Direct(strategy: Light),
        film: (filter: Gaussian(radius: 1.5, sigma: 0.1), crop: (0, 0, 10, 10)),
        budget: (seconds: 0.1),
        camera: {"PerspectiveCamera": (hfov_deg: 40)},
        overrides: {"entities.m.Conductor": (alpha: 0.1, eta: (1, 2, 3), k: 2)},
    )"#;
    let sets = [
        "entities.m.Conductor.alpha=0.2",
        "sampler.seed=18446744073709551615",
    ];
    let got = load(&[("c.ron", config), ("a.scene.ron", SCENE)], &sets).clean();
    let resolved = resolved_config(&got.world);
    assert_eq!(
        resolved,
        r#"(
    scene: "a.scene.ron",
    camera: {"PerspectiveCamera": (hfov_deg: 40)},
    integrator: Direct(strategy: Light, lights: 0),
    film: (width: Some(200), height: Some(100), filter: Gaussian(radius: 1.5, sigma: 0.1), crop: Some((0, 0, 10, 10)), layers: [], precision: Float, clamp: None),
    sampler: (kind: Sobol, seed: 18446744073709551615, replicas: 2),
    budget: (samples: None, seconds: Some(0.1), target_error: None, pass_samples: None),
    adaptive: (rule: Off, tolerance: 0.05, confidence: 0.95, batch: 32, min_samples: 64, block: 4, floor: 0.0),
    post: (exposure: 0.0, tone_map: Srgb),
    compile: (accel: Balanced, light_selection: Spatial),
    overrides: {"entities.m.Conductor.eta": (1, 2, 3), "entities.m.Conductor.k": 2, "entities.m.Conductor.alpha": 0.2},
)
"#
    );
    let again = load(&[("r.ron", &resolved), ("a.scene.ron", SCENE)], &[]).clean();
    assert_eq!(resolved_config(&again.world), resolved);
}

#[test]
fn the_hash_is_that_of_the_literature_and_tells_settings_apart() {
    // Test vectors of the draft of FNV (Fowler, Noll, Vo, Eastlake).
    assert_eq!(config_hash(""), "cbf29ce484222325");
    assert_eq!(config_hash("a"), "af63dc4c8601ec8c");
    assert_eq!(config_hash("foobar"), "85944171f73967e8");
    let hash = |sets: &[&str]| {
        let got = load(&[("a.scene.ron", SCENE)], sets).clean();
        // The folder is a new one each time.
        let text = resolved_config(&got.world);
        config_hash(&text[text.find("integrator").expect("a field")..])
    };
    assert_eq!(hash(&[]), hash(&[]));
    assert_ne!(hash(&[]), hash(&["sampler.seed=1"]));
    assert_ne!(hash(&[]), hash(&["entities.m.Conductor.alpha=0.9"]));
    assert_eq!(
        hash(&["film.width=200"]),
        hash(&[]),
        "what the scene says already"
    );
}
