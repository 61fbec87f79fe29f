//! Sums in fixed blocks of samples.
//!
//! Samples are added one by one to the sum of their block, and a block's sum is added to the total
//! when the block is left. The order of additions is thus a property of the sample indices alone:
//! one pass of 64 samples, sixteen of 4, and shards of whole blocks that are merged afterwards
//! round in the same places and agree bit for bit.

use glam::DVec3;

/// Samples of a block. A shard of samples is a whole number of blocks.
const BLOCK_SAMPLES: u64 = 64;

/// The block that a sample belongs to.
#[inline]
pub(crate) const fn block_of(sample: u64) -> u64 {
    sample / BLOCK_SAMPLES
}

/// The sum of the blocks that are done and of the one under way.
#[derive(Clone, Copy, Default)]
pub(crate) struct BlockSum {
    done: DVec3,
    block: DVec3,
}

impl BlockSum {
    /// Adds to the block under way.
    #[inline]
    pub fn add(&mut self, value: DVec3) {
        self.block += value;
    }

    /// Ends the block under way.
    #[inline]
    pub fn fold(&mut self) {
        self.done += self.block;
        self.block = DVec3::ZERO;
    }

    /// The sum of everything added: what it would be if the block under way ended here.
    #[inline]
    pub fn total(&self) -> DVec3 {
        self.done + self.block
    }
}
