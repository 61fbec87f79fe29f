//! A tree over the lights that have a place, walked by how much light each part may bring to a
//! point (Conty Estevez, Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
//! Splitting"; Pharr, Jakob, Humphreys 2023, §12.6.3).
//!
//! The importance of a node estimates irradiance: intensity over squared distance, times bounds of
//! the cosines at light and receiver. It is 0 only where no light of the node can contribute, rounding
//! included, and a child that may contribute gets at least [`SHARE`] of its parent's samples.

use super::Receiver;
use super::angle::Angle;
use super::build::{BuildNode, Content, Item, build};
use super::cluster::Cluster;
use glam::Vec3;
use sr_math::gamma;
use std::f64::consts::PI;

/// Least share of the samples that a choice gets beside a better one. Importance knows nothing of
/// what is in the way: where the bright lights are hidden the dim ones are all there is, and the
/// weight of a sample stays bounded. Over the 17 levels of a tree of 10⁵ lights it costs 2 % of the
/// samples at most.
pub(super) const SHARE: f32 = 1.0 / 1024.0;

/// What is in doubt of a cosine. A unit vector between rounded points errs by γ₅ an axis, an axis or
/// normal by γ₂; a product of two of these, with its own three roundings and √3 for the sum of three
/// axes, by γ₁₈ at most. Two differences of angles, each a sum of two products of such numbers, take
/// that to under γ₉₀; the direction that a sample or a scattered ray has in the end errs by γ₂₀ more.
const DOUBT: f32 = gamma(128);

/// Importance is kept within these, so that no sum, product with [`SHARE`] or quotient of them leaves
/// the range, whatever the number of lights.
const LEAST: f32 = 1e-30;
const MOST: f32 = 1e30;

/// Importances of two or more choices, `0` for what cannot be chosen, become weights: what is above
/// 0 is at least [`SHARE`] of the sum.
#[inline]
pub(super) fn weight(importance: f32, sum: f32) -> f32 {
    if importance > 0.0 {
        importance.max(SHARE * sum)
    } else {
        0.0
    }
}

/// Importance as it may be: a number above 0.
#[inline]
pub(super) fn in_range(importance: f32) -> f32 {
    // What is no number fails the comparison.
    if importance > LEAST {
        importance.min(MOST)
    } else {
        LEAST
    }
}

/// Bound of the cosine at a receiver of light from a sphere that fills the angle `around` about the
/// unit direction `to`; `None` when all of it is below the surface.
#[inline]
pub(super) fn receiver_cosine(n: Vec3, to: Vec3, around: Angle) -> Option<f32> {
    let angle = Angle {
        cos: n.dot(to),
        sin: n.cross(to).length(),
    };
    let cos = angle.minus(around).cos;
    (cos > -DOUBT).then_some(cos.max(DOUBT))
}

/// One cache line: half the nodes that a walk looks at lie beside the other half.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Node {
    /// Of the sphere around the lights, rounding included.
    center: Vec3,
    radius: f32,
    /// Of the cone that contains the lights' axes.
    axis: Vec3,
    /// Of all the lights, relative to the brightest there is.
    intensity: f32,
    /// Half angle of the cone.
    theta_o: Angle,
    /// Beyond this cosine to the nearest axis the lights are dark.
    cos_e: f32,
    two_sided: bool,
    is_leaf: bool,
    /// The light, or the first of two children.
    content: u32,
    parent: u32,
}

impl Node {
    fn new(node: &BuildNode, scale: f64) -> Self {
        let Cluster {
            bounds,
            cone,
            theta_e,
            intensity,
            two_sided,
        } = node.cluster;
        let center = bounds.center();
        let radius = bounds.bounding_radius();
        // Points on lights err by γ₆ of the light's coordinates and extent, the centre by an ulp;
        // √3 for three axes. The square root of a sum of squares of differences, as it is taken
        // here and at the receiver, errs by γ₄ of itself each time.
        let reach = bounds.min.abs().max(bounds.max.abs()).max_element();
        let radius = radius * (1.0 + gamma(16)) + gamma(16) * reach;
        let (is_leaf, content) = match node.content {
            Content::Light(light) => (true, light),
            Content::Children(first) => (false, first),
        };
        Self {
            center,
            radius,
            axis: cone.axis.as_vec3(),
            intensity: (intensity * scale) as f32,
            theta_o: Angle::from_radians(cone.theta),
            cos_e: theta_e.clamp(0.0, 0.5 * PI).cos() as f32,
            two_sided,
            is_leaf,
            content,
            parent: node.parent,
        }
    }

    /// Estimate of the irradiance at a receiver, 0 only when it is 0.
    ///
    /// The distance term is that of a disk of the node's radius seen along its axis, `1/(d² + r²)`:
    /// exact for that disk, and without a pole.
    #[inline]
    fn importance(&self, receiver: &Receiver) -> f32 {
        let d = self.center - receiver.p;
        let (d2, r2) = (d.length_squared(), self.radius * self.radius);
        let mut irradiance = self.intensity / (d2 + r2);
        // Within the sphere light may come from anywhere, and so it may where d² is no number.
        if d2 > r2 {
            let inv = d2.sqrt().recip();
            let to = d * inv;
            // The angle that the sphere fills. Near the sphere its cosine is a small number, and
            // 1 − sin² would round it away; 1 − sin is exact there.
            let sin = (self.radius * inv).min(1.0);
            let around = Angle {
                cos: ((1.0 - sin) * (1.0 + sin)).sqrt(),
                sin,
            };
            if receiver.n != Vec3::ZERO {
                match receiver_cosine(receiver.n, to, around) {
                    Some(cos) => irradiance *= cos,
                    None => return 0.0,
                }
            }
            if self.theta_o != Angle::STRAIGHT {
                let cos = -to.dot(self.axis);
                let from_axis = Angle {
                    cos: if self.two_sided { cos.abs() } else { cos },
                    sin: to.cross(self.axis).length(),
                };
                let cos = from_axis.minus(self.theta_o).minus(around).cos;
                if cos <= self.cos_e - DOUBT {
                    return 0.0;
                }
                irradiance *= cos.max(DOUBT);
            }
        }
        in_range(irradiance)
    }
}

/// The tree.
#[derive(Clone, Debug)]
pub(super) struct LightTree {
    /// The root first, children side by side.
    nodes: Vec<Node>,
    /// The leaf of each light; `u32::MAX` for what is not in the tree.
    leaf: Vec<u32>,
    levels: u32,
}

impl LightTree {
    /// Over some of `count` lights; `None` over none. `scale` goes to all intensities.
    pub fn new(mut items: Vec<Item>, count: usize, scale: f64) -> Option<Self> {
        if items.is_empty() {
            return None;
        }
        let built = build(&mut items);
        let mut leaf = vec![u32::MAX; count];
        let mut depth = vec![1u32; built.len()];
        for (k, node) in built.iter().enumerate() {
            if k > 0 {
                depth[k] = depth[node.parent as usize] + 1;
            }
            if let Content::Light(light) = node.content {
                leaf[light as usize] = k as u32;
            }
        }
        Some(Self {
            nodes: built.iter().map(|n| Node::new(n, scale)).collect(),
            leaf,
            levels: depth.into_iter().max().unwrap_or(1),
        })
    }

    /// How many nodes there are from the root to the farthest light.
    pub fn levels(&self) -> u32 {
        self.levels
    }

    /// What all lights together may bring.
    #[inline]
    pub fn importance(&self, receiver: &Receiver) -> f32 {
        self.nodes[0].importance(receiver)
    }

    /// Weights of the two nodes from `first` on.
    #[inline]
    fn weights(&self, first: usize, receiver: &Receiver) -> [f32; 2] {
        let importance = [first, first + 1].map(|k| self.nodes[k].importance(receiver));
        let sum = importance[0] + importance[1];
        importance.map(|i| weight(i, sum))
    }

    /// A light, its probability, and what is left of `u`. `None` where the bound of a node was too
    /// loose to see that nothing below it contributes.
    #[inline]
    pub fn select(&self, receiver: &Receiver, mut u: f64) -> Option<(u32, f32, f64)> {
        let mut node = &self.nodes[0];
        let mut pmf = 1.0;
        while !node.is_leaf {
            let first = node.content as usize;
            let [left, right] = self.weights(first, receiver);
            let sum = left + right;
            if sum == 0.0 {
                return None;
            }
            let at = u * f64::from(sum);
            let (next, w, begin) = if at < f64::from(left) {
                (first, left, 0.0)
            } else {
                (first + 1, right, f64::from(left))
            };
            u = part(at - begin, w);
            pmf *= w / sum;
            node = &self.nodes[next];
        }
        Some((node.content, pmf.max(LEAST), u))
    }

    /// The probability of a light; 0 for one that is not in the tree.
    #[inline]
    pub fn pmf(&self, receiver: &Receiver, light: u32) -> f32 {
        let leaf = self.leaf.get(light as usize).copied();
        let Some(leaf) = leaf.filter(|l| *l != u32::MAX) else {
            return 0.0;
        };
        let mut at = leaf as usize;
        let mut pmf = 1.0;
        while at != 0 {
            let parent = self.nodes[at].parent as usize;
            let first = self.nodes[parent].content as usize;
            let [left, right] = self.weights(first, receiver);
            let w = if at == first { left } else { right };
            if w == 0.0 {
                return 0.0;
            }
            pmf *= w / (left + right);
            at = parent;
        }
        pmf.max(LEAST)
    }
}

/// Where `at` lies in an interval of width `w` that begins at 0: in `[0, 1)`, whatever the rounding.
#[inline]
pub(super) fn part(at: f64, w: f32) -> f64 {
    (at / f64::from(w)).min(1.0 - f64::EPSILON / 2.0)
}
