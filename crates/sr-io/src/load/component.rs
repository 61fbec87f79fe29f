//! Components by name onto entities.

use super::session::Session;
use crate::reflect::{FieldPath, Origin, Step, default_value};
use crate::ron::{Node, Pos};
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::{PartialReflect, Reflect, ReflectRef, TypeInfo, TypeRegistration, TypeRegistry};
use sr_scene::components::{ActiveCamera, LocalTransform, LookAt, MaterialRef, ThinLens};
use sr_scene::diagnostics::{Diagnostic, suggest};
use sr_scene::lobes::LobeCatalog;
use std::any::TypeId;

/// A component of an entity, or a field of one, and its new value.
pub(super) struct Assignment<'a> {
    pub entity: Entity,
    /// The component's name in RON.
    pub component: &'a str,
    /// The way to the field; empty for the whole component.
    pub steps: &'a [Step<'a>],
    pub value: &'a Node,
    pub origin: &'a Origin,
    /// Where component and steps are written.
    pub pos: Pos,
    /// The path up to and with the component, as the user wrote it.
    pub path: &'a str,
}

/// A registered component by its short name, or by its full path when that is ambiguous.
pub(super) fn find_component<'r>(
    registry: &'r TypeRegistry,
    name: &str,
) -> Option<(&'r TypeRegistration, &'r ReflectComponent)> {
    let registration = registry
        .get_with_short_type_path(name)
        .or_else(|| registry.get_with_type_path(name))?;
    Some((registration, registration.data::<ReflectComponent>()?))
}

/// The names of all components that RON can name, sorted.
pub(super) fn component_names(registry: &TypeRegistry) -> Vec<&'static str> {
    let mut names: Vec<&str> = registry
        .iter_with_data::<ReflectComponent>()
        .map(|(r, _)| r.type_info().type_path_table().short_path())
        .collect();
    names.sort_unstable();
    names
}

/// A copy of the current value, or the default. Not every value can clone itself by reflection
/// (arrays cannot); each can be applied to another of its type.
fn copy_or_default(
    registry: &TypeRegistry,
    info: &TypeInfo,
    current: Option<&dyn Reflect>,
) -> Option<Box<dyn PartialReflect>> {
    if let Some(Ok(copy)) = current.map(|c| c.reflect_clone()) {
        return Some(copy.into_partial_reflect());
    }
    let mut value = default_value(registry, info)?;
    if let Some(current) = current {
        value.try_apply(current.as_partial_reflect()).ok()?;
    }
    Some(value)
}

/// The entity that a [`ChildOf`] names.
fn parent_in(value: &dyn PartialReflect) -> Option<Entity> {
    let ReflectRef::TupleStruct(child_of) = value.reflect_ref() else {
        return None;
    };
    child_of.field(0)?.try_downcast_ref::<Entity>().copied()
}

impl Session<'_> {
    /// Sets a component or a field of it; one that the entity lacks starts from its default. Every
    /// mistake is reported.
    pub fn assign(&mut self, assignment: &Assignment<'_>) {
        let types = self.types();
        let registry = types.read();
        let Assignment {
            entity,
            component,
            origin,
            path,
            ..
        } = *assignment;
        let Some((registration, reflect)) = find_component(&registry, component) else {
            let hint = suggest(component, component_names(&registry));
            let diagnostic = Diagnostic::error(format!("there is no component `{component}`"))
                .at(origin.span(assignment.pos))
                .field(path)
                .hint(hint);
            self.diagnostics.push(diagnostic);
            return;
        };
        let info = registration.type_info();
        let current = reflect.reflect(self.world.entity(entity));
        let Some(mut value) = copy_or_default(&registry, info, current) else {
            let message = format!("`{component}` is registered without a default");
            self.error(origin.span(assignment.pos), path, message);
            return;
        };
        let wants_material = registration.type_id() == TypeId::of::<MaterialRef>();
        let resolved = self.reflecting(&registry, origin, wants_material, |context| {
            context.apply_at(
                value.as_mut(),
                assignment.steps,
                assignment.pos,
                assignment.value,
                &FieldPath::Root(path),
            );
        });
        if registration.type_id() == TypeId::of::<ChildOf>()
            && parent_in(value.as_ref()) == Some(entity)
        {
            // Said here, for bevy drops such a relation before a check of the world could see it.
            let message = "the entity is its own parent".to_owned();
            self.error(origin.span(assignment.pos), path, message);
            return;
        }
        // A name that stands for nothing leaves a placeholder, which must not reach the world.
        if resolved {
            self.record(assignment);
            self.insert(&registry, reflect, entity, value.as_ref());
        }
    }

    fn insert(
        &mut self,
        registry: &TypeRegistry,
        reflect: &ReflectComponent,
        entity: Entity,
        value: &dyn PartialReflect,
    ) {
        reflect.insert(&mut self.world.entity_mut(entity), value, registry);
    }

    /// Notes where the value was set, under the path that errors call the entity by.
    fn record(&mut self, assignment: &Assignment<'_>) {
        let mut typed = assignment.path.to_owned();
        for step in assignment.steps {
            match step {
                Step::Field(name) => typed = format!("{typed}.{name}"),
                Step::Index(index) => typed = format!("{typed}[{index}]"),
            }
        }
        // The whole value of a file's component is best looked up where its name stands.
        let pos = if assignment.steps.is_empty() {
            assignment.pos
        } else {
            assignment.value.pos
        };
        self.places.record(typed, assignment.origin.span(pos));
        let known_as = format!(
            "{}.{}",
            self.names.path(assignment.entity),
            assignment.component
        );
        if known_as != assignment.path {
            self.places.alias(assignment.path, &known_as);
        }
    }

    /// Before an override brings a lobe to a material that has another, places a thing in another
    /// way, focuses a lens in another, or makes another camera the active one: there can be only one,
    /// so the older goes.
    pub fn make_way(&mut self, assignment: &Assignment<'_>) {
        let entity = assignment.entity;
        match (assignment.component, assignment.steps) {
            ("ActiveCamera", _) => return self.deactivate_cameras(),
            // A field of the other placement is told in `Validate`: it might be a slip.
            ("LookAt", []) => drop(self.world.entity_mut(entity).remove::<LocalTransform>()),
            ("LocalTransform", []) => drop(self.world.entity_mut(entity).remove::<LookAt>()),
            ("ThinLens", [Step::Field(field)]) => self.refocus(entity, field),
            _ => {}
        }
        let lobes: Vec<_> = {
            let catalog = self.world.resource::<LobeCatalog>();
            if catalog.get(assignment.component).is_none() {
                return;
            }
            let present = catalog.of(self.world.entity(entity)).map(|(name, _)| name);
            present.collect()
        };
        if lobes.contains(&assignment.component) {
            return;
        }
        for name in &lobes {
            let entry = self.world.resource::<LobeCatalog>().get(name).copied();
            if let Some(entry) = entry {
                (entry.remove)(&mut self.world.entity_mut(entity));
            }
        }
        // Naming a whole component is plain; a field might be meant for the lobe that was there.
        if let (Some(old), false) = (lobes.first(), assignment.steps.is_empty()) {
            let message = format!("the material was {old} and is {} now", assignment.component);
            let notice = Diagnostic::notice(message)
                .at(assignment.origin.span(assignment.pos))
                .field(assignment.path);
            self.diagnostics.push(notice);
        }
    }

    /// A focus that an override gives takes the place of one given in the other way.
    fn refocus(&mut self, entity: Entity, field: &str) {
        if let Some(mut lens) = self.world.get_mut::<ThinLens>(entity) {
            match field {
                "focus" => lens.focus_distance = None,
                "focus_distance" => lens.focus = None,
                _ => {}
            }
        }
    }

    /// Takes the tag off every camera.
    pub fn deactivate_cameras(&mut self) {
        let mut active = self.world.query_filtered::<Entity, With<ActiveCamera>>();
        let active: Vec<Entity> = active.iter(self.world).collect();
        for entity in active {
            self.world.entity_mut(entity).remove::<ActiveCamera>();
        }
    }
}
