//! The schedules that this crate owns, and their sets: public places for a plug-in's systems.

use crate::stage;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;

/// Runs once a scene: files become entities.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Load;

/// The steps of [`Load`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LoadSet {
    /// Files are read and understood.
    Parse,
    /// Entities and settings come into being.
    Spawn,
    /// Overrides by path are applied: the scene's, the configuration's, the command line's.
    Override,
    /// What does not fit together is reported, all of it.
    Validate,
}

/// Runs once a scene, and again for what changed: entities become a sealed scene.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Compile;

/// The steps of [`Compile`], in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompileSet {
    /// World transforms, in f64; the camera; the origin of render space.
    Transforms,
    /// Materials become a table.
    Materials,
    /// Shapes become flat arrays in render space.
    Geometry,
    /// Lights become a table with a way to choose among them.
    Lights,
    /// The acceleration structure is built, and the lens focused by a ray through it.
    Accel,
    /// What the scene has and lacks.
    Features,
    /// Everything moves into the [`RenderScene`](sr_render::RenderScene).
    Seal,
    /// Whether what is to run can run on this scene.
    Check,
}

pub(crate) fn install(world: &mut World) {
    stage::add_schedule(world, Load, |s| {
        s.configure_sets(
            (
                LoadSet::Parse,
                LoadSet::Spawn,
                LoadSet::Override,
                LoadSet::Validate,
            )
                .chain(),
        );
    });
    stage::add_schedule(world, Compile, |s| {
        s.configure_sets(
            (
                CompileSet::Transforms,
                CompileSet::Materials,
                CompileSet::Geometry,
                CompileSet::Lights,
                CompileSet::Accel,
                CompileSet::Features,
                CompileSet::Seal,
                CompileSet::Check,
            )
                .chain(),
        );
    });
}
