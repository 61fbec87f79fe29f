//! The examination of one scene: what it says is right where that is known, and finds what is put in.

use sr_pipeline::Pipeline;
use sr_pipeline::replay::SampleId;
use sr_stability::health::{Condition, Examination, Finding, Health, Kind, examine};
use sr_stability::{Bench, Effort};
use sr_tests::Scene;

/// A closed sphere of albedo 0.9 that glows, seen from inside: after k bounces there is 0.9^k of the light.
const SPHERE: &str = r#"(
    film: (width: 12, height: 8),
    entities: {
        "wall": {"Lambert": (reflectance: 0.9), "Emission": (radiance: 1, two_sided: true)},
        "sphere": {"Sphere": (radius: 1), "MaterialRef": "wall"},
        "eye": {"PerspectiveCamera": (), "LookAt": (from: (0, 0, 0.5), to: (0, 0, 0)), "ActiveCamera": ()},
    },
)"#;

/// A lamp behind a glass ball, and the floor before it, where the ball throws the light.
const CAUSTIC: &str = r#"(
    film: (width: 96, height: 72),
    entities: {
        "grey": {"Lambert": (reflectance: 0.6)},
        "glass": {"Dielectric": ()},
        "glow": {"Lambert": (reflectance: 0), "Emission": (radiance: 20)},
        "floor": {"Quad": (width: 4, height: 4), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "grey"},
        "lamp": {"Sphere": (radius: 0.1), "LocalTransform": (translate: (0, 1.5, -2.5)), "MaterialRef": "glow"},
        "ball": {"Sphere": (radius: 0.5), "LocalTransform": (translate: (0, 0.5, 0)), "MaterialRef": "glass"},
        "eye": {"PerspectiveCamera": (hfov_deg: 45), "LookAt": (from: (0, 1.5, 4), to: (0, 0.5, 0)), "ActiveCamera": ()},
    },
)"#;

fn of(pipeline: &mut Pipeline) -> Health {
    let host = Bench::new(0);
    let how = Examination {
        effort: Effort::default(),
        oracle: false,
        replay: &|id: SampleId| format!("replay {id}"),
        host: &host,
    };
    examine(pipeline, &how).unwrap_or_else(|e| panic!("{e:?}: {:?}", host.told()))
}

fn examined(threads: usize, scene: &str, set: &[(&str, &str)]) -> Health {
    let scene = Bench::new(threads).scene(scene, set);
    of(&mut scene.unwrap_or_else(|e| panic!("{e}")))
}

fn finding<'a>(health: &'a Health, name: &str) -> &'a Finding {
    let found = health.findings.iter().find(|f| f.name == name);
    found.unwrap_or_else(|| panic!("no `{name}` in {:?}", health.findings))
}

fn assert_near(found: f64, wanted: f64, relative: f64, what: &str) {
    let near = (found - wanted).abs() <= relative * wanted;
    assert!(near, "{what}: {found}, should be {wanted}");
}

/// In the closed sphere everything is known: no sample differs from another, so the tolerances are those of sums of
/// `f32`.
#[test]
fn what_a_limit_of_bounces_cuts_off_is_known_in_a_closed_sphere() {
    for integrator in ["PathBsdf", "Path"] {
        let cut = format!("{integrator}(max_depth: 8, roulette_from: None)");
        let health = examined(0, SPHERE, &[("integrator", &cut)]);
        let paths = health.paths.as_ref().unwrap();
        assert_eq!(paths.max_depth, Some(8));
        assert_near(paths.missing.unwrap(), 0.9f64.powi(9), 1e-4, "missing");
        let ends: f64 = paths.ends.iter().map(|e| e.throughput).sum();
        assert_near(ends, 0.9f64.powi(8), 1e-4, "throughput");
        let here = (1.0 - 0.9f64.powi(9)) / 0.1;
        for (k, light) in paths.light.iter().enumerate() {
            let wanted = 0.9f64.powi(k as i32) / here;
            assert_near(light.share, wanted, 1e-4, &format!("light {k}"));
        }
        assert_near(health.mean, here, 1e-5, "mean");
        assert_eq!(finding(&health, "depth").condition, Condition::Look);
    }
    // Deep enough: 0.9^201 is nothing.
    let deep = "PathBsdf(max_depth: 200, roulette_from: None)";
    let health = examined(0, SPHERE, &[("integrator", deep)]);
    assert_eq!(health.kurtosis.pixels, 0, "there is no noise");
    assert_eq!(finding(&health, "depth").condition, Condition::Ok);
    assert_eq!(health.condition(), Condition::Ok, "{:?}", health.findings);
}

#[test]
fn fireflies_are_found_and_named_by_what_makes_them() {
    let floor = ("film.crop", "(20, 52, 76, 72)");
    let health = examined(0, CAUSTIC, &[floor]);
    let brightest = finding(&health, "brightest");
    assert_eq!(brightest.condition, Condition::Look, "{brightest:?}");
    for part in ["fireflies", "caustics, thrown by `glass`"] {
        assert!(brightest.text.contains(part), "{brightest:?}");
    }
    let worst = &health.brightest.worst;
    assert_eq!(worst.len(), 10);
    assert!(worst.is_sorted_by(|a, b| a.luminance >= b.luminance));
    let first = &worst[0];
    assert_eq!(first.kind, Some(Kind::Caustic), "{first:?}");
    assert!(
        first.route.as_ref().unwrap().starts_with("camera → "),
        "{first:?}"
    );
    assert_eq!(first.replay, Some(format!("replay {}", first.example)));
    assert_eq!(finding(&health, "kurtosis").condition, Condition::Look);
    // A grey ball throws nothing.
    let plain = CAUSTIC.replace("\"MaterialRef\": \"glass\"", "\"MaterialRef\": \"grey\"");
    let health = examined(0, &plain, &[floor]);
    assert_eq!(finding(&health, "brightest").condition, Condition::Ok);
}

#[test]
fn an_examination_does_not_depend_on_threads() {
    let told = |threads| {
        let mut health = examined(threads, CAUSTIC, &[("film.crop", "(3, 50, 95, 67)")]);
        health.seconds = 0.0;
        let map: Vec<u32> = health.map.values.iter().map(|v| v.to_bits()).collect();
        (serde_json::to_string(&health).unwrap(), map)
    };
    let one = told(1);
    assert!(told(2) == one && told(7) == one);
}

#[test]
fn a_large_picture_is_looked_at_in_steps_and_light_that_overflows_is_broken() {
    let large = [("film.width", "4000"), ("film.height", "3000")];
    let health = examined(0, SPHERE, &[large[0], large[1], ("integrator", "Aov()")]);
    assert!(health.step > 1 && health.pixels * health.samples <= 1 << 22);
    let radiance = ("entities.wall.Emission.radiance", "3e38");
    let health = examined(
        0,
        SPHERE,
        &[radiance, ("integrator", "PathBsdf(max_depth: 3)")],
    );
    let rejected = finding(&health, "rejected");
    assert_eq!(rejected.condition, Condition::Broken);
    assert_eq!(health.rejected.count, health.pixels * health.samples);
    let kind = &health.rejected.kinds[0];
    assert_eq!((kind.bounces, kind.material.as_deref()), (3, Some("wall")));
    assert_eq!(kind.example, "0,0,0");
    assert_eq!(finding(&health, "light").condition, Condition::Look);
}

/// A light tracer brings systems of its own and no tracer: what is looked at are passes of one sample.
#[test]
fn integrators_without_a_tracer_are_looked_at_pass_by_pass() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lamp.scene.ron");
    std::fs::write(&path, CAUSTIC).unwrap();
    let mut scene = Scene::load(&path, &[("integrator", "LightTracer(max_depth: 4)")]);
    let health = of(scene.pipeline());
    assert!(health.paths.is_none() && health.mean > 0.0, "{health:?}");
    assert_eq!(health.left_out.len(), 2, "{:?}", health.left_out);
    assert!(
        health.left_out[0].contains("LightTracer"),
        "{:?}",
        health.left_out
    );
    assert!(health.brightest.worst.iter().all(|b| b.replay.is_none()));
    assert_eq!(finding(&health, "rejected").condition, Condition::Ok);
}
