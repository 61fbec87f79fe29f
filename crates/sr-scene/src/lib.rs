//! The scene as entities: components, and the systems that compile them into one sealed
//! [`RenderScene`](sr_render::RenderScene).
//!
//! Readers spawn entities in the [`Load`](schedule::Load) schedule; the systems of
//! [`compile`] run in [`Compile`](schedule::Compile) and end with the sealed scene. After that no
//! entity is touched again: the loop over rays sees flat tables only.

pub mod compile;
pub mod components;
pub mod diagnostics;
pub mod integrator;
pub mod lobes;
pub mod schedule;
pub mod settings;
pub mod stage;

pub use bevy_ecs;
pub use bevy_reflect;
pub use sr_render;

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;

/// Makes a world able to hold a scene: registers components, lobes, settings and the systems of
/// `Compile`.
pub fn install(world: &mut World) {
    world.init_resource::<AppTypeRegistry>();
    world.init_resource::<diagnostics::Diagnostics>();
    world.init_resource::<integrator::IntegratorCatalog>();
    world.init_resource::<lobes::LobeCatalog>();
    components::register(world);
    settings::register(world);
    schedule::install(world);
    compile::install(world);
}
