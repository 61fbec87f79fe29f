//! Entities become a sealed scene.
//!
//! Each system reads components and the tables of the systems before it; the last one moves all
//! tables into one [`RenderScene`](sr_render::RenderScene) and removes them from the world.

mod accel;
mod camera;
mod environment;
mod features;
mod geometry;
mod lens;
mod lights;
mod materials;
mod seal;
mod transforms;

pub use seal::{SceneSources, SealedScene};

use crate::schedule::{Compile, CompileSet};
use crate::stage;
use bevy_ecs::prelude::*;

pub(crate) fn install(world: &mut World) {
    stage::add_systems(
        world,
        Compile,
        (
            (transforms::propagate_transforms, camera::place_camera)
                .chain()
                .in_set(CompileSet::Transforms),
            materials::collect_materials.in_set(CompileSet::Materials),
            geometry::bake_geometry.in_set(CompileSet::Geometry),
            (environment::check_maps, lights::collect_lights)
                .chain()
                .in_set(CompileSet::Lights),
            (accel::build_accel, lens::focus_lens)
                .chain()
                .in_set(CompileSet::Accel),
            features::find_features.in_set(CompileSet::Features),
            seal::seal.in_set(CompileSet::Seal),
        ),
    );
}
