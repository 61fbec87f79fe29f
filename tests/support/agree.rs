//! Whether two methods give the same picture.

#![allow(clippy::print_stderr, reason = "the figures of a test are its output")]

use crate::Scene;
use glam::Vec3;
use sr_pipeline::film_kernel::Image;
use sr_stats::{sidak, student_cdf};

/// Independently seeded pictures of each method.
const REPLICAS: u64 = 8;
/// Side of the blocks whose means are compared, in pixels.
const BLOCK: u32 = 16;
/// Probability that two methods that agree fail.
const FAMILY_LEVEL: f64 = 1e-3;

/// Block means of a method: one row for each seed.
pub struct Blocks(Vec<Vec<Vec3>>);

impl Blocks {
    /// Renders `scene` with several seeds, other ones than any other `method` number takes.
    pub fn render(scene: &mut Scene, samples: u64, method: u64) -> Self {
        let seeds = (0..REPLICAS).map(|r| 100 * method + r);
        Self(
            seeds
                .map(|seed| blocks(&scene.render(samples, seed).image.rgb))
                .collect(),
        )
    }

    /// Mean and variance of the mean, over the seeds, of a block's channel.
    fn estimate(&self, block: usize, channel: usize) -> (f64, f64) {
        let values = || self.0.iter().map(|row| f64::from(row[block][channel]));
        let n = self.0.len() as f64;
        let mean = values().sum::<f64>() / n;
        let squares = values().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        (mean, squares / (n - 1.0) / n)
    }
}

fn blocks(image: &Image) -> Vec<Vec3> {
    let mut means = Vec::new();
    for y in (0..image.height).step_by(BLOCK as usize) {
        for x in (0..image.width).step_by(BLOCK as usize) {
            let rows = y..(y + BLOCK).min(image.height);
            let pixels =
                rows.flat_map(|py| (x..(x + BLOCK).min(image.width)).map(move |px| (px, py)));
            let (mut sum, mut n) = (Vec3::ZERO, 0.0);
            for (px, py) in pixels {
                sum += image.pixel(px, py);
                n += 1.0;
            }
            means.push(sum / n);
        }
    }
    means
}

/// Welch's t-test (Welch 1947) on each block and channel, Šidák-corrected to a false alarm of
/// 10⁻³ in all. It would find a difference of about 8 standard errors of a block, and says how
/// much of the picture's mean that is.
pub fn assert_same(what: &str, a: &Blocks, b: &Blocks) {
    let count = a.0[0].len();
    let level = sidak(FAMILY_LEVEL, 3 * count);
    let (mut worst, mut total, mut errors) = ((1.0, String::new()), 0.0, 0.0);
    for block in 0..count {
        for channel in 0..3 {
            let ((ma, va), (mb, vb)) = (a.estimate(block, channel), b.estimate(block, channel));
            total += mb;
            errors += (va + vb).sqrt();
            // Pictures are f32: equal to its resolution is equal.
            if (ma - mb).abs() <= 4.0 * f64::from(f32::EPSILON) * mb.abs() {
                continue;
            }
            let t = (ma - mb) / (va + vb).sqrt();
            let n = a.0.len() as f64 - 1.0;
            let dof = (va + vb) * (va + vb) / ((va * va + vb * vb) / n);
            let p = 2.0 * student_cdf(-t.abs(), dof);
            if p < worst.0 {
                worst = (
                    p,
                    format!("block {block} channel {channel}: {ma} and {mb}, t {t:.2}"),
                );
            }
        }
    }
    eprintln!(
        "{what}: p ≥ {:.1e} of {level:.1e}; a block's error is {:.1e} of the mean",
        worst.0,
        errors / total
    );
    assert!(worst.0 > level, "{what}: {}", worst.1);
}
