//! The binary tree, from the leaves up: neighbours along a Morton curve are merged in passes.
//!
//! In a pass every cluster looks at those near it on the curve for the one whose union with it has
//! the least area, and two that choose each other merge (Meister, Bittner 2018, "Parallel
//! Locally-Ordered Clustering for Bounding Volume Hierarchy Construction").
//!
//! # Why it always ends soon
//! As published, a pass may merge a single pair, and then time and depth are quadratic and linear:
//! of equal boxes each prefers the same side, of boxes nested in one another each prefers the next
//! smaller one (n spheres on one point, n spheres that touch in one point). Here a pass that would
//! merge fewer than one pair in [`SLOWEST`] clusters pairs neighbours on the curve instead. So
//! every pass takes away a share of at least 1/[`SLOWEST`], the passes together look at no more
//! than `SLOWEST · n` clusters, whatever the boxes are, and the tree is at most
//! `SLOWEST · ln n` deep and a few.

use glam::DVec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use rayon::prelude::*;

/// A pass merges at least one pair in so many clusters. Free choice merges one pair in three to
/// six.
const SLOWEST: usize = 16;
/// The first passes, which see the most clusters, look at direct neighbours only.
const NARROW_PASSES: usize = 2;
/// Clusters a task looks at, at least.
const GRAIN: usize = 1024;

/// The tree over boxes.
///
/// `reach` is how far along the curve a cluster looks, to either side. One primitive a leaf; the
/// indices of the primitives are those of the boxes.
///
/// # Panics
/// Without boxes.
pub(crate) fn build(boxes: &[Aabb], reach: usize) -> Bvh2 {
    assert!(!boxes.is_empty(), "a tree has a leaf");
    let mut clusters: Vec<Bvh2Node> = curve_order(boxes)
        .into_iter()
        .map(|i| Bvh2Node::new(boxes[i as usize], 1, i))
        .collect();
    let mut bvh = Bvh2 {
        nodes: vec![Bvh2Node::default(); 2 * boxes.len() - 1],
        primitive_indices: (0..boxes.len() as u32).collect(),
        children_are_ordered_after_parents: true,
        ..Bvh2::default()
    };
    // Filled from the end, so that parents come before children.
    let mut free = bvh.nodes.len();
    for pass in 0.. {
        if clusters.len() == 1 {
            break;
        }
        let reach = if pass < NARROW_PASSES { 1 } else { reach };
        clusters = merge(
            &clusters,
            &partners(&clusters, reach),
            &mut bvh.nodes,
            &mut free,
        );
    }
    bvh.nodes[0] = clusters[0];
    bvh
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

/// Whom each cluster merges with in this pass; itself, where it waits.
fn partners(clusters: &[Bvh2Node], reach: usize) -> Vec<u32> {
    let count = clusters.len();
    let chosen: Vec<u32> = (0..count)
        .into_par_iter()
        .with_min_len(GRAIN)
        .map(|i| best_partner(clusters, i, reach))
        .collect();
    let mutual = |i: usize| chosen[chosen[i] as usize] as usize == i;
    let pairs = (0..count).filter(|&i| mutual(i)).count() / 2;
    if pairs * SLOWEST < count {
        // The last of an odd number waits.
        let beside = |i: usize| if (i ^ 1) < count { i ^ 1 } else { i };
        return (0..count).map(|i| beside(i) as u32).collect();
    }
    (0..count)
        .map(|i| if mutual(i) { chosen[i] } else { i as u32 })
        .collect()
}

/// The cluster near `i` with which it has the least union. Of those that are as good, the one that
/// it would be paired with on the curve, which thinks the same; so equal boxes merge in one pass.
#[inline]
fn best_partner(clusters: &[Bvh2Node], i: usize, reach: usize) -> u32 {
    let own = clusters[i].aabb();
    let area = |k: usize| own.union(clusters[k].aabb()).half_area();
    let last = clusters.len() - 1;
    let mut best = if (i ^ 1) <= last { i ^ 1 } else { i - 1 };
    let mut least = area(best);
    for k in i.saturating_sub(reach)..=(i + reach).min(last) {
        if k == i {
            continue;
        }
        let a = area(k);
        if a < least {
            (best, least) = (k, a);
        }
    }
    best as u32
}

/// The clusters of the next pass, in order on the curve; the children of new ones go to `nodes`.
fn merge(
    clusters: &[Bvh2Node],
    partners: &[u32],
    nodes: &mut [Bvh2Node],
    free: &mut usize,
) -> Vec<Bvh2Node> {
    let mut next = Vec::with_capacity(clusters.len());
    for (i, &partner) in partners.iter().enumerate() {
        let partner = partner as usize;
        if partner == i {
            next.push(clusters[i]);
        } else if partner > i {
            let (left, right) = (clusters[i], clusters[partner]);
            *free -= 2;
            nodes[*free] = left;
            nodes[*free + 1] = right;
            let both = left.aabb().union(right.aabb());
            next.push(Bvh2Node::new(both, 0, *free as u32));
        }
    }
    next
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use glam::Vec3A;

    /// Sets of boxes among which free choice stalls, and one among which it does not.
    pub fn sets(count: u32) -> Vec<(&'static str, Vec<Aabb>)> {
        let unit = |i: u32, k: u32| sr_math::hash::unit_f32(sr_math::hash::mix(i, k));
        let cube = |centre: Vec3A, half: f32| Aabb::new(centre - half, centre + half);
        let of = |make: &dyn Fn(u32, f32) -> Aabb| {
            let boxes = (0..count).map(|i| make(i, (i + 1) as f32 / count as f32));
            boxes.collect()
        };
        let point = |i: u32| Vec3A::new(unit(i, 0), unit(i, 1), unit(i, 2));
        vec![
            ("spread", of(&|i, _| cube(point(i), 0.01))),
            ("equal", of(&|_, _| cube(Vec3A::ONE, 0.5))),
            ("points on one point", of(&|_, _| cube(Vec3A::ONE, 0.0))),
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

    /// Every primitive is in one leaf, and every box around those of its children. Returns the
    /// depth.
    pub fn check(bvh: &Bvh2, boxes: &[Aabb]) -> usize {
        let mut seen = vec![false; boxes.len()];
        let mut pending = vec![(0, 1)];
        let (mut visited, mut deepest) = (0, 0);
        while let Some((i, depth)) = pending.pop() {
            visited += 1;
            assert!(visited <= bvh.nodes.len(), "the nodes are no tree");
            deepest = deepest.max(depth);
            let node = &bvh.nodes[i as usize];
            let first = node.first_index;
            if node.is_leaf() {
                let prim = bvh.primitive_indices[first as usize] as usize;
                assert_eq!(node.prim_count, 1);
                assert_eq!(*node.aabb(), boxes[prim]);
                assert!(!std::mem::replace(&mut seen[prim], true));
            } else {
                let [a, b] = [first, first + 1].map(|k| *bvh.nodes[k as usize].aabb());
                assert_eq!(*node.aabb(), a.union(&b));
                pending.extend([(first, depth + 1), (first + 1, depth + 1)]);
            }
        }
        assert!(seen.iter().all(|&s| s));
        deepest
    }

    #[test]
    fn every_pass_takes_away_its_share_of_the_clusters() {
        for (name, boxes) in sets(3000) {
            for reach in [1, 6, 24] {
                let leaf = |(i, b): (usize, &Aabb)| Bvh2Node::new(*b, 1, i as u32);
                let mut clusters: Vec<_> = boxes.iter().enumerate().map(leaf).collect();
                let mut nodes = vec![Bvh2Node::default(); 2 * boxes.len() - 1];
                let mut free = nodes.len();
                let mut looked_at = 0;
                while clusters.len() > 1 {
                    looked_at += clusters.len();
                    let partners = partners(&clusters, reach);
                    let next = merge(&clusters, &partners, &mut nodes, &mut free);
                    let share = clusters.len().div_ceil(SLOWEST);
                    assert!(clusters.len() - next.len() >= share, "{name} {reach}");
                    clusters = next;
                }
                assert_eq!(free, 1);
                assert!(looked_at <= SLOWEST * boxes.len(), "{name} {looked_at}");
            }
        }
    }

    #[test]
    fn trees_hold_every_box_once_and_are_shallow() {
        for count in [1, 2, 3, 4, 5, 17, 4000] {
            for (name, boxes) in sets(count) {
                let depth = check(&build(&boxes, 14), &boxes);
                let bound = SLOWEST as f64 * f64::from(count).ln() + 2.0;
                assert!((depth as f64) < bound, "{name} {count} {depth}");
            }
        }
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
