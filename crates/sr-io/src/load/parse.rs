//! `Parse`: files become documents and models.

use super::names::Names;
use super::{Change, LoadRequest, Override};
use crate::document::{self, Config, Document, ModelEntry, OverrideEntry, Scene};
use crate::model::Model;
use crate::reflect::{Origin, Places};
use crate::ron::{self, Node, Pos, Value};
use bevy_ecs::prelude::*;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::{Diagnostic, Diagnostics, nearest};
use std::path::{Path, PathBuf};

/// Everything that was read, for the steps that follow.
#[derive(Resource)]
pub(super) struct Documents {
    pub config: Config,
    /// The scene's path as the user wrote it.
    pub scene_path: String,
    pub scene: Scene,
    pub models: Vec<LoadedModel>,
    /// Changes by path, in order.
    pub overrides: Vec<Change>,
    /// How many of them are the scene's own.
    pub scene_overrides: usize,
}

/// A model and how it was asked for.
pub(super) struct LoadedModel {
    pub name: String,
    pub file: SourceSpan,
    /// Where a scene asks for it; unset for a model that is rendered by itself.
    pub entry: Option<SourceSpan>,
    pub transform: Option<Node>,
    pub format: Format,
    pub model: Model,
}

/// Model formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Gltf,
    Obj,
}

/// Reads everything that the request leads to.
pub(super) fn read_files(world: &mut World) -> Result {
    let request = world.resource::<LoadRequest>().clone();
    let mut reader = FileReader::default();
    let documents = reader.read(&request);
    world.remove_resource::<Documents>();
    world.insert_resource(Places::default());
    world
        .resource_mut::<Diagnostics>()
        .0
        .extend(reader.diagnostics);
    world.insert_resource(reader.names);
    match documents {
        Some(documents) => world.insert_resource(documents),
        // Without a configuration there is nothing to go on with.
        None => world.resource::<Diagnostics>().check()?,
    }
    Ok(())
}

#[derive(Default)]
struct FileReader {
    diagnostics: Vec<Diagnostic>,
    names: Names,
}

impl FileReader {
    fn read(&mut self, request: &LoadRequest) -> Option<Documents> {
        let mut changes = request.changes.clone();
        changes.extend(request.overrides.iter().map(|o| self.change(o)));
        let (mut scenes, mut changes): (Vec<Change>, Vec<Change>) =
            changes.into_iter().partition(|c| c.entry.path == "scene");
        let path = &request.path;
        let mut config = if is_ron(path) {
            match self.document(path, None)? {
                Document::Config(config) => config,
                // Another scene in its place leaves a configuration of defaults.
                Document::Scene(_) if !scenes.is_empty() => Config::new(Origin::file(path)),
                Document::Scene(scene) => {
                    return Some(self.around(
                        Config::new(Origin::file(path)),
                        path,
                        scene,
                        changes,
                    ));
                }
            }
        } else if !scenes.is_empty() {
            Config::new(Origin::file(path))
        } else {
            let scene = self.bare_model(path, None)?;
            return Some(self.around(Config::new(Origin::file(path)), path, scene, changes));
        };
        let mut origin = config.origin.clone();
        if let Some(change) = scenes.pop() {
            config.scene = self.scene_of(&change).or(config.scene);
            origin = change.origin;
        }
        let Some((text, pos)) = config.scene.clone() else {
            self.names.lost_scene = true;
            let scene = Scene::empty(config.origin.clone());
            return Some(self.around(config, path, scene, changes));
        };
        let scene_path = origin.folder.join(&text);
        let span = origin.span(pos);
        let scene = if is_ron(&scene_path) {
            match self.document(&scene_path, Some(&span)) {
                Some(Document::Scene(scene)) => Some(scene),
                Some(Document::Config(_)) => {
                    let message = format!("`{text}` is a run configuration and no scene");
                    self.error(Some(span), "scene", message, None);
                    None
                }
                None => None,
            }
        } else {
            self.bare_model(&scene_path, Some(&span))
        };
        let scene = scene.unwrap_or_else(|| {
            self.names.lost_scene = true;
            Scene::empty(Origin::file(&scene_path))
        });
        let of_config = config.overrides.drain(..).map(|entry| Change {
            origin: config.origin.clone(),
            entry,
        });
        changes.splice(0..0, of_config.collect::<Vec<_>>());
        Some(self.around(config, Path::new(&text), scene, changes))
    }

    /// Puts documents together and reads the models.
    fn around(
        &mut self,
        config: Config,
        scene_path: &Path,
        mut scene: Scene,
        changes: Vec<Change>,
    ) -> Documents {
        let of_scene = std::mem::take(&mut scene.overrides);
        let scene_overrides = of_scene.len();
        let origin = scene.origin.clone();
        let overrides = of_scene.into_iter().map(|entry| Change {
            origin: origin.clone(),
            entry,
        });
        let overrides = overrides.chain(changes).collect();
        let entries = std::mem::take(&mut scene.models);
        let models = entries
            .into_iter()
            .filter_map(|entry| self.model(&scene, entry))
            .collect();
        Documents {
            config,
            scene_path: scene_path.display().to_string(),
            scene,
            models,
            overrides,
            scene_overrides,
        }
    }

    /// An override of the command line; what is no RON there is a word.
    fn change(&mut self, given: &Override) -> Change {
        let origin = Origin::option(&given.origin);
        let pos = Pos { line: 1, column: 1 };
        let value = match ron::parse(&given.value) {
            Ok(node) => node,
            Err(error) => {
                if !is_word(&given.value) {
                    let message = format!(
                        "`{}` is no RON at column {}: {}",
                        given.value, error.pos.column, error.message
                    );
                    self.error(Some(origin.span(pos)), &given.path, message, None);
                }
                Node {
                    value: Value::String(given.value.clone()),
                    pos,
                }
            }
        };
        let entry = OverrideEntry {
            path: given.path.clone(),
            pos,
            value,
        };
        Change { origin, entry }
    }

    fn scene_of(&mut self, change: &Change) -> Option<(String, Pos)> {
        let node = &change.entry.value;
        match &node.value {
            Value::String(text) | Value::Name(text) => Some((text.clone(), node.pos)),
            other => {
                let message = format!("expected a path, found {}", other.describe());
                self.error(Some(change.origin.span(node.pos)), "scene", message, None);
                None
            }
        }
    }

    fn error(
        &mut self,
        span: Option<SourceSpan>,
        field: &str,
        message: String,
        hint: Option<String>,
    ) {
        let mut diagnostic = Diagnostic::error(message).at(span).field(field);
        diagnostic.hint = hint;
        self.diagnostics.push(diagnostic);
    }

    /// Reads and understands a RON file that stands in `scene`, or that the user named.
    fn document(&mut self, path: &Path, asked: Option<&SourceSpan>) -> Option<Document> {
        let bytes = match crate::file::read(path) {
            Ok(bytes) => bytes,
            Err(reason) => {
                self.unreadable(path, &reason, asked, "scene");
                return None;
            }
        };
        match std::str::from_utf8(&bytes) {
            Ok(text) => document::parse(path, text, &mut self.diagnostics),
            Err(error) => {
                let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
                let line = valid.matches('\n').count() + 1;
                let last = valid.rsplit('\n').next().unwrap_or("");
                let pos = Pos {
                    line: u32::try_from(line).unwrap_or(u32::MAX),
                    column: u32::try_from(last.chars().count() + 1).unwrap_or(u32::MAX),
                };
                let span = Origin::file(path).span(pos);
                self.error(Some(span), "", "the file is no UTF-8 text".into(), None);
                None
            }
        }
    }

    fn unreadable(&mut self, path: &Path, reason: &str, asked: Option<&SourceSpan>, field: &str) {
        // What is there needs no other name.
        let is_missing =
            std::fs::metadata(path).is_err_and(|e| e.kind() == std::io::ErrorKind::NotFound);
        let hint = is_missing
            .then(|| nearest_file(path))
            .flatten()
            .map(|near| format!("did you mean `{}`?", near.display()));
        let field = if asked.is_some() { field } else { "" };
        let message = format!("`{}`: {reason}", path.display());
        self.error(asked.cloned(), field, message, hint);
    }

    /// A model by itself as a scene.
    fn bare_model(&mut self, path: &Path, asked: Option<&SourceSpan>) -> Option<Scene> {
        if format(path).is_none() {
            let field = if asked.is_some() { "scene" } else { "" };
            let message = format!("`{}` is of no kind that can be rendered", path.display());
            self.error(asked.cloned(), field, message, Some(KINDS.into()));
            return None;
        }
        let pos = Pos { line: 0, column: 0 };
        let mut scene = Scene::empty(Origin::file(path));
        let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned());
        scene.models.push(ModelEntry {
            name: stem.unwrap_or_else(|| "model".into()),
            pos,
            path: path.to_owned(),
            path_pos: pos,
            transform: None,
        });
        Some(scene)
    }

    fn model(&mut self, scene: &Scene, entry: ModelEntry) -> Option<LoadedModel> {
        let asked = (entry.pos.line > 0).then(|| scene.origin.span(entry.path_pos));
        let field = format!("models.{}.path", entry.name);
        let format = format(&entry.path);
        let is_there = std::fs::metadata(&entry.path);
        let read = match (format, is_there) {
            (_, Err(error)) => {
                let reason = match error.kind() {
                    std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
                    _ => error.to_string(),
                };
                self.unreadable(&entry.path, &reason, asked.as_ref(), &field);
                None
            }
            (None, _) => {
                let message = format!("`{}` is no model", entry.path.display());
                let hint = "models are .gltf, .glb and .obj files";
                self.error(asked.clone(), &field, message, Some(hint.into()));
                None
            }
            (Some(Format::Gltf), _) => Some(crate::gltf::read(&entry.path)),
            (Some(Format::Obj), _) => Some(crate::obj::read(&entry.path)),
        };
        let model = match read {
            Some(Ok(model)) => model,
            failed => {
                if let Some(Err(errors)) = failed {
                    self.diagnostics.extend(errors);
                }
                self.names.lost_models.push(entry.name);
                return None;
            }
        };
        self.diagnostics.extend(model.notes.iter().cloned());
        Some(LoadedModel {
            name: entry.name,
            file: SourceSpan::file(entry.path.as_path().into()),
            entry: (entry.pos.line > 0).then(|| scene.origin.span(entry.pos)),
            transform: entry.transform,
            format: format?,
            model,
        })
    }
}

const KINDS: &str =
    "give a run configuration (.ron), a scene (.scene.ron) or a model (.gltf, .glb, .obj)";

fn extension(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default();
    extension.to_string_lossy().to_lowercase()
}

fn is_ron(path: &Path) -> bool {
    extension(path) == "ron"
}

fn format(path: &Path) -> Option<Format> {
    match extension(path).as_str() {
        "gltf" | "glb" => Some(Format::Gltf),
        "obj" => Some(Format::Obj),
        _ => None,
    }
}

/// A word that a shell would hand over without its quotes, such as `box/left_wall` or a file name.
fn is_word(text: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || "_-./#+ :\\~".contains(c);
    !text.trim().is_empty() && text.chars().all(part)
}

/// The other file of the same folder whose name is nearest to a missing one's.
pub fn nearest_file(path: &Path) -> Option<PathBuf> {
    let folder = path.parent()?;
    let listed = if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    };
    let mut names: Vec<String> = std::fs::read_dir(listed)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort();
    let name = path.file_name()?.to_str()?;
    // A link that leads nowhere is listed although it is missing.
    names.retain(|n| n != name);
    nearest(name, names.iter().map(String::as_str)).map(|near| folder.join(near))
}
