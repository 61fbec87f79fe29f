//! Walking the tree.

use crate::accel::Accel;
use crate::collapse::WideTree;
use crate::leaf::LeafRay;
use crate::node::{Conservative, LEAF, SlabMargin, SlabRay, WIDTH, leaf_range};
use crate::ray::{Hit, Ray};
use glam::Vec3;
use sr_math::Bounds3;

/// Stacks of this many entries live in the caller's frame: enough for 18 levels, and 50 000
/// triangles of a mesh need 8. Deeper trees get theirs from the heap.
const INLINE_STACK: usize = 128;

/// A child yet to visit: the bits of its lower bound of `t` above its word. Bounds are not
/// negative, so that larger numbers are farther.
type Entry = u64;

#[inline(always)]
fn entry(t: f32, word: u32) -> Entry {
    (u64::from(t.to_bits()) << 32) | u64::from(word)
}

/// A ray ready to walk.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    slabs: SlabRay,
    leaf: LeafRay,
    t_max: f32,
}

/// Refuses rays that cannot hit anything.
#[inline(always)]
fn prepare<M: SlabMargin>(ray: &Ray, bounds: &Bounds3) -> Option<Prepared> {
    let sound = ray.o.is_finite() && ray.d.is_finite() && ray.d != Vec3::ZERO && ray.t_max > 0.0;
    if !sound {
        return None;
    }
    Some(Prepared {
        slabs: SlabRay::new::<M>(ray, bounds),
        leaf: LeafRay::new(ray),
        // A hit at infinity would be an overflow.
        t_max: ray.t_max.min(f32::MAX),
    })
}

impl Accel {
    /// The first hit of each ray.
    ///
    /// # Panics
    /// When the slices differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.closest_with::<Conservative>(rays, hits);
    }

    /// [`Accel::closest`] with other margins, for checks of what they are good for.
    #[doc(hidden)]
    pub fn closest_with<M: SlabMargin>(&self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len(), "one hit a ray");
        let Some(tree) = self.tree() else {
            return hits.fill(Hit::MISS);
        };
        with_stack(tree, |stack| {
            for (ray, hit) in rays.iter().zip(hits) {
                *hit = trace::<false, M>(tree, &self.bounds(), ray, stack);
            }
        });
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// When the slices differ in length.
    pub fn occluded(&self, rays: &[Ray], out: &mut [bool]) {
        self.occluded_with::<Conservative>(rays, out);
    }

    /// [`Accel::occluded`] with other margins, for checks of what they are good for.
    #[doc(hidden)]
    pub fn occluded_with<M: SlabMargin>(&self, rays: &[Ray], out: &mut [bool]) {
        assert_eq!(rays.len(), out.len(), "one answer a ray");
        let Some(tree) = self.tree() else {
            return out.fill(false);
        };
        with_stack(tree, |stack| {
            for (ray, occluded) in rays.iter().zip(out) {
                *occluded = trace::<true, M>(tree, &self.bounds(), ray, stack).is_hit();
            }
        });
    }

    /// The first hit of one ray; batches are faster.
    pub fn closest_one(&self, ray: &Ray) -> Hit {
        self.tree().map_or(Hit::MISS, |tree| {
            with_stack(tree, |s| {
                trace::<false, Conservative>(tree, &self.bounds(), ray, s)
            })
        })
    }

    /// Whether one ray hits anything; batches are faster.
    pub fn occluded_one(&self, ray: &Ray) -> bool {
        self.tree().is_some_and(|tree| {
            with_stack(tree, |s| {
                trace::<true, Conservative>(tree, &self.bounds(), ray, s)
            })
            .is_hit()
        })
    }
}

/// What the tree can fill: on each level all children of a node but the one that is visited.
fn stack_len(tree: &WideTree) -> usize {
    tree.depth * (WIDTH - 1)
}

/// Runs with a stack that the tree cannot overflow.
fn with_stack<T>(tree: &WideTree, run: impl FnOnce(&mut [Entry]) -> T) -> T {
    let needed = stack_len(tree);
    if needed <= INLINE_STACK {
        run(&mut [0; INLINE_STACK])
    } else {
        run(&mut vec![0; needed])
    }
}

/// The first hit of a ray, or with `ANY` some hit.
#[inline(always)]
fn trace<const ANY: bool, M: SlabMargin>(
    tree: &WideTree,
    bounds: &Bounds3,
    ray: &Ray,
    stack: &mut [Entry],
) -> Hit {
    let Some(ray) = prepare::<M>(ray, bounds) else {
        return Hit::MISS;
    };
    let mut best = Hit {
        t: ray.t_max,
        ..Hit::MISS
    };
    let mut t_cull = best.t * M::CULL;
    let mut top = 0;
    let mut word = tree.root;
    loop {
        if word & LEAF == 0 {
            let node = &tree.nodes[word as usize];
            let (mask, t_near) = node.intersect(&ray.slabs, t_cull);
            if mask != 0 {
                word = push_children::<ANY>(stack, &mut top, mask, &t_near, &node.children);
                continue;
            }
        } else {
            let (first, count) = leaf_range(word);
            if tree
                .leaves
                .intersect::<ANY>(first, count, &ray.leaf, &mut best)
            {
                if ANY {
                    return best;
                }
                t_cull = best.t * M::CULL;
            }
        }
        // Nearer hits may have been found since an entry was pushed.
        loop {
            if top == 0 {
                return if best.is_hit() { best } else { Hit::MISS };
            }
            top -= 1;
            let e = stack[top];
            if ANY || f32::from_bits((e >> 32) as u32) <= t_cull {
                word = e as u32;
                break;
            }
        }
    }
}

/// Pushes the children of a mask that is not empty but for one, which is returned: with `ANY` the
/// last, else the nearest, the others sorted so that nearer ones are popped sooner.
#[inline(always)]
fn push_children<const ANY: bool>(
    stack: &mut [Entry],
    top: &mut usize,
    mut mask: u32,
    t_near: &[f32; WIDTH],
    children: &[u32; WIDTH],
) -> u32 {
    let from = *top;
    let mut next = || {
        let i = mask.trailing_zeros() as usize & (WIDTH - 1);
        mask &= mask - 1;
        (entry(t_near[i], children[i]), mask == 0)
    };
    let (mut current, mut last) = next();
    while !last {
        let e;
        (e, last) = next();
        let farther = if ANY || e > current { e } else { current };
        if ANY {
            stack[*top] = current;
            current = e;
        } else {
            current = current.min(e);
            let mut at = *top;
            while at > from && stack[at - 1] < farther {
                stack[at] = stack[at - 1];
                at -= 1;
            }
            stack[at] = farther;
        }
        *top += 1;
    }
    current as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BuildSettings, Geometry, SphereShape};
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
            let mut stack = vec![0; stack_len(tree)];
            for i in 0..2000u32 {
                let r = |k| unit_f32(mix(i, k)) * 2.0 - 1.0;
                let size = 3f32.powf(r(0));
                let ray = Ray {
                    o: Vec3::new(-size, size * r(1) * 0.1, size * r(2) * 0.1),
                    t_max: f32::INFINITY,
                    d: Vec3::new(1.0, r(3) * 0.1, r(4) * 0.1),
                };
                let hit = trace::<false, Conservative>(tree, &accel.bounds(), &ray, &mut stack);
                assert_eq!(hit, accel.closest_one(&ray));
                let any = trace::<true, Conservative>(tree, &accel.bounds(), &ray, &mut stack);
                assert_eq!(any.is_hit(), hit.is_hit());
            }
        }
        assert!(deepest >= 6, "depth {deepest} tests little");
    }
}
