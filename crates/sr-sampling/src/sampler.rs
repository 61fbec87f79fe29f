//! What all samplers have in common, and how one is made.

use crate::{Dim, IndependentSampler, SobolSampler};
use glam::Vec2;
use sr_math::hash::mix64;

/// The random numbers of one sample of one pixel.
///
/// All lie in `[0, 1)`, on multiples of 2⁻²⁴. Asking twice gives the same answer; `d1(dim)` is the
/// first component of `d2(dim)`, so a decision uses one of the two.
pub trait Sampler: Copy + Send + Sync {
    /// One number.
    fn d1(&self, dim: Dim) -> f32;
    /// Two numbers, well distributed together.
    fn d2(&self, dim: Dim) -> Vec2;

    /// The numbers of sub-sample `j` of `n`, for a decision that one sample takes `n` times.
    ///
    /// Sub-samples of one sample are as well spread together as samples are: those of sample i are
    /// the points i·n to i·n + n − 1 of one sequence. Of one there is only itself.
    #[must_use]
    fn split(&self, j: u32, n: u32) -> Self;

    /// The numbers of the decision number `k` of several that share a [`Dim`], independent of the
    /// others and spread over the samples as they are. Number 0 is the sampler itself.
    #[must_use]
    fn fork(&self, k: u32) -> Self;
}

/// The samplers there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SamplerKind {
    /// Independent uniform numbers.
    Independent,
    /// Owen-scrambled Sobol points, padded two dimensions at a time.
    #[default]
    Sobol,
}

/// What a sampler is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerSpec {
    /// Which points.
    pub kind: SamplerKind,
    /// Another seed, another picture.
    pub seed: u64,
    /// Number of independently scrambled sequences the samples are dealt to in turn; a power of two.
    ///
    /// Samples of one sequence depend on one another, so their own spread says nothing about the
    /// error. The spread of the means of the replicas does.
    pub replicas: u32,
}

impl Default for SamplerSpec {
    fn default() -> Self {
        Self {
            kind: SamplerKind::default(),
            seed: 0,
            replicas: 1,
        }
    }
}

impl SamplerSpec {
    fn pixel_key(&self, [x, y]: [u32; 2]) -> u64 {
        mix64(self.seed, u64::from(x) | u64::from(y) << 32)
    }

    /// The independent numbers of a sample of a pixel (its x and y on the whole film, not in a crop).
    #[inline]
    pub fn independent(&self, pixel: [u32; 2], sample: u64) -> IndependentSampler {
        IndependentSampler::new(mix64(self.pixel_key(pixel), sample))
    }

    /// The Sobol numbers of a sample of a pixel (its x and y on the whole film, not in a crop).
    ///
    /// Sample i belongs to replica i mod `replicas` and is number i / `replicas` of it. Every 2³²
    /// samples a replica starts a new sequence. `replicas` that is no power of two is a mistake
    /// that debug builds catch.
    #[inline]
    pub fn sobol(&self, pixel: [u32; 2], sample: u64) -> SobolSampler {
        debug_assert!(self.replicas.is_power_of_two());
        let replica = sample & u64::from(self.replicas.wrapping_sub(1));
        let index = sample >> self.replicas.trailing_zeros();
        let sequence = replica | (index >> 32) << 32;
        SobolSampler::new(mix64(self.pixel_key(pixel), sequence), index as u32)
    }
}
