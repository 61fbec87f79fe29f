//! Whether two methods give the same picture.

#![allow(clippy::print_stderr, reason = "the figures of a test are its output")]

use crate::Scene;
use sr_experiment::same::{Settings, same};
use sr_pipeline::film_kernel::Image;

/// Independently seeded pictures of each method.
const REPLICAS: u64 = 8;
/// Side of the tiles whose means are compared, in pixels.
const TILE: u32 = 16;
/// Probability that two methods that agree fail, for the tiles and again for the mean.
const FAMILY_LEVEL: f64 = 1e-3;

/// Renders `scene` with several seeds, other ones than any other `method` number takes.
pub fn pictures(scene: &mut Scene, samples: u64, method: u64) -> Vec<Image> {
    let seeds = (0..REPLICAS).map(|r| 100 * method + r);
    seeds
        .map(|seed| scene.render(samples, seed).image.rgb)
        .collect()
}

/// Welch's t-test on each tile and channel, and on the mean of the picture, Šidák-corrected to a
/// false alarm of 10⁻³ each. It would find a difference of about 8 standard errors of a tile, and
/// says how much of the picture's mean that is. The distribution of the p-values is no part of it:
/// with 8 seeds of few samples their tails make it uneven.
pub fn assert_same(what: &str, a: &[Image], b: &[Image]) {
    let settings = Settings {
        tile: TILE,
        ..Default::default()
    };
    let verdict = same(a, b, &settings).unwrap_or_else(|e| panic!("{what}: {e}"));
    let (tiles, mean) = (verdict.tiles.p_value, verdict.mean.p_value);
    eprintln!(
        "{what}: p of tiles {tiles:.1e}, of the mean {mean:.1e}; a tile's error is {:.1e} of the mean",
        verdict.tile_error
    );
    assert!(
        tiles > FAMILY_LEVEL && mean > FAMILY_LEVEL,
        "{what}:\n{}",
        verdict.describe()
    );
}
