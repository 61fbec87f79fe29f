//! The acceleration structure and how it is built.

use crate::collapse::{Source, WideTree, collapse};
use crate::geometry::{Defect, Geometry, Prim};
use crate::leaf::Leaves;
use crate::node::{MAX_PRIMS, Node};
use crate::runs::Runs;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use sr_math::Bounds3;
use std::time::{Duration, Instant};

/// Time spent on the tree against time spent in it. Answers do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quality {
    /// For previews.
    Fast,
    /// For everything.
    #[default]
    Balanced,
    /// For long renders: the builder searches wider and optimises more.
    High,
}

/// How to build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BuildSettings {
    /// Effort.
    pub quality: Quality,
}

/// What was built.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildReport {
    /// Primitives in the tree.
    pub prims: usize,
    /// Eight-wide nodes.
    pub nodes: usize,
    /// Nodes on the longest way from the root to a leaf; 0 when the root is a leaf.
    pub depth: usize,
    /// Primitives left out: a coordinate is infinite or NaN, or a vertex index is out of range.
    pub left_out_non_finite: usize,
    /// Primitives left out: no area, or a radius that is not positive.
    pub left_out_degenerate: usize,
    /// Size of the tree, with its copy of the primitives.
    pub bytes: usize,
    /// Wall-clock time of the build.
    pub seconds: f64,
}

/// The answer to ray queries over a [`Geometry`]; immutable.
#[derive(Clone, Debug)]
pub struct Accel {
    geometry: Geometry,
    bounds: Bounds3,
    tree: Option<WideTree>,
    report: BuildReport,
}

/// Which primitives can be hit, with their boxes.
struct Hittable {
    prims: Vec<u32>,
    bounds: Vec<Bounds3>,
    non_finite: usize,
    degenerate: usize,
}

impl Accel {
    /// Builds over all that can be hit; what cannot is left out and counted.
    ///
    /// Runs on the rayon pool of the caller.
    ///
    /// # Panics
    /// With more than [`MAX_PRIMS`] primitives.
    pub fn build(geometry: Geometry, settings: &BuildSettings) -> Self {
        let start = Instant::now();
        assert!(
            geometry.prim_count() <= MAX_PRIMS,
            "{} primitives are more than a tree can hold",
            geometry.prim_count()
        );
        let hittable = hittable(&geometry);
        let bounds = hittable
            .bounds
            .iter()
            .fold(Bounds3::EMPTY, |all, &b| all.union(b));
        let tree = (!hittable.prims.is_empty()).then(|| {
            let bvh = build_binary(&hittable.bounds, &bounds, settings);
            let of_kind = |test: fn(Prim) -> bool| {
                let kinds = hittable.prims.iter().map(|&p| geometry.kind(p));
                kinds.filter(|&k| test(k)).count()
            };
            let leaves = Leaves::with_capacity(
                of_kind(|k| matches!(k, Prim::Triangle(_))),
                of_kind(|k| matches!(k, Prim::Sphere(_))),
                hittable.prims.len(),
            );
            let source = Source {
                bvh: &bvh,
                prims: &hittable.prims,
                bounds: &hittable.bounds,
                geometry: &geometry,
            };
            collapse(&source, leaves)
        });
        let (nodes, depth, bytes) = tree.as_ref().map_or((0, 0, 0), |t| {
            let bytes = size_of::<Node>() * t.nodes.len() + t.leaves.bytes();
            (t.nodes.len(), t.depth, bytes)
        });
        let report = BuildReport {
            prims: hittable.prims.len(),
            nodes,
            depth,
            left_out_non_finite: hittable.non_finite,
            left_out_degenerate: hittable.degenerate,
            bytes,
            seconds: start.elapsed().as_secs_f64(),
        };
        Self {
            geometry,
            bounds,
            tree,
            report,
        }
    }

    /// What the tree was built over.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// A box around all that can be hit; empty when nothing can.
    pub fn bounds(&self) -> Bounds3 {
        self.bounds
    }

    /// Counts and sizes.
    pub fn report(&self) -> &BuildReport {
        &self.report
    }

    /// The tree, unless nothing can be hit.
    pub(crate) fn tree(&self) -> Option<&WideTree> {
        self.tree.as_ref()
    }
}

/// Sorts the primitives into those that can be hit and the rest.
fn hittable(geometry: &Geometry) -> Hittable {
    let count = geometry.prim_count();
    let mut out = Hittable {
        prims: Vec::with_capacity(count),
        bounds: Vec::with_capacity(count),
        non_finite: 0,
        degenerate: 0,
    };
    for prim in 0..count as u32 {
        match geometry.checked_bounds(prim) {
            Ok(bounds) => {
                out.prims.push(prim);
                out.bounds.push(bounds);
            }
            Err(Defect::NonFinite) => out.non_finite += 1,
            Err(Defect::Degenerate) => out.degenerate += 1,
        }
    }
    out
}

/// The binary tree, one primitive a leaf.
///
/// It is built over boxes scaled to about unit size by a power of two, so that no area in the
/// builder overflows, whatever the unit of the scene.
fn build_binary(bounds: &[Bounds3], all: &Bounds3, settings: &BuildSettings) -> Bvh2 {
    let size = all.min.abs().max(all.max.abs()).max_element();
    // Exponents of ±126 keep the factor itself a normal number.
    let exponent = (size.log2().ceil() as i32).clamp(-126, 126);
    let scale = Vec3::splat((-exponent as f32).exp2());
    let boxes: Vec<Aabb> = bounds
        .iter()
        .map(|b| Aabb::new((b.min * scale).into(), (b.max * scale).into()))
        .collect();
    let preset = match settings.quality {
        Quality::Fast => BvhBuildParams::fast_build(),
        Quality::Balanced => BvhBuildParams::medium_build(),
        Quality::High => BvhBuildParams::slow_build(),
    };
    let params = BvhBuildParams {
        // Splitting would put a primitive in several leaves.
        pre_split: false,
        max_prims_per_leaf: 1,
        post_collapse_reinsertion_batch_ratio_multiplier: 0.0,
        ..preset
    };
    let runs = Runs::new(&boxes);
    let mut bvh = build_bvh2(&runs.bounds, params, &mut Duration::default());
    runs.splice(&mut bvh, &boxes);
    bvh
}
