//! Ray queries in `f64`: textbook intersections behind a tree of boxes.

use sr_pipeline::accel::Geometry;
use sr_pipeline::accel::oracle::{Line, OracleHit, bounds, intersect};
use sr_pipeline::accel::{PRIM_NONE, Prim};
use sr_pipeline::glam::DVec3;
use sr_pipeline::math::gamma_of;

/// Primitives of a leaf.
const LEAF: usize = 4;

/// A ray, and the surfaces at its ends, which it cannot meet there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub line: Line,
    /// The primitive that it leaves, or [`PRIM_NONE`].
    pub leaves: u32,
    /// The primitive that it leads to, or [`PRIM_NONE`].
    pub reaches: u32,
}

/// Boxes around boxes; each inner one is split at the middle primitive of its longest side.
pub(super) struct Tree<'a> {
    geometry: &'a Geometry,
    nodes: Vec<Node>,
    order: Vec<u32>,
}

struct Node {
    low: DVec3,
    high: DVec3,
    /// The first of the primitives of a leaf, or the first of two children that follow one another.
    first: u32,
    /// Primitives; 0 for an inner node.
    count: u32,
}

impl<'a> Tree<'a> {
    pub fn new(geometry: &'a Geometry) -> Self {
        let all = 0..geometry.prim_count() as u32;
        let boxes: Vec<_> = all.map(|prim| bounds(geometry, prim)).collect();
        let order = (0u32..)
            .zip(&boxes)
            .filter_map(|(prim, b)| b.is_some().then_some(prim));
        let mut tree = Self {
            geometry,
            order: order.collect(),
            nodes: Vec::new(),
        };
        let boxes: Vec<[DVec3; 2]> = boxes.into_iter().map(Option::unwrap_or_default).collect();
        if !tree.order.is_empty() {
            tree.nodes.push(tree.leaf(&boxes, 0, tree.order.len()));
        }
        let mut next = 0;
        while next < tree.nodes.len() {
            tree.split(&boxes, next);
            next += 1;
        }
        tree
    }

    fn leaf(&self, boxes: &[[DVec3; 2]], first: usize, count: usize) -> Node {
        let mut node = Node {
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
            first: first as u32,
            count: count as u32,
        };
        for prim in &self.order[first..first + count] {
            let [low, high] = boxes[*prim as usize];
            node.low = node.low.min(low);
            node.high = node.high.max(high);
        }
        node
    }

    /// Makes an inner node of a leaf that has too many primitives.
    fn split(&mut self, boxes: &[[DVec3; 2]], index: usize) {
        let (first, count) = (
            self.nodes[index].first as usize,
            self.nodes[index].count as usize,
        );
        if count <= LEAF {
            return;
        }
        let side = (self.nodes[index].high - self.nodes[index].low).max_position();
        let middle = |prim: &u32| {
            let [low, high] = boxes[*prim as usize];
            low[side] + high[side]
        };
        let half = count / 2;
        self.order[first..first + count]
            .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        let children = [
            self.leaf(boxes, first, half),
            self.leaf(boxes, first + half, count - half),
        ];
        self.nodes[index].first = self.nodes.len() as u32;
        self.nodes[index].count = 0;
        self.nodes.extend(children);
    }

    /// The first surface on the way; of several at the same place, that with the smallest number.
    pub fn closest(&self, way: &Way) -> Option<OracleHit> {
        let mut best = OracleHit::MISS;
        self.visit(way, |hit| {
            if hit.t < best.t || hit.t == best.t && hit.prim < best.prim {
                best = hit;
            }
            best.t
        });
        (best.prim != PRIM_NONE).then_some(best)
    }

    /// Whether anything stands in the way.
    pub fn occluded(&self, way: &Way) -> bool {
        let mut found = false;
        self.visit(way, |_| {
            found = true;
            f64::NEG_INFINITY
        });
        found
    }

    /// Shows all hits; what the caller answers is how far it still looks.
    fn visit(&self, way: &Way, mut see: impl FnMut(OracleHit) -> f64) {
        let mut far = way.line.t_max;
        let mut stack = Vec::with_capacity(64);
        stack.extend((!self.nodes.is_empty()).then_some(0u32));
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !node.is_met(&way.line, far) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.first + 1, node.first]);
                continue;
            }
            let first = node.first as usize;
            for prim in &self.order[first..first + node.count as usize] {
                if let Some(hit) = self.hit(*prim, way) {
                    far = far.min(see(hit));
                }
            }
        }
    }

    fn hit(&self, prim: u32, way: &Way) -> Option<OracleHit> {
        if prim == way.reaches {
            return None;
        }
        if prim != way.leaves {
            return intersect(self.geometry, prim, &way.line);
        }
        // A flat surface is not met again. Of a sphere's two points one is where the way begins, the sum of both
        // is −2 f·d/d².
        let Prim::Sphere(i) = self.geometry.kind(prim) else {
            return None;
        };
        let from_center = way.line.o - self.geometry.spheres[i as usize].center.as_dvec3();
        let t = -2.0 * from_center.dot(way.line.d) / way.line.d.length_squared();
        let (u, v) = (0.0, 0.0);
        (t > 0.0 && t <= way.line.t_max).then_some(OracleHit { t, u, v, prim })
    }
}

impl Node {
    /// Whether the box may be met before `far`. Both ends of an interval round twice, and the comparison allows for
    /// three (Ize 2013, "Robust BVH Ray Traversal").
    fn is_met(&self, line: &Line, far: f64) -> bool {
        let (mut enter, mut leave) = (0.0f64, far);
        for k in 0..3 {
            let (o, d) = (line.o[k], line.d[k]);
            if d == 0.0 {
                if o < self.low[k] || o > self.high[k] {
                    return false;
                }
                continue;
            }
            let (a, b) = ((self.low[k] - o) / d, (self.high[k] - o) / d);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b) * (1.0 + 2.0 * gamma_of::<f64>(3)));
        }
        enter <= leave
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_pipeline::accel::oracle::brute_force_closest;
    use sr_pipeline::accel::{QuadShape, Ray, SphereShape};
    use sr_pipeline::glam::Vec3;
    use sr_pipeline::math::hash::{mix, unit_f32};

    fn number(i: u32, k: u32) -> f32 {
        2.0 * unit_f32(mix(i, k)) - 1.0
    }

    fn place(i: u32, k: u32) -> Vec3 {
        Vec3::new(number(i, k), number(i, k + 1), number(i, k + 2))
    }

    #[test]
    fn nothing_is_met_where_nothing_is() {
        let geometry = Geometry::default();
        let line = Line {
            o: DVec3::ZERO,
            d: DVec3::X,
            t_max: f64::INFINITY,
        };
        let way = Way {
            line,
            leaves: PRIM_NONE,
            reaches: PRIM_NONE,
        };
        assert_eq!(Tree::new(&geometry).closest(&way), None);
    }

    fn clutter() -> Geometry {
        let mut all = Geometry::default();
        for i in 0..200 {
            let corner = 4.0 * place(i, 0);
            let at = all.positions.len() as u32;
            all.positions
                .extend([corner, corner + place(i, 3), corner + place(i, 6)]);
            all.triangles.push([at, at + 1, at + 2]);
            all.spheres.push(SphereShape {
                center: 4.0 * place(i, 9),
                radius: 0.3 * number(i, 12).abs() + 0.01,
            });
            all.quads.push(QuadShape {
                corner: 4.0 * place(i, 13),
                edge_u: Vec3::X,
                edge_v: place(i, 16),
            });
        }
        all
    }

    #[test]
    fn the_tree_answers_as_brute_force_does() {
        let geometry = clutter();
        let tree = Tree::new(&geometry);
        let mut hits = 0;
        for i in 0..500 {
            let ray = Ray {
                o: 5.0 * place(i, 20),
                d: place(i, 23),
                t_max: f32::INFINITY,
            };
            let way = Way {
                line: Line::from(&ray),
                leaves: PRIM_NONE,
                reaches: PRIM_NONE,
            };
            let wanted = brute_force_closest(&geometry, &ray);
            let found = tree.closest(&way).unwrap_or(OracleHit::MISS);
            assert_eq!(found, wanted);
            assert_eq!(tree.occluded(&way), wanted.prim != PRIM_NONE);
            hits += u32::from(wanted.prim != PRIM_NONE);
        }
        assert!((100..500).contains(&hits), "{hits}");
    }
}
