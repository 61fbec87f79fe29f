//! The choice by what arrives at a point: the lights of the tree against those that have no place.

use super::Receiver;
use super::angle::Angle;
use super::build::Item;
use super::cluster::Cluster;
use super::tree::{LightTree, in_range, part, receiver_cosine, weight};
use crate::Light;
use glam::Vec3;
use sr_math::color::luminance;
use std::f64::consts::PI;

/// An infinite light: its irradiance needs no distance, so it competes with the whole tree.
#[derive(Clone, Copy, Debug)]
struct Infinite {
    light: u32,
    /// Of a surface that faces the light, relative to the brightest light; for an environment π
    /// times its mean radiance.
    irradiance: f32,
    /// Unit vector towards a directional light; zero when light comes from all sides.
    wi: Vec3,
}

impl Infinite {
    #[inline]
    fn importance(&self, receiver: &Receiver) -> f32 {
        if self.wi == Vec3::ZERO || receiver.n == Vec3::ZERO {
            return in_range(self.irradiance);
        }
        receiver_cosine(receiver.n, self.wi, Angle::ZERO)
            .map_or(0.0, |cos| in_range(self.irradiance * cos))
    }
}

/// All lights, to be chosen from by what they may bring to a point.
#[derive(Clone, Debug)]
pub(super) struct Spatial {
    infinite: Vec<Infinite>,
    tree: Option<LightTree>,
}

impl Spatial {
    /// From lights and whether each is to be chosen at all.
    pub fn new(lights: &[Light], shines: impl Fn(&Light) -> bool) -> Self {
        let (mut items, mut infinite) = (Vec::new(), Vec::new());
        for (light, k) in lights.iter().zip(0u32..).filter(|(l, _)| shines(l)) {
            match Cluster::of(light) {
                Some(cluster) => items.push(Item { light: k, cluster }),
                None => infinite.push((k, irradiance(light))),
            }
        }
        // Only ratios count, so the brightest may be 1: no intensity is then out of range.
        let brightest = items
            .iter()
            .map(|i| i.cluster.intensity)
            .chain(infinite.iter().map(|i| i.1))
            .fold(0.0, f64::max);
        let scale = if brightest > 0.0 && brightest.is_finite() {
            brightest.recip()
        } else {
            1.0
        };
        let infinite = infinite.into_iter().map(|(light, irradiance)| Infinite {
            light,
            irradiance: (irradiance * scale) as f32,
            wi: towards(&lights[light as usize]),
        });
        Self {
            infinite: infinite.collect(),
            tree: LightTree::new(items, lights.len(), scale),
        }
    }

    /// How many nodes there are from the root of the tree to its farthest light.
    pub fn levels(&self) -> u32 {
        self.tree.as_ref().map_or(0, LightTree::levels)
    }

    #[inline]
    fn tree_importance(&self, receiver: &Receiver) -> f32 {
        self.tree.as_ref().map_or(0.0, |t| t.importance(receiver))
    }

    /// The importance of the tree, the sum of all importances, and the sum of the weights.
    #[inline]
    fn sums(&self, receiver: &Receiver) -> (f32, f32, f32) {
        let tree = self.tree_importance(receiver);
        let infinite = || self.infinite.iter().map(|l| l.importance(receiver));
        let sum = tree + infinite().sum::<f32>();
        let weights = weight(tree, sum) + infinite().map(|i| weight(i, sum)).sum::<f32>();
        (tree, sum, weights)
    }

    /// A light, its probability, and what is left of `u`; `None` where no light contributes.
    #[inline]
    pub fn select(&self, receiver: &Receiver, u: f64) -> Option<(u32, f32, f64)> {
        if let ([], Some(tree)) = (&self.infinite[..], &self.tree) {
            return tree.select(receiver, u);
        }
        let (tree, sum, weights) = self.sums(receiver);
        if weights == 0.0 {
            return None;
        }
        let mut at = u * f64::from(weights);
        let w = weight(tree, sum);
        if at < f64::from(w) {
            let tree = self.tree.as_ref()?;
            let (light, pmf, rest) = tree.select(receiver, part(at, w))?;
            return Some((light, pmf * (w / weights), rest));
        }
        at -= f64::from(w);
        let mut last = None;
        for light in &self.infinite {
            let w = weight(light.importance(receiver), sum);
            if w > 0.0 {
                last = Some((light.light, w / weights, part(at, w)));
                if at < f64::from(w) {
                    break;
                }
                at -= f64::from(w);
            }
        }
        // The sum of the weights is rounded, so `at` may lie a little past the last one.
        last
    }

    /// See [`super::LightSampler::pmf`].
    #[inline]
    pub fn pmf(&self, receiver: &Receiver, light: u32) -> f32 {
        let in_tree = |tree: &LightTree| tree.pmf(receiver, light);
        if self.infinite.is_empty() {
            return self.tree.as_ref().map_or(0.0, in_tree);
        }
        let (tree, sum, weights) = self.sums(receiver);
        if weights == 0.0 {
            return 0.0;
        }
        match self.infinite.iter().find(|l| l.light == light) {
            Some(l) => weight(l.importance(receiver), sum) / weights,
            None if tree == 0.0 => 0.0,
            None => self.tree.as_ref().map_or(0.0, in_tree) * (weight(tree, sum) / weights),
        }
    }
}

/// Luminance of what a surface receives that faces an infinite light. Within a sphere of radius 1 its
/// power is π times the irradiance of a directional light, and 4π² times the mean radiance of an
/// environment.
fn irradiance(light: &Light) -> f64 {
    let power = f64::from(luminance(light.power(Vec3::ZERO, 1.0)));
    if light.is_delta() {
        power / PI
    } else {
        power / (4.0 * PI)
    }
}

fn towards(light: &Light) -> Vec3 {
    match light {
        Light::Directional(l) => l.wi,
        _ => Vec3::ZERO,
    }
}
