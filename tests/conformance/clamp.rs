//! A biased method is found out: by its pictures, by its curve.

use crate::convergence::{SMOOTH, cornell, error_curves, smooth_reference};
use sr_experiment::mse;
use sr_experiment::same::{Answer, Settings, Verdict, same};
use sr_experiment::stats::{Flattening, slope};
use sr_pipeline::film_kernel::Image;
use sr_scene::settings::FilmSettings;
use sr_tests::{Scene, repository};

/// The box with a mirror and a glass sphere, of which the caustic and the lamp have bright samples.
fn spheres() -> Scene {
    let path = repository().join("scenes/cornell_spheres/cornell_spheres.scene.ron");
    Scene::load(
        &path,
        &[
            ("integrator", "Path(max_depth: 6)"),
            ("film.width", "64"),
            ("film.height", "48"),
            // Below the lamp, which any clamp would dim.
            ("film.crop", "(0, 16, 64, 48)"),
        ],
    )
}

/// Pictures of four seeds at 32 samples: what an experiment of seconds has.
fn pictures(scene: &mut Scene, clamp: Option<f32>, first_seed: u64) -> (Vec<Image>, f64) {
    scene.world().resource_mut::<FilmSettings>().clamp = clamp;
    let mut removed = 0.0;
    let images = (0..4)
        .map(|seed| {
            let rendered = scene.render(32, first_seed + seed);
            removed = rendered.clamp.map_or(0.0, |c| c.removed_share());
            rendered.image.rgb
        })
        .collect();
    (images, removed)
}

fn judged(what: &str, a: &[Image], b: &[Image]) -> Verdict {
    let verdict = same(a, b, &Settings::default()).unwrap_or_else(|e| panic!("{what}: {e}"));
    eprintln!(
        "{what}: {:?}, p of tiles {:.1e}, distribution {:.1e}, mean {:.1e}",
        verdict.answer, verdict.tiles.p_value, verdict.distribution.p_value, verdict.mean.p_value
    );
    verdict
}

/// The verdict of four against four pictures has a false-alarm rate of 1 %. At 32 samples a pixel a tile's
/// standard error is 3 % of the mean, the picture's 0.7 %: a bias of 4 % everywhere would be seen, and in
/// one tile one of 40 %. A clamp at 5 takes 9 % of the light, all of it where mirror and glass bring the lamp.
#[test]
fn a_clamped_render_is_called_different_and_an_unclamped_one_is_not() {
    let mut scene = spheres();
    let (plain, _) = pictures(&mut scene, None, 0);
    let (other, _) = pictures(&mut scene, None, 100);
    let (clamped, removed) = pictures(&mut scene, Some(5.0), 200);
    eprintln!(
        "clamp at 5: {:.2} % of the light is missing",
        100.0 * removed
    );
    let verdict = judged("unclamped", &plain, &other);
    assert_eq!(verdict.answer, Answer::Same, "{verdict:?}");
    let verdict = judged("clamped", &clamped, &plain);
    assert_eq!(verdict.answer, Answer::Different, "{verdict:?}");
    assert!(!verdict.mean.passed, "{verdict:?}");
    // It is too dark, about by what the film says (by luminance there, by channel here).
    for channel in &verdict.mean_difference {
        let missing = -channel.difference / channel.b;
        assert!(
            missing > 0.5 * removed && missing < 2.0 * removed,
            "{channel:?}"
        );
    }
}

/// Uniform directions find the lamp in few cases, each of which is bright: clamped, the error falls
/// like 1/n until the missing light is all of it. Without a clamp it goes on. A false alarm of the flag
/// has a rate below 1 %; what is found has p < 10⁻³.
#[test]
fn the_curve_of_a_clamped_render_flattens_and_is_flagged() {
    let reference = smooth_reference();
    let independent = [SMOOTH.as_slice(), &[("sampler.kind", "Independent")]].concat();
    let mut scene = cornell("Direct(strategy: Hemisphere)", &independent);
    let mut flattening = |clamp: Option<f32>| -> Flattening {
        scene.world().resource_mut::<FilmSettings>().clamp = clamp;
        let runs = error_curves(&mut scene, (mse, &reference), 2..=10, 4);
        let found = slope(&runs).unwrap_or_else(|e| panic!("{e}"));
        let flattening = found.flattening.expect("there are enough points");
        eprintln!(
            "clamp {clamp:?}: slope {:.2}, from {:.2} to {:.2}, p {:.1e}",
            found.slope, flattening.early, flattening.late, flattening.p_value
        );
        flattening
    };
    let (plain, clamped) = (flattening(None), flattening(Some(4.0)));
    assert!(!plain.found && (plain.late + 1.0).abs() < 0.1, "{plain:?}");
    assert!(clamped.found && clamped.p_value < 1e-3, "{clamped:?}");
}
