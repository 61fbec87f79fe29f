//! The error of a picture as it judges itself.

use crate::FilmImage;
use glam::{DVec3, Vec3};

/// What is added to the squared reference in relMSE, `(x − r)² / (r² + 0.01)`, so that dark pixels
/// do not decide it (the constant of Rousselle, Knaus, Zwicker 2011, in wide use since).
pub const RELMSE_OFFSET: f64 = 0.01;

/// Side of the blocks whose spread gives the standard error.
const BLOCK: usize = 8;

/// Estimated error of a picture against the truth, from its own variance.
///
/// It knows of noise only: a biased integrator's bias is not in it. `mse` is unbiased. `relmse` needs
/// the true mean in its denominators and has an estimate; what that does is in docs/convergence.md.
///
/// The pixel's own mean would be the plain plug-in. But a bright outlier raises mean and variance of
/// its pixel together and hides itself: where light comes as fireflies that estimate was a half to a
/// tenth of the error, at tens of samples a pixel. So the mean is drawn to that of the eight
/// neighbours, whose noise is none of the pixel's, the more the noisier the pixel is and the less the
/// neighbours differ: m + (m_N − m) v / (v + τ²), where τ² is the variance among the neighbours' means
/// less what their noise brings into it (empirical Bayes after Efron, Morris 1973, "Stein's estimation
/// rule and its competitors", with the moments of the neighbourhood). Where the noise is small or
/// neighbours tell nothing (v ≪ τ², or there are fewer than two) this is the plug-in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Mean over pixels and channels of the variance of the mean: the expected mean squared error.
    pub mse: f64,
    /// Mean over pixels and channels of variance / (mean² + [`RELMSE_OFFSET`]), with means as above.
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
            let mean = self.drawn_to_neighbours(i, mean.as_dvec3(), variance.as_dvec3());
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

    /// The mean of pixel `i` as far as its neighbourhood tells.
    fn drawn_to_neighbours(&self, i: usize, mean: DVec3, variance: DVec3) -> DVec3 {
        let (mut sum, mut squares, mut noise) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        let mut count = 0.0;
        for j in self.neighbours(i) {
            let own = self.variance_of_mean.pixels[j];
            if own.is_finite() {
                // Differences, so that the squares do not cancel.
                let off = self.rgb.pixels[j].as_dvec3() - mean;
                sum += off;
                squares += off * off;
                noise += own.as_dvec3();
                count += 1.0;
            }
        }
        if count < 2.0 {
            return mean;
        }
        let off = sum / count;
        let spread = (squares - sum * off) / (count - 1.0);
        let differences = (spread - noise / count).max(DVec3::ZERO);
        let weight = variance / (variance + differences);
        // Without noise there is nothing to learn, and perhaps nothing to divide by.
        DVec3::select(variance.cmpgt(DVec3::ZERO), mean + weight * off, mean)
    }

    /// The pixels around pixel `i`, up to eight.
    fn neighbours(&self, i: usize) -> impl Iterator<Item = usize> {
        let (width, height) = (self.width as usize, self.height as usize);
        let (x, y) = (i % width, i / width);
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
            .filter(move |j| *j != i)
    }
}

fn relative(m: DVec3, variance: Vec3) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Film, FilmSpec, VarianceEstimator};

    /// A noisy pixel of mean 3 among eight of mean 1.
    fn picture() -> FilmImage {
        let film = Film::new(FilmSpec::of_size(3, 3)).expect("a small film");
        let mut image = film.resolve(VarianceEstimator::Samples);
        for i in 0..9 {
            let mean = if i % 2 == 0 { 0.75 } else { 1.25 };
            image.rgb.pixels[i] = Vec3::splat(mean);
            image.variance_of_mean.pixels[i] = Vec3::splat(0.031_25);
        }
        image.rgb.pixels[4] = Vec3::splat(3.0);
        image.variance_of_mean.pixels[4] = Vec3::splat(0.125);
        image
    }

    fn drawn(image: &FilmImage) -> f64 {
        let [m, v] = [&image.rgb, &image.variance_of_mean].map(|i| i.pixels[4].as_dvec3());
        image.drawn_to_neighbours(4, m, v).x
    }

    #[test]
    fn a_pixel_is_drawn_to_its_neighbours_by_its_noise_and_their_likeness() {
        let mut image = picture();
        // Their variance is 8/7 · 1/16 and their noise 1/32, which leaves 9/224.
        let weight = 0.125 / (0.125 + 9.0 / 224.0);
        assert!((drawn(&image) - (3.0 - 2.0 * weight)).abs() < 1e-12);
        // Neighbours that differ by their noise alone are trusted.
        for i in (0..9).filter(|i| *i != 4) {
            image.variance_of_mean.pixels[i] = Vec3::splat(1.0);
        }
        assert!((drawn(&image) - 1.0).abs() < 1e-12);
        // Those of which nothing is known have no say.
        for i in (0..9).filter(|i| *i > 1 && *i != 4) {
            image.variance_of_mean.pixels[i] = Vec3::INFINITY;
        }
        assert!((drawn(&image) - 1.0).abs() < 1e-12);
        image.variance_of_mean.pixels[1] = Vec3::INFINITY;
        assert_eq!(drawn(&image), 3.0);
    }

    #[test]
    fn a_pixel_without_noise_stays() {
        let mut image = picture();
        image.variance_of_mean.pixels = vec![Vec3::ZERO; 9];
        assert_eq!(drawn(&image), 3.0);
        image.rgb.pixels = vec![Vec3::ONE; 9];
        assert_eq!(drawn(&image), 1.0);
        assert_eq!(image.error_estimate().map(|e| e.relmse), Some(0.0));
    }

    #[test]
    fn neighbours_are_those_around_it() {
        let image = picture();
        let of = |i| image.neighbours(i).collect::<Vec<_>>();
        assert_eq!(of(4), [0, 1, 2, 3, 5, 6, 7, 8]);
        assert_eq!(of(0), [1, 3, 4]);
        assert_eq!(of(5), [1, 2, 4, 7, 8]);
    }
}
