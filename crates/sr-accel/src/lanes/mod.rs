//! The two inner loops of a query, for each instruction set.
//!
//! [`Lanes`] tests the eight boxes of a node and the triangles of a leaf. [`Portable`] says what the
//! answers are; the others give the same bits, since they do the same operations in the same order on
//! more numbers at once: no fused and no approximate ones. Which one runs is found out once a batch, and
//! all that it runs is compiled for its instruction set ([`SimdLevel::run`]).

#[cfg(target_arch = "x86_64")]
mod avx2;
mod portable;

pub(crate) use portable::Portable;

use crate::leaf::LeafRay;
use crate::node::{Node, SlabRay, WIDTH};
use crate::triangle::Candidates;

/// Eight children of a node that a ray may have hits in.
pub(crate) type Slots = [u32; WIDTH];

/// The tests of one instruction set. A value of the type is the proof that the machine has it.
///
/// Implementations are `#[inline(always)]` and call no closures: what is not inlined is not compiled for
/// the instruction set.
pub(crate) trait Lanes: Copy {
    /// Which children the ray may have a hit in, at `t` up to `t_cull`: their [`key`]s, the farthest
    /// first, and their words in the same order; and how many those are. Beyond them the slots hold
    /// nothing of meaning.
    fn nearest_last(
        self,
        node: &Node,
        ray: &SlabRay,
        t_cull: f32,
        keys: &mut Slots,
        words: &mut Slots,
    ) -> usize;

    /// As [`Lanes::nearest_last`], in the order of the children and without keys.
    fn any_order(self, node: &Node, ray: &SlabRay, t_cull: f32, words: &mut Slots) -> usize;

    /// Which of `n` triangles, 1 to 8, the ray's line runs through, and how. `pick` says which vertices of
    /// a primitive make the triangle; vertex v has its coordinate on axis k in `rows` from `(3 v + k) n`
    /// on, and seven numbers follow the last row.
    fn triangles(self, rows: &[f32], n: usize, pick: [usize; 3], ray: &LeafRay) -> Candidates;

    /// Asks for the 256 bytes from an address on, which need not be one of ours.
    fn prefetch(self, at: *const u8);
}

/// A child in order of distance: a larger key is nearer. The lower bound of `t` is not negative, so that
/// its bits are in its order; the lane takes the place of the lowest three.
#[inline(always)]
pub(crate) fn key(t_near: f32, lane: usize) -> u32 {
    (!t_near.to_bits() & !LANE_BITS) | lane as u32
}

/// Smaller keys are of children beyond `t`, even by their lower bound.
#[inline(always)]
pub(crate) fn farthest_key(t: f32) -> u32 {
    !t.to_bits() & !LANE_BITS
}

const LANE_BITS: u32 = WIDTH as u32 - 1;

/// What can be run on any [`Lanes`].
pub(crate) trait Job {
    /// Its answer.
    type Out;
    /// Implementations are `#[inline(always)]`, so that they are compiled for the instruction set.
    fn run<L: Lanes>(self, lanes: L) -> Self::Out;
}

/// An instruction set for ray queries. Answers are the same, bit by bit, on all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SimdLevel {
    /// What every machine of the target has.
    Portable,
    /// Eight lanes of x86-64 with AVX2.
    Avx2,
}

impl SimdLevel {
    /// All that this machine has, the best first.
    pub fn available() -> impl Iterator<Item = Self> {
        [Self::Avx2, Self::Portable]
            .into_iter()
            .filter(|level| level.is_available())
    }

    /// The best that this machine has.
    #[inline]
    pub fn best() -> Self {
        if Self::Avx2.is_available() {
            Self::Avx2
        } else {
            Self::Portable
        }
    }

    #[inline]
    fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => avx2::Avx2::detect().is_some(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 => false,
        }
    }

    /// Runs `job` compiled for this level, or for the portable one where the machine lacks it.
    #[inline]
    pub(crate) fn run<J: Job>(self, job: J) -> J::Out {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => match avx2::Avx2::detect() {
                Some(lanes) => lanes.run(job),
                None => job.run(Portable),
            },
            _ => job.run(Portable),
        }
    }
}

#[cfg(test)]
mod tests;
