//! Whether the estimated variances are the true ones.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use glam::{DVec3, Vec3};
use sr_film::{Film, FilmImage, FilmSpec, Image, Rect, VarianceEstimator};
use sr_math::hash;

/// Uniform in [0, 1), distinct for each pixel, sample and channel.
fn uniform(x: u32, y: u32, sample: u64, channel: u32) -> f32 {
    hash::unit_f32(hash::mix(
        hash::mix(x, y),
        hash::mix(sample as u32, channel),
    ))
}

/// A film of 128 × 128 pixels, each with the samples that `value` gives.
fn film(replicas: u32, samples: u64, value: impl Fn(u32, u32, u64) -> Option<Vec3>) -> Film {
    let mut film = Film::new(FilmSpec {
        replicas,
        ..FilmSpec::of_size(128, 128)
    })
    .unwrap();
    for tile in film.tiles_mut() {
        for p in 0..tile.pixel_count() {
            let (x, y) = tile.pixel(p);
            for i in 0..samples {
                if let Some(rgb) = value(x, y, i) {
                    tile.add(p, i, rgb).unwrap();
                }
            }
        }
    }
    film
}

/// Mean of the estimates against the truth, in standard errors of that mean. The 49152 estimates
/// (pixels, channels) are independent: at 6σ a false alarm has a chance of 2·10⁻⁹.
fn check_unbiased(image: &FilmImage, truth: f64, what: &str) {
    let estimates = || {
        let pixels = image.variance_of_mean.pixels.iter();
        pixels.flat_map(|v| v.as_dvec3().to_array())
    };
    let n = estimates().count() as f64;
    let mean = estimates().sum::<f64>() / n;
    let spread = estimates().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let error = (spread / n).sqrt();
    // What the test can see: 6 standard errors are at most this part of the truth.
    assert!(6.0 * error < 0.07 * truth, "{what}: {error} for {truth}");
    let z = (mean - truth) / error;
    assert!(z.abs() < 6.0, "{what}: {mean}, not {truth} (z = {z})");
}

fn exponential(x: u32, y: u32, sample: u64) -> Vec3 {
    let value = |c| -(1.0 - uniform(x, y, sample, c)).ln();
    Vec3::new(value(0), value(1), value(2))
}

/// Exponential samples: variance 1, and fourth moment 9, far from Gaussian. Sees a bias of 7 %.
#[test]
fn both_estimators_are_unbiased_for_independent_samples() {
    for (replicas, samples) in [(2, 16), (4, 16), (16, 64), (2, 2)] {
        let film = film(replicas, samples, |x, y, i| Some(exponential(x, y, i)));
        for estimator in [VarianceEstimator::Samples, VarianceEstimator::Replicas] {
            let image = film.resolve(estimator);
            let what = format!("{estimator:?} of {samples} samples in {replicas} replicas");
            check_unbiased(&image, 1.0 / samples as f64, &what);
        }
    }
}

/// As above when replicas have different numbers of samples: weights must be right, too.
#[test]
fn estimators_are_unbiased_when_replicas_are_uneven() {
    // Replicas of 7, 6, 6 and 6 samples; then of 13, 0, 1 and 13 of 52.
    let odd = film(4, 25, |x, y, i| Some(exponential(x, y, i)));
    let kept = |i: u64| match i % 4 {
        1 => false,
        2 => i == 2,
        _ => true,
    };
    let rejected = film(4, 52, |x, y, i| kept(i).then(|| exponential(x, y, i)));
    for (film, n) in [(odd, 25.0), (rejected, 27.0)] {
        for estimator in [VarianceEstimator::Samples, VarianceEstimator::Replicas] {
            let what = format!("{estimator:?} of {n}");
            check_unbiased(&film.resolve(estimator), 1.0 / n, &what);
        }
    }
}

/// Each replica stratified on its own: its mean of 8 samples has variance 1/(12·8³). The spread of
/// replicas sees that (to 7 %); the sum of squares believes 1/(12·16).
#[test]
fn replicas_are_honest_where_samples_are_not_independent() {
    let film = film(2, 16, |x, y, i| {
        let stratum = (i / 2) as f32;
        let value = |c| (stratum + uniform(x, y, i, c)) / 8.0;
        Some(Vec3::new(value(0), value(1), value(2)))
    });
    let truth = 1.0 / (12.0 * 512.0) / 2.0;
    check_unbiased(
        &film.resolve(VarianceEstimator::Replicas),
        truth,
        "stratified",
    );
    let squares = film.resolve(VarianceEstimator::Samples);
    let claimed = squares.variance_of_mean.pixels[0].x;
    assert!(f64::from(claimed) > 20.0 * truth);
}

#[test]
fn variance_is_infinite_where_nothing_is_known() {
    let one = film(2, 1, |x, y, i| Some(exponential(x, y, i)));
    let none = film(2, 0, |_, _, _| None);
    let no_replicas = film(1, 4, |x, y, i| Some(exponential(x, y, i)));
    for (film, estimator) in [
        (&one, VarianceEstimator::Samples),
        (&one, VarianceEstimator::Replicas),
        (&none, VarianceEstimator::Samples),
        (&none, VarianceEstimator::Replicas),
        (&no_replicas, VarianceEstimator::Replicas),
    ] {
        let image = film.resolve(estimator);
        assert_eq!(image.variance_of_mean.pixels[0], Vec3::INFINITY);
        assert_eq!(image.error_estimate(), None);
        assert!(image.rgb.pixels[0].is_finite());
    }
}

/// Two blocks of 8 × 8: variances and means chosen by hand, one pixel unknown.
#[test]
fn error_estimate_is_its_formula() {
    let mut image = Film::new(FilmSpec::of_size(16, 8))
        .unwrap()
        .resolve(VarianceEstimator::Samples);
    image.rgb = Image::filled(16, 8, Vec3::new(0.0, 0.3, 0.7));
    for y in 0..8 {
        for x in 0..16 {
            let v = if x < 8 { 0.01 } else { 0.03 };
            image.variance_of_mean.pixels[y * 16 + x] = Vec3::new(v, 10.0 * v, 0.0);
        }
    }
    let e = image.error_estimate().unwrap();
    // Left (0.01/0.01 + 0.1/0.1 + 0)/3 = 2/3, right three times that.
    assert!((e.mse - 0.22 / 3.0).abs() < 1e-8);
    assert!((e.relmse - 4.0 / 3.0).abs() < 1e-6);
    // Two block means 2/3 off: √(Σ w d² / (K − 1)) = 2/3.
    assert!((e.relmse_std_error.unwrap() - 2.0 / 3.0).abs() < 1e-6);
    assert_eq!((e.pixels, e.unknown_pixels), (128, 0));

    image.variance_of_mean.pixels[0] = Vec3::INFINITY;
    let e = image.error_estimate().unwrap();
    assert!((e.relmse - (63.0 * 2.0 + 64.0 * 6.0) / 3.0 / 127.0).abs() < 1e-6);
    assert_eq!((e.pixels, e.unknown_pixels), (127, 1));
}

/// The picture's own estimate against its true error, which is known here. 16384 pixels of 32
/// samples: estimate and truth each have a relative standard error of about 1 % (√2 and √2 over
/// √49152, and the exponential's fourth moment), so 6 % is 4 to 5 σ; the plug-in bias is below 1 %.
/// The seed is fixed.
#[test]
fn error_estimate_predicts_the_true_error() {
    let film = film(2, 32, |x, y, i| Some(exponential(x, y, i)));
    let truth = film
        .resolve(VarianceEstimator::Samples)
        .rgb
        .pixels
        .iter()
        .map(|m| ((m.as_dvec3() - DVec3::ONE).powf(2.0) / 1.01).element_sum() / 3.0)
        .sum::<f64>()
        / (128.0 * 128.0);
    for estimator in [VarianceEstimator::Samples, VarianceEstimator::Replicas] {
        let e = film.resolve(estimator).error_estimate().unwrap();
        println!(
            "{estimator:?}: {} ± {:?}, true {truth}",
            e.relmse, e.relmse_std_error
        );
        assert!((e.mse / 1.01 / truth - 1.0).abs() < 0.06, "{estimator:?}");
        let off = (e.relmse - truth).abs();
        assert!(
            off < 0.15 * truth,
            "{estimator:?}: {} and {truth}",
            e.relmse
        );
        assert!(e.relmse_std_error.unwrap() < 0.05 * truth);
    }
}

#[test]
fn a_crop_of_one_block_has_no_standard_error() {
    let mut film = Film::new(FilmSpec {
        crop: Rect {
            x0: 9,
            y0: 9,
            x1: 12,
            y1: 12,
        },
        ..FilmSpec::of_size(32, 32)
    })
    .unwrap();
    for i in 0..4 {
        film.tiles_mut()[0]
            .add(0, i, Vec3::splat(i as f32))
            .unwrap();
    }
    let e = film
        .resolve(VarianceEstimator::Samples)
        .error_estimate()
        .unwrap();
    assert_eq!(
        (e.relmse_std_error, e.pixels, e.unknown_pixels),
        (None, 1, 8)
    );
}
