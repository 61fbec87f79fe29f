//! Where each field was set, so that a later check can point there.

use bevy_ecs::resource::Resource;
use sr_scene::components::SourceSpan;
use std::collections::BTreeMap;

/// The place of each field that a file or the command line has set, by its path.
#[derive(Resource, Clone, Debug, Default)]
pub struct Places(BTreeMap<String, SourceSpan>);

impl Places {
    /// Notes that the field at `path` was set there. A later place takes the place of an earlier.
    pub fn record(&mut self, path: String, span: SourceSpan) {
        self.0.insert(path, span);
    }

    /// Notes the places of everything at and inside `path` under another path too.
    pub fn alias(&mut self, path: &str, other: &str) {
        let inside: Vec<(String, SourceSpan)> = self
            .0
            .range(path.to_owned()..)
            .take_while(|(p, _)| p.starts_with(path))
            .filter(|(p, _)| p.len() == path.len() || p[path.len()..].starts_with(['.', '[']))
            .map(|(p, span)| (format!("{other}{}", &p[path.len()..]), span.clone()))
            .collect();
        self.0.extend(inside);
    }

    /// The place of the field, or of the nearest value around it.
    pub fn find(&self, path: &str) -> Option<&SourceSpan> {
        let mut path = path;
        loop {
            if let Some(span) = self.0.get(path) {
                return Some(span);
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }
}
