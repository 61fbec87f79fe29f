//! What ends up in a pixel: means that do not depend on how the work was cut.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use glam::Vec3;
use sr_film::{
    AdaptiveSpec, Criterion, Film, FilmError, FilmSpec, FilmTile, Layer, Rect, Reject,
    StoppingRule, TILE_SIZE, VarianceEstimator,
};
use sr_math::hash;

/// A sample of pixel (x, y): values of very different size, so that the order of sums shows.
fn sample(x: u32, y: u32, index: u64) -> Vec3 {
    let u = |c| hash::unit_f32(hash::mix(hash::mix(x, y), hash::mix(index as u32, c)));
    Vec3::new(
        u(0),
        10f32.powf(16.0 * u(1) - 8.0),
        10f32.powf(24.0 * u(2) - 12.0),
    )
}

fn add_pass(film: &mut Film, samples: std::ops::Range<u64>) {
    for tile in film.tiles_mut() {
        for p in 0..tile.pixel_count() {
            let (x, y) = tile.pixel(p);
            for i in samples.clone() {
                tile.add(p, i, sample(x, y, i)).unwrap();
                tile.add_layer(p, Layer::Albedo, i, sample(y, x, i))
                    .unwrap();
                tile.add_layer(p, Layer::Ids, i, Vec3::new(i as f32, 2.0, 0.0))
                    .unwrap();
            }
        }
    }
}

fn layered(width: u32, height: u32) -> FilmSpec {
    FilmSpec {
        layers: vec![Layer::Albedo, Layer::Ids],
        ..FilmSpec::of_size(width, height)
    }
}

#[test]
fn passes_may_be_split_anywhere() {
    for replicas in [1, 2, 16] {
        let spec = FilmSpec {
            replicas,
            ..layered(19, 5)
        };
        let resolved = [200, 64, 4, 7].map(|pass| {
            let mut film = Film::new(spec.clone()).unwrap();
            for start in (0..200).step_by(pass) {
                add_pass(&mut film, start as u64..(start + pass).min(200) as u64);
            }
            assert_eq!(film.sample_count(), 19 * 5 * 200);
            let squares = film.resolve(VarianceEstimator::Samples);
            let spread = film.resolve(VarianceEstimator::Replicas);
            (squares, spread)
        });
        for other in &resolved[1..] {
            assert_eq!(&resolved[0], other, "{replicas} replicas");
        }
    }
}

#[test]
fn a_crop_gives_the_pixels_of_the_whole() {
    let whole = layered(50, 40);
    let crop = Rect {
        x0: 5,
        y0: 17,
        x1: 35,
        y1: 33,
    };
    let render = |spec: FilmSpec| {
        let mut film = Film::new(spec).unwrap();
        add_pass(&mut film, 0..70);
        film.resolve(VarianceEstimator::Samples)
    };
    let (cropped, whole) = (
        render(FilmSpec {
            crop,
            ..whole.clone()
        }),
        render(whole),
    );
    assert_eq!((cropped.width, cropped.height), (30, 16));
    for y in 0..16 {
        for x in 0..30 {
            let (at_x, at_y) = (x + crop.x0, y + crop.y0);
            assert_eq!(cropped.rgb.pixel(x, y), whole.rgb.pixel(at_x, at_y));
            assert_eq!(
                cropped.variance_of_mean.pixel(x, y),
                whole.variance_of_mean.pixel(at_x, at_y)
            );
            let (i, j) = ((y * 30 + x) as usize, (at_y * 50 + at_x) as usize);
            for (a, b) in cropped.layers.iter().zip(&whole.layers) {
                for (a, b) in a.planes.iter().zip(&b.planes) {
                    assert_eq!(a[i], b[j]);
                }
            }
        }
    }
}

#[test]
fn tiles_cover_the_crop_once_on_the_grid_of_the_picture() {
    for crop in [
        Rect::of_size(1, 1),
        Rect::of_size(64, 48),
        Rect {
            x0: 15,
            y0: 16,
            x1: 17,
            y1: 48,
        },
        Rect {
            x0: 5,
            y0: 7,
            x1: 63,
            y1: 47,
        },
    ] {
        let film = Film::new(FilmSpec {
            crop,
            ..FilmSpec::of_size(64, 48)
        })
        .unwrap();
        let mut hits = vec![0; crop.pixel_count() as usize];
        for tile in film.tiles() {
            let r = tile.rect();
            assert_eq!(r.x0 / TILE_SIZE, (r.x1 - 1) / TILE_SIZE, "{r:?}");
            assert_eq!(r.y0 / TILE_SIZE, (r.y1 - 1) / TILE_SIZE, "{r:?}");
            for p in 0..tile.pixel_count() {
                let (x, y) = tile.pixel(p);
                assert!(r.contains(x, y) && crop.contains(x, y));
                hits[((y - crop.y0) * crop.width() + x - crop.x0) as usize] += 1;
            }
        }
        assert!(hits.iter().all(|&n| n == 1), "{crop:?}");
    }
}

/// Single-precision sums stop growing at 2²⁴ samples.
#[test]
fn a_hundred_million_equal_samples_keep_their_mean() {
    let mut film = Film::new(FilmSpec::of_size(1, 1)).unwrap();
    let value = Vec3::new(0.1, 1.0 / 3.0, 1e-3);
    let tile = &mut film.tiles_mut()[0];
    for i in 0..100_000_000 {
        tile.add(0, i, value).unwrap();
    }
    for estimator in [VarianceEstimator::Samples, VarianceEstimator::Replicas] {
        let image = film.resolve(estimator);
        assert_eq!(image.rgb.pixels[0], value);
        assert_eq!(image.sample_count[0], 100_000_000);
        // 1.6 million blocks, each rounded by 2⁻⁵³ at most: relative 2·10⁻¹⁰ of the square.
        let bound = value * value * 2e-10 / 1e8;
        assert!(image.variance_of_mean.pixels[0].cmple(bound).all());
    }
}

#[test]
fn rejected_samples_leave_no_trace() {
    let mut film = Film::new(FilmSpec::of_size(1, 1)).unwrap();
    let tile = &mut film.tiles_mut()[0];
    let ok = Vec3::new(1.0, 2.0, 0.0);
    tile.add(0, 0, ok).unwrap();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for at in 0..3 {
            let mut rgb = [1.0; 3];
            rgb[at] = bad;
            assert_eq!(tile.add(0, 1, rgb.into()), Err(Reject::NonFinite));
            let depth = tile.add_layer(0, Layer::Depth, 1, Vec3::splat(bad));
            assert_eq!(depth, Ok(()), "a layer that is not kept takes anything");
        }
    }
    assert_eq!(
        tile.add(0, 1, Vec3::new(1.0, -1e-30, 1.0)),
        Err(Reject::Negative)
    );
    tile.add(0, 3, ok).unwrap();
    tile.add(0, 4, Vec3::splat(-0.0)).unwrap();
    let image = film.resolve(VarianceEstimator::Samples);
    assert_eq!(image.rgb.pixels[0], ok * 2.0 / 3.0);
    assert_eq!(image.sample_count, [3]);
}

#[test]
fn layers_average_and_ids_stay_with_the_first_sample() {
    let mut film = Film::new(FilmSpec {
        layers: Layer::ALL.to_vec(),
        ..FilmSpec::of_size(2, 1)
    })
    .unwrap();
    let tile = &mut film.tiles_mut()[0];
    for (i, v) in [1.0, 3.0].into_iter().enumerate() {
        for layer in Layer::ALL {
            tile.add_layer(0, layer, i as u64, Vec3::splat(v)).unwrap();
        }
    }
    assert_eq!(
        tile.add_layer(0, Layer::Normal, 2, Vec3::NAN),
        Err(Reject::NonFinite)
    );
    let image = film.resolve(VarianceEstimator::Samples);
    for layer in &image.layers {
        let (hit, empty) = match layer.layer {
            Layer::Normal | Layer::Albedo | Layer::Bounces => (2.0, 0.0),
            Layer::Depth => (2.0, f32::INFINITY),
            Layer::Ids => (1.0, -1.0),
            Layer::Seconds => (4.0, 0.0),
        };
        assert_eq!(layer.planes.len(), layer.layer.channel_names().len());
        for plane in &layer.planes {
            assert_eq!(plane[..], [hit, empty], "{:?}", layer.layer);
        }
    }
}

/// Seconds of a tile are shared out among the pixels that were sampled, and added up over passes.
#[test]
fn seconds_go_to_the_pixels_that_were_sampled() {
    let adaptive = |layers| FilmSpec {
        layers,
        adaptive: Some(AdaptiveSpec {
            rule: StoppingRule::Course,
            block: 1,
        }),
        ..FilmSpec::of_size(2, 2)
    };
    let mut film = Film::new(adaptive(vec![Layer::Seconds])).unwrap();
    let tile = &mut film.tiles_mut()[0];
    let sample = |tile: &mut FilmTile, indices: std::ops::Range<u64>| {
        for i in indices {
            for p in tile.active_pixels() {
                // Of the first two pixels every sample is the same.
                let value = if p < 2 { 1.0 } else { i as f32 };
                tile.add(p, i, Vec3::splat(value)).unwrap();
            }
        }
    };
    sample(tile, 0..4);
    tile.add_seconds(2.0);
    tile.decide(&Criterion {
        tolerance: 0.1,
        floor: 0.0,
        estimator: VarianceEstimator::Samples,
        quantile: &|_| 1.96,
    });
    sample(tile, 4..8);
    tile.add_seconds(1.0);
    assert_eq!(tile.active_pixels(), [2, 3]);
    let seconds = film.resolve(VarianceEstimator::Samples).layers[0].planes[0].clone();
    assert_eq!(seconds, [0.5, 0.5, 1.0, 1.0]);

    let mut film = Film::new(adaptive(Vec::new())).unwrap();
    film.tiles_mut()[0].add_seconds(1.0);
    assert!(film.resolve(VarianceEstimator::Samples).layers.is_empty());
}

#[test]
fn impossible_films_are_refused_with_their_numbers() {
    let good = FilmSpec::of_size(8, 8);
    let crop = |x0, y0, x1, y1| FilmSpec {
        crop: Rect { x0, y0, x1, y1 },
        ..good.clone()
    };
    let message = |spec: FilmSpec| Film::new(spec).err().expect("is refused").to_string();
    assert!(message(FilmSpec::of_size(0, 8)).contains("0 × 8"));
    for bad in [crop(0, 0, 9, 8), crop(4, 4, 4, 8), crop(5, 0, 4, 8)] {
        assert!(message(bad).contains("not inside the picture of 8 × 8"));
    }
    for replicas in [0, 3, 32] {
        let spec = FilmSpec {
            replicas,
            ..good.clone()
        };
        assert_eq!(
            Film::new(spec).err(),
            Some(FilmError::BadReplicas(replicas))
        );
    }
    let twice = FilmSpec {
        layers: vec![Layer::Depth, Layer::Depth],
        ..good.clone()
    };
    assert!(message(twice).contains("Depth"));
    let huge = message(FilmSpec::of_size(u32::MAX, u32::MAX));
    assert!(
        huge.contains("18446744065119617025 pixels") && huge.contains("GiB"),
        "{huge}"
    );
    // The last tile of such a picture ends where 32 bits do.
    let corner = u32::MAX - 3;
    let film = Film::new(FilmSpec {
        crop: Rect {
            x0: corner,
            y0: corner,
            x1: u32::MAX,
            y1: u32::MAX,
        },
        ..FilmSpec::of_size(u32::MAX, u32::MAX)
    });
    assert_eq!(film.unwrap().tiles()[0].pixel_count(), 9);
}
