//! Scene or configuration: told by the extension and, where that is silent, by the fields.

use super::fields::Reader;
use super::{Config, Scene, config, scene};
use crate::reflect::Origin;
use crate::ron::{self, Node, Value};
use sr_scene::diagnostics::Diagnostic;
use std::path::Path;

/// One file.
#[derive(Clone, Debug)]
pub enum Document {
    /// A scene.
    Scene(Scene),
    /// A run configuration.
    Config(Config),
}

/// Reads the text of a file. Its problems are added to `diagnostics`; `None` when it is no RON or
/// neither of the two.
pub fn parse(path: &Path, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Document> {
    let origin = Origin::file(path);
    let mut reader = Reader {
        origin: &origin,
        diagnostics,
    };
    let node = match ron::parse(text) {
        Ok(node) => node,
        Err(error) => {
            reader.error(error.pos, "", error.message);
            return None;
        }
    };
    let is_scene_file = path
        .to_string_lossy()
        .to_lowercase()
        .ends_with(".scene.ron");
    let of_scene = first_field(&node, |f| is_only(f, &scene::FIELDS, &config::FIELDS));
    let of_config = first_field(&node, |f| is_only(f, &config::FIELDS, &scene::FIELDS));
    match (of_scene, of_config) {
        (Some((scene, _)), Some((config, pos))) => {
            let message = format!(
                "`{config}` belongs to a run configuration and `{scene}` to a scene: one file \
                 cannot be both"
            );
            let hint = "keep the scene in a `.scene.ron` file and name it in `scene`";
            reader.error_with_hint(pos, &config, message, hint);
            None
        }
        (Some(_), None) => Some(Document::Scene(scene::read(&mut reader, &node))),
        (None, Some((field, pos))) if is_scene_file => {
            let message = format!("`{field}` belongs to a run configuration, this is a scene");
            let hint = "the name of a configuration ends in `.ron` without `.scene`";
            reader.error_with_hint(pos, &field, message, hint);
            None
        }
        (None, None) if is_scene_file => Some(Document::Scene(scene::read(&mut reader, &node))),
        _ => Some(Document::Config(config::read(&mut reader, &node))),
    }
}

fn is_only(field: &str, here: &[&str], there: &[&str]) -> bool {
    here.contains(&field) && !there.contains(&field)
}

fn first_field(node: &Node, accept: impl Fn(&str) -> bool) -> Option<(String, ron::Pos)> {
    match &node.value {
        Value::Struct { fields, .. } => fields
            .iter()
            .find(|f| accept(&f.key))
            .map(|f| (f.key.clone(), f.key_pos)),
        _ => None,
    }
}
