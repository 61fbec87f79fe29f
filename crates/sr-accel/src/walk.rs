//! One ray's way through the tree, step by step.

use crate::collapse::WideTree;
use crate::lanes::{Lanes, farthest_key};
use crate::leaf::LeafRay;
use crate::node::{LEAF, SlabMargin, SlabRay, WIDTH, leaf_range};
use crate::ray::{Hit, Ray};
use glam::Vec3;
use sr_math::Bounds3;

/// The word below all others on a stack: a leaf behind the last that a tree can hold.
pub(crate) const DONE: u32 = u32::MAX;

/// Children yet to visit: their keys, which queries for any hit do without, and their words. Stacks of
/// several rays lie one behind the other.
pub(crate) struct Stack<'a> {
    pub keys: &'a mut [u32],
    pub words: &'a mut [u32],
}

/// Entries that a tree can fill: on each level all children of a node but the one that is visited, the
/// word below them, and room for a whole node on top.
pub(crate) fn stack_len(tree: &WideTree) -> usize {
    1 + tree.depth * (WIDTH - 1) + WIDTH
}

/// A ray on its way.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Walk {
    slabs: SlabRay,
    leaf: LeafRay,
    /// The best hit so far; with none, `t` is the largest that counts.
    best: Hit,
    /// Boxes beyond are culled.
    t_cull: f32,
    /// The same for keys.
    key_cull: u32,
    /// What is visited next.
    pub word: u32,
    /// Where the next entry of the stack goes.
    top: usize,
}

impl Walk {
    /// Puts the ray at the root, with a stack from `base` on; false when it cannot hit anything.
    #[inline(always)]
    pub fn start<M: SlabMargin>(
        &mut self,
        ray: &Ray,
        tree: &WideTree,
        bounds: &Bounds3,
        stack: &mut Stack<'_>,
        base: usize,
    ) -> bool {
        let sound =
            ray.o.is_finite() && ray.d.is_finite() && ray.d != Vec3::ZERO && ray.t_max > 0.0;
        if !sound {
            return false;
        }
        // A hit at infinity would be an overflow.
        let t_max = ray.t_max.min(f32::MAX);
        // Never culled: as near as can be.
        stack.keys[base] = u32::MAX;
        stack.words[base] = DONE;
        self.slabs = SlabRay::new::<M>(ray, bounds);
        self.leaf = LeafRay::new(ray);
        self.best = Hit {
            t: t_max,
            ..Hit::MISS
        };
        self.cull(t_max * M::CULL);
        self.word = tree.root;
        self.top = base + 1;
        true
    }

    /// Visits an inner node: its children go onto the stack.
    #[inline(always)]
    pub fn node<const ANY: bool, L: Lanes>(
        &mut self,
        lanes: L,
        tree: &WideTree,
        stack: &mut Stack<'_>,
    ) {
        let node = &tree.nodes[self.word as usize];
        let room = "the stack is as deep as the tree, and a node more";
        let words = stack.words[self.top..].first_chunk_mut().expect(room);
        self.top += if ANY {
            lanes.any_order(node, &self.slabs, self.t_cull, words)
        } else {
            let keys = stack.keys[self.top..].first_chunk_mut().expect(room);
            lanes.nearest_last(node, &self.slabs, self.t_cull, keys, words)
        };
    }

    /// Visits a leaf; true when its hit is the answer.
    #[inline(always)]
    pub fn leaf<const ANY: bool, M: SlabMargin, L: Lanes>(
        &mut self,
        lanes: L,
        tree: &WideTree,
    ) -> bool {
        let range = leaf_range(self.word);
        let found = tree
            .leaves
            .intersect::<ANY, L>(lanes, range, &self.leaf, &mut self.best);
        if found {
            self.cull(self.best.t * M::CULL);
        }
        ANY && found
    }

    #[inline(always)]
    fn cull(&mut self, t: f32) {
        self.t_cull = t;
        self.key_cull = farthest_key(t);
    }

    /// Takes what is visited next from the stack; in the end that is [`DONE`].
    #[inline(always)]
    pub fn pop<const ANY: bool>(&mut self, stack: &Stack<'_>) {
        self.top -= 1;
        if !ANY {
            // Nearer hits may have been found since an entry was pushed.
            while stack.keys[self.top] < self.key_cull {
                self.top -= 1;
            }
        }
        self.word = stack.words[self.top];
    }

    /// The answer, once the walk is over.
    #[inline(always)]
    pub fn hit(&self) -> Hit {
        if self.best.is_hit() {
            self.best
        } else {
            Hit::MISS
        }
    }
}

/// Whether a word leads to a leaf; so does [`DONE`].
#[inline(always)]
pub(crate) fn is_leaf(word: u32) -> bool {
    word & LEAF != 0
}
