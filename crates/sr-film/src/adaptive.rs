//! Adaptive sampling: which pixels need more samples, decided such that the picture stays unbiased.
//!
//! # Why stopping is delicate
//! A pixel that stops as soon as *its own samples* look quiet stops early exactly when it has been
//! lucky so far, and a pixel that has missed a bright path looks quiet: the mean over what it has is
//! too low on average. [`StoppingRule::Course`] does that, as classic assignments ask for.
//!
//! # Folds
//! [`StoppingRule::Folds`] deals the samples of a pixel to R folds in turn (the film's replicas: fold
//! = index mod R), and lets no fold have a say in its own end. At fixed sample counts k = 1, 2, …
//! fold g is asked whether the criterion holds on the samples of *all other folds* up to k. The
//! first such k is τ_g; what fold g gets later serves the decisions of the others and stays out of the
//! estimate. A pixel is sampled until every τ_g is known or the budget ends, which stands in for those
//! that are not. The estimate is
//! ```text
//! x̂ = (1/R) Σ_g m_g,   m_g = mean of fold g's samples up to τ_g.
//! ```
//! *x̂ is unbiased.* Imagine every fold's sequence drawn to the end of the budget, whether or not it
//! is looked at. τ_g is a function of the sequences of the other folds alone: it asks at each k for the
//! others' samples up to k, all of which exist whenever fold g has not ended before (a pixel ends as a
//! whole), and that the budget ended first is decided by the same samples. Folds are independent of one
//! another: other samples under independent numbers, other scrambles under a low-discrepancy sequence.
//! So given the other folds, τ_g is a constant and m_g the mean of that many samples of a fold that
//! knows nothing of it: `E[m_g | others]` = μ, hence `E[m_g]` = μ. The weights 1/R are constants, thus
//! `E[x̂]` = μ. Nothing is asked of the distribution, the criterion or the sampler's convergence. ∎
//! (Weights by the number of samples would undo it, since these depend on all folds.)
//!
//! With R = 2 it is the scheme of two halves that decide for each other. More folds decide on more
//! samples, (R − 1)/R of all, so that the τ_g lie closer together and less is left out.
//!
//! The same argument holds for a block of pixels that end together: given the other folds of *all*
//! pixels of the block, τ_g is a constant.
//!
//! What it does not cover: a budget of time or of the whole picture's error, layers other than radiance
//! (plain means over what was taken), and rejected samples.
//!
//! # Criterion
//! With the mean m and the estimated variance v of the *whole* pixel's mean, both from the folds asked,
//! relative to `r² = v / (m² + floor²)`: stop when `t √(mean of r² over the block) ≤ tolerance`, t the
//! quantile of Student's distribution at the degrees of freedom of the block's estimates. With block 1
//! and floor 0 that is "the half width of the confidence interval is within the tolerance of the
//! mean". Radiance counts by luminance.

use crate::{Rect, VarianceEstimator};
use glam::Vec3;
use sr_math::color::LUMINANCE_WEIGHTS;

/// Whose samples decide on the end of a fold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StoppingRule {
    /// Those of all other folds: unbiased.
    Folds,
    /// All, the fold's own included, and all folds end together: biased, and of more confidence than
    /// it deserves. The rule of classic assignments.
    Course,
}

/// How a film samples adaptively.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AdaptiveSpec {
    /// Whose samples decide.
    pub rule: StoppingRule,
    /// Side in pixels of the blocks that end together: 1, 2, 4, 8 or 16. Blocks lie on the grid that
    /// starts at the picture's (0, 0); a film with a crop samples the blocks that the crop cuts as a
    /// whole, so that a crop is that part of the picture bit for bit.
    pub block: u32,
}

/// When enough is known; see the [module](self).
#[derive(Clone, Copy)]
pub struct Criterion<'a> {
    /// Largest half width of the interval, relative to the mean.
    pub tolerance: f64,
    /// Luminance that is added (as squares are) to the mean that the width is relative to: a pixel much
    /// darker is held to `tolerance · floor`, absolutely.
    pub floor: f64,
    /// How the samples of a pixel tell its variance.
    pub estimator: VarianceEstimator,
    /// Half width of the interval in standard errors for so many degrees of freedom.
    pub quantile: &'a (dyn Fn(f64) -> f64 + Sync),
}

/// What adaptive sampling has come to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AdaptiveReport {
    /// Pixels that are sampled, those around a crop included.
    pub pixels: u64,
    /// Pixels that met the criterion.
    pub converged: u64,
    /// Samples accepted.
    pub taken: u64,
    /// Samples in the estimate; the others served decisions only.
    pub used: u64,
    /// Fewest and most samples accepted in a pixel.
    pub range: (u64, u64),
}

impl AdaptiveReport {
    /// Share of the samples that are not in the estimate.
    pub fn left_out(&self) -> f64 {
        1.0 - self.used as f64 / self.taken.max(1) as f64
    }
}

/// What the decisions know of one fold of a pixel: all its samples, by luminance.
#[derive(Clone, Copy, Default)]
struct Watch {
    sum: f64,
    squares: f64,
    count: u64,
}

/// The adaptive part of a tile.
pub(crate) struct Adaptive {
    rule: StoppingRule,
    folds: usize,
    /// The block of each pixel.
    block_of: Vec<u32>,
    /// The folds of a pixel stand together.
    watches: Vec<Watch>,
    /// Folds of each block that have ended, a bit each.
    ended: Vec<u16>,
    /// The pixels of each block.
    blocks: Vec<Vec<u32>>,
}

impl Adaptive {
    pub fn new(rect: Rect, spec: AdaptiveSpec, folds: usize) -> Self {
        let cells = Rect {
            x0: rect.x0 / spec.block,
            y0: rect.y0 / spec.block,
            x1: rect.x1.div_ceil(spec.block),
            y1: rect.y1.div_ceil(spec.block),
        };
        let mut blocks = vec![Vec::new(); cells.pixel_count() as usize];
        let mut block_of = Vec::with_capacity(rect.pixel_count() as usize);
        for y in rect.y0..rect.y1 {
            for x in rect.x0..rect.x1 {
                let block = cells.index(x / spec.block, y / spec.block);
                blocks[block].push(block_of.len() as u32);
                block_of.push(block as u32);
            }
        }
        Self {
            rule: spec.rule,
            folds,
            watches: vec![Watch::default(); block_of.len() * folds],
            ended: vec![0; blocks.len()],
            block_of,
            blocks,
        }
    }

    /// Bytes for each pixel, with blocks of one pixel.
    pub const fn bytes_per_pixel(folds: usize) -> usize {
        let per_block = size_of::<Vec<u32>>() + size_of::<u32>() + size_of::<u16>();
        size_of::<u32>() + folds * size_of::<Watch>() + per_block
    }

    /// Whether the pixel goes on.
    #[inline]
    pub fn is_active(&self, pixel: usize) -> bool {
        !self.is_ended(self.block_of[pixel] as usize)
    }

    #[inline]
    fn is_ended(&self, block: usize) -> bool {
        self.ended[block].count_ones() == self.folds as u32
    }

    /// Notes a sample; whether it enters the estimate.
    #[inline]
    pub fn watch(&mut self, pixel: usize, fold: usize, rgb: Vec3) -> bool {
        if !self.is_active(pixel) {
            return false;
        }
        let y = rgb.as_dvec3().dot(LUMINANCE_WEIGHTS.as_dvec3());
        let watch = &mut self.watches[pixel * self.folds + fold];
        watch.sum += y;
        watch.squares += y * y;
        watch.count += 1;
        self.ended[self.block_of[pixel] as usize] >> fold & 1 == 0
    }

    /// Samples accepted, whatever they served.
    pub fn taken(&self, pixel: usize) -> u64 {
        self.watches(pixel).iter().map(|w| w.count).sum()
    }

    fn watches(&self, pixel: usize) -> &[Watch] {
        &self.watches[pixel * self.folds..][..self.folds]
    }

    /// Ends the folds that have enough. Between passes, at fixed sample counts.
    pub fn decide(&mut self, criterion: &Criterion<'_>) {
        let mut quantiles = Quantiles {
            of: criterion.quantile,
            last: (f64::NAN, f64::NAN),
        };
        for block in 0..self.blocks.len() {
            if self.is_ended(block) {
                continue;
            }
            let mut holds = |without| self.holds(block, without, criterion, &mut quantiles);
            let now = match self.rule {
                StoppingRule::Course => u16::from(holds(None)) * (u16::MAX >> (16 - self.folds)),
                StoppingRule::Folds => (0..self.folds)
                    .filter(|fold| self.ended[block] >> fold & 1 == 0 && holds(Some(*fold)))
                    .fold(0, |bits, fold| bits | 1 << fold),
            };
            self.ended[block] |= now;
        }
    }

    /// Whether the criterion holds on the folds of a block but `without`.
    fn holds(
        &self,
        block: usize,
        without: Option<usize>,
        criterion: &Criterion<'_>,
        quantiles: &mut Quantiles<'_>,
    ) -> bool {
        let pixels = &self.blocks[block];
        let (mut squared, mut freedom) = (0.0, 0.0);
        for &pixel in pixels {
            let watches = self.watches(pixel as usize).iter().enumerate();
            let asked = watches
                .filter(|(fold, w)| Some(*fold) != without && w.count > 0)
                .map(|(_, w)| *w);
            let spread = match criterion.estimator {
                VarianceEstimator::Samples => Spread::of_samples(asked, without, self.folds),
                VarianceEstimator::Replicas => Spread::of_means(asked, self.folds),
            };
            let Some(spread) = spread else {
                return false;
            };
            squared += spread.relative_squared(criterion.floor);
            freedom += spread.freedom;
        }
        let squared = squared / pixels.len() as f64;
        quantiles.get(freedom) * squared.sqrt() <= criterion.tolerance
    }

    /// Adds the counts of the tile's pixels.
    pub fn report(&self, total: &mut AdaptiveReport) {
        for pixel in 0..self.block_of.len() {
            let taken = self.taken(pixel);
            let first = total.pixels == 0;
            total.pixels += 1;
            total.converged += u64::from(!self.is_active(pixel));
            total.taken += taken;
            total.range = match total.range {
                _ if first => (taken, taken),
                (fewest, most) => (fewest.min(taken), most.max(taken)),
            };
        }
    }
}

/// The last quantile is kept: most blocks of a tile have the same degrees of freedom.
struct Quantiles<'a> {
    of: &'a (dyn Fn(f64) -> f64 + Sync),
    last: (f64, f64),
}

impl Quantiles<'_> {
    fn get(&mut self, freedom: f64) -> f64 {
        if self.last.0 != freedom {
            self.last = (freedom, (self.of)(freedom));
        }
        self.last.1
    }
}

/// What some folds tell of a pixel.
struct Spread {
    mean: f64,
    /// Of the mean of all folds.
    variance: f64,
    freedom: f64,
}

impl Spread {
    /// Σ(y − m)²/(n − 1) over the samples, divided by the samples of all `folds`.
    fn of_samples(
        asked: impl Iterator<Item = Watch>,
        without: Option<usize>,
        folds: usize,
    ) -> Option<Self> {
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0u64);
        for watch in asked {
            sum += watch.sum;
            squares += watch.squares;
            count += watch.count;
        }
        if count < 2 {
            return None;
        }
        let n = count as f64;
        // Rounding may leave the difference of two equal numbers below zero.
        let variance = (squares - sum * sum / n).max(0.0) / (n - 1.0);
        let asked_folds = folds - usize::from(without.is_some());
        Some(Self {
            mean: sum / n,
            variance: variance / (n * folds as f64 / asked_folds as f64),
            freedom: n - 1.0,
        })
    }

    /// Σ(m_h − m)²/(n − 1) over the folds, divided by the number of all.
    fn of_means(asked: impl Iterator<Item = Watch> + Clone, folds: usize) -> Option<Self> {
        let means = asked.map(|w| w.sum / w.count as f64);
        let (mut sum, mut n) = (0.0, 0.0);
        for mean in means.clone() {
            sum += mean;
            n += 1.0;
        }
        if n < 2.0 {
            return None;
        }
        let mean = sum / n;
        let spread: f64 = means.map(|m| (m - mean) * (m - mean)).sum();
        Some(Self {
            mean,
            variance: spread / (n - 1.0) / folds as f64,
            freedom: n - 1.0,
        })
    }

    /// A black pixel is black for sure, as far as anybody can tell.
    fn relative_squared(&self, floor: f64) -> f64 {
        if self.variance == 0.0 {
            return 0.0;
        }
        self.variance / (self.mean * self.mean + floor * floor)
    }
}

#[cfg(test)]
mod tests;
