//! The schedules that run once there is a sealed scene, and their sets.

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;
use sr_scene::bevy_ecs;
use sr_scene::stage;

/// Runs once a pass: [`PassSpec`](crate::PassSpec) says which samples.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Render;

/// The steps of [`Render`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RenderSet {
    /// Before any sample.
    Begin,
    /// The selected integrator adds the pass's samples to the film.
    Integrate,
    /// Layers and other things beside radiance.
    Accumulate,
    /// Decisions on where the next samples go.
    Adapt,
    /// What must outlive a crash.
    Checkpoint,
    /// After everything.
    End,
}

/// The systems of one integrator, by its name. Only the selected one's run, so those of two
/// integrators may touch the same data without an order between them.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct IntegratorSet(pub &'static str);

/// Runs off the clock: at [log points](crate::LogPoints), after every pass when the error decides, and
/// at the end. Systems that keep a log run if [`at_log_point`](crate::at_log_point).
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Measure;

/// The steps of [`Measure`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeasureSet {
    /// The error of the picture so far.
    Error,
    /// Whether that is good enough.
    Stop,
    /// Rows of data.
    Log,
}

/// Runs once an image.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Post;

/// The steps of [`Post`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PostSet {
    /// From radiance to something to look at.
    Develop,
    /// To files.
    Write,
}

pub(crate) fn install(world: &mut World) {
    stage::add_schedule(world, Render, |s| {
        s.configure_sets(
            (
                RenderSet::Begin,
                RenderSet::Integrate,
                RenderSet::Accumulate,
                RenderSet::Adapt,
                RenderSet::Checkpoint,
                RenderSet::End,
            )
                .chain(),
        );
    });
    stage::add_schedule(world, Measure, |s| {
        s.configure_sets((MeasureSet::Error, MeasureSet::Stop, MeasureSet::Log).chain());
    });
    stage::add_schedule(world, Post, |s| {
        s.configure_sets((PostSet::Develop, PostSet::Write).chain());
    });
}
