//! What two paths of the same random numbers are compared by.

use serde::Serialize;
use sr_pipeline::LightId;
use sr_pipeline::bsdf::LobeFlags;
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::replay::{Event, PathEnd};
use sr_pipeline::{RenderScene, SurfacePoint};
use std::collections::VecDeque;
use std::fmt;

/// One segment of a path, and what happened at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Step {
    /// The primitive that was met; `None` outside of the scene.
    pub prim: Option<u32>,
    /// Lights that were met by chance.
    pub met: Vec<LightId>,
    /// Lights that were sampled, and whether something stands before them; `None` where they bring [nothing](brings).
    pub connections: Vec<(LightId, Option<bool>)>,
    /// The lobe that was chosen, when the path goes on.
    pub lobe: Option<LobeFlags>,
    /// Whether roulette let it live, where it was played.
    pub lives: Option<bool>,
    /// Why the path ended here.
    pub end: Option<PathEnd>,
}

/// Whether light is more than rounding makes of nothing: a lobe whose value is below the smallest normal `f32` has no
/// digits there, or is 0.
pub(super) fn brings(contribution: DVec3) -> bool {
    contribution.max_element() >= f64::from(f32::MIN_POSITIVE)
}

/// What two paths do differently, where they part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// One meets another shape than the other, or leaves the scene.
    Surface,
    /// They meet two primitives of one shape.
    Primitive,
    /// They sample two lights, or meet two by chance, or one brings something to one of them alone.
    Light,
    /// One shadow ray is stopped, the other is not.
    Shadow,
    /// They choose two lobes.
    Lobe,
    /// Roulette ends one of them.
    Roulette,
    /// One ends for another reason.
    End,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Surface => "another surface",
            Self::Primitive => "another primitive of the surface",
            Self::Light => "another light",
            Self::Shadow => "another answer of a shadow ray",
            Self::Lobe => "another lobe",
            Self::Roulette => "another answer of roulette",
            Self::End => "another end",
        })
    }
}

/// The steps that a record tells of, and the surfaces that were met.
pub(super) fn recorded(events: &[Event]) -> (Vec<Step>, Vec<SurfacePoint>) {
    let (mut steps, mut points) = (Vec::new(), Vec::new());
    let mut step = Step::default();
    let mut waiting: VecDeque<Option<usize>> = VecDeque::new();
    for event in events {
        match event {
            Event::Ray(_) => {
                steps.push(std::mem::take(&mut step));
                waiting.clear();
            }
            Event::Surface { point, .. } => {
                step.prim = Some(point.prim);
                points.push(*point);
            }
            Event::Emission(met) => step.met.push(met.light),
            Event::Connection(c) => {
                // No ray is traced for nothing at all.
                if c.contribution != Vec3::ZERO {
                    let brings = brings(c.contribution.as_dvec3());
                    waiting.push_back(brings.then_some(step.connections.len()));
                }
                step.connections.push((c.light, None));
            }
            Event::Shadow { occluded, .. } => {
                if let Some(i) = waiting.pop_front().flatten() {
                    step.connections[i].1 = Some(*occluded);
                }
            }
            Event::Scatter(s) => step.lobe = Some(s.lobe),
            Event::Roulette { u, survival, .. } => step.lives = Some(u < survival),
            Event::End { why, .. } => step.end = Some(*why),
            Event::Number(_) | Event::Miss | Event::At { .. } => {}
        }
    }
    steps.push(step);
    // What was before the first ray.
    steps.remove(0);
    (steps, points)
}

/// The first step at which two paths part, and how.
pub(super) fn parting(scene: &RenderScene, a: &[Step], b: &[Step]) -> Option<(usize, Cause)> {
    let steps = a.iter().zip(b).enumerate();
    let first = steps
        .filter_map(|(i, (a, b))| difference(scene, a, b).map(|cause| (i, cause)))
        .next();
    // Steps that agree end together.
    first.or_else(|| (a.len() != b.len()).then_some((a.len().min(b.len()), Cause::End)))
}

fn difference(scene: &RenderScene, a: &Step, b: &Step) -> Option<Cause> {
    if a.prim != b.prim {
        let shape = |prim: Option<u32>| prim.map(|prim| scene.shape_of(prim));
        return Some(match shape(a.prim) == shape(b.prim) {
            true => Cause::Primitive,
            false => Cause::Surface,
        });
    }
    let lights = |step: &Step| {
        let sampled = step.connections.iter().map(|(l, o)| (*l, o.is_some()));
        sampled.collect::<Vec<_>>()
    };
    if a.met != b.met || lights(a) != lights(b) {
        return Some(Cause::Light);
    }
    if a.connections != b.connections {
        return Some(Cause::Shadow);
    }
    if a.lobe != b.lobe && a.lobe.is_some() == b.lobe.is_some() {
        return Some(Cause::Lobe);
    }
    if a.lives != b.lives {
        return Some(Cause::Roulette);
    }
    (a.end != b.end || a.lobe != b.lobe).then_some(Cause::End)
}
