//! Where an entity was read from, so that a later error can name it.

use bevy_ecs::prelude::*;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// The place in a file that an entity comes from.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct SourceSpan {
    /// The file as the user named it.
    pub file: Arc<Path>,
    /// Line from 1; 0 when the format has no lines.
    pub line: u32,
    /// Column from 1, in characters; 0 when the format has no lines.
    pub column: u32,
}

impl SourceSpan {
    /// A place in a file without lines, such as a binary one.
    pub fn file(file: Arc<Path>) -> Self {
        Self {
            file,
            line: 0,
            column: 0,
        }
    }
}

impl fmt::Display for SourceSpan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if self.line > 0 {
            write!(f, ":{}:{}", self.line, self.column)?;
        }
        Ok(())
    }
}
