//! Which components are lobes: an open list, so that a plug-in's component can be one.

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_ecs::world::EntityRef;
use bevy_reflect::{GetTypeRegistration, Reflect, TypePath};
use sr_render::bsdf::Bsdf;

/// A component that says how a material scatters light. A material has one.
pub trait Lobe: Component + Reflect + GetTypeRegistration + TypePath {
    /// What kernels see, or which field is out of its range and what it may be.
    fn bsdf(&self) -> Result<Bsdf, String>;
}

/// What the catalogue knows of one lobe component.
#[derive(Clone, Copy)]
pub struct LobeEntry {
    /// Name in RON.
    pub name: &'static str,
    /// The lobe of an entity, when it has this component.
    pub bsdf: fn(EntityRef<'_>) -> Option<Result<Bsdf, String>>,
    /// Takes the component off an entity.
    pub remove: fn(&mut EntityWorldMut<'_>),
}

/// Every registered lobe component, in order of registration.
#[derive(Resource, Default)]
pub struct LobeCatalog(pub Vec<LobeEntry>);

impl LobeCatalog {
    /// The entry of a component by its name in RON.
    pub fn get(&self, name: &str) -> Option<&LobeEntry> {
        self.0.iter().find(|e| e.name == name)
    }

    /// The lobes that an entity has: exactly one in a valid material.
    pub fn of<'a>(
        &'a self,
        entity: EntityRef<'a>,
    ) -> impl Iterator<Item = (&'static str, Result<Bsdf, String>)> + 'a {
        self.0
            .iter()
            .filter_map(move |e| (e.bsdf)(entity).map(|b| (e.name, b)))
    }
}

/// Makes `L` known to readers and to `Compile`.
pub fn register_lobe<L: Lobe>(world: &mut World) {
    world.resource::<AppTypeRegistry>().write().register::<L>();
    world.resource_mut::<LobeCatalog>().0.push(LobeEntry {
        name: L::short_type_path(),
        bsdf: |e| e.get::<L>().map(Lobe::bsdf),
        remove: |e| {
            e.remove::<L>();
        },
    });
}
