use super::*;
use crate::{Film, FilmError, FilmSpec, Layer};
use sr_math::hash::{mix, unit_f32};

const FOLDS: usize = 4;

/// A pixel of one block, `batches` batches of 16 samples, a decision after each; when each fold ended.
fn ends(rule: StoppingRule, batches: u64, sample: impl Fn(u64) -> f32) -> Vec<Option<u64>> {
    let spec = AdaptiveSpec { rule, block: 1 };
    let mut adaptive = Adaptive::new(Rect::of_size(1, 1), spec, FOLDS);
    let criterion = Criterion {
        tolerance: 0.2,
        floor: 0.0,
        estimator: VarianceEstimator::Replicas,
        quantile: &|_| 2.0,
    };
    let mut ends = vec![None; FOLDS];
    for batch in 0..batches {
        for i in batch * 16..(batch + 1) * 16 {
            adaptive.watch(0, i as usize % FOLDS, Vec3::splat(sample(i)));
        }
        adaptive.decide(&criterion);
        for (fold, end) in ends.iter_mut().enumerate() {
            if adaptive.ended[0] >> fold & 1 == 1 {
                end.get_or_insert(batch);
            }
        }
    }
    ends
}

fn noise(seed: u32) -> impl Fn(u64) -> f32 {
    move |i| 4.0 * unit_f32(mix(seed, i as u32)).powi(3)
}

/// What the proof rests on: the fold's own samples have no say in its end. (The last batch is another
/// matter: the budget ends there for everybody.)
#[test]
fn a_fold_ends_without_its_own_say() {
    let (mut different, mut compared) = (0, 0);
    for seed in 0..200 {
        let plain = ends(StoppingRule::Folds, 40, noise(seed));
        for fold in 0..FOLDS {
            let changed = |i: u64| match i as usize % FOLDS == fold {
                true => 100.0 * noise(seed + 1000)(i),
                false => noise(seed)(i),
            };
            // With these samples of its own the other folds end elsewhere, most of the time.
            let other = ends(StoppingRule::Folds, 40, changed);
            assert_eq!(plain[fold], other[fold], "seed {seed}, fold {fold}");
            different += usize::from(plain != other);
            compared += usize::from(plain[fold].is_some());
        }
    }
    assert!(different > 700 && compared > 700, "{different} {compared}");

    // The course's rule fails the same test.
    let fails = (0..200).any(|seed| {
        let changed = |i: u64| noise(seed)(i) * if i.is_multiple_of(4) { 100.0 } else { 1.0 };
        ends(StoppingRule::Course, 40, changed) != ends(StoppingRule::Course, 40, noise(seed))
    });
    assert!(fails);
}

#[test]
fn black_and_constant_pixels_end_at_the_first_decision() {
    for rule in [StoppingRule::Folds, StoppingRule::Course] {
        assert_eq!(ends(rule, 2, |_| 0.0), [Some(0); FOLDS]);
        assert_eq!(ends(rule, 2, |_| 3.0), [Some(0); FOLDS]);
    }
    // Too noisy for this many samples.
    let wild = ends(StoppingRule::Folds, 2, |i| if i == 0 { 1e30 } else { 0.0 });
    assert!(wild.contains(&None), "{wild:?}");
}

#[test]
fn the_spread_of_samples_and_of_means_is_that_of_the_text_book() {
    let watch = |values: &[f64]| Watch {
        sum: values.iter().sum(),
        squares: values.iter().map(|v| v * v).sum(),
        count: values.len() as u64,
    };
    let folds = [watch(&[1.0, 3.0]), watch(&[5.0, 7.0]), watch(&[2.0, 6.0])];
    // Means 2, 6, 4: variance 4, of the mean of four such folds 1.
    let means = Spread::of_means(folds.into_iter(), 4).unwrap();
    assert_eq!((means.mean, means.variance, means.freedom), (4.0, 1.0, 2.0));
    // Squared deviations from 4: 9, 1, 1, 9, 4, 4: variance 28/5, of the mean of eight samples 28/40.
    let samples = Spread::of_samples(folds.into_iter(), Some(3), 4).unwrap();
    assert_eq!((samples.mean, samples.freedom), (4.0, 5.0));
    assert!((samples.variance - 0.7).abs() < 1e-15);
    assert_eq!(samples.relative_squared(0.0), samples.variance / 16.0);
    assert_eq!(samples.relative_squared(3.0), samples.variance / 25.0);
    assert!(Spread::of_means(folds.into_iter().take(1), 4).is_none());
    assert!(Spread::of_samples([watch(&[1.0])].into_iter(), None, 4).is_none());
}

fn spec(block: u32) -> FilmSpec {
    FilmSpec {
        replicas: FOLDS as u32,
        adaptive: Some(AdaptiveSpec {
            rule: StoppingRule::Folds,
            block,
        }),
        ..FilmSpec::of_size(40, 30)
    }
}

#[test]
fn blocks_that_a_crop_cuts_are_sampled_as_a_whole_and_shown_in_part() {
    let crop = Rect {
        x0: 5,
        y0: 9,
        x1: 33,
        y1: 29,
    };
    let spec = FilmSpec { crop, ..spec(8) };
    let sampled = Rect {
        x0: 0,
        y0: 8,
        x1: 40,
        y1: 30,
    };
    assert_eq!(spec.sampled(), sampled);
    let film = Film::new(spec).unwrap();
    assert_eq!(film.active_pixels(), sampled.pixel_count());
    let image = film.resolve(VarianceEstimator::Replicas);
    assert_eq!((image.width, image.height), (28, 20));
    assert_eq!(FilmSpec::of_size(40, 30).sampled(), Rect::of_size(40, 30));
}

#[test]
fn what_cannot_be_adaptive_is_refused() {
    for block in [0, 3, 32] {
        let error = Film::new(spec(block)).err();
        assert_eq!(error, Some(FilmError::BadBlock(block)));
    }
    let splats = FilmSpec {
        splats: true,
        ..spec(4)
    };
    assert_eq!(Film::new(splats).err(), Some(FilmError::AdaptiveSplats));
}

/// The mean is that of the folds' means; what came after a fold's end is counted, not averaged.
#[test]
fn a_fold_that_has_ended_keeps_its_mean() {
    let mut film = Film::new(FilmSpec {
        layers: vec![Layer::Bounces],
        ..spec(16)
    })
    .unwrap();
    let tile = &mut film.tiles_mut()[0];
    let add = |tile: &mut crate::FilmTile, samples: std::ops::Range<u64>, odd: [f32; 4]| {
        for pixel in 0..tile.pixel_count() {
            for i in samples.clone() {
                let rgb = Vec3::splat(odd[i as usize % 4]);
                tile.add(pixel, i, rgb).unwrap();
            }
        }
    };
    let criterion = |tolerance| Criterion {
        tolerance,
        floor: 0.0,
        estimator: VarianceEstimator::Replicas,
        quantile: &|_| 1.0,
    };
    // Without fold 3 the others agree: fold 3 alone has enough.
    add(tile, 0..8, [1.0, 1.0, 1.0, 5.0]);
    tile.decide(&criterion(0.1));
    add(tile, 8..16, [3.0, 3.0, 3.0, 9.0]);
    assert_eq!(tile.active_pixels().len(), 256);
    tile.decide(&criterion(1e9));
    assert!(tile.active_pixels().is_empty());
    // Too late: nobody waits for these.
    add(tile, 16..24, [100.0; 4]);
    let report = film.adaptive_report().unwrap();
    assert_eq!((report.pixels, report.converged), (40 * 30, 256));
    assert_eq!((report.taken, report.used), (256 * 16, 256 * 14));
    assert_eq!(report.range, (0, 16));
    let image = film.resolve(VarianceEstimator::Replicas);
    // Means 2, 2, 2 and 5; variance of them 2.25, of their mean a quarter of it.
    assert_eq!(image.rgb.pixels[0], Vec3::splat(2.75));
    assert_eq!(image.variance_of_mean.pixels[0], Vec3::splat(0.5625));
    assert_eq!(image.sample_count[0], 16);
    // Within the folds: three times four samples 1, 1, 3, 3 and twice 5 leave 12/10 of variance.
    let image = film.resolve(VarianceEstimator::Samples);
    let expected = 1.2 * (3.0 / 4.0 + 1.0 / 2.0) / 16.0;
    assert!((image.variance_of_mean.pixels[0].x - expected).abs() < 1e-7);
}
