//! Ray queries.

use crate::accel::Accel;
use crate::collapse::WideTree;
use crate::flight::Batch;
use crate::lanes::{Job, Lanes, SimdLevel};
use crate::node::{Conservative, SlabMargin};
use crate::ray::{Hit, Ray};
use crate::walk::{DONE, Stack, Walk, is_leaf, stack_len};
use sr_math::Bounds3;
use std::marker::PhantomData;

/// Stacks of single rays of so many entries live in the caller's frame, enough for 7 levels and for 17; a
/// mesh of 50 000 triangles needs 7 or 8. Deeper trees get theirs from the heap.
const SMALL_STACK: usize = 58;
const LARGE_STACK: usize = 128;

impl Accel {
    /// The first hit of each ray.
    ///
    /// # Panics
    /// When the slices differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.closest_with::<Conservative>(SimdLevel::best(), rays, hits);
    }

    /// [`Accel::closest`] on some instruction set and with other margins, for checks of what they are good for.
    #[doc(hidden)]
    pub fn closest_with<M: SlabMargin>(&self, level: SimdLevel, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len(), "one hit a ray");
        match self.tree() {
            None => hits.fill(Hit::MISS),
            Some(tree) => level.run(Batch::<false, M, _> {
                tree,
                bounds: &self.bounds(),
                rays,
                done: |i, hit| hits[i] = hit,
                margin: PhantomData,
            }),
        }
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// When the slices differ in length.
    pub fn occluded(&self, rays: &[Ray], out: &mut [bool]) {
        self.occluded_with::<Conservative>(SimdLevel::best(), rays, out);
    }

    /// [`Accel::occluded`] on some instruction set and with other margins, for checks of what they are good for.
    #[doc(hidden)]
    pub fn occluded_with<M: SlabMargin>(&self, level: SimdLevel, rays: &[Ray], out: &mut [bool]) {
        assert_eq!(rays.len(), out.len(), "one answer a ray");
        match self.tree() {
            None => out.fill(false),
            Some(tree) => level.run(Batch::<true, M, _> {
                tree,
                bounds: &self.bounds(),
                rays,
                done: |i, hit: Hit| out[i] = hit.is_hit(),
                margin: PhantomData,
            }),
        }
    }

    /// The first hit of one ray; batches are faster.
    pub fn closest_one(&self, ray: &Ray) -> Hit {
        self.one::<false>(ray)
    }

    /// Whether one ray hits anything; batches are faster.
    pub fn occluded_one(&self, ray: &Ray) -> bool {
        self.one::<true>(ray).is_hit()
    }

    fn one<const ANY: bool>(&self, ray: &Ray) -> Hit {
        self.tree().map_or(Hit::MISS, |tree| {
            let bounds = &self.bounds();
            SimdLevel::best().run(Single::<ANY> { tree, bounds, ray })
        })
    }
}

/// Asks for the first hit of a ray, or with `ANY` for some hit.
struct Single<'a, const ANY: bool> {
    tree: &'a WideTree,
    bounds: &'a Bounds3,
    ray: &'a Ray,
}

impl<const ANY: bool> Job for Single<'_, ANY> {
    type Out = Hit;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Hit {
        let needed = stack_len(self.tree);
        if needed <= SMALL_STACK {
            self.trace(lanes, &mut [0; SMALL_STACK], &mut [0; SMALL_STACK])
        } else if needed <= LARGE_STACK {
            self.trace(lanes, &mut [0; LARGE_STACK], &mut [0; LARGE_STACK])
        } else {
            self.trace(lanes, &mut vec![0; needed], &mut vec![0; needed])
        }
    }
}

impl<const ANY: bool> Single<'_, ANY> {
    #[inline(always)]
    fn trace<L: Lanes>(&self, lanes: L, keys: &mut [u32], words: &mut [u32]) -> Hit {
        let mut stack = Stack { keys, words };
        let mut walk = Walk::default();
        if !walk.start::<Conservative>(self.ray, self.tree, self.bounds, &mut stack, 0) {
            return Hit::MISS;
        }
        while walk.word != DONE {
            if !is_leaf(walk.word) {
                walk.node::<ANY, L>(lanes, self.tree, &mut stack);
            } else if walk.leaf::<ANY, Conservative, L>(lanes, self.tree) {
                break;
            }
            walk.pop::<ANY>(&stack);
        }
        walk.hit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Portable;
    use crate::{BuildSettings, Geometry, SphereShape};
    use glam::Vec3;
    use sr_math::hash::{mix, unit_f32};

    /// Nested boxes in front of one another: rays along the row visit all of them.
    #[test]
    fn the_stack_that_the_depth_asks_for_is_never_overrun() {
        let mut deepest = 0;
        for ratio in [1.0f32, 1.05, 1.2, 2.0] {
            let sphere = |i: i32| SphereShape {
                center: Vec3::X * ratio.powi(i % 120) * (1 + i / 120) as f32,
                radius: ratio.powi(i % 120) * 0.3,
            };
            let g = Geometry {
                spheres: (0..2000).map(sphere).collect(),
                ..Geometry::default()
            };
            let accel = Accel::build(g, &BuildSettings::default());
            let tree = accel.tree().expect("not empty");
            deepest = deepest.max(tree.depth);
            let (mut keys, mut words) = (vec![0; stack_len(tree)], vec![0; stack_len(tree)]);
            for i in 0..2000u32 {
                let r = |k| unit_f32(mix(i, k)) * 2.0 - 1.0;
                let size = 3f32.powf(r(0));
                let ray = Ray {
                    o: Vec3::new(-size, size * r(1) * 0.1, size * r(2) * 0.1),
                    t_max: f32::INFINITY,
                    d: Vec3::new(1.0, r(3) * 0.1, r(4) * 0.1),
                };
                let bounds = &accel.bounds();
                let (keys, words) = (&mut keys[..], &mut words[..]);
                let (closest, any) = (
                    Single::<false> {
                        tree,
                        bounds,
                        ray: &ray,
                    },
                    Single::<true> {
                        tree,
                        bounds,
                        ray: &ray,
                    },
                );
                let hit = closest.trace(Portable, keys, words);
                assert_eq!(hit, accel.closest_one(&ray));
                assert_eq!(any.trace(Portable, keys, words).is_hit(), hit.is_hit());
            }
        }
        assert!(deepest >= 6, "depth {deepest} tests little");
    }
}
