//! The files that a user writes: what a scene and a run configuration consist of.
//!
//! Here is only the outer frame, which is closed: which fields there are and where they stand.
//! What is inside of components and settings is open, and is applied by
//! [`reflect`](crate::reflect) once the world has the types.

mod config;
mod fields;
mod kind;
mod scene;

pub use config::{Config, SECTIONS};
pub use fields::{Reader, join};
pub use kind::{Document, parse};
pub use scene::{Components, EntityEntry, ModelEntry, Scene};

use crate::ron::{Node, Pos};

/// `"path": value` of a scene or a configuration.
#[derive(Clone, Debug)]
pub struct OverrideEntry {
    /// The path as written.
    pub path: String,
    /// Where the path is written.
    pub pos: Pos,
    /// The new value.
    pub value: Node,
}

#[cfg(test)]
mod tests;
