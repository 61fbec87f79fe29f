//! Many rays on their way at once.
//!
//! A ray alone waits: for a node that is not in the cache, for a branch that was foreseen wrongly. Of the
//! rays in flight here, those at inner nodes all make a step, then those at leaves; what one will read
//! is asked for while the others move, and each loop does one thing. That is worth more than the
//! coherence it gives up (measured against single rays by `benches/rays.rs`).

use crate::collapse::WideTree;
use crate::lanes::{Job, Lanes};
use crate::leaf::LEAF_STRIDE;
use crate::node::{SlabMargin, leaf_range};
use crate::ray::{Hit, Ray};
use crate::walk::{DONE, Stack, Walk, is_leaf, stack_len};
use sr_math::Bounds3;
use std::hint::select_unpredictable;
use std::marker::PhantomData;

/// Rays in flight. From 16 to 64 the rate is the same.
const SEATS: usize = 32;

/// Asks for the first hits of rays, or with `ANY` for some hits; `done` gets a ray's number and its hit,
/// in no particular order.
pub(crate) struct Batch<'a, const ANY: bool, M, F> {
    pub tree: &'a WideTree,
    pub bounds: &'a Bounds3,
    pub rays: &'a [Ray],
    pub done: F,
    pub margin: PhantomData<M>,
}

impl<const ANY: bool, M: SlabMargin, F: FnMut(usize, Hit)> Job for Batch<'_, ANY, M, F> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let depth = stack_len(self.tree);
        let mut flight = Flight::<ANY, L, M, F> {
            lanes,
            depth,
            walks: [Walk::default(); SEATS],
            numbers: [0; SEATS],
            keys: vec![0; SEATS * depth],
            words: vec![0; SEATS * depth],
            next: 0,
            at_nodes: Queue::default(),
            at_leaves: Queue::default(),
            batch: self,
        };
        for seat in 0..SEATS {
            flight.board(seat);
        }
        while flight.at_nodes.len + flight.at_leaves.len > 0 {
            flight.visit_nodes();
            flight.visit_leaves();
        }
    }
}

/// Seats, and room for one more.
#[derive(Clone, Copy)]
struct Queue {
    seats: [u8; SEATS + 1],
    len: usize,
}

impl Default for Queue {
    fn default() -> Self {
        Self {
            seats: [0; SEATS + 1],
            len: 0,
        }
    }
}

impl Queue {
    /// Adds a seat, if `really`: a decision without a branch.
    #[inline(always)]
    fn push_if(&mut self, really: bool, seat: usize) {
        self.seats[self.len] = seat as u8;
        self.len += usize::from(really);
    }
}

struct Flight<'a, const ANY: bool, L, M, F> {
    lanes: L,
    batch: Batch<'a, ANY, M, F>,
    /// Entries of a seat's stack.
    depth: usize,
    walks: [Walk; SEATS],
    /// The ray in each seat.
    numbers: [usize; SEATS],
    keys: Vec<u32>,
    words: Vec<u32>,
    /// The ray that boards next.
    next: usize,
    at_nodes: Queue,
    at_leaves: Queue,
}

impl<const ANY: bool, L: Lanes, M: SlabMargin, F: FnMut(usize, Hit)> Flight<'_, ANY, L, M, F> {
    /// Seats the next ray that can hit anything, if there is one.
    #[inline(always)]
    fn board(&mut self, seat: usize) {
        while let Some(ray) = self.batch.rays.get(self.next) {
            let number = self.next;
            self.next += 1;
            let stack = &mut Stack {
                keys: &mut self.keys,
                words: &mut self.words,
            };
            let (tree, bounds) = (self.batch.tree, self.batch.bounds);
            let base = seat * self.depth;
            if self.walks[seat].start::<M>(ray, tree, bounds, stack, base) {
                self.numbers[seat] = number;
                return self.enqueue(seat);
            }
            (self.batch.done)(number, Hit::MISS);
        }
    }

    /// Hands in a seat's answer and seats the next ray.
    #[inline(always)]
    fn land(&mut self, seat: usize) {
        (self.batch.done)(self.numbers[seat], self.walks[seat].hit());
        self.board(seat);
    }

    /// Puts a seat where its ray goes next, and asks for what is there. Which of both it is, a node or a
    /// leaf, no processor can foresee, so nothing here branches on it.
    #[inline(always)]
    fn enqueue(&mut self, seat: usize) {
        let word = self.walks[seat].word;
        let tree = self.batch.tree;
        let (leaf, (first, _)) = (is_leaf(word), leaf_range(word));
        let (node, head) = (tree.nodes.as_ptr(), tree.leaves.head());
        self.lanes.prefetch(select_unpredictable(
            leaf,
            head.wrapping_add(first * LEAF_STRIDE).cast(),
            node.wrapping_add(word as usize).cast(),
        ));
        self.at_leaves.push_if(leaf, seat);
        self.at_nodes.push_if(!leaf, seat);
    }

    #[inline(always)]
    fn go_on(&mut self, seat: usize) {
        let stack = Stack {
            keys: &mut self.keys,
            words: &mut self.words,
        };
        self.walks[seat].pop::<ANY>(&stack);
        if self.walks[seat].word == DONE {
            self.land(seat);
        } else {
            self.enqueue(seat);
        }
    }

    #[inline(always)]
    fn visit_nodes(&mut self) {
        let queue = std::mem::take(&mut self.at_nodes);
        for &seat in &queue.seats[..queue.len] {
            let seat = usize::from(seat) % SEATS;
            let mut stack = Stack {
                keys: &mut self.keys,
                words: &mut self.words,
            };
            self.walks[seat].node::<ANY, L>(self.lanes, self.batch.tree, &mut stack);
            self.go_on(seat);
        }
    }

    #[inline(always)]
    fn visit_leaves(&mut self) {
        let queue = std::mem::take(&mut self.at_leaves);
        for &seat in &queue.seats[..queue.len] {
            let seat = usize::from(seat) % SEATS;
            if self.walks[seat].leaf::<ANY, M, L>(self.lanes, self.batch.tree) {
                self.land(seat);
            } else {
                self.go_on(seat);
            }
        }
    }
}
