//! Clamped films: what is cut off, and that it is counted.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use glam::{DVec3, Vec3};
use sr_film::{
    AdaptiveSpec, ClampReport, Film, FilmError, FilmSpec, Reject, StoppingRule, VarianceEstimator,
};
use sr_math::color::LUMINANCE_WEIGHTS;
use sr_math::hash;

const SAMPLES: u64 = 200;

/// Values from 10⁻³ to 10³.
fn sample(x: u32, y: u32, index: u64) -> Vec3 {
    let u = |c| hash::unit_f32(hash::mix(hash::mix(x, y), hash::mix(index as u32, c)));
    Vec3::new(u(0), u(1), u(2)).map(|v| 10f32.powf(6.0 * v - 3.0))
}

fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(LUMINANCE_WEIGHTS.as_dvec3())
}

fn film(clamp: Option<f32>) -> Film {
    Film::new(FilmSpec {
        clamp,
        ..FilmSpec::of_size(19, 5)
    })
    .unwrap()
}

fn add(film: &mut Film, samples: std::ops::Range<u64>, of: impl Fn(Vec3) -> Vec3) {
    for tile in film.tiles_mut() {
        for p in 0..tile.pixel_count() {
            let (x, y) = tile.pixel(p);
            for i in samples.clone() {
                tile.add(p, i, of(sample(x, y, i))).unwrap();
            }
        }
    }
}

/// Scaling by hand, where nothing can underflow.
fn scaled(rgb: Vec3, limit: f32) -> Vec3 {
    let factor = f64::from(limit) / f64::from(rgb.max_element());
    if factor < 1.0 {
        (rgb.as_dvec3() * factor).as_vec3()
    } else {
        rgb
    }
}

#[test]
fn a_clamped_film_is_a_film_of_scaled_samples_variance_included() {
    let mut clamped = film(Some(10.0));
    add(&mut clamped, 0..SAMPLES, |v| v);
    let mut by_hand = film(None);
    add(&mut by_hand, 0..SAMPLES, |v| scaled(v, 10.0));
    for estimator in [VarianceEstimator::Samples, VarianceEstimator::Replicas] {
        assert_eq!(clamped.resolve(estimator), by_hand.resolve(estimator));
    }
    assert_eq!(by_hand.clamp_report(), None);
}

#[test]
fn a_clamp_that_nothing_reaches_changes_no_bit() {
    let mut high = film(Some(1001.0));
    add(&mut high, 0..SAMPLES, |v| v);
    let mut none = film(None);
    add(&mut none, 0..SAMPLES, |v| v);
    let estimator = VarianceEstimator::Replicas;
    assert_eq!(high.resolve(estimator), none.resolve(estimator));
    let report = high.clamp_report().unwrap();
    assert_eq!((report.clamped, report.removed_share()), (0, 0.0));
}

#[test]
fn what_is_cut_off_is_counted_whatever_the_passes() {
    let reports: Vec<ClampReport> = [200, 64, 7]
        .into_iter()
        .map(|pass| {
            let mut film = film(Some(10.0));
            for first in (0..SAMPLES).step_by(pass) {
                add(&mut film, first..(first + pass as u64).min(SAMPLES), |v| v);
            }
            film.clamp_report().unwrap()
        })
        .collect();
    assert!(reports.iter().all(|r| *r == reports[0]), "{reports:?}");

    let all = (0..5).flat_map(|y| (0..19).flat_map(move |x| (0..SAMPLES).map(move |i| (x, y, i))));
    let (mut count, mut kept, mut removed) = (0, 0.0, 0.0);
    for (x, y, i) in all {
        let (whole, added) = (sample(x, y, i), scaled(sample(x, y, i), 10.0));
        count += u64::from(whole != added);
        kept += luminance(added.as_dvec3()) / SAMPLES as f64;
        removed += luminance(whole.as_dvec3() - added.as_dvec3()) / SAMPLES as f64;
    }
    let report = reports[0];
    assert_eq!(report.clamped, count);
    // Sums of 19000 terms in double precision; the picture is in single precision.
    let close = |a: f64, b: f64| (a - b).abs() < f64::from(f32::EPSILON) * b;
    assert!(close(report.kept, kept) && close(report.removed, removed));
    assert!(close(report.removed_share(), removed / (kept + removed)));
}

#[test]
fn samples_that_are_refused_are_not_clamped_into_being() {
    let mut film = film(Some(1.0));
    let tile = &mut film.tiles_mut()[0];
    let bad = [
        (Vec3::splat(f32::INFINITY), Reject::NonFinite),
        (Vec3::new(f32::NAN, 5.0, 0.0), Reject::NonFinite),
        (Vec3::new(5.0, -1.0, 0.0), Reject::Negative),
    ];
    for (rgb, cause) in bad {
        assert_eq!(tile.add(0, 0, rgb), Err(cause));
    }
    assert_eq!(film.clamp_report(), Some(ClampReport::default()));
}

/// Decisions see what is added, so that they do not chase fireflies that the picture has not; what is
/// left out of the mean is left out of the figures.
#[test]
fn adaptive_sampling_sees_clamped_samples() {
    let adaptive = |clamp| {
        let spec = FilmSpec {
            replicas: 4,
            clamp,
            adaptive: Some(AdaptiveSpec {
                rule: StoppingRule::Folds,
                block: 1,
            }),
            ..FilmSpec::of_size(19, 5)
        };
        let mut film = Film::new(spec).unwrap();
        for batch in 0..8u64 {
            for tile in film.tiles_mut() {
                for p in tile.active_pixels() {
                    let (x, y) = tile.pixel(p);
                    for i in 64 * batch..64 * (batch + 1) {
                        tile.add(p, i, sample(x, y, i)).unwrap();
                    }
                }
                tile.decide(&sr_film::Criterion {
                    tolerance: 0.2,
                    floor: 0.0,
                    estimator: VarianceEstimator::Samples,
                    quantile: &|_| 2.0,
                });
            }
        }
        film
    };
    let (none, clamped) = (adaptive(None), adaptive(Some(1.0)));
    assert!(clamped.sample_count() < none.sample_count() / 2);
    let report = clamped.clamp_report().unwrap();
    let used = clamped.adaptive_report().unwrap().used;
    assert!(report.clamped > used / 4 && report.clamped < used);
    // The light of the picture, and with what is missing that of the samples.
    let picture = clamped.resolve(VarianceEstimator::Samples).rgb;
    let light: f64 = picture.pixels.iter().map(|p| luminance(p.as_dvec3())).sum();
    assert_eq!(report.kept, light);
}

#[test]
fn splats_are_clamped_and_counted_in_any_order() {
    let spec = FilmSpec {
        splats: true,
        clamp: Some(10.0),
        ..FilmSpec::of_size(4, 4)
    };
    let all: Vec<(u32, u32, u64)> = (0..4)
        .flat_map(|y| (0..4).flat_map(move |x| (0..SAMPLES).map(move |i| (x, y, i))))
        .collect();
    let render = |order: &mut dyn Iterator<Item = &(u32, u32, u64)>, huge: f32| {
        let mut film = Film::new(spec.clone()).unwrap();
        for &(x, y, i) in order {
            film.splat(x, y, i, sample(x, y, i)).unwrap();
        }
        // Past the range of splats, but for the clamp; outside the crop nothing is counted.
        film.splat(1, 1, 0, Vec3::splat(huge)).unwrap();
        film.splat(9, 9, 0, Vec3::splat(huge)).unwrap();
        film.add_splat_samples(0..SAMPLES);
        (
            film.resolve(VarianceEstimator::Replicas),
            film.clamp_report().unwrap(),
        )
    };
    let (picture, report) = render(&mut all.iter(), 20.0);
    assert_eq!(
        (picture.clone(), report),
        render(&mut all.iter().rev(), 20.0)
    );
    let bright = all
        .iter()
        .filter(|&&(x, y, i)| sample(x, y, i).max_element() > 10.0);
    assert_eq!(report.clamped, bright.count() as u64 + 1);
    let light: f64 = picture
        .rgb
        .pixels
        .iter()
        .map(|p| luminance(p.as_dvec3()))
        .sum();
    assert_eq!(report.kept, light);
    let lost: f64 = all
        .iter()
        .map(|&(x, y, i)| {
            let whole = sample(x, y, i);
            luminance(whole.as_dvec3() - scaled(whole, 10.0).as_dvec3())
        })
        .sum::<f64>()
        + 10.0;
    assert!((report.removed * SAMPLES as f64 / lost - 1.0).abs() < 1e-6);
    // The same picture, and figures that are numbers, at the end of the range.
    let (same, report) = render(&mut all.iter(), f32::MAX);
    assert_eq!(same, picture);
    assert!(report.removed.is_finite() && report.removed_share() > 0.99);
}

#[test]
fn a_limit_is_finite_and_above_0() {
    for limit in [0.0, -1.0, f32::INFINITY, f32::NAN] {
        let spec = FilmSpec {
            clamp: Some(limit),
            ..FilmSpec::of_size(1, 1)
        };
        let Err(FilmError::BadClamp(named)) = Film::new(spec) else {
            panic!("{limit} is a clamp");
        };
        assert_eq!(named.to_bits(), limit.to_bits());
    }
}
