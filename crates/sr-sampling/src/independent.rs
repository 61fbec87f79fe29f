//! Independent uniform numbers.

use crate::{Dim, Sampler};
use glam::Vec2;
use sr_math::hash::{finalize64, mix64, unit_f32};

/// The increment of SplitMix64: the odd number next to 2⁶⁴/φ.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// 64 random bits for a dimension: the SplitMix64 generator (Steele, Lea, Flood 2014), entered at
/// any place of its sequence.
#[inline(always)]
pub(crate) fn dimension_bits(key: u64, dim: Dim) -> u64 {
    finalize64(key.wrapping_add(GOLDEN.wrapping_mul(u64::from(dim.index()) + 1)))
}

/// See [`crate::SamplerSpec::independent`].
#[derive(Clone, Copy, Debug)]
pub struct IndependentSampler {
    key: u64,
}

impl IndependentSampler {
    pub(crate) const fn new(key: u64) -> Self {
        Self { key }
    }
}

impl Sampler for IndependentSampler {
    #[inline]
    fn d1(&self, dim: Dim) -> f32 {
        unit_f32((dimension_bits(self.key, dim) >> 32) as u32)
    }

    #[inline]
    fn d2(&self, dim: Dim) -> Vec2 {
        let bits = dimension_bits(self.key, dim);
        Vec2::new(unit_f32((bits >> 32) as u32), unit_f32(bits as u32))
    }

    #[inline]
    fn split(&self, j: u32, n: u32) -> Self {
        if n == 1 {
            return *self;
        }
        Self::new(mix64(self.key, u64::from(n) << 32 | u64::from(j)))
    }

    #[inline]
    fn fork(&self, k: u32) -> Self {
        if k == 0 {
            return *self;
        }
        Self::new(mix64(self.key, u64::from(k)))
    }
}
