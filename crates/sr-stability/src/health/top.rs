//! The brightest samples of all.

use super::moments::Moments;
use std::collections::BTreeMap;

/// One of many samples that are called the brightest.
const ONE_OF: u64 = 10_000;
/// As many are told one by one.
pub(super) const TOLD: usize = 10;

/// A bright sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bright {
    pub luminance: f64,
    /// Index in the grid.
    pub pixel: usize,
    pub sample: u64,
}

/// The brightest so far. Samples are offered block by block in rising order of their index: of equal ones the
/// earlier, and of these the upper left, comes first, whoever offers it.
#[derive(Clone, Debug)]
pub(super) struct Top {
    /// One in 10,000 of all samples.
    count: usize,
    kept: Vec<Bright>,
}

impl Top {
    /// Of so many samples.
    pub fn of(total: u64) -> Self {
        Self {
            count: total.div_ceil(ONE_OF) as usize,
            kept: Vec::new(),
        }
    }

    /// How many count as the brightest.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What a sample of a later block has to exceed to be kept.
    pub fn threshold(&self) -> f64 {
        let last = self.count.max(TOLD) - 1;
        self.kept.get(last).map_or(0.0, |b| b.luminance)
    }

    /// A block's samples above the threshold, in any order.
    pub fn offer(&mut self, block: Vec<Bright>) {
        self.kept.extend(block);
        self.kept.sort_by(|a, b| {
            let bright = b.luminance.total_cmp(&a.luminance);
            bright.then((a.sample, a.pixel).cmp(&(b.sample, b.pixel)))
        });
        self.kept.truncate(self.count.max(TOLD));
    }

    /// The few that are told.
    pub fn told(&self) -> &[Bright] {
        &self.kept[..self.kept.len().min(TOLD)]
    }

    /// Sum of the brightest, and of what each has above the mean of its pixel's samples that are not among them:
    /// a lamp that the camera sees is bright and no outlier.
    pub fn light(&self, pixels: &[Moments]) -> (f64, f64) {
        let top = &self.kept[..self.kept.len().min(self.count)];
        let mut by_pixel: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        for bright in top {
            let (sum, n) = by_pixel.entry(bright.pixel).or_default();
            *sum += bright.luminance;
            *n += 1.0;
        }
        let excess = |(pixel, (sum, n)): (&usize, &(f64, f64))| {
            let all = &pixels[*pixel];
            let others = all.count() - n;
            let mean = if others > 0.0 {
                (all.sum() - sum) / others
            } else {
                0.0
            };
            (sum - n * mean).max(0.0)
        };
        let sum = top.iter().map(|b| b.luminance).sum();
        (sum, by_pixel.iter().map(excess).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bright(luminance: f64, pixel: usize, sample: u64) -> Bright {
        Bright {
            luminance,
            pixel,
            sample,
        }
    }

    #[test]
    fn the_brightest_are_found_whatever_the_order_of_offers() {
        let sample = |i: u64| bright((i * 7919 % 1000) as f64, i as usize % 50, i / 50);
        let mut all: Vec<Bright> = (0..3000).map(sample).collect();
        let mut top = Top::of(3000);
        for block in all.chunks(500) {
            let over = block.iter().filter(|b| b.luminance > top.threshold());
            let over = over.rev().copied().collect();
            top.offer(over);
        }
        all.sort_by(|a, b| b.luminance.total_cmp(&a.luminance));
        assert_eq!(top.count(), 1);
        let found: Vec<f64> = top.told().iter().map(|b| b.luminance).collect();
        let wanted: Vec<f64> = all[..TOLD].iter().map(|b| b.luminance).collect();
        assert_eq!(found, wanted);
        assert!(top.told()[0].sample < top.told()[1].sample);
    }

    #[test]
    fn a_visible_lamp_is_bright_and_has_no_excess() {
        let mut pixels = [Moments::default(); 2];
        (0..100).for_each(|_| pixels[0].add(50.0));
        (0..99).for_each(|_| pixels[1].add(1.0));
        pixels[1].add(41.0);
        let mut top = Top::of(1);
        top.offer(vec![bright(50.0, 0, 0)]);
        let (sum, excess) = top.light(&pixels);
        assert!(sum == 50.0 && excess.abs() < 1e-9, "{sum} {excess}");
        let mut top = Top::of(1);
        top.offer(vec![bright(41.0, 1, 99)]);
        let (_, excess) = top.light(&pixels);
        assert!((excess - 40.0).abs() < 1e-9, "{excess}");
    }
}
