//! The tests in plain Rust, four lanes at a time where that pays on every machine.

use super::{Lanes, Slots, key};
use crate::leaf::LeafRay;
use crate::node::{Node, SlabRay, WIDTH};
use crate::triangle::{Candidates, test_lanes};

/// Triangles at once; every machine has registers of four numbers.
const LANES: usize = 4;

/// No instruction set in particular; the oracle of the others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Lanes for Portable {
    #[inline(always)]
    fn nearest_last(
        self,
        node: &Node,
        ray: &SlabRay,
        t_cull: f32,
        keys: &mut Slots,
        words: &mut Slots,
    ) -> usize {
        let (mut mask, t_near) = node.intersect(ray, t_cull);
        let mut count = 0;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & (WIDTH - 1);
            mask &= mask - 1;
            let (k, mut at) = (key(t_near[lane], lane), count);
            while at > 0 && keys[at - 1] > k {
                keys[at] = keys[at - 1];
                words[at] = words[at - 1];
                at -= 1;
            }
            keys[at] = k;
            words[at] = node.children[lane];
            count += 1;
        }
        count
    }

    #[inline(always)]
    fn any_order(self, node: &Node, ray: &SlabRay, t_cull: f32, words: &mut Slots) -> usize {
        let (mut mask, _) = node.intersect(ray, t_cull);
        let mut count = 0;
        while mask != 0 {
            words[count & (WIDTH - 1)] =
                node.children[mask.trailing_zeros() as usize & (WIDTH - 1)];
            mask &= mask - 1;
            count += 1;
        }
        count
    }

    #[inline(always)]
    fn triangles(self, rows: &[f32], n: usize, pick: [usize; 3], ray: &LeafRay) -> Candidates {
        let mut out = Candidates::default();
        for from in (0..n).step_by(LANES) {
            test_lanes::<LANES>(&ray.shear, &ray.o, from, &mut out, |vertex, axis| {
                rows[(pick[vertex] * 3 + axis) * n + from..]
                    .first_chunk()
                    .expect("rows are padded by a set of lanes")
            });
        }
        out.mask &= u32::MAX >> (32 - n);
        out
    }

    #[inline(always)]
    fn prefetch(self, _at: *const u8) {}
}
