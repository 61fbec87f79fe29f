//! The error of a picture as it judges itself.

use crate::FilmImage;
use glam::Vec3;

/// What is added to the squared reference in relMSE, `(x − r)² / (r² + 0.01)`, so that dark pixels
/// do not decide it (the constant of Rousselle, Knaus, Zwicker 2011, in wide use since).
pub const RELMSE_OFFSET: f64 = 0.01;

/// Side of the blocks whose spread gives the standard error.
const BLOCK: usize = 8;

/// Estimated error of a picture against the truth, from its own variance.
///
/// It knows of noise only: a biased integrator's bias is not in it. `relmse` puts the estimated
/// mean where the true one belongs. A pixel whose variance is v and mean m is thereby off by a factor
/// 1 + O(v / (m² + 0.01)), which is small once the error is, and less trustworthy before: bright
/// outliers come with large denominators, so that the estimate errs to the low side in fireflies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Mean over pixels and channels of the variance of the mean: the expected mean squared error.
    pub mse: f64,
    /// Mean over pixels and channels of variance / (mean² + [`RELMSE_OFFSET`]).
    pub relmse: f64,
    /// Standard error of `relmse` from the spread of the means of 8 × 8 blocks. The spread also holds
    /// real differences between regions, so it is rather too large. `None` with fewer than two
    /// blocks.
    pub relmse_std_error: Option<f64>,
    /// Pixels whose variance is known, over which the means are taken.
    pub pixels: u64,
    /// Pixels left out since their variance is not known.
    pub unknown_pixels: u64,
}

impl FilmImage {
    /// The picture's own estimate of its error; `None` when no pixel's variance is known.
    pub fn error_estimate(&self) -> Option<ErrorEstimate> {
        let columns = (self.width as usize).div_ceil(BLOCK);
        let rows = (self.height as usize).div_ceil(BLOCK);
        let mut blocks = vec![(0.0f64, 0u64); columns * rows];
        let (mut mse, mut relmse, mut pixels) = (0.0, 0.0, 0u64);
        let both = self.rgb.pixels.iter().zip(&self.variance_of_mean.pixels);
        for (i, (&mean, &variance)) in both.enumerate() {
            if !variance.is_finite() {
                continue;
            }
            let rel = relative(mean, variance);
            mse += variance.as_dvec3().element_sum() / 3.0;
            relmse += rel;
            pixels += 1;
            let (x, y) = (i % self.width as usize, i / self.width as usize);
            let block = &mut blocks[y / BLOCK * columns + x / BLOCK];
            *block = (block.0 + rel, block.1 + 1);
        }
        if pixels == 0 {
            return None;
        }
        let n = pixels as f64;
        relmse /= n;
        Some(ErrorEstimate {
            mse: mse / n,
            relmse,
            relmse_std_error: std_error(&blocks, relmse, n),
            pixels,
            unknown_pixels: self.rgb.pixels.len() as u64 - pixels,
        })
    }
}

fn relative(mean: Vec3, variance: Vec3) -> f64 {
    let m = mean.as_dvec3();
    (variance.as_dvec3() / (m * m + RELMSE_OFFSET)).element_sum() / 3.0
}

/// Standard error of the mean of all pixels from the weighted spread of block means.
fn std_error(blocks: &[(f64, u64)], mean: f64, pixels: f64) -> Option<f64> {
    let used = blocks.iter().filter(|b| b.1 > 0);
    let (mut spread, mut count) = (0.0, 0.0);
    for &(sum, n) in used {
        let off = sum / n as f64 - mean;
        spread += n as f64 / pixels * off * off;
        count += 1.0;
    }
    (count >= 2.0).then(|| (spread / (count - 1.0)).sqrt())
}
