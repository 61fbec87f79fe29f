//! `Override`: values by path, of the scene, the configuration and the command line, in that order.
//!
//! | path | what it reaches |
//! |---|---|
//! | `entities.<name>.<Component>.<field>` | whatever has a name |
//! | `materials.<model>/<material>.<Component>.<field>` | what a model file brought |
//! | `camera.<Component>.<field>` | the camera that renders |
//! | `integrator.<field>`, `film.<field>`, `sampler.…`, `budget.…`, `adaptive.…`, `post.…`, `compile.…` | settings |
//!
//! Without fields the whole value is set; what it does not name keeps what it had. Names may hold
//! dots and slashes: the longest name that the scene knows is meant.

use super::Change;
use super::camera::components_of;
use super::component::{Assignment, find_component};
use super::parse::Documents;
use super::session::{Session, in_session};
use super::settings::Setting;
use crate::document::SECTIONS;
use crate::reflect::{Step, parse_steps};
use crate::ron::Value;
use bevy_ecs::prelude::*;
use sr_scene::components::{MaterialRef, Quad, Sphere, TriangleMesh};
use sr_scene::diagnostics::{Diagnostic, suggest};

/// Longer paths are no slip of the pen; names within paths are sought at every dot.
const LONGEST_PATH: usize = 4096;

/// Applies all overrides.
pub(super) fn apply_overrides(world: &mut World) {
    let Some(documents) = world.remove_resource::<Documents>() else {
        return;
    };
    in_session(world, |session| {
        for change in &documents.overrides {
            session.change(change);
        }
    });
    world.insert_resource(documents);
}

impl Session<'_> {
    fn change(&mut self, change: &Change) {
        let path = change.entry.path.as_str();
        if path.len() > LONGEST_PATH {
            let message = format!(
                "a path of {} bytes, {LONGEST_PATH} at most lead anywhere",
                path.len()
            );
            return self.path_error(change, message, None);
        }
        let (head, rest) = match path.find(['.', '[']) {
            Some(at) => (&path[..at], &path[at..]),
            None => (path, ""),
        };
        match head {
            "entities" | "materials" => self.change_named(change, head, rest),
            "camera" if rest.is_empty() => {
                self.set_camera(&change.entry.value, &change.origin);
            }
            "camera" => self.change_camera(change, rest),
            _ => self.change_setting(change, head, rest),
        }
    }

    /// Reports what is wrong with the path itself.
    fn path_error(&mut self, change: &Change, message: String, hint: Option<String>) {
        let mut diagnostic = Diagnostic::error(message)
            .at(change.origin.span(change.entry.pos))
            .field(change.entry.path.as_str());
        diagnostic.hint = hint;
        self.diagnostics.push(diagnostic);
    }

    fn change_setting(&mut self, change: &Change, head: &str, rest: &str) {
        let heads = ["entities", "materials", "camera", "integrator"];
        let heads = || heads.into_iter().chain(SECTIONS);
        if !heads().any(|h| h == head) {
            let message = format!("no path starts with `{head}`");
            return self.path_error(change, message, Some(suggest(head, heads())));
        }
        let steps = match parse_steps(rest) {
            Ok(steps) => steps,
            Err(message) => return self.path_error(change, message, None),
        };
        let setting = Setting {
            steps: &steps,
            value: &change.entry.value,
            origin: &change.origin,
            pos: change.entry.pos,
        };
        if !self.set_section(head, &setting) {
            self.set_integrator(&setting);
        }
    }

    fn change_camera(&mut self, change: &Change, rest: &str) {
        match self.active_camera() {
            Some(camera) => self.change_entity(change, camera, "camera", rest),
            None if self.names.lost_scene || !self.names.lost_models.is_empty() => {}
            None => {
                let message = "the scene has no camera to change".to_owned();
                let hint = "give one: `camera: {\"PerspectiveCamera\": (…), \"LookAt\": (…)}`";
                self.path_error(change, message, Some(hint.into()));
            }
        }
    }

    /// `entities` and `materials`: finds the name in the path.
    fn change_named(&mut self, change: &Change, head: &str, rest: &str) {
        let Some(rest) = rest.strip_prefix('.').filter(|r| !r.is_empty()) else {
            let message = format!("a name is missing after `{head}.`");
            return self.path_error(change, message, None);
        };
        let names = if head == "entities" {
            &self.names.entities
        } else {
            &self.names.materials
        };
        // Every name that the path may start with, the longest first.
        let mut found: Vec<(&str, Entity)> = (0..=rest.len())
            .rev()
            .filter(|at| rest.is_char_boundary(*at))
            .filter(|at| rest[*at..].is_empty() || rest[*at..].starts_with('.'))
            .filter_map(|at| Some((&rest[..at], *names.get(&rest[..at])?)))
            .collect();
        if found.len() > 1 {
            let types = self.types();
            let registry = types.read();
            let sensible = |(name, _): &(&str, Entity)| {
                let component = component_of(&rest[name.len()..]);
                component.is_none_or(|c| find_component(&registry, c).is_some())
            };
            if found.iter().any(sensible) {
                found.retain(sensible);
            }
        }
        match found.as_slice() {
            [] => self.unknown_name(change, head, rest),
            [(name, entity)] => {
                let prefix = format!("{head}.{name}");
                self.change_entity(change, *entity, &prefix, &rest[name.len()..]);
            }
            several => {
                let names: Vec<&str> = several.iter().map(|(name, _)| *name).collect();
                let message = format!("the path may mean any of {}", names.join(", "));
                self.path_error(change, message, Some("rename one of them".into()));
            }
        }
    }

    fn unknown_name(&mut self, change: &Change, head: &str, rest: &str) {
        if self.names.is_lost(rest) {
            return;
        }
        // What is most likely meant as the name: everything before a component.
        let name = {
            let types = self.types();
            let registry = types.read();
            let end = rest
                .match_indices('.')
                .map(|(at, _)| at)
                .find(|at| {
                    component_of(&rest[*at..])
                        .is_some_and(|c| find_component(&registry, c).is_some())
                })
                .or_else(|| rest.find('.'));
            &rest[..end.unwrap_or(rest.len())]
        };
        let (known, other, other_head, what) = if head == "entities" {
            let (known, other) = (&self.names.entities, &self.names.materials);
            (known, other, "materials", "entity")
        } else {
            let (known, other) = (&self.names.materials, &self.names.entities);
            (known, other, "entities", "material")
        };
        let hint = if other.contains_key(name) {
            format!("`{other_head}.{name}` is there")
        } else {
            suggest(name, known.keys().map(String::as_str))
        };
        self.path_error(change, format!("there is no {what} `{name}`"), Some(hint));
    }

    /// `.Component`, `.Component.field` or nothing after the name of an entity.
    fn change_entity(&mut self, change: &Change, entity: Entity, prefix: &str, rest: &str) {
        if rest.is_empty() {
            return self.change_components(change, entity, prefix);
        }
        let steps = match parse_steps(rest) {
            Ok(steps) => steps,
            Err(message) => return self.path_error(change, message, None),
        };
        let Some((Step::Field(component), steps)) = steps.split_first() else {
            let message = "expected the name of a component".to_owned();
            return self.path_error(change, message, None);
        };
        let assignment = Assignment {
            entity,
            component,
            steps,
            value: &change.entry.value,
            origin: &change.origin,
            pos: change.entry.pos,
            path: &format!("{prefix}.{component}"),
        };
        self.assign_override(&assignment);
    }

    fn change_components(&mut self, change: &Change, entity: Entity, prefix: &str) {
        let Value::Map(entries) = &change.entry.value.value else {
            let message = format!(
                "expected components, found {}",
                change.entry.value.value.describe()
            );
            let hint = "write `{\"Component\": (…), …}`, or name one in the path";
            return self.path_error(change, message, Some(hint.into()));
        };
        for (component, pos, value) in &components_of(entries) {
            let assignment = Assignment {
                entity,
                component,
                steps: &[],
                value,
                origin: &change.origin,
                pos: *pos,
                path: &format!("{prefix}.{component}"),
            };
            self.assign_override(&assignment);
        }
    }

    fn assign_override(&mut self, assignment: &Assignment<'_>) {
        let entity = assignment.entity;
        if assignment.component != "MaterialRef" || self.is_shape(entity) {
            self.make_way(assignment);
            return self.assign(assignment);
        }
        // On something that is no shape itself, such as a model: everything below it.
        let shapes = self.shapes_below(entity);
        if shapes.is_empty() {
            let message = "there is no shape here or below that could have a material".to_owned();
            let span = assignment.origin.span(assignment.pos);
            return self.error(span, assignment.path, message);
        }
        let before = self.diagnostics.len();
        for entity in shapes {
            self.assign(&Assignment {
                entity,
                ..*assignment
            });
            if self.diagnostics.len() > before {
                return;
            }
        }
    }

    /// Whether an entity has a shape of its own.
    pub fn is_shape(&self, entity: Entity) -> bool {
        let entity = self.world.entity(entity);
        entity.contains::<TriangleMesh>()
            || entity.contains::<Sphere>()
            || entity.contains::<Quad>()
    }

    /// Shapes that are children of an entity, or theirs. Hierarchies may be deep, and until they
    /// are validated may even run in circles.
    fn shapes_below(&self, root: Entity) -> Vec<Entity> {
        let mut seen = std::collections::HashSet::from([root]);
        let mut stack = vec![root];
        let mut shapes = Vec::new();
        while let Some(entity) = stack.pop() {
            if self.is_shape(entity) {
                shapes.push(entity);
            }
            let children = self.world.get::<Children>(entity);
            let children = children.into_iter().flatten().copied();
            stack.extend(children.filter(|c| seen.insert(*c)));
        }
        shapes
    }
}

impl Session<'_> {
    /// The material of a shape, when it has one.
    pub fn material_of(&self, shape: Entity) -> Option<Entity> {
        self.world.get::<MaterialRef>(shape).map(|m| m.0)
    }
}

/// The component that a path names after an entity: `.Lambert.reflectance` → `Lambert`.
fn component_of(rest: &str) -> Option<&str> {
    let rest = rest.strip_prefix('.')?;
    Some(&rest[..rest.find(['.', '[']).unwrap_or(rest.len())])
}
