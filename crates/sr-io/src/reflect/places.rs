//! Where each field was set, so that a later check can point there.

use sr_scene::components::SourceSpan;
use std::collections::BTreeMap;

/// The place of each field that a file or the command line has set, by its path.
#[derive(Clone, Debug, Default)]
pub struct Places(BTreeMap<String, SourceSpan>);

impl Places {
    /// Notes that the field at `path` was set there. A later place takes the place of an earlier.
    pub fn record(&mut self, path: String, span: SourceSpan) {
        self.0.insert(path, span);
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
