//! The eight-wide node, and the boxes as a ray sees them.
//!
//! # Why no box that holds a hit is culled
//! The primitive tests below round. Whatever they answer is the exact answer for a primitive whose
//! points are moved by at most `δ = γ₁₆ R` an axis, R being the largest distance on an axis between
//! the ray's origin and a point of the scene:
//!
//! - Triangle: a sheared coordinate `(p.x − o.x) − s (p.z − o.z)` has |s| ≤ 1 and suffers 1 rounding
//!   of the first term, 3 of the second (s, the difference, the product) and 1 of the sum of size at
//!   most 2R: 6 u R. A product of an edge function rounds once more, of size 2R: 8 u R in all.
//! - Sphere: the nearest point to the centre, `f + (b/a) d`, is off across the ray by γ₃ |f| and
//!   along it by γ₉ |f|; |f| ≤ √3 R.
//!
//! So the slabs are tested for a ray with two origins, moved outward by δ: the near planes are seen
//! from one, the far planes from the other. That adds no operation per node. Moving the origins
//! is rounded outward, which matters far from the origin of the coordinates.
//!
//! What the slab arithmetic itself rounds is relative to its result: a difference, a reciprocal and
//! a product, γ₃ for near and far each. The far side is widened by the sum of both (Ize 2013,
//! "Robust BVH Ray Traversal").

use crate::ray::Ray;
use glam::Vec3;
use sr_math::{Bounds3, gamma};

/// Children of a node.
pub(crate) const WIDTH: usize = 8;
/// The bit of a child word that says leaf.
pub(crate) const LEAF: u32 = 1 << 31;
/// A leaf holds up to 2³ primitives: the low bits of its word hold their number less 1.
pub(crate) const LEAF_COUNT_BITS: u32 = 3;
/// The most primitives, of all kinds together, that [`crate::Accel::build`] takes: 2²⁸. What is left
/// of a leaf's word holds the first of its primitives.
pub const MAX_PRIMS: usize = 1 << (31 - LEAF_COUNT_BITS);

/// Eight boxes and where they lead; 256 bytes, four cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Rows min x, max x, min y, max y, min z, max z. An unused child has an empty box.
    pub planes: [[f32; WIDTH]; 6],
    /// Inner nodes by index; leaves as [`LEAF`] | first << 3 | (count − 1).
    pub children: [u32; WIDTH],
}

/// A child word taken apart: the first leaf slot and the number of primitives.
#[inline(always)]
pub(crate) fn leaf_range(word: u32) -> (usize, usize) {
    let first = (word & !LEAF) >> LEAF_COUNT_BITS;
    let count = (word & ((1 << LEAF_COUNT_BITS) - 1)) + 1;
    (first as usize, count as usize)
}

impl Node {
    /// All children unused.
    pub const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [LEAF; WIDTH],
    };

    /// Fills a child's place.
    pub fn set_child(&mut self, slot: usize, bounds: &Bounds3, word: u32) {
        for axis in 0..3 {
            self.planes[2 * axis][slot] = bounds.min[axis];
            self.planes[2 * axis + 1][slot] = bounds.max[axis];
        }
        self.children[slot] = word;
    }

    /// Which children a ray may have a hit in, at `t` up to `t_cull`, as a bit mask, and a lower
    /// bound of `t` for each of those.
    ///
    /// A difference of 0 times an infinite reciprocal is NaN, where the plane says nothing; the
    /// comparisons are written so that NaN keeps the other operand.
    #[inline(always)]
    pub fn intersect(&self, ray: &SlabRay, t_cull: f32) -> (u32, [f32; WIDTH]) {
        let mut t_near = [0.0f32; WIDTH];
        let mut t_far = [t_cull; WIDTH];
        for axis in 0..3 {
            let s = &ray.axes[axis];
            let near = &self.planes[s.near_row as usize];
            let far = &self.planes[s.far_row as usize];
            for i in 0..WIDTH {
                let a = (near[i] - s.near_origin) * s.near_rcp;
                let b = (far[i] - s.far_origin) * s.far_rcp;
                t_near[i] = if a > t_near[i] { a } else { t_near[i] };
                t_far[i] = if b < t_far[i] { b } else { t_far[i] };
            }
        }
        let mut mask = 0;
        for i in 0..WIDTH {
            mask |= u32::from(t_near[i] <= t_far[i]) << i;
        }
        (mask, t_near)
    }
}

/// By how much boxes are tested wider than they are.
///
/// A type parameter of the traversal, so that a check can show what happens without the margins; the
/// renderer knows [`Conservative`] alone.
pub trait SlabMargin: 'static {
    /// Factor of the far distances, for the slab arithmetic itself.
    const FAR: f32;
    /// Factor of the nearest hit's `t`, beyond which boxes are culled.
    const CULL: f32;

    /// By how much the ray's origin is moved up and down each axis, the scene's farthest point on an axis
    /// being `reach` away.
    fn shift(o: Vec3, reach: f32) -> Vec3;
}

/// The margins that this module's text derives.
#[derive(Clone, Copy, Debug)]
pub struct Conservative;

impl SlabMargin for Conservative {
    /// (1 + γ₃)² and the two roundings of widening, with room.
    const FAR: f32 = 1.0 + 2.0 * gamma(4);
    /// Both `t` and the entry of a box are rounded, the first by at most γ₈, the second by γ₃.
    const CULL: f32 = 1.0 + 2.0 * gamma(8);

    /// δ, the rounding of the moved origin, and those of the shift itself.
    #[inline(always)]
    fn shift(o: Vec3, reach: f32) -> Vec3 {
        gamma(17) * reach + gamma(2) * o.abs()
    }
}

/// What the slab test needs of a ray, for one axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SlabAxis {
    /// The rows of the planes that the ray meets first and last, below 6.
    pub near_row: u32,
    pub far_row: u32,
    pub near_origin: f32,
    pub near_rcp: f32,
    pub far_origin: f32,
    pub far_rcp: f32,
}

/// A ray prepared for [`Node::intersect`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SlabRay {
    pub axes: [SlabAxis; 3],
}

impl SlabRay {
    /// `bounds` holds all that the tree holds.
    ///
    /// Without branches, as no processor foresees the signs of directions.
    #[inline(always)]
    pub fn new<M: SlabMargin>(ray: &Ray, bounds: &Bounds3) -> Self {
        let reach = (bounds.min - ray.o).abs().max((bounds.max - ray.o).abs());
        let rcp = Vec3::ONE / ray.d;
        // Against the direction, away from the far planes.
        let shift = M::shift(ray.o, reach.max_element()).copysign(rcp);
        let (near, far) = (ray.o + shift, ray.o - shift);
        let far_rcp = rcp * M::FAR;
        let axis = |k: usize| SlabAxis {
            near_row: 2 * k as u32 + (rcp[k].to_bits() >> 31),
            far_row: 2 * k as u32 + (!rcp[k].to_bits() >> 31),
            near_origin: near[k],
            near_rcp: rcp[k],
            far_origin: far[k],
            far_rcp: far_rcp[k],
        };
        Self {
            axes: [axis(0), axis(1), axis(2)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one_box(min: Vec3, max: Vec3, o: Vec3, d: Vec3) -> bool {
        let bounds = Bounds3 { min, max };
        let mut node = Node::EMPTY;
        node.set_child(5, &bounds, 0);
        let ray = Ray {
            o,
            t_max: f32::INFINITY,
            d,
        };
        let (mask, _) = node.intersect(&SlabRay::new::<Conservative>(&ray, &bounds), f32::MAX);
        assert_eq!(mask & !(1 << 5), 0, "an unused child was hit");
        mask != 0
    }

    #[test]
    fn a_node_is_four_cache_lines() {
        assert_eq!(size_of::<Node>(), 256);
    }

    #[test]
    fn flat_boxes_are_hit_by_rays_in_their_plane_whatever_the_sign_of_zero() {
        let (min, max) = (Vec3::new(-1.0, 2.0, -1.0), Vec3::new(1.0, 2.0, 1.0));
        for zero in [0.0f32, -0.0] {
            for dir in [1.0f32, -1.0] {
                let o = Vec3::new(-3.0 * dir, 2.0, 0.0);
                assert!(one_box(min, max, o, Vec3::new(dir, zero, zero)));
                let o = Vec3::new(0.5, 2.0 - 3.0 * dir, -1.0);
                assert!(one_box(min, max, o, Vec3::new(zero, dir, zero)));
            }
            // Beside the box and behind it.
            let d = Vec3::new(1.0, zero, zero);
            assert!(!one_box(min, max, Vec3::new(-3.0, 2.001, 0.0), d));
            assert!(!one_box(min, max, Vec3::new(3.0, 2.0, 0.0), d));
        }
    }

    #[test]
    fn a_ray_starting_inside_hits() {
        for i in 0..8 {
            let d = Vec3::new(
                if i & 1 == 0 { 1.0 } else { -1.0 },
                if i & 2 == 0 { 1e-30 } else { -1e-30 },
                if i & 4 == 0 { 0.0 } else { -0.0 },
            );
            assert!(one_box(-Vec3::ONE, Vec3::ONE, Vec3::splat(0.5), d));
        }
    }
}
