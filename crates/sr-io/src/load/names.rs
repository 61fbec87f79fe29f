//! Which entity a name means.

use crate::reflect::Resolved;
use bevy_ecs::prelude::*;
use sr_scene::diagnostics::suggest;
use std::collections::{BTreeMap, HashMap};

/// The two spaces of names. A model's node and its material may share a name; so `entities.` and
/// `materials.` are told apart.
#[derive(Resource, Default, Debug)]
pub(super) struct Names {
    /// Things: `entities.<name>`.
    pub entities: BTreeMap<String, Entity>,
    /// Materials: `materials.<model>/<material>`, and entities of the scene file that are some.
    pub materials: BTreeMap<String, Entity>,
    /// The path that errors call an entity by.
    paths: HashMap<Entity, String>,
    /// How often a name was asked for, to make repeated ones unique.
    repeats: HashMap<String, usize>,
    /// Models that could not be read: names that start so are not known to be wrong.
    pub lost_models: Vec<String>,
    /// The scene file could not be read, so no name is known to be wrong.
    pub lost_scene: bool,
}

impl Names {
    /// Adds a thing.
    pub fn add_entity(&mut self, name: &str, entity: Entity) {
        self.entities.insert(name.to_owned(), entity);
        self.paths.insert(entity, format!("entities.{name}"));
    }

    /// Adds a material that a model brought.
    pub fn add_material(&mut self, name: &str, entity: Entity) {
        self.materials.insert(name.to_owned(), entity);
        self.paths.insert(entity, format!("materials.{name}"));
    }

    /// Adds the camera of a configuration.
    pub fn add_camera(&mut self, name: &str, entity: Entity) {
        self.entities.insert(name.to_owned(), entity);
        self.paths.insert(entity, "camera".into());
    }

    /// The path that errors call an entity by.
    pub fn path(&self, entity: Entity) -> String {
        self.paths.get(&entity).cloned().unwrap_or_default()
    }

    /// `base`, or with `#2`, `#3` when it is taken already among the materials or the things.
    pub fn unique(&mut self, base: &str, among_materials: bool) -> String {
        let taken = |names: &Self, name: &str| {
            if among_materials {
                names.materials.contains_key(name)
            } else {
                names.entities.contains_key(name)
            }
        };
        if !taken(self, base) {
            return base.to_owned();
        }
        let key = format!("{base}\0{among_materials}");
        let mut count = self.repeats.get(&key).copied().unwrap_or(1);
        loop {
            count += 1;
            let name = format!("{base}#{count}");
            if !taken(self, &name) {
                self.repeats.insert(key, count);
                return name;
            }
        }
    }

    /// Whether a name belongs to something that could not be read.
    pub fn is_lost(&self, name: &str) -> bool {
        let of_model = |model: &String| {
            name.strip_prefix(model.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['/', '.', '[']))
        };
        self.lost_scene || self.lost_models.iter().any(of_model)
    }

    /// The entity that a component's field names: materials come first where one is wanted.
    pub fn resolve(&self, name: &str, wants_material: bool) -> Resolved {
        let (first, second) = if wants_material {
            (&self.materials, &self.entities)
        } else {
            (&self.entities, &self.materials)
        };
        if let Some(entity) = first.get(name).or_else(|| second.get(name)) {
            return Ok(*entity);
        }
        if self.is_lost(name) {
            return Err(None);
        }
        let candidates = first.keys().map(String::as_str);
        Err(Some(if wants_material && first.is_empty() {
            "the scene has no material yet: an entity with a lobe, such as `Lambert`, is one".into()
        } else {
            suggest(name, candidates)
        }))
    }
}
