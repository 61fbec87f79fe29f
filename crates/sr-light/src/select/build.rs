//! The tree over the lights is built from the top, each cluster split where the cost of the halves
//! is least (Conty Estevez, Kulla 2018, §4.4).

use super::cluster::{Cluster, measure};
use glam::DVec3;
use sr_math::Bounds3;
use std::f64::consts::PI;

/// Bins along an axis in which splits are tried.
const BINS: usize = 12;

/// Levels that are split by cost. Below them, halves have equal numbers of lights, so that a tree
/// over 2³² lights has no more than 64 levels, whatever the lights.
const COST_LEVELS: u32 = 32;

/// A light on its way into the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub light: u32,
    pub cluster: Cluster,
}

/// What the builder makes of a range of items.
#[derive(Clone, Copy, Debug)]
pub(super) enum Content {
    /// One light.
    Light(u32),
    /// Two nodes that lie next to each other, the first of them at this index.
    Children(u32),
}

/// A node before it is rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuildNode {
    pub cluster: Cluster,
    pub content: Content,
    /// Index of the node above; 0 for the root itself.
    pub parent: u32,
}

/// All nodes, the root first. `items` are put in order; there must be at least one.
pub(super) fn build(items: &mut [Item]) -> Vec<BuildNode> {
    let placeholder = BuildNode {
        cluster: items[0].cluster,
        content: Content::Light(items[0].light),
        parent: 0,
    };
    let mut nodes = Vec::with_capacity(2 * items.len() - 1);
    nodes.push(placeholder);
    fill(items, 0, 0, &mut nodes);
    nodes
}

fn fill(items: &mut [Item], node: usize, level: u32, nodes: &mut Vec<BuildNode>) {
    if let [item] = items {
        nodes[node].cluster = item.cluster;
        nodes[node].content = Content::Light(item.light);
        return;
    }
    let middle = split(items, level);
    let (left, right) = items.split_at_mut(middle);
    let first = nodes.len();
    nodes[node].content = Content::Children(first as u32);
    let child = BuildNode {
        parent: node as u32,
        ..nodes[node]
    };
    nodes.extend([child, child]);
    fill(left, first, level + 1, nodes);
    fill(right, first + 1, level + 1, nodes);
    nodes[node].cluster = nodes[first].cluster.union(&nodes[first + 1].cluster);
}

/// Puts the items of the first half first; how many they are, at least one and not all.
fn split(items: &mut [Item], level: u32) -> usize {
    let equal = items.len() / 2;
    if items.len() == 2 || level >= COST_LEVELS {
        return equal;
    }
    let Some(Split { axis, bin, bins }) = best_split(items) else {
        return equal;
    };
    partition(items, |item| bins.of(item, axis) <= bin)
}

/// Items that satisfy `first` come first, each group in the order it had; the size of the first.
fn partition(items: &mut [Item], first: impl Fn(&Item) -> bool) -> usize {
    let rest: Vec<Item> = items.iter().copied().filter(|i| !first(i)).collect();
    let mut kept = 0;
    for k in 0..items.len() {
        if first(&items[k]) {
            items[kept] = items[k];
            kept += 1;
        }
    }
    items[kept..].copy_from_slice(&rest);
    kept
}

/// The bins along the axes of the box of the items' centres.
#[derive(Clone, Copy)]
struct Bins {
    centers: Bounds3,
    count: usize,
}

impl Bins {
    /// Whether the axis tells centres apart, by an extent that can be divided by.
    fn has(&self, axis: usize) -> bool {
        let extent = self.centers.extent()[axis];
        extent > 0.0 && extent.is_finite()
    }

    fn of(&self, item: &Item, axis: usize) -> usize {
        let (low, high) = (self.centers.min[axis], self.centers.max[axis]);
        let at = (item.cluster.bounds.center()[axis] - low) / (high - low);
        ((at * self.count as f32) as usize).min(self.count - 1)
    }
}

/// Bins up to `bin` along `axis` against the others.
struct Split {
    axis: usize,
    bin: usize,
    bins: Bins,
}

/// The split of least cost; `None` when all centres are one point.
fn best_split(items: &[Item]) -> Option<Split> {
    let centers = Bounds3::from_points(items.iter().map(|i| i.cluster.bounds.center()));
    let bins = Bins {
        centers,
        count: BINS.min(items.len()),
    };
    let mut cells = [[Side::EMPTY; BINS]; 3];
    for item in items {
        let side = Side::of(&item.cluster);
        for (axis, cells) in cells.iter_mut().enumerate().filter(|(a, _)| bins.has(*a)) {
            let cell = &mut cells[bins.of(item, axis)];
            *cell = cell.union(&side);
        }
    }
    let longest = f64::from(centers.extent().max_element());
    let mut best: Option<(f64, Split)> = None;
    for (axis, cells) in cells.iter().enumerate().filter(|(a, _)| bins.has(*a)) {
        // Thin slabs are dear: eq. 2 of the paper.
        let thinness = longest / f64::from(centers.extent()[axis]);
        for (bin, cost) in costs(&cells[..bins.count]) {
            let cost = cost * thinness;
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, Split { axis, bin, bins }));
            }
        }
    }
    best.map(|(_, split)| split)
}

/// What a side of a split is judged by. All of it adds up, so that bins are cheap: the bounds that
/// the tree has in the end are made once a node.
#[derive(Clone, Copy)]
struct Side {
    bounds: Bounds3,
    intensity: f64,
    /// Sum of the axes; spheres and points have none.
    axes: DVec3,
    lights: f64,
    theta_e: f64,
}

impl Side {
    const EMPTY: Self = Self {
        bounds: Bounds3::EMPTY,
        intensity: 0.0,
        axes: DVec3::ZERO,
        lights: 0.0,
        theta_e: 0.0,
    };

    fn of(cluster: &Cluster) -> Self {
        let axis = cluster.cone.axis;
        let axes = if cluster.cone.theta >= PI {
            DVec3::ZERO
        } else if cluster.two_sided && axis[axis.abs().max_position()] < 0.0 {
            // Axes that hold both ways are to agree where they are alike.
            -axis
        } else {
            axis
        };
        Self {
            bounds: cluster.bounds,
            intensity: cluster.intensity,
            axes,
            lights: 1.0,
            theta_e: cluster.theta_e,
        }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            bounds: self.bounds.union(other.bounds),
            intensity: self.intensity + other.intensity,
            axes: self.axes + other.axes,
            lights: self.lights + other.lights,
            theta_e: self.theta_e.max(other.theta_e),
        }
    }

    /// What it costs to keep these lights together: intensity, times the measure of the directions
    /// they shine in, times the square of the radius.
    ///
    /// The cone is the one whose directions have on average the length that the axes have: (1 +
    /// cos θ)/2. The paper takes the area of the box; the importance of a cluster goes by the sphere
    /// around the box, and lamps in a row, whose box has none, are worth splitting too.
    fn cost(&self) -> f64 {
        if self.lights == 0.0 {
            return 0.0;
        }
        let r = f64::from(self.bounds.bounding_radius());
        let mean = self.axes.length() / self.lights;
        let theta_o = (2.0 * mean - 1.0).clamp(-1.0, 1.0).acos();
        self.intensity * measure(theta_o, self.theta_e) * r * r
    }
}

/// The cost of each split of a row of bins that leaves something on both sides.
fn costs(cells: &[Side]) -> impl Iterator<Item = (usize, f64)> {
    let mut above = [0.0; BINS];
    let mut side = Side::EMPTY;
    for k in (1..cells.len()).rev() {
        side = side.union(&cells[k]);
        above[k] = side.cost();
    }
    let last = cells.iter().rposition(|c| c.lights > 0.0).unwrap_or(0);
    let mut side = Side::EMPTY;
    (0..last).filter_map(move |bin| {
        side = side.union(&cells[bin]);
        (side.lights > 0.0).then(|| (bin, side.cost() + above[bin + 1]))
    })
}
