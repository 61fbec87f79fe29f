//! The way of a sample's light, in words.

use serde::Serialize;
use sr_film::luminance;
use sr_pipeline::bsdf::LobeFlags;
use sr_pipeline::glam::Vec3;
use sr_pipeline::replay::Event;
use sr_pipeline::{MaterialId, RenderScene};
use std::fmt::Write;

/// How the brightest part of a sample came to the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The light itself, seen directly, in mirrors or through clear glass.
    Seen,
    /// A surface that a light shines at, seen likewise.
    Direct,
    /// Light that more than one such surface has scattered.
    Indirect,
    /// Light that mirrors or clear glass threw onto a surface.
    Caustic,
}

impl Kind {
    /// For messages.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Seen => "a light that the camera sees",
            Self::Direct => "direct light",
            Self::Indirect => "indirect light",
            Self::Caustic => "caustic",
        }
    }
}

/// The way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Route {
    /// What it is.
    pub kind: Kind,
    /// The material that matters most: of a caustic what threw the light, else the one the camera's path scattered at
    /// last.
    pub material: Option<String>,
    /// From the camera to the light.
    pub text: String,
}

/// A surface on the way, and how the path left it.
#[derive(Clone, Copy)]
struct Vertex {
    material: MaterialId,
    lobe: Option<LobeFlags>,
}

/// The way of the brightest part of a sample; `None` where the integrator did not tell its parts.
pub(super) fn route(events: &[Event], scene: &RenderScene) -> Option<Route> {
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut connected = 0;
    let mut best: Option<(f64, Vec<Vertex>, bool)> = None;
    let mut offer = |light: Vec3, way: &[Vertex], sampled: bool| {
        let light = luminance(light.as_dvec3());
        if best.as_ref().is_none_or(|(most, _, _)| light > *most) {
            best = Some((light, way.to_vec(), sampled));
        }
    };
    for event in events {
        match event {
            Event::Surface { point, .. } => vertices.push(Vertex {
                material: point.material,
                lobe: None,
            }),
            Event::Scatter(s) => {
                // Another branch begins where all of them do.
                vertices.truncate(s.depth as usize + 1);
                if let Some(vertex) = vertices.last_mut() {
                    vertex.lobe = Some(s.lobe);
                }
            }
            // The light's own surface is no part of the way to it.
            Event::Emission(e) => {
                let way = vertices.len().min(e.depth as usize);
                offer(e.contribution, &vertices[..way], false);
            }
            Event::Connection(c) => connected = c.depth as usize + 1,
            Event::Shadow {
                occluded: false,
                contribution: Some(light),
                ..
            } => offer(*light, &vertices[..vertices.len().min(connected)], true),
            _ => {}
        }
    }
    let (_, way, sampled) = best?;
    let kind = kind(&way, sampled);
    Some(Route {
        kind,
        material: deciding(&way, kind).map(|m| scene.material(m).name.clone()),
        text: text(&way, sampled, scene),
    })
}

fn is_delta(vertex: &Vertex) -> bool {
    vertex.lobe.is_some_and(|l| l.contains(LobeFlags::DELTA))
}

fn kind(way: &[Vertex], sampled: bool) -> Kind {
    let scattering = way.iter().filter(|v| !is_delta(v)).count();
    match (scattering, way.last()) {
        (0, _) => Kind::Seen,
        (_, Some(last)) if !sampled && is_delta(last) => Kind::Caustic,
        (1, _) => Kind::Direct,
        _ => Kind::Indirect,
    }
}

fn deciding(way: &[Vertex], kind: Kind) -> Option<MaterialId> {
    let caustic = kind == Kind::Caustic;
    let mut from_light = way.iter().rev();
    from_light
        .find(|v| caustic == is_delta(v) || kind == Kind::Seen)
        .map(|v| v.material)
}

/// `camera → floor → glass (delta) ×2 → light, met by chance`.
fn text(way: &[Vertex], sampled: bool, scene: &RenderScene) -> String {
    let mut text = String::from("camera");
    let mut steps = way
        .iter()
        .map(|v| (scene.material(v.material).name.as_str(), is_delta(v)))
        .peekable();
    while let Some(step) = steps.next() {
        let mut times = 1;
        while steps.next_if_eq(&step).is_some() {
            times += 1;
        }
        let (name, delta) = step;
        let _ = write!(text, " → `{name}`{}", if delta { " (delta)" } else { "" });
        if times > 1 {
            let _ = write!(text, " ×{times}");
        }
    }
    text + if sampled {
        " → sampled light"
    } else {
        " → light met by chance"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind_of(lobes: &[LobeFlags], sampled: bool) -> Kind {
        let vertex = |lobe: &LobeFlags| Vertex {
            material: MaterialId(0),
            lobe: Some(*lobe),
        };
        let way: Vec<Vertex> = lobes.iter().map(vertex).collect();
        kind(&way, sampled)
    }

    #[test]
    fn kinds_of_light_are_told_apart() {
        let (rough, clear) = (LobeFlags::DIFFUSE, LobeFlags::DELTA);
        assert_eq!(kind_of(&[], false), Kind::Seen);
        assert_eq!(kind_of(&[clear, clear], false), Kind::Seen);
        assert_eq!(kind_of(&[rough], true), Kind::Direct);
        assert_eq!(kind_of(&[clear, rough], false), Kind::Direct);
        assert_eq!(kind_of(&[rough, clear, clear], false), Kind::Caustic);
        assert_eq!(kind_of(&[rough, rough], true), Kind::Indirect);
        assert_eq!(kind_of(&[rough, clear, rough], true), Kind::Indirect);
    }
}
