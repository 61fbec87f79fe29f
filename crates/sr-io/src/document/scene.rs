//! `*.scene.ron`: models, entities, overrides, and the picture size that suits them.

use super::OverrideEntry;
use super::fields::{Reader, join};
use crate::reflect::Origin;
use crate::ron::{Node, Pos, Value};
use std::path::PathBuf;

/// A scene file.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file.
    pub origin: Origin,
    /// Model files to include.
    pub models: Vec<ModelEntry>,
    /// Width and height of the picture, for [`SceneFilm`](sr_scene::settings::SceneFilm).
    pub film: Option<Node>,
    /// What the scene file itself brings.
    pub entities: Vec<EntityEntry>,
    /// Changes to what the models brought.
    pub overrides: Vec<OverrideEntry>,
}

impl Scene {
    /// One that has nothing.
    pub fn empty(origin: Origin) -> Self {
        Self {
            origin,
            models: Vec::new(),
            film: None,
            entities: Vec::new(),
            overrides: Vec::new(),
        }
    }
}

/// A model to include.
#[derive(Clone, Debug)]
pub struct ModelEntry {
    /// What its entities' names start with.
    pub name: String,
    /// Where the entry is.
    pub pos: Pos,
    /// The file, relative to the scene file's folder made one that can be opened.
    pub path: PathBuf,
    /// Where the path is written.
    pub path_pos: Pos,
    /// Placement of the model's root.
    pub transform: Option<Node>,
}

/// Components by name, each with the place of its name.
pub type Components = Vec<(String, Pos, Node)>;

/// An entity and its components.
#[derive(Clone, Debug)]
pub struct EntityEntry {
    /// Its name, unique in the file.
    pub name: String,
    /// Where the name is.
    pub pos: Pos,
    /// Its components.
    pub components: Components,
}

pub(super) const FIELDS: [&str; 4] = ["models", "film", "entities", "overrides"];

/// Reads the frame of a scene file.
pub(super) fn read(reader: &mut Reader<'_>, node: &Node) -> Scene {
    let mut scene = Scene::empty(reader.origin.clone());
    for field in reader.fields(node, "", &FIELDS) {
        match field.key.as_str() {
            "models" => scene.models = models(reader, &field.value),
            "film" => scene.film = Some(field.value.clone()),
            "entities" => scene.entities = entities(reader, &field.value),
            _ => scene.overrides = reader.overrides(&field.value, "overrides"),
        }
    }
    unique_names(reader, &mut scene);
    scene
}

fn models(reader: &mut Reader<'_>, node: &Node) -> Vec<ModelEntry> {
    let Value::List(items) = &node.value else {
        reader.expected(node, "models", "a list as `[(path: \"…\"), …]`");
        return Vec::new();
    };
    items
        .iter()
        .enumerate()
        .filter_map(|(i, node)| model(reader, &format!("models[{i}]"), node))
        .collect()
}

fn model(reader: &mut Reader<'_>, place: &str, node: &Node) -> Option<ModelEntry> {
    let before = reader.diagnostics.len();
    let (mut name, mut path, mut transform) = (None, None, None);
    for field in reader.fields(node, place, &["name", "path", "transform"]) {
        let place = join(place, &field.key);
        match field.key.as_str() {
            "name" => name = reader.text(&field.value, &place),
            "path" => {
                path = reader
                    .text(&field.value, &place)
                    .map(|p| (p, field.value.pos))
            }
            _ => transform = Some(field.value.clone()),
        }
    }
    let Some((text, path_pos)) = path else {
        if reader.diagnostics.len() == before {
            reader.error(node.pos, place, "a model needs a `path`");
        }
        return None;
    };
    let path = reader.origin.folder.join(&text);
    let stem = || path.file_stem().map(|s| s.to_string_lossy().into_owned());
    Some(ModelEntry {
        name: name.or_else(stem).unwrap_or_else(|| "model".into()),
        pos: node.pos,
        path,
        path_pos,
        transform,
    })
}

fn entities(reader: &mut Reader<'_>, node: &Node) -> Vec<EntityEntry> {
    let what = "entities as `{\"name\": {\"Component\": (…)}, …}`";
    reader
        .entries(node, "entities", what)
        .into_iter()
        .map(|(name, pos, node)| EntityEntry {
            name: name.to_owned(),
            pos,
            components: components(reader, &format!("entities.{name}"), node),
        })
        .collect()
}

/// Components of an entity or of the configuration's camera.
pub(super) fn components(reader: &mut Reader<'_>, path: &str, node: &Node) -> Components {
    reader
        .entries(node, path, "components as `{\"Component\": (…), …}`")
        .into_iter()
        .map(|(name, pos, node)| (name.to_owned(), pos, node.clone()))
        .collect()
}

/// Models and entities share one space of names.
fn unique_names(reader: &mut Reader<'_>, scene: &mut Scene) {
    let mut names = std::collections::HashSet::new();
    scene.models.retain(|m| {
        let new = names.insert(m.name.clone());
        if !new {
            let message = format!("another model is called `{}` already", m.name);
            reader.error_with_hint(m.pos, "models", message, "give it a `name` of its own");
        }
        new
    });
    scene.entities.retain(|e| {
        let new = names.insert(e.name.clone());
        if !new {
            let field = format!("entities.{}", e.name);
            reader.error(e.pos, &field, "a model has this name already");
        }
        new
    });
}
