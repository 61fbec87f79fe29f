//! `*.ron`: what to render of a scene, how, and when to stop.

use super::OverrideEntry;
use super::fields::Reader;
use crate::reflect::Origin;
use crate::ron::{Node, Pos};

/// Sections whose fields are those of a settings resource.
pub const SECTIONS: [&str; 6] = ["film", "sampler", "budget", "adaptive", "post", "compile"];

/// A run configuration.
#[derive(Clone, Debug)]
pub struct Config {
    /// The file, or whatever stands for it when a scene is rendered without one.
    pub origin: Origin,
    /// Path of the scene as written, and where. Unset when it is missing, which is reported.
    pub scene: Option<(String, Pos)>,
    /// Components of a camera, or the name of one.
    pub camera: Option<Node>,
    /// Name and settings of the integrator.
    pub integrator: Option<Node>,
    /// Settings by section.
    pub sections: Vec<(&'static str, Node)>,
    /// Changes to the scene.
    pub overrides: Vec<OverrideEntry>,
}

impl Config {
    /// Defaults around a scene.
    pub fn new(origin: Origin) -> Self {
        Self {
            origin,
            scene: None,
            camera: None,
            integrator: None,
            sections: Vec::new(),
            overrides: Vec::new(),
        }
    }
}

pub(super) const FIELDS: [&str; 10] = [
    "scene",
    "camera",
    "integrator",
    "sampler",
    "film",
    "budget",
    "adaptive",
    "post",
    "compile",
    "overrides",
];

/// Reads the frame of a configuration.
pub(super) fn read(reader: &mut Reader<'_>, node: &Node) -> Config {
    let mut config = Config::new(reader.origin.clone());
    let mut has_scene = false;
    for field in reader.fields(node, "", &FIELDS) {
        match field.key.as_str() {
            "scene" => {
                has_scene = true;
                let text = reader.text(&field.value, "scene");
                config.scene = text.map(|t| (t, field.value.pos));
            }
            "camera" => config.camera = Some(field.value.clone()),
            "integrator" => config.integrator = Some(field.value.clone()),
            "overrides" => config.overrides = reader.overrides(&field.value, "overrides"),
            key => {
                let section = SECTIONS.into_iter().find(|s| *s == key);
                config
                    .sections
                    .extend(section.map(|s| (s, field.value.clone())));
            }
        }
    }
    if !has_scene {
        reader.error_with_hint(
            node.pos,
            "scene",
            "a configuration needs a scene",
            "add `scene: \"path/to/a.scene.ron\"`",
        );
    }
    config
}
