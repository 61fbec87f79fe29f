//! One sample again, looked at closely.
//!
//! A sample is a function of scene, settings and its index, so it can be traced once more at any time
//! with the same bits. An integrator that can do so has a [`SampleTracer`]: those that answer one camera
//! ray at a time have one by themselves, others bring theirs by
//! [`Pipeline::add_tracer`](crate::Pipeline::add_tracer).

mod event;
mod ray;
mod record;

pub use event::{Connection, Draw, Emission, Event, Nobody, Number, PathEnd, Scatter, Witness};
pub(crate) use ray::ray_tracer;
pub use record::{Record, RecordingSampler};

use crate::integrator::IntegratorTable;
use crate::pipeline::Pipeline;
use bevy_ecs::prelude::*;
use glam::Vec3;
use sr_render::MaterialId;
use sr_render::film::{Rect, Reject, check_colour};
use sr_scene::bevy_ecs;
use sr_scene::integrator::SelectedIntegrator;
use std::fmt;

/// A sample: the pixel in the whole picture, whatever the crop, and the index within the pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SampleId {
    /// Column and row from the top left.
    pub pixel: [u32; 2],
    /// Index among the samples of the pixel.
    pub sample: u64,
}

/// As `steradian render --replay` takes it: `x,y,sample`.
impl fmt::Display for SampleId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.pixel;
        write!(f, "{x},{y},{}", self.sample)
    }
}

/// What came of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// Radiance as it is offered to the film, which may refuse it.
    pub radiance: Vec3,
    /// Bounces, as rejected samples are counted by.
    pub bounces: u32,
    /// The material of the last surface, likewise.
    pub material: Option<MaterialId>,
}

/// Traces any one sample of a picture.
///
/// Its radiance has the bits of the sample in the film. Threads share it, and nothing but the record
/// remembers that it has been called.
pub trait SampleTracer: Send + Sync {
    /// Traces a sample and enters what happens on the way.
    fn trace(&self, id: SampleId, record: &Record) -> Traced;
}

/// Makes a tracer of what a compiled world holds, or says why not.
pub type MakeTracer = for<'w> fn(&'w World) -> Result<Box<dyn SampleTracer + 'w>, String>;

/// A sample that was traced again.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Which one.
    pub id: SampleId,
    /// What came of it.
    pub traced: Traced,
    /// What happened on the way.
    pub events: Vec<Event>,
}

impl Replay {
    /// Why the film refuses it; `None` when it is added.
    pub fn refused(&self) -> Option<Reject> {
        check_colour(self.traced.radiance).err()
    }

    /// The first event with a [defect](Event::defect), its place, and what is wrong.
    pub fn first_defect(&self) -> Option<(usize, &'static str)> {
        let events = self.events.iter().enumerate();
        events
            .filter_map(|(i, e)| e.defect().map(|what| (i, what)))
            .next()
    }
}

/// Why a sample cannot be replayed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReplayError {
    /// The selected integrator has no tracer, or it cannot be made.
    NoTracer(String),
    /// There is no such pixel.
    Outside {
        /// The pixel asked for.
        pixel: [u32; 2],
        /// Width and height of the picture.
        size: [u32; 2],
    },
}

impl fmt::Display for ReplayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTracer(why) => f.write_str(why),
            Self::Outside {
                pixel: [x, y],
                size: [width, height],
            } => write!(
                f,
                "there is no pixel {x},{y}: the picture has {width} × {height} pixels, 0,0 to {},{}",
                width.saturating_sub(1),
                height.saturating_sub(1)
            ),
        }
    }
}

impl std::error::Error for ReplayError {}

impl Pipeline {
    /// The selected integrator's tracer of single samples, over the compiled scene.
    ///
    /// # Errors
    /// When it has none, or the settings do not let it be made.
    pub fn tracer(&self) -> Result<Box<dyn SampleTracer + '_>, ReplayError> {
        make(&self.world).map_err(ReplayError::NoTracer)
    }

    /// Traces one sample of the compiled scene again. Nothing of the world changes.
    ///
    /// # Errors
    /// When the integrator has no tracer, or the pixel lies outside of the picture.
    pub fn replay(&self, id: SampleId) -> Result<Replay, ReplayError> {
        let spec = crate::film_spec(&self.world).map_err(ReplayError::NoTracer)?;
        let size = [spec.width, spec.height];
        if !Rect::of_size(spec.width, spec.height).contains(id.pixel[0], id.pixel[1]) {
            let pixel = id.pixel;
            return Err(ReplayError::Outside { pixel, size });
        }
        let tracer = self.tracer()?;
        let record = Record::new();
        let traced = self.install(|| tracer.trace(id, &record));
        Ok(Replay {
            id,
            traced,
            events: record.take(),
        })
    }
}

fn make(world: &World) -> Result<Box<dyn SampleTracer + '_>, String> {
    let selected = world
        .get_resource::<SelectedIntegrator>()
        .ok_or("no integrator is selected")?;
    let entry = world.resource::<IntegratorTable>().entry(&selected.name)?;
    match entry.tracer {
        Some(make) => make(world),
        None => Err(format!(
            "`{}` cannot trace a single sample: it brings systems of its own, and no tracer for them",
            selected.name
        )),
    }
}
