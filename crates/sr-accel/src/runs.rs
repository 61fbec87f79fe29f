//! Nested boxes as one: what keeps the builder of obvhs out of quadratic time.
//!
//! That builder merges, in each pass, the pairs that choose each other among their neighbours on a
//! Morton curve. Of equal boxes each prefers the next one, of boxes that hold one another the next
//! smaller one; so n spheres on one point, or n that touch in one point, take n passes. Such boxes
//! are neighbours on the curve, where those with the same centre come in order of size: a [`Run`].
//! A long run has next to no structure to find, and the box around it is its largest one. obvhs
//! gets that box, and [`Runs::splice`] puts a balanced tree in its place.
//!
//! In an even row each box prefers the next one too, and so do clusters of them in later passes,
//! but there is structure to find. So the boxes for obvhs are a little larger than they are, at
//! random, and ties break one way as often as the other.
//!
//! This steers the costs only: leaves keep their boxes. It does not bound the passes whatever the
//! boxes are: in an even row of boxes smaller than the rounding of their coordinates divided by
//! [`JITTER`], ties can stay.

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;
use sr_math::hash::{mix, unit_f32};
use std::ops::Range;

/// Shorter runs cost obvhs no more passes than other boxes do, so it may as well see them.
const MIN_RUN: usize = 16;
/// Centre, radius and their sum are rounded once each and the box outwards: two units in the last
/// place of the largest coordinate, and as much for the other box.
const SLACK: f32 = 4.0 * f32::EPSILON;
/// By how much of its extent a side of a box moves out at most, to break ties: well above
/// rounding, and far below what the choice of a better pair saves.
const JITTER: f32 = 1.0 / 1024.0;

/// Places on the curve, one or at least [`MIN_RUN`].
type Run = Range<u32>;

/// Boxes in curve order, in runs that cover them all.
pub(crate) struct Runs {
    /// Indices of the boxes.
    order: Vec<u32>,
    runs: Vec<Run>,
    /// A box around each run, and up to [`JITTER`] more.
    pub bounds: Vec<Aabb>,
}

impl Runs {
    /// Of boxes of about unit size.
    pub fn new(boxes: &[Aabb]) -> Self {
        let order = curve_order(boxes);
        let mut out = Self {
            order,
            runs: Vec::new(),
            bounds: Vec::new(),
        };
        let mut start = 0;
        while start < boxes.len() {
            let (len, around) = out.nested_from(start, boxes);
            if len >= MIN_RUN {
                out.runs.push(start as u32..(start + len) as u32);
                out.bounds.push(around);
            } else {
                for place in start..start + len {
                    out.runs.push(place as u32..place as u32 + 1);
                    out.bounds.push(boxes[out.order[place] as usize]);
                }
            }
            start += len;
        }
        for (i, b) in out.bounds.iter_mut().enumerate() {
            let part = |k| JITTER * unit_f32(mix(i as u32, k));
            let extent = b.max - b.min;
            b.min -= extent * Vec3A::new(part(0), part(1), part(2));
            b.max += extent * Vec3A::new(part(3), part(4), part(5));
        }
        out
    }

    /// How many boxes from `start` on each hold the one before, or are each held by it, and the box
    /// around them. What is compared is the union and the intersection of all so far, so that the
    /// slack does not add up.
    fn nested_from(&self, start: usize, boxes: &[Aabb]) -> (usize, Aabb) {
        let first = boxes[self.order[start] as usize];
        let (mut around, mut inside) = (first, first);
        let (mut growing, mut shrinking) = (true, true);
        let mut len = 1;
        for &i in &self.order[start + 1..] {
            let next = &boxes[i as usize];
            growing &= holds(next, &around);
            shrinking &= holds(&inside, next);
            if !growing && !shrinking {
                break;
            }
            around = around.union(next);
            inside = Aabb::new(inside.min.max(next.min), inside.max.min(next.max));
            len += 1;
        }
        (len, around)
    }

    /// Turns the tree over [`Self::bounds`] into one over the boxes, one a leaf.
    pub fn splice(self, bvh: &mut Bvh2, boxes: &[Aabb]) {
        let built = bvh.nodes.len();
        let mut pending = Vec::new();
        for i in 0..built {
            if bvh.nodes[i].is_leaf() {
                let run = bvh.primitive_indices[bvh.nodes[i].first_index as usize];
                pending.push((i, self.runs[run as usize].clone()));
            }
        }
        while let Some((i, run)) = pending.pop() {
            if run.len() == 1 {
                let bounds = boxes[self.order[run.start as usize] as usize];
                bvh.nodes[i] = Bvh2Node::new(bounds, 1, run.start);
                continue;
            }
            let left = bvh.nodes.len();
            // The box of the run serves until those of the children are known.
            let around = *bvh.nodes[i].aabb();
            bvh.nodes[i] = Bvh2Node::new(around, 0, left as u32);
            bvh.nodes.extend([Bvh2Node::new(around, 0, 0); 2]);
            let middle = run.start + run.len() as u32 / 2;
            pending.push((left + 1, middle..run.end));
            pending.push((left, run.start..middle));
        }
        // New nodes lie behind their parents.
        for i in (built..bvh.nodes.len()).rev() {
            let node = bvh.nodes[i];
            if !node.is_leaf() {
                let [a, b] = [0, 1].map(|k| *bvh.nodes[node.first_index as usize + k].aabb());
                bvh.nodes[i] = Bvh2Node::new(a.union(&b), 0, node.first_index);
            }
        }
        bvh.primitive_indices = self.order;
        bvh.parents.clear();
    }
}

/// Whether `b` lies in `a`, but for rounding.
fn holds(a: &Aabb, b: &Aabb) -> bool {
    let size = a.min.abs().max(a.max.abs()).max_element();
    let slack = size * SLACK;
    (a.min - slack).cmple(b.min).all() && (a.max + slack).cmpge(b.max).all()
}

/// The boxes in the order of their centres on the Morton curve, smaller boxes first where centres
/// coincide, so that shells around one point pair with their likes.
fn curve_order(boxes: &[Aabb]) -> Vec<u32> {
    let centre = |b: &Aabb| b.min.as_dvec3() + b.max.as_dvec3();
    let (low, high) = boxes
        .iter()
        .map(centre)
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), c| {
            (low.min(c), high.max(c))
        });
    // The same scale on all axes: cells are cubes.
    let extent = (high - low).max_element();
    let cells = (1u64 << MORTON_BITS) as f64;
    let scale = if extent > 0.0 { cells / extent } else { 0.0 };
    let mut keys: Vec<(u128, u32, u32)> = boxes
        .par_iter()
        .enumerate()
        .map(|(i, b)| {
            // Areas are not negative, so their bits are in their order.
            (
                morton((centre(b) - low) * scale),
                b.half_area().to_bits(),
                i as u32,
            )
        })
        .collect();
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, _, i)| i).collect()
}

/// Bits an axis: cells finer than `f32` coordinates in all but a corner of the scene.
const MORTON_BITS: u32 = 40;

/// The bits of three cell numbers, interleaved.
fn morton(cell: DVec3) -> u128 {
    let last = (1u64 << MORTON_BITS) - 1;
    let spread = |x: f64| {
        let mut bits = u128::from((x as u64).min(last));
        for (step, mask) in SPREAD.iter().enumerate() {
            bits = (bits | (bits << (64 >> step))) & mask;
        }
        bits
    };
    spread(cell.x) | (spread(cell.y) << 1) | (spread(cell.z) << 2)
}

/// Groups of 32, 16, … 1 bits, each followed by twice as many zeros.
const SPREAD: [u128; 6] = [
    bit_groups(32),
    bit_groups(16),
    bit_groups(8),
    bit_groups(4),
    bit_groups(2),
    bit_groups(1),
];

const fn bit_groups(size: u32) -> u128 {
    let mut mask = 0;
    let mut bit = 0;
    while bit < u128::BITS {
        if bit % (3 * size) < size {
            mask |= 1 << bit;
        }
        bit += 1;
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;
    use obvhs::BvhBuildParams;
    use obvhs::bvh2::builder::build_bvh2;
    use std::time::Duration;

    /// Sets of boxes, nested and not.
    fn sets(count: u32) -> Vec<(&'static str, Vec<Aabb>)> {
        let unit = |i: u32, k: u32| unit_f32(mix(i, k));
        let cube = |centre: Vec3A, half: f32| Aabb::new(centre - half, centre + half);
        let of = |make: &dyn Fn(u32, f32) -> Aabb| {
            let boxes = (0..count).map(|i| make(i, (i + 1) as f32 / count as f32));
            boxes.collect()
        };
        let point = |i: u32| Vec3A::new(unit(i, 0), unit(i, 1), unit(i, 2));
        vec![
            ("spread", of(&|i, _| cube(point(i), 0.01))),
            ("equal", of(&|_, _| cube(Vec3A::ONE, 0.5))),
            ("points", of(&|_, _| cube(Vec3A::ONE, 0.0))),
            ("nested, growing", of(&|_, x| cube(Vec3A::ZERO, x))),
            ("nested, shrinking", of(&|_, x| cube(Vec3A::ZERO, 2.0 - x))),
            ("nested in a corner", of(&|_, x| cube(Vec3A::splat(x), x))),
            ("on a line", of(&|_, x| cube(Vec3A::X * x, 0.3))),
            ("areas vanish", of(&|i, _| cube(point(i) * 1e-25, 1e-26))),
            (
                "far apart",
                of(&|i, _| cube(Vec3A::X * (-(i as f32)).exp2(), 0.0)),
            ),
            (
                "through one another",
                of(&|i, _| cube(point(i), unit(i, 3))),
            ),
        ]
    }

    fn build(boxes: &[Aabb]) -> Bvh2 {
        let params = BvhBuildParams {
            max_prims_per_leaf: 1,
            ..BvhBuildParams::medium_build()
        };
        let runs = Runs::new(boxes);
        let mut bvh = build_bvh2(&runs.bounds, params, &mut Duration::default());
        runs.splice(&mut bvh, boxes);
        bvh
    }

    #[test]
    fn trees_hold_every_box_once_and_children_lie_in_their_parents() {
        for count in [1, 2, 3, 15, 16, 17, 33, 4000] {
            for (name, boxes) in sets(count) {
                let bvh = build(&boxes);
                let mut seen = vec![false; boxes.len()];
                let mut pending = vec![0];
                while let Some(i) = pending.pop() {
                    let node = &bvh.nodes[i];
                    let first = node.first_index as usize;
                    if node.is_leaf() {
                        let prim = bvh.primitive_indices[first] as usize;
                        assert_eq!(node.prim_count, 1);
                        assert_eq!(*node.aabb(), boxes[prim]);
                        let again = std::mem::replace(&mut seen[prim], true);
                        assert!(!again, "{name} {count}: {prim} twice");
                    } else {
                        for child in [first, first + 1] {
                            let union = node.aabb().union(bvh.nodes[child].aabb());
                            assert_eq!(*node.aabb(), union, "{name} {count}");
                            pending.push(child);
                        }
                    }
                }
                assert!(seen.iter().all(|&s| s), "{name} {count}");
                assert_eq!(bvh.nodes.len(), 2 * boxes.len() - 1);
            }
        }
    }

    #[test]
    fn nested_boxes_are_one_run_and_others_are_none() {
        for (name, boxes) in sets(1000) {
            let expected = match name {
                "far apart" => 150 + 1, // All others are 0.
                "equal" | "points" => 1,
                _ if name.starts_with("nested") => 1,
                _ => boxes.len(),
            };
            assert_eq!(Runs::new(&boxes).bounds.len(), expected, "{name}");
        }
    }

    #[test]
    fn what_is_shifted_by_less_than_the_slack_each_time_is_not_one_run() {
        let shift = f32::EPSILON * Vec3A::X;
        let boxes: Vec<Aabb> = (0..1000)
            .map(|i| Aabb::new(i as f32 * shift, Vec3A::ONE + i as f32 * shift))
            .collect();
        assert!(Runs::new(&boxes).bounds.len() > 10);
    }

    #[test]
    fn cells_interleave_their_bits_without_loss() {
        for bit in 0..MORTON_BITS {
            let x = (1u64 << bit) as f64;
            assert_eq!(morton(DVec3::X * x), 1 << (3 * bit));
            assert_eq!(morton(DVec3::Y * x), 2 << (3 * bit));
            assert_eq!(morton(DVec3::Z * x), 4 << (3 * bit));
        }
        let all = morton(DVec3::splat(1e30));
        assert_eq!(all, (1 << (3 * MORTON_BITS)) - 1);
    }
}
