//! Which camera renders.

use super::component::Assignment;
use super::session::Session;
use crate::document::Components;
use crate::reflect::Origin;
use crate::ron::{Node, Pos, Value};
use bevy_ecs::prelude::*;
use sr_scene::components::{ActiveCamera, Orthographic, PerspectiveCamera, SourceSpan};
use sr_scene::diagnostics::{Diagnostic, suggest};

impl Session<'_> {
    /// Whether an entity is a camera.
    pub fn is_camera(&self, entity: Entity) -> bool {
        let entity = self.world.entity(entity);
        entity.contains::<PerspectiveCamera>() || entity.contains::<Orthographic>()
    }

    /// The camera that renders, when the scene has one.
    pub fn active_camera(&mut self) -> Option<Entity> {
        let mut active = self.world.query_filtered::<Entity, With<ActiveCamera>>();
        active.iter(self.world).next()
    }

    /// `camera` of a configuration or of an override: components of a new camera, or the name of
    /// one that the scene has. It takes the place of whichever was active.
    pub fn set_camera(&mut self, value: &Node, origin: &Origin) {
        let name = match &value.value {
            Value::String(name) => name,
            Value::Name(name) if !origin.is_file => name,
            Value::Map(entries) => {
                let components = components_of(entries);
                return self.spawn_camera(&components, value.pos, origin);
            }
            other => {
                let diagnostic = Diagnostic::error(format!(
                    "expected a camera, found {}",
                    other.describe()
                ))
                .at(origin.span(value.pos))
                .field("camera")
                .hint("write the name of a camera, or components as `{\"Component\": (…), …}`");
                self.diagnostics.push(diagnostic);
                return;
            }
        };
        match self.names.entities.get(name).copied() {
            Some(entity) if self.is_camera(entity) => {
                self.deactivate_cameras();
                self.world.entity_mut(entity).insert(ActiveCamera);
            }
            _ if self.names.is_lost(name) => {}
            _ => {
                let cameras: Vec<&str> = (self.names.entities.iter())
                    .filter(|(_, e)| self.is_camera(**e))
                    .map(|(name, _)| name.as_str())
                    .collect();
                let diagnostic = Diagnostic::error(format!("there is no camera `{name}`"))
                    .at(origin.span(value.pos))
                    .field("camera")
                    .hint(suggest(name, cameras));
                self.diagnostics.push(diagnostic);
            }
        }
    }

    fn spawn_camera(&mut self, components: &Components, pos: Pos, origin: &Origin) {
        self.deactivate_cameras();
        let name = self.names.unique("camera", false);
        let span = origin.span(pos);
        let bundle = (Name::new(name.clone()), span.clone(), ActiveCamera);
        let entity = self.world.spawn(bundle).id();
        self.names.add_camera(&name, entity);
        self.assign_all(entity, components, "camera", origin);
        if !self.is_camera(entity) {
            let message = "the camera has no projection".to_owned();
            self.places.record("camera".into(), span.clone());
            let diagnostic = Diagnostic::error(message)
                .at(span)
                .field("camera")
                .hint("add `\"PerspectiveCamera\": (hfov_deg: 40)` or `\"Orthographic\": (…)`");
            self.diagnostics.push(diagnostic);
        }
    }

    /// Sets components by name.
    pub fn assign_all(
        &mut self,
        entity: Entity,
        components: &Components,
        path: &str,
        origin: &Origin,
    ) {
        for (component, pos, value) in components {
            self.assign(&Assignment {
                entity,
                component,
                steps: &[],
                value,
                origin,
                pos: *pos,
                path: &format!("{path}.{component}"),
            });
        }
    }

    /// Without a tag, the scene file's own cameras come before those of models, the first of them
    /// before the others.
    pub fn choose_camera(&mut self, of_scene: &[Entity], of_models: &[Entity]) {
        if self.active_camera().is_some() {
            return;
        }
        let cameras = |session: &Self, entities: &[Entity]| -> Vec<Entity> {
            let is_camera = |e: &&Entity| session.is_camera(**e);
            entities.iter().filter(is_camera).copied().collect()
        };
        let mut candidates = cameras(self, of_scene);
        if candidates.is_empty() {
            candidates = cameras(self, of_models);
        }
        let Some(first) = candidates.first().copied() else {
            return;
        };
        self.world.entity_mut(first).insert(ActiveCamera);
        if candidates.len() > 1 {
            let names: Vec<&str> = (candidates.iter())
                .filter_map(|e| self.world.get::<Name>(*e).map(Name::as_str))
                .collect();
            let message = format!(
                "no camera is marked as `ActiveCamera`, so the first of {} is taken: {}",
                candidates.len(),
                names.first().unwrap_or(&"unnamed")
            );
            let notice = Diagnostic::notice(message)
                .at(self.world.get::<SourceSpan>(first).cloned())
                .field("camera")
                .hint(format!("the others are {}", names[1..].join(", ")));
            self.diagnostics.push(notice);
        }
    }
}

/// Components by name out of a map; other keys are kept as text, so that they are reported as
/// components that do not exist.
pub(super) fn components_of(entries: &[(Node, Node)]) -> Components {
    entries
        .iter()
        .map(|(key, value)| {
            let name = match &key.value {
                Value::String(text) | Value::Name(text) => text.clone(),
                other => other.to_string(),
            };
            (name, key.pos, value.clone())
        })
        .collect()
}
