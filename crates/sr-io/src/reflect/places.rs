//! Where each field was set, so that a later check can point there.

use bevy_ecs::resource::Resource;
use sr_scene::components::SourceSpan;
use std::collections::{BTreeMap, BTreeSet};

/// The place of each field that a file or the command line has set, by its path, and which fields
/// could not be set as it is written.
#[derive(Resource, Clone, Debug, Default)]
pub struct Places {
    set: BTreeMap<String, SourceSpan>,
    faulty: BTreeSet<String>,
}

impl Places {
    /// Notes that the field at `path` was set there. A later place takes the place of an earlier.
    pub fn record(&mut self, path: String, span: SourceSpan) {
        self.set.insert(path, span);
    }

    /// Notes the places of everything at and inside `path` under another path too.
    pub fn alias(&mut self, path: &str, other: &str) {
        let renamed =
            |p: &String| is_inside(p, path).then(|| format!("{other}{}", &p[path.len()..]));
        let set = (self.set.range(path.to_owned()..))
            .take_while(|(p, _)| p.starts_with(path))
            .filter_map(|(p, span)| Some((renamed(p)?, span.clone())));
        let set: Vec<(String, SourceSpan)> = set.collect();
        let faulty = (self.faulty.range(path.to_owned()..))
            .take_while(|p| p.starts_with(path))
            .filter_map(renamed);
        let faulty: Vec<String> = faulty.collect();
        self.set.extend(set);
        self.faulty.extend(faulty);
    }

    /// Notes that the field at `path` was told to be wrong, so that it has a value that nobody
    /// wrote.
    pub fn mark_faulty(&mut self, path: String) {
        self.faulty.insert(path);
    }

    /// Whether the field, something inside of it or something around it was told to be wrong: what
    /// its value is then says nothing about what was written.
    pub fn is_faulty(&self, path: &str) -> bool {
        let first_from = |start: String| {
            let mut from = self.faulty.range(start.clone()..);
            from.next().is_some_and(|p| p.starts_with(&start))
        };
        let around = path.rmatch_indices(['.', '[']).map(|(at, _)| &path[..at]);
        std::iter::once(path)
            .chain(around)
            .any(|p| self.faulty.contains(p))
            || first_from(format!("{path}."))
            || first_from(format!("{path}["))
    }

    /// Whether anybody wrote the field itself.
    pub fn is_set(&self, path: &str) -> bool {
        self.set.contains_key(path)
    }

    /// The place of the field, or of the nearest value around it.
    pub fn find(&self, path: &str) -> Option<&SourceSpan> {
        let mut path = path;
        loop {
            if let Some(span) = self.set.get(path) {
                return Some(span);
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }
}

/// Whether a path leads to what `outer` leads to, or further in.
fn is_inside(path: &str, outer: &str) -> bool {
    path.strip_prefix(outer)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}
