//! From the binary tree to the eight-wide one, at least cost.
//!
//! The surface area cost of a wide tree is a sum over its nodes and leaves, and what a subtree
//! costs as a forest of at most k trees depends on its children alone. So the cheapest collapse
//! follows by dynamic programming from the leaves up (Ylitie, Karras, Laine 2017, "Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", §3.2). A leaf holds one kind of
//! primitive.
//!
//! The boxes of the binary tree steer the costs only; those of the wide tree are made anew from the
//! primitives, so that nothing has to be known about how the builder rounds.

use crate::geometry::{Geometry, Prim};
use crate::leaf::Leaves;
use crate::node::{LEAF, LEAF_COUNT_BITS, Node, WIDTH};
use obvhs::bvh2::Bvh2;
use sr_math::Bounds3;

/// The most primitives of a leaf.
const MAX_LEAF: u32 = 1 << LEAF_COUNT_BITS;
/// What a visit costs: a node, and a leaf, whatever it holds. Flat over a factor of 2 either way.
const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 0.6;

/// The wide tree.
#[derive(Clone, Debug)]
pub(crate) struct WideTree {
    pub nodes: Vec<Node>,
    pub leaves: Leaves,
    pub root: u32,
    /// Nodes on the longest way from the root to a leaf.
    pub depth: usize,
}

/// The kind of all primitives of a subtree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Triangles,
    Spheres,
    Quads,
    Mixed,
}

/// The cheapest ways to turn one binary subtree into wide trees.
#[derive(Clone, Copy, Debug)]
struct Plan {
    /// `cost[k − 1]`: as a forest of at most k trees.
    cost: [f32; WIDTH],
    /// How many trees of a forest of k go to the left child; 0: k − 1 trees are as good.
    left_share: [u8; WIDTH],
    /// As a node of its own: how many of its eight children come from the left.
    node_left_share: u8,
    /// As a single tree: a leaf rather than a node.
    is_leaf: bool,
    kind: Kind,
    count: u32,
    bounds: Bounds3,
}

/// The binary tree with what it was built over.
pub(crate) struct Source<'a> {
    pub bvh: &'a Bvh2,
    /// Primitive ids by the builder's index.
    pub prims: &'a [u32],
    /// Boxes by the builder's index.
    pub bounds: &'a [Bounds3],
    pub geometry: &'a Geometry,
}

/// Collapses a tree that is not empty.
pub(crate) fn collapse(source: &Source, leaves: Leaves) -> WideTree {
    let mut emitter = Emitter {
        plans: plan_all(source),
        source,
        tree: WideTree {
            nodes: Vec::new(),
            leaves,
            root: 0,
            depth: 0,
        },
    };
    emitter.emit();
    emitter.tree.leaves.finish();
    emitter.tree
}

/// Plans of all nodes, by node index.
fn plan_all(source: &Source) -> Vec<Plan> {
    let nodes = &source.bvh.nodes;
    // Parents before children; walked backwards, children come first.
    let mut order = Vec::with_capacity(nodes.len());
    let mut pending = vec![0u32];
    while let Some(i) = pending.pop() {
        order.push(i);
        let node = &nodes[i as usize];
        if !node.is_leaf() {
            pending.extend([node.first_index, node.first_index + 1]);
        }
    }
    let unused = Plan::single(Kind::Mixed, 0.0, Bounds3::EMPTY);
    let mut plans = vec![unused; nodes.len()];
    for &i in order.iter().rev() {
        let node = &nodes[i as usize];
        let area = node.aabb().half_area();
        let first = node.first_index as usize;
        plans[i as usize] = if node.is_leaf() {
            let index = source.bvh.primitive_indices[first] as usize;
            let kind = match source.geometry.kind(source.prims[index]) {
                Prim::Triangle(_) => Kind::Triangles,
                Prim::Sphere(_) => Kind::Spheres,
                Prim::Quad(_) => Kind::Quads,
            };
            Plan::single(kind, area, source.bounds[index])
        } else {
            Plan::merge(&plans[first], &plans[first + 1], area)
        };
    }
    plans
}

impl Plan {
    /// For one primitive.
    fn single(kind: Kind, area: f32, bounds: Bounds3) -> Self {
        Self {
            cost: [area * LEAF_COST; WIDTH],
            left_share: [0; WIDTH],
            node_left_share: 0,
            is_leaf: true,
            kind,
            count: 1,
            bounds,
        }
    }

    /// For an inner node.
    fn merge(left: &Self, right: &Self, area: f32) -> Self {
        let mut cost = [f32::INFINITY; WIDTH];
        let mut left_share = [0; WIDTH];
        for k in 2..=WIDTH {
            for l in 1..k {
                let c = left.cost[l - 1] + right.cost[k - l - 1];
                if c < cost[k - 1] {
                    cost[k - 1] = c;
                    left_share[k - 1] = l as u8;
                }
            }
        }
        let count = left.count + right.count;
        let kind = if left.kind == right.kind {
            left.kind
        } else {
            Kind::Mixed
        };
        let as_leaf = if kind != Kind::Mixed && count <= MAX_LEAF {
            area * LEAF_COST
        } else {
            f32::INFINITY
        };
        let as_node = cost[WIDTH - 1] + area * NODE_COST;
        let node_left_share = left_share[WIDTH - 1];
        cost[0] = as_leaf.min(as_node);
        for k in 1..WIDTH {
            if cost[k - 1] <= cost[k] {
                cost[k] = cost[k - 1];
                left_share[k] = 0;
            }
        }
        Self {
            cost,
            left_share,
            node_left_share,
            is_leaf: as_leaf <= as_node,
            kind,
            count,
            bounds: left.bounds.union(right.bounds),
        }
    }
}

/// Writes the wide tree as planned.
struct Emitter<'a> {
    plans: Vec<Plan>,
    source: &'a Source<'a>,
    tree: WideTree,
}

impl Emitter<'_> {
    /// Depth first, the children of a node next to one another.
    fn emit(&mut self) {
        if self.plans[0].is_leaf {
            self.tree.root = self.emit_leaf(0);
            return;
        }
        self.tree.nodes.push(Node::EMPTY);
        let mut pending = vec![(0u32, 0u32, 1usize)];
        let mut children = Vec::with_capacity(WIDTH);
        while let Some((binary, wide, depth)) = pending.pop() {
            self.tree.depth = self.tree.depth.max(depth);
            self.children(binary, &mut children);
            let mut node = Node::EMPTY;
            let below = pending.len();
            for (slot, &child) in children.iter().enumerate() {
                let plan = &self.plans[child as usize];
                let bounds = plan.bounds;
                let word = if plan.is_leaf {
                    self.emit_leaf(child)
                } else {
                    let index = self.tree.nodes.len() as u32;
                    self.tree.nodes.push(Node::EMPTY);
                    pending.push((child, index, depth + 1));
                    index
                };
                node.set_child(slot, &bounds, word);
            }
            pending[below..].reverse();
            self.tree.nodes[wide as usize] = node;
        }
    }

    /// The binary nodes that become the children of a wide node, the largest first, so that an
    /// occlusion query, which takes them as they come, finds its hit soon.
    fn children(&self, binary: u32, out: &mut Vec<u32>) {
        out.clear();
        let left = self.source.bvh.nodes[binary as usize].first_index;
        let share = usize::from(self.plans[binary as usize].node_left_share);
        self.forest(left, share, out);
        self.forest(left + 1, WIDTH - share, out);
        let area = |&i: &u32| self.source.bvh.nodes[i as usize].aabb().half_area();
        out.sort_by(|a, b| area(b).total_cmp(&area(a)));
    }

    /// The roots of the cheapest forest of at most `k` trees. Each level of the recursion divides
    /// `k`, so it is at most eight deep.
    fn forest(&self, binary: u32, mut k: usize, out: &mut Vec<u32>) {
        let plan = &self.plans[binary as usize];
        while k > 1 && plan.left_share[k - 1] == 0 {
            k -= 1;
        }
        if k == 1 {
            out.push(binary);
            return;
        }
        let left = self.source.bvh.nodes[binary as usize].first_index;
        let share = usize::from(plan.left_share[k - 1]);
        self.forest(left, share, out);
        self.forest(left + 1, k - share, out);
    }

    /// Copies the primitives of a subtree and returns the child word.
    fn emit_leaf(&mut self, binary: u32) -> u32 {
        let mut prims = Vec::with_capacity(MAX_LEAF as usize);
        let mut pending = vec![binary];
        while let Some(i) = pending.pop() {
            let node = &self.source.bvh.nodes[i as usize];
            if node.is_leaf() {
                let index = self.source.bvh.primitive_indices[node.first_index as usize];
                prims.push(self.source.prims[index as usize]);
            } else {
                pending.extend([node.first_index, node.first_index + 1]);
            }
        }
        prims.sort_unstable();
        let first = self.tree.leaves.push(self.source.geometry, &prims);
        LEAF | (first << LEAF_COUNT_BITS) | (prims.len() as u32 - 1)
    }
}
