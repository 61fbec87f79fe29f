//! A picture's estimate of its own error against the error itself.
//!
//! The truth is the relMSE against a long render with another seed, less what the variance of that
//! render brings into it. A diffuse scene, one with glass and a mirror, and a glossy one of rough
//! metal, each with low-discrepancy samples in two replicas and with independent ones. Fixed seeds.

use sr_experiment::{Debiased, debiased};
use sr_pipeline::film_kernel::{ErrorEstimate, FilmImage};
use sr_pipeline::settings::Budget;
use sr_stats::{MeanEstimate, sidak};
use sr_tests::{Scene, repository};
use std::collections::BTreeMap;
use std::sync::OnceLock;

const SCENES: [&str; 3] = ["cornell_boxes", "cornell_spheres", "cornell_gold"];
const SAMPLERS: [&str; 2] = ["Sobol", "Independent"];
const SEEDS: u64 = 16;
const SAMPLES: u64 = 32;

/// Probability that a family of tests fails although nothing is wrong.
const FAMILY_LEVEL: f64 = 1e-3;

/// A quick configuration at thumbnail size. Paths of six bounces differ from longer ones by nothing
/// that matters here.
fn thumbnail(name: &str, sampler: &str) -> Scene {
    let path = repository().join(format!("configs/quick/{name}.ron"));
    let overrides = [
        ("film.width", "32"),
        ("film.height", "24"),
        ("integrator.max_depth", "6"),
        ("sampler.kind", sampler),
    ];
    Scene::load(&path, &overrides)
}

/// The long render of a scene.
fn reference(name: &str) -> &'static FilmImage {
    static ALL: OnceLock<BTreeMap<&str, FilmImage>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let render = |name| thumbnail(name, "Sobol").render(2048, 1_000_003).image;
        SCENES.into_iter().map(|n| (n, render(n))).collect()
    });
    &all[name]
}

/// What the estimate may be off on average, at this many samples, where light comes as fireflies. The
/// plain plug-in is off by half to four fifths in these scenes.
const BIAS: f64 = 0.15;

/// What a picture says of its relMSE, and what that is.
struct Pair {
    said: ErrorEstimate,
    is: f64,
}

fn pair(image: &FilmImage, reference: &FilmImage) -> Pair {
    let known = debiased(&image.rgb, &reference.rgb, &reference.variance_of_mean);
    let Debiased {
        relmse,
        reference_relmse,
        ..
    } = known.expect("the pictures have one size");
    // Else the truth would be made of noise.
    assert!(
        reference_relmse < 0.15 * relmse,
        "{reference_relmse} of {relmse}"
    );
    Pair {
        said: image.error_estimate().expect("there are samples"),
        is: relmse,
    }
}

/// Over sixteen seeds the mean of the estimates is that of the errors, up to the bias that is stated
/// (Student's t of the differences). Of single estimates at least five of six have the expected error
/// within two of their own standard errors; 95 % is what is promised, and of 96 estimates 15 off
/// would have a chance of 10⁻⁴.
#[test]
fn the_estimate_is_the_error_within_its_interval() {
    let level = sidak(FAMILY_LEVEL, SCENES.len() * SAMPLERS.len());
    let (mut off, mut all) = (0, 0);
    for name in SCENES {
        for sampler in SAMPLERS {
            let mut scene = thumbnail(name, sampler);
            let pairs: Vec<Pair> = (0..SEEDS)
                .map(|seed| pair(&scene.render(SAMPLES, seed).image, reference(name)))
                .collect();
            let truth = MeanEstimate::of(pairs.iter().map(|p| p.is));
            let said = MeanEstimate::of(pairs.iter().map(|p| p.said.relmse));
            let differences = MeanEstimate::of(pairs.iter().map(|p| p.said.relmse - p.is));
            let half_width = differences.half_width(1.0 - level);
            let claimed = |p: &Pair| p.said.relmse_std_error.expect("there are blocks");
            let outside = pairs.iter().filter(|p| {
                let spread = claimed(p).hypot(truth.variance.sqrt());
                (p.said.relmse - truth.mean).abs() > 2.0 * spread
            });
            let outside = outside.count();
            let mean_claim = pairs.iter().map(claimed).sum::<f64>() / pairs.len() as f64;
            let spread = (said.variance * pairs.len() as f64).sqrt();
            eprintln!(
                "{name} {sampler}: relMSE {:.2e}, estimated {:+.1} %, seen from {:.1} % on; standard \
                 error of one {:.1} %, claimed {:.1} %; {outside} of {} outside",
                truth.mean,
                100.0 * differences.mean / truth.mean,
                100.0 * half_width / truth.mean,
                100.0 * spread / truth.mean,
                100.0 * mean_claim / truth.mean,
                pairs.len(),
            );
            assert!(
                half_width < 0.3 * truth.mean,
                "{name} {sampler} tells nothing"
            );
            assert!(
                differences.mean.abs() < half_width + BIAS * truth.mean,
                "{name} {sampler}: {} of {}",
                differences.mean,
                truth.mean
            );
            off += outside;
            all += pairs.len();
        }
    }
    assert!(off < 15, "{off} of {all}");
}

/// What `--target-error` promises, seed by seed and on average.
#[test]
fn a_target_error_is_what_the_picture_has() {
    const TARGET: f64 = 0.01;
    for name in SCENES {
        for sampler in SAMPLERS {
            let mut scene = thumbnail(name, sampler);
            scene.world().insert_resource(Budget {
                target_error: Some(TARGET),
                ..Default::default()
            });
            let most = 1 << 16;
            let errors: Vec<(f64, u64)> = (100..100 + SEEDS)
                .map(|seed| {
                    let rendered = scene.render(most, seed);
                    assert!(rendered.report.samples_per_pixel < most);
                    let pair = pair(&rendered.image, reference(name));
                    assert!(pair.said.relmse <= TARGET);
                    (pair.is, rendered.report.samples_per_pixel)
                })
                .collect();
            let is = MeanEstimate::of(errors.iter().map(|e| e.0 / TARGET));
            let samples = errors.iter().map(|e| e.1 as f64).sum::<f64>() / errors.len() as f64;
            eprintln!(
                "{name} {sampler}: relMSE {:.3} ± {:.3} of the target after {samples:.0} samples",
                is.mean,
                is.variance.sqrt(),
            );
            assert!((is.mean - 1.0).abs() < 0.15, "{name} {sampler}");
        }
    }
}
