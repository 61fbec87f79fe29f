//! What the systems of a stage work with, in one hand.

use super::names::Names;
use crate::reflect::{Context, Origin, Places};
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_reflect::TypeRegistry;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::{Diagnostic, Diagnostics};

/// The world, with names, places and complaints taken out of it for the time of a system.
pub(super) struct Session<'w> {
    pub world: &'w mut World,
    pub names: Names,
    pub places: Places,
    pub diagnostics: Vec<Diagnostic>,
    types: AppTypeRegistry,
}

/// Runs `work` and puts everything back.
pub(super) fn in_session<T>(world: &mut World, work: impl FnOnce(&mut Session<'_>) -> T) -> T {
    let names = world.remove_resource().unwrap_or_default();
    let places = world.remove_resource().unwrap_or_default();
    let diagnostics = std::mem::take(&mut world.resource_mut::<Diagnostics>().0);
    let types = world.resource::<AppTypeRegistry>().clone();
    let mut session = Session {
        world,
        names,
        places,
        diagnostics,
        types,
    };
    let result = work(&mut session);
    let Session {
        world,
        names,
        places,
        diagnostics,
        ..
    } = session;
    world.insert_resource(names);
    world.insert_resource(places);
    world.resource_mut::<Diagnostics>().0 = diagnostics;
    result
}

impl Session<'_> {
    /// The registered types.
    pub fn types(&self) -> AppTypeRegistry {
        self.types.clone()
    }

    /// Lends what a reflected value needs, and says whether each name in it stood for an entity.
    pub fn reflecting(
        &mut self,
        registry: &TypeRegistry,
        origin: &Origin,
        wants_material: bool,
        work: impl FnOnce(&mut Context<'_>),
    ) -> bool {
        let names = &self.names;
        let mut context = Context {
            registry,
            origin,
            entity: &|name| names.resolve(name, wants_material),
            places: &mut self.places,
            diagnostics: &mut self.diagnostics,
            unresolved: false,
        };
        work(&mut context);
        !context.unresolved
    }

    /// Adds an error.
    pub fn error(&mut self, span: impl Into<Option<SourceSpan>>, field: &str, message: String) {
        let diagnostic = Diagnostic::error(message).at(span).field(field);
        self.diagnostics.push(diagnostic);
    }

    /// The place of a field of an entity, or else of the entity.
    pub fn place(&self, entity: Entity, field: &str) -> Option<SourceSpan> {
        let path = format!("{}{field}", self.names.path(entity));
        let place = self.places.find(&path);
        place
            .or_else(|| self.world.get::<SourceSpan>(entity))
            .cloned()
    }
}
