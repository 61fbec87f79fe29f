//! Splats: sums that depend on nothing but the splats.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use glam::Vec3;
use sr_film::{
    Film, FilmImage, FilmSpec, Rect, Reject, SPLAT_LIMIT, SPLAT_RESOLUTION, VarianceEstimator,
};
use sr_math::hash;

fn splatting(width: u32, height: u32) -> FilmSpec {
    FilmSpec {
        splats: true,
        ..FilmSpec::of_size(width, height)
    }
}

type Splat = (u32, u32, u64, Vec3);

/// Splats of sizes from 10⁻⁶ to 10⁶.
fn splats(count: u32, samples: u32) -> Vec<Splat> {
    let unit = |i, k| hash::unit_f32(hash::mix(i, k));
    let value = |i, k| 10f32.powf(12.0 * unit(i, k) - 6.0);
    (0..count)
        .map(|i| {
            let x = (unit(i, 0) * 4.0) as u32;
            let y = (unit(i, 1) * 4.0) as u32;
            let sample = u64::from((unit(i, 2) * samples as f32) as u32);
            (
                x,
                y,
                sample,
                Vec3::new(value(i, 3), value(i, 4), value(i, 5)),
            )
        })
        .collect()
}

fn resolve(spec: FilmSpec, splats: &[Splat], samples: u64, threads: usize) -> FilmImage {
    let mut film = Film::new(spec).unwrap();
    std::thread::scope(|scope| {
        for part in splats.chunks(splats.len().div_ceil(threads)) {
            let film = &film;
            scope.spawn(move || {
                for &(x, y, sample, rgb) in part {
                    film.splat(x, y, sample, rgb).unwrap();
                }
            });
        }
    });
    film.add_splat_samples(0..samples);
    film.resolve(VarianceEstimator::Replicas)
}

#[test]
fn order_and_threads_do_not_matter() {
    let mut splats = splats(100_000, 64);
    let first = resolve(splatting(4, 4), &splats, 64, 1);
    splats.reverse();
    assert_eq!(first, resolve(splatting(4, 4), &splats, 64, 1));
    // Fisher and Yates.
    for i in (1..splats.len()).rev() {
        splats.swap(i, hash::mix(7, i as u32) as usize % (i + 1));
    }
    for threads in [1, 2, 7] {
        assert_eq!(first, resolve(splatting(4, 4), &splats, 64, threads));
    }
}

#[test]
fn a_crop_keeps_its_pixels_and_drops_the_rest() {
    let splats = splats(10_000, 64);
    let whole = resolve(splatting(4, 4), &splats, 64, 1);
    let spec = FilmSpec {
        crop: Rect {
            x0: 1,
            y0: 2,
            x1: 3,
            y1: 4,
        },
        ..splatting(4, 4)
    };
    let crop = resolve(spec, &splats, 64, 1);
    for y in 0..2 {
        for x in 0..2 {
            assert_eq!(crop.rgb.pixel(x, y), whole.rgb.pixel(x + 1, y + 2));
        }
    }
}

#[test]
fn the_sum_is_the_sum() {
    let splats = splats(10_000, 64);
    let image = resolve(splatting(4, 4), &splats, 64, 1);
    for y in 0..4 {
        for x in 0..4 {
            let here = splats.iter().filter(|s| (s.0, s.1) == (x, y));
            let sum: glam::DVec3 = here.map(|s| s.3.as_dvec3()).sum();
            let off = image.rgb.pixel(x, y).as_dvec3() - sum / 64.0;
            // One unit per splat, the rounding of the mean to a float, and that of the f64 sums.
            let bound = 1e4 * SPLAT_RESOLUTION + sum / 64.0 * 2f64.powi(-23);
            assert!(off.abs().cmple(bound).all(), "({x}, {y}): {off}");
            assert_eq!(image.sample_count[(y * 4 + x) as usize], 64);
        }
    }
}

/// 10⁶ splats of 0.3 units: 300000 units expected, σ = √(10⁶·0.3·0.7) = 458. At 6σ a false alarm
/// has a chance of 2·10⁻⁹; an error of 1 % of the sum is seen. Plain rounding would give 0.
#[test]
fn splats_below_the_resolution_add_up() {
    let mut film = Film::new(splatting(1, 1)).unwrap();
    let tiny = (0.3 * SPLAT_RESOLUTION) as f32;
    for i in 0..1_000_000 {
        film.splat(0, 0, i, Vec3::splat(tiny)).unwrap();
    }
    film.add_splat_samples(0..1);
    let image = film.resolve(VarianceEstimator::Replicas);
    for units in (image.rgb.pixels[0].as_dvec3() / SPLAT_RESOLUTION).to_array() {
        assert!((units - 300_000.0).abs() < 6.0 * 458.0, "{units}");
    }
}

#[test]
fn what_does_not_fit_is_rejected_whole() {
    let mut film = Film::new(splatting(1, 1)).unwrap();
    for (value, reject) in [
        (f32::NAN, Reject::NonFinite),
        (f32::INFINITY, Reject::NonFinite),
        (-1e-9, Reject::Negative),
        (SPLAT_LIMIT as f32, Reject::OutOfRange),
        (f32::MAX, Reject::OutOfRange),
    ] {
        let rgb = Vec3::new(1.0, 1.0, value);
        assert_eq!(film.splat(0, 0, 0, rgb), Err(reject));
    }
    // Half the range twice is one unit too much: green overflows, red must be taken back.
    let half = SPLAT_LIMIT as f32 / 2.0;
    film.splat(0, 0, 0, Vec3::new(1.0, half, 0.0)).unwrap();
    let again = film.splat(0, 0, 0, Vec3::new(1.0, half, 0.0));
    assert_eq!(again, Err(Reject::OutOfRange));
    film.splat(0, 0, 1, Vec3::new(1.0, half, 0.0)).unwrap();
    film.add_splat_samples(0..2);
    let image = film.resolve(VarianceEstimator::Replicas);
    assert_eq!(image.rgb.pixels[0], Vec3::new(1.0, half, 0.0));

    let without = Film::new(FilmSpec::of_size(1, 1)).unwrap();
    assert_eq!(without.splat(0, 0, 0, Vec3::ONE), Err(Reject::NoSplats));
}

/// Samples of two passes, camera samples beside: value = camera mean + splats over samples noted;
/// the variance is that of replica means, by hand.
#[test]
fn splats_join_the_camera_samples() {
    let mut film = Film::new(splatting(1, 1)).unwrap();
    film.add_splat_samples(0..3);
    film.add_splat_samples(3..5);
    let camera = [1.0, 3.0, 5.0, 3.0];
    let (tiles, splats) = film.parts_mut();
    for (i, v) in camera.into_iter().enumerate() {
        tiles[0].add(0, i as u64, Vec3::splat(v)).unwrap();
    }
    splats.add(0, 0, 4, Vec3::splat(6.0)).unwrap();
    splats.add(0, 0, 1, Vec3::splat(4.0)).unwrap();
    let image = film.resolve(VarianceEstimator::Samples);
    assert_eq!(image.estimator, VarianceEstimator::Replicas);
    assert_eq!(image.rgb.pixels[0], Vec3::splat(3.0 + 10.0 / 5.0));
    // Replica 0: 3 + 6/3, replica 1: 3 + 4/2: both 5, as is the mean.
    assert_eq!(image.variance_of_mean.pixels[0], Vec3::ZERO);
    film.splat(0, 0, 1, Vec3::splat(4.0)).unwrap();
    let image = film.resolve(VarianceEstimator::Replicas);
    // Now 5, 7 and the mean 5.8: (2·0.64 + 2·1.44) / (4·1).
    assert_eq!(image.rgb.pixels[0], Vec3::splat(5.8));
    assert!(
        (image.variance_of_mean.pixels[0] - 1.04)
            .abs()
            .max_element()
            < 1e-6
    );
    assert_eq!(image.sample_count, [4]);
}
