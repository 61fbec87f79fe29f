//! Every level against the portable one, bit by bit.

use super::*;
use crate::node::Conservative;
use crate::ray::Ray;
use crate::triangle::Candidate;
use glam::Vec3;
use sr_math::Bounds3;
use sr_math::hash::{mix, unit_f32};

fn random(i: u32, k: u32) -> f32 {
    unit_f32(mix(i, k)) * 2.0 - 1.0
}

fn point(i: u32, k: u32) -> Vec3 {
    Vec3::new(random(i, k), random(i, k + 1), random(i, k + 2))
}

/// Rays from anywhere; each fourth one has a direction, and each sixth an origin, with zeros.
fn ray(i: u32) -> Ray {
    let mut d = point(i, 0);
    let mut o = point(i, 3) * if i % 4 == 2 { 0.2 } else { 2.0 };
    if i.is_multiple_of(4) {
        d[i as usize / 4 % 3] = if i.is_multiple_of(8) { 0.0 } else { -0.0 };
    }
    if i.is_multiple_of(6) {
        o[i as usize / 6 % 3] = 0.0;
    }
    let t_max = if i.is_multiple_of(5) {
        0.7
    } else {
        f32::INFINITY
    };
    Ray { o, t_max, d }
}

/// Boxes here and there, as many as `i` says; in each fifth node some flat in planes of the axes.
fn node(i: u32) -> Node {
    let mut node = Node::EMPTY;
    for slot in 0..i % 9 {
        let (a, b) = (point(i, 10 + 8 * slot), point(i, 14 + 8 * slot));
        let mut bounds = Bounds3::from_points([a, b]);
        if i.is_multiple_of(2) {
            // Around the middle, where more rays pass.
            bounds = Bounds3::from_points([a.abs(), -b.abs()]);
        }
        if i.is_multiple_of(5) && slot.is_multiple_of(3) {
            bounds.min[slot as usize / 3] = 0.0;
            bounds.max[slot as usize / 3] = 0.0;
        }
        node.set_child(slot as usize, &bounds, mix(i, slot));
    }
    node
}

/// What the tests of nodes answer.
struct Nodes;

impl Job for Nodes {
    type Out = Vec<(Vec<u32>, Vec<u32>, Vec<u32>)>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Out {
        let world = Bounds3::from_points([Vec3::NEG_ONE, Vec3::ONE]);
        let answer = |i| {
            let (node, ray) = (node(i), ray(i));
            let slabs = SlabRay::new::<Conservative>(&ray, &world);
            let t_cull = ray.t_max.min(f32::MAX);
            let (mut keys, mut words, mut any) = ([0; WIDTH], [0; WIDTH], [0; WIDTH]);
            let n = lanes.nearest_last(&node, &slabs, t_cull, &mut keys, &mut words);
            let m = lanes.any_order(&node, &slabs, t_cull, &mut any);
            (keys[..n].to_vec(), words[..n].to_vec(), any[..m].to_vec())
        };
        (0..50_000).map(answer).collect()
    }
}

#[test]
fn nodes_have_the_same_children_in_the_same_order_on_all_levels() {
    let expected = SimdLevel::Portable.run(Nodes);
    let full = expected.iter().filter(|(keys, ..)| keys.len() == WIDTH);
    assert!(full.count() > 10, "whole nodes are rare");
    for (keys, words, any) in &expected {
        assert!(keys.is_sorted(), "the farthest first: {keys:?}");
        let (mut words, mut any) = (words.clone(), any.clone());
        words.sort_unstable();
        any.sort_unstable();
        assert_eq!(words, any);
    }
    for level in SimdLevel::available() {
        assert_eq!(level.run(Nodes), expected, "{level:?}");
    }
}

/// A child is culled if and only if its lower bound is beyond, but for the bits that the lane takes.
#[test]
fn keys_cull_what_their_bounds_cull() {
    for i in 0..10_000 {
        let t = unit_f32(mix(i, 0)).powi(8) * 1e20;
        for lane in 0..WIDTH {
            let k = key(t, lane);
            assert!(k >= farthest_key(t), "{t} culls itself");
            let nearer = t * (1.0 - 16.0 * f32::EPSILON);
            assert!(t < f32::MIN_POSITIVE || k < farthest_key(nearer), "{t}");
        }
    }
}

/// What the test of triangles answers for leaves of 1 to 8.
struct Leaves;

impl Job for Leaves {
    type Out = Vec<Vec<(usize, [u32; 6])>>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Out {
        let answer = |i: u32| {
            let n = (i % 8 + 1) as usize;
            // Beside triangles of any size flat ones in planes of the axes, and rays at their edges.
            let mut rows: Vec<f32> = (0..12 * n as u32).map(|k| random(i, 20 + k)).collect();
            if i.is_multiple_of(3) {
                rows.iter_mut().for_each(|x| *x = x.signum());
            }
            rows.extend([0.0; WIDTH]);
            let pick = if i.is_multiple_of(2) {
                [0, 1, 2]
            } else {
                [0, 2, 3]
            };
            let found = lanes.triangles(&rows, n, pick, &LeafRay::new(&ray(i)));
            let hit = (0..n).filter(|k| found.mask >> k & 1 == 1);
            let bits = |k| {
                let Candidate {
                    weights: [a, b, c],
                    depths: [d, e, f],
                } = found.get(k);
                (k, [a, b, c, d, e, f].map(f32::to_bits))
            };
            assert_eq!(found.mask >> n, 0, "beyond the leaf");
            hit.map(bits).collect()
        };
        (0..50_000).map(answer).collect()
    }
}

#[test]
fn triangles_have_the_same_bits_on_all_levels() {
    let expected = SimdLevel::Portable.run(Leaves);
    let hits: usize = expected.iter().map(Vec::len).sum();
    assert!(hits > 5_000, "{hits} tell little");
    let beyond = expected.iter().flatten().filter(|(k, _)| *k >= 4);
    assert!(beyond.count() > 1_000, "second sets of lanes are rare");
    for level in SimdLevel::available() {
        assert_eq!(level.run(Leaves), expected, "{level:?}");
    }
}
