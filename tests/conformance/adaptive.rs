//! Adaptive sampling against known means: an integrator of this file returns noise whose mean is 1,
//! and 1024 renders of 4 × 4 pixels with seeds of their own tell whether the mean is met and how
//! often the interval holds it. A stranger's integrator, too: it knows nothing of adaptive sampling.
//!
//! Fixed seeds. Means are held to 4σ of the spread between seeds, a false alarm of 6·10⁻⁵ each; what
//! bias each would show is printed.

use sr_pipeline::accel::Ray;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::{AdaptiveReport, FilmImage, VarianceEstimator};
use sr_pipeline::prelude::*;
use sr_pipeline::settings::{
    AdaptiveRule, AdaptiveSettings, Budget, FilmSettings, SamplerName, SamplerSettings,
};
use sr_pipeline::{Pipeline, StopReason};
use sr_scene::components::{ActiveCamera, PerspectiveCamera};
use sr_stats::{normal_quantile, student_quantile};
use std::ops::ControlFlow;

/// Noise of mean 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
enum Noise {
    /// Uniform from 0 to 2.
    #[default]
    Uniform,
    /// A smooth function of four numbers: what a low-discrepancy sequence is good at.
    Smooth,
    /// 0 but for 3 % of the samples: fireflies.
    Bernoulli,
    /// u^(−0.45) · 0.55: of finite variance and infinite third moment.
    Heavy,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
struct NoiseSettings {
    noise: Noise,
}

impl Integrator for Noise {
    const NAME: &'static str = "Noise";
    const SUMMARY: &'static str = "noise of mean 1";
    const USES: SceneFeatures = SceneFeatures::TRIANGLES;
    type Settings = NoiseSettings;
}

impl RayIntegrator for Noise {
    fn prepare(settings: &NoiseSettings, _: &RenderScene) -> Result<Self, String> {
        Ok(settings.noise)
    }

    fn li<C: RayContext>(&self, _: &Ray, context: &mut C) -> Vec3 {
        let at = |depth| context.sampler().d2(Dim::bounce(depth, BounceDim::Bsdf));
        let u = at(0);
        Vec3::splat(match self {
            Self::Uniform => 2.0 * u.x,
            Self::Smooth => {
                let v = at(1);
                let product = |a: f32, b: f32| 4.0 * a * b;
                0.5 * (product(u.x, u.y) + 1.5 * (v.x * v.x + v.y * v.y))
            }
            // On no dyadic grid, which a low-discrepancy sequence would meet exactly.
            Self::Bernoulli => f32::from(u8::from(u.x < 0.03)) / 0.03,
            // The centres of the 2²⁴ cells that u lies on: its 0 is one of them.
            Self::Heavy => 0.55 * (u.x + 0.5 / 16_777_216.0).powf(-0.45),
        })
    }
}

/// Side of a picture; one block of the default size.
const SIDE: u32 = 4;
const SEEDS: u64 = 1024;

/// What many seeds came to.
struct Trial {
    mean: f64,
    /// Of the mean, from the spread between seeds.
    std_error: f64,
    /// Share of pixels whose 95 % interval holds the mean.
    coverage: f64,
    /// Estimated variance of a pixel over its true one.
    variance_ratio: f64,
    report: AdaptiveReport,
}

impl Trial {
    fn bias_in_sigma(&self) -> f64 {
        (self.mean - 1.0) / self.std_error
    }

    /// Renders, and prints what it comes to.
    fn run(noise: Noise, kind: SamplerName, adaptive: &AdaptiveSettings) -> Self {
        let mut pipeline = pipeline(noise, kind, adaptive);
        let mut trial = Self {
            mean: 0.0,
            std_error: 0.0,
            coverage: 0.0,
            variance_ratio: 0.0,
            report: AdaptiveReport::default(),
        };
        let (mut squares, mut spread, mut estimated) = (0.0, 0.0, 0.0);
        for seed in 0..SEEDS {
            let (image, report) = render(&mut pipeline, seed);
            let mut sum = 0.0;
            for i in 0..image.rgb.pixels.len() {
                let mean = f64::from(image.rgb.pixels[i].x);
                let variance = f64::from(image.variance_of_mean.pixels[i].x);
                sum += mean;
                spread += (mean - 1.0) * (mean - 1.0);
                estimated += variance;
                let half = quantile(adaptive, &image, i) * variance.sqrt();
                trial.coverage += f64::from(u8::from((mean - 1.0).abs() <= half));
            }
            let mean = sum / f64::from(SIDE * SIDE);
            trial.mean += mean;
            squares += mean * mean;
            trial.report.taken += report.taken;
            trial.report.used += report.used;
            trial.report.converged += report.converged;
            trial.report.pixels += report.pixels;
        }
        let n = SEEDS as f64;
        trial.mean /= n;
        trial.std_error = ((squares / n - trial.mean * trial.mean) / (n - 1.0)).sqrt();
        trial.coverage /= n * f64::from(SIDE * SIDE);
        trial.variance_ratio = estimated / spread;
        eprintln!(
            "{noise:?} {kind:?} {:?} block {}: mean {:.5} ± {:.5} ({:+.1}σ, 4σ is a bias of {:.2} %), \
             95 % covers {:.1} %, variance estimated/true {:.3}, {:.0} samples, {:.1} % converged, \
             {:.1} % left out",
            adaptive.rule,
            adaptive.block,
            trial.mean,
            trial.std_error,
            trial.bias_in_sigma(),
            400.0 * trial.std_error,
            100.0 * trial.coverage,
            trial.variance_ratio,
            trial.report.taken as f64 / trial.report.pixels as f64,
            100.0 * trial.report.converged as f64 / trial.report.pixels as f64,
            100.0 * trial.report.left_out(),
        );
        trial
    }
}

/// Half width of the 95 % interval in standard errors.
fn quantile(adaptive: &AdaptiveSettings, image: &FilmImage, pixel: usize) -> f64 {
    match (adaptive.rule, image.estimator) {
        (AdaptiveRule::Course, _) => normal_quantile(0.975),
        (_, VarianceEstimator::Replicas) => student_quantile(0.975, 7.0),
        (_, VarianceEstimator::Samples) => {
            student_quantile(0.975, f64::from(image.sample_count[pixel]) - 8.0)
        }
    }
}

fn pipeline(noise: Noise, kind: SamplerName, adaptive: &AdaptiveSettings) -> Pipeline {
    let mut pipeline = sr_tests::pipeline(1);
    pipeline.add_ray_integrator::<Noise>();
    let world = &mut pipeline.world;
    world.spawn((PerspectiveCamera::default(), ActiveCamera));
    world.insert_resource(FilmSettings {
        width: Some(SIDE),
        height: Some(SIDE),
        ..Default::default()
    });
    world.insert_resource(Budget {
        samples: Some(512),
        ..Default::default()
    });
    world.insert_resource(SamplerSettings {
        kind,
        replicas: 8,
        ..Default::default()
    });
    world.insert_resource(adaptive.clone());
    world.insert_resource(SelectedIntegrator {
        name: "Noise".into(),
        settings: Box::new(NoiseSettings { noise }),
    });
    pipeline.compile().unwrap_or_else(|e| panic!("{e}"));
    pipeline
}

fn render(pipeline: &mut Pipeline, seed: u64) -> (FilmImage, AdaptiveReport) {
    pipeline.world.resource_mut::<SamplerSettings>().seed = seed;
    let stop = pipeline.render(|_| ControlFlow::Continue(()));
    assert!(matches!(
        stop,
        Ok(StopReason::Converged | StopReason::Samples)
    ));
    let film = pipeline.world.resource::<FilmResource>();
    let report = film.film.adaptive_report().expect("it is adaptive");
    (film.film.resolve(film.estimator), report)
}

/// Such that the smooth noises end well after the first decision and before the budget does.
fn tolerance(noise: Noise, kind: SamplerName) -> f64 {
    match (noise, kind) {
        (Noise::Uniform | Noise::Smooth, SamplerName::Sobol) => 0.02,
        _ => 0.1,
    }
}

#[test]
fn folds_are_unbiased_whatever_the_noise() {
    for kind in [SamplerName::Independent, SamplerName::Sobol] {
        for noise in [
            Noise::Uniform,
            Noise::Smooth,
            Noise::Bernoulli,
            Noise::Heavy,
        ] {
            for block in [1, 4] {
                let adaptive = AdaptiveSettings {
                    rule: AdaptiveRule::Folds,
                    tolerance: tolerance(noise, kind),
                    block,
                    ..Default::default()
                };
                let trial = Trial::run(noise, kind, &adaptive);
                assert!(trial.bias_in_sigma().abs() < 4.0);
                // Smooth pixels keep what the interval promises.
                let smooth = matches!(noise, Noise::Uniform | Noise::Smooth);
                assert!(!smooth || trial.coverage >= 0.93);
            }
        }
    }
}

/// The same test finds the bias of a rule that looks at the samples it averages.
#[test]
fn the_courses_rule_is_biased_and_covers_less_than_it_says() {
    let course = AdaptiveSettings {
        rule: AdaptiveRule::Course,
        tolerance: 0.1,
        block: 1,
        ..Default::default()
    };
    for (noise, most_covered) in [
        (Noise::Uniform, 0.96),
        (Noise::Bernoulli, 0.7),
        (Noise::Heavy, 0.85),
    ] {
        let trial = Trial::run(noise, SamplerName::Independent, &course);
        assert!(trial.coverage < most_covered);
        assert!(trial.bias_in_sigma().abs() > 6.0);
    }
}
