//! The configuration as it is after everything has been applied, for provenance.

use super::camera::components_of;
use super::parse::Documents;
use super::session::Session;
use crate::reflect::to_ron;
use crate::ron::{Node, Value, quote};
use bevy_ecs::prelude::*;
use bevy_reflect::PartialReflect;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{
    AdaptiveSettings, Budget, CompileSettings, FilmSettings, PostSettings, SamplerSettings,
    SceneFilm,
};
use std::fmt::Write;

/// What of the configuration is no setting: kept by `Load` for [`resolved_config`].
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct ResolvedConfig {
    /// The scene's path as the user wrote it.
    pub scene: String,
    /// The configuration's camera in RON.
    pub camera: Option<String>,
    /// Changes to the scene by the configuration and the command line: path and value in RON, in
    /// order, without those that are visible in the settings.
    pub overrides: Vec<(String, String)>,
}

impl Session<'_> {
    /// Keeps what [`resolved_config`] needs.
    pub(super) fn keep_resolved(&mut self, documents: &Documents) {
        let mut camera = documents.config.camera.as_ref().map(ToString::to_string);
        let mut overrides: Vec<(String, String)> = Vec::new();
        for change in &documents.overrides[documents.scene_overrides..] {
            let path = &change.entry.path;
            match path.split(['.', '[']).next() {
                Some("camera") if path == "camera" => {
                    camera = Some(change.entry.value.to_string());
                    overrides.retain(|(p, _)| !p.starts_with("camera"));
                }
                Some("entities" | "materials" | "camera") => {
                    let value = &change.entry.value;
                    if change.origin.is_file {
                        expand(path, value, &mut overrides);
                    } else {
                        expand(path, &anchored(path, value), &mut overrides);
                    }
                }
                _ => {}
            }
        }
        self.world.insert_resource(ResolvedConfig {
            scene: documents.scene_path.clone(),
            camera,
            overrides,
        });
    }
}

/// A value of the command line as a file would write it: the path of a map starts in the folder of
/// whoever names it, and the resolved configuration stands in another.
fn anchored(path: &str, node: &Node) -> Node {
    let mut node = node.clone();
    let at_map = path.ends_with("Environment.map");
    match &mut node.value {
        Value::String(text) if at_map => {
            if let Ok(absolute) = std::path::absolute(&*text) {
                *text = absolute.display().to_string();
            }
        }
        Value::Some(inner) => **inner = anchored(path, inner),
        Value::Struct { fields, .. } => {
            for field in fields {
                field.value = anchored(&format!("{path}.{}", field.key), &field.value);
            }
        }
        Value::Map(entries) => {
            for (component, value) in entries {
                if let Value::String(component) = &component.value {
                    *value = anchored(&format!("{path}.{component}"), value);
                }
            }
        }
        _ => {}
    }
    node
}

/// One override a field, so that each path stands there once: a value by parts keeps what it does
/// not name, so a later one does not make all of an earlier one void.
fn expand(path: &str, value: &Node, overrides: &mut Vec<(String, String)>) {
    match &value.value {
        Value::Struct { name: None, fields } if !fields.is_empty() => {
            for field in fields {
                expand(&format!("{path}.{}", field.key), &field.value, overrides);
            }
        }
        Value::Map(entries) if !entries.is_empty() => {
            for (component, _, value) in components_of(entries) {
                expand(&format!("{path}.{component}"), &value, overrides);
            }
        }
        value => {
            overrides.retain(|(p, _)| p != path);
            overrides.push((path.to_owned(), value.to_string()));
        }
    }
}

/// The configuration that was run, as RON that describes the same run when it stands where the
/// original stood. Every setting is there, defaults included.
pub fn resolved_config(world: &World) -> String {
    let mut text = String::from("(\n");
    let mut line = |field: &str, value: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "    {field}: {value},");
    };
    let config = world.get_resource::<ResolvedConfig>();
    if let Some(config) = config {
        line("scene", quote(&config.scene));
        if let Some(camera) = &config.camera {
            line("camera", camera.clone());
        }
    }
    if let Some(selected) = world.get_resource::<SelectedIntegrator>() {
        let settings = to_ron(selected.settings.as_partial_reflect());
        line("integrator", format!("{}{settings}", selected.name));
    }
    let mut film = world
        .get_resource::<FilmSettings>()
        .cloned()
        .unwrap_or_default();
    let scene_film = world.get_resource::<SceneFilm>().copied();
    let [width, height] = film.size(scene_film.unwrap_or_default());
    (film.width, film.height) = (Some(width), Some(height));
    line("film", to_ron(&film));
    line("sampler", section::<SamplerSettings>(world));
    line("budget", section::<Budget>(world));
    line("adaptive", section::<AdaptiveSettings>(world));
    line("post", section::<PostSettings>(world));
    line("compile", section::<CompileSettings>(world));
    if let Some(config) = config.filter(|c| !c.overrides.is_empty()) {
        let overrides: Vec<String> = (config.overrides.iter())
            .map(|(path, value)| format!("{}: {value}", quote(path)))
            .collect();
        line("overrides", format!("{{{}}}", overrides.join(", ")));
    }
    text.push(')');
    text.push('\n');
    text
}

fn section<R: Resource + PartialReflect + Default>(world: &World) -> String {
    match world.get_resource::<R>() {
        Some(settings) => to_ron(settings),
        None => to_ron(&R::default()),
    }
}

/// A short name of a configuration's text: FNV-1a of 64 bits (Fowler, Noll, Vo 1991), in hex. The
/// same on every machine and for every version.
pub fn config_hash(text: &str) -> String {
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{hash:016x}")
}
