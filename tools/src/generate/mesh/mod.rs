//! Meshes of the project's own scenes, as binary glTF.
//!
//! All stand on y = 0 with their middle over the origin. They are computed in `f64` and rounded
//! once, so that a mesh made again is the file in `scenes/`.

mod gem;
mod glb;
mod grid;
mod lathe;
mod surface;

use super::{Error, Made, save};
use clap::{Args, ValueEnum};
use glam::DVec3;
use std::path::PathBuf;

/// Arguments of `generate mesh`.
#[derive(Args, Clone, Debug)]
pub struct MeshArgs {
    /// What to make.
    #[arg(value_enum)]
    pub shape: Shape,
    /// The file.
    #[arg(short, long, value_name = "MESH.GLB")]
    pub output: PathBuf,
    /// About how many triangles a curved shape has, from 100 to 10 million; by default what the
    /// project's scenes have. Cut stones have as many as they have facets.
    #[arg(long, value_name = "N")]
    pub triangles: Option<u64>,
}

/// The shapes there are.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A fluted tube along a trefoil knot, 1 m high: folds, and parts that see each other.
    Knot,
    /// A ball with hollows, 1 m high.
    Blob,
    /// A flat ring of outer radius 1 m and height 0.4 m, for caustics.
    Ring,
    /// A chess pawn, 1 m high.
    Pawn,
    /// A stone in the round brilliant cut, 1 m across, on its point.
    Brilliant,
    /// A stone in the step cut of emeralds, 1.3 m long, on its small flat end.
    StepCut,
}

/// A closed triangle mesh; fronts are outside.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    /// Vertices in metres.
    pub positions: Vec<DVec3>,
    /// Unit normals, one a vertex; none for a faceted mesh.
    pub normals: Vec<DVec3>,
    /// Counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Moves the mesh onto y = 0, and scales it to a height when one is given.
    fn standing(mut self, height: Option<f64>) -> Self {
        let lowest = |m: &Self| {
            m.positions
                .iter()
                .map(|p| p.y)
                .fold(f64::INFINITY, f64::min)
        };
        let highest = |m: &Self| {
            m.positions
                .iter()
                .map(|p| p.y)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let bottom = lowest(&self);
        let scale = height.map_or(1.0, |h| h / (highest(&self) - bottom));
        for p in &mut self.positions {
            *p = (*p - DVec3::Y * bottom) * scale;
        }
        self
    }
}

/// A shape of about so many triangles.
fn build(shape: Shape, triangles: Option<u64>) -> Mesh {
    let about = |default: u64| triangles.unwrap_or(default);
    match shape {
        Shape::Knot => surface::knot(about(20_000)),
        Shape::Blob => surface::blob(about(12_000)),
        Shape::Ring => lathe::ring(about(4_000)),
        Shape::Pawn => lathe::pawn(about(6_000)),
        Shape::Brilliant => gem::brilliant(),
        Shape::StepCut => gem::step_cut(),
    }
}

/// The file's bytes, and what is in it.
fn encode(args: &MeshArgs) -> Result<(Vec<u8>, String), Error> {
    let name = args.shape.to_possible_value();
    let name = name.as_ref().map_or("mesh", |v| v.get_name()).to_owned();
    match (args.shape, args.triangles) {
        (Shape::Brilliant | Shape::StepCut, Some(_)) => {
            let message = format!("--triangles: a {name} has as many as its cut has facets");
            return Err(Error::Usage(message));
        }
        (_, Some(n)) if !(100..=10_000_000).contains(&n) => {
            let message = format!("--triangles: {n} must be between 100 and 10000000");
            return Err(Error::Usage(message));
        }
        _ => {}
    }
    let mesh = build(args.shape, args.triangles);
    let counts = (mesh.triangles.len(), mesh.positions.len());
    let summary = format!("{name}: {} triangles, {} vertices", counts.0, counts.1);
    Ok((glb::encode(&name, &mesh).map_err(Error::Usage)?, summary))
}

/// Makes the mesh and writes it.
pub(super) fn write(args: &MeshArgs) -> Result<Made, Error> {
    let (bytes, summary) = encode(args)?;
    save(&args.output, &bytes)?;
    Ok(Made {
        summary: vec![summary],
        written: vec![args.output.clone()],
    })
}

#[cfg(test)]
mod tests;
