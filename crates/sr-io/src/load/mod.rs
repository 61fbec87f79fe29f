//! The systems of [`Load`]: files become entities and settings.
//!
//! `Parse` reads the files, `Spawn` makes entities of them, `Override` changes values by path,
//! `Validate` looks at the result. A mistake does not stop at the step that finds it: each goes
//! on with what it has, so that all problems of all files come in one go, and the stage fails at
//! its end. What belongs to a file that could not be read is passed over in silence.

mod camera;
mod component;
mod model;
mod names;
mod overrides;
mod parse;
mod resolved;
mod session;
mod settings;
mod spawn;
mod validate;

pub use parse::nearest_file;
pub use resolved::{ResolvedConfig, config_hash, resolved_config};

use crate::document::OverrideEntry;
use crate::reflect::Origin;
use bevy_ecs::prelude::*;
use sr_scene::schedule::{Load, LoadSet};
use sr_scene::stage;
use std::path::PathBuf;

/// What to load: the input of the [`Load`] schedule.
#[derive(Resource, Clone, Debug, Default)]
pub struct LoadRequest {
    /// A run configuration, a scene or a model file.
    pub path: PathBuf,
    /// Changes that come after those of the files, in order: another file's, such as an
    /// experiment's.
    pub changes: Vec<Change>,
    /// Changes that come after all others, in order: the command line's.
    pub overrides: Vec<Override>,
}

/// A change by path, and where it is written.
#[derive(Clone, Debug)]
pub struct Change {
    /// The file or option.
    pub origin: Origin,
    /// Path and value.
    pub entry: OverrideEntry,
}

/// A value by path, as a command line gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// The path, such as `entities.gold.Conductor.alpha`.
    pub path: String,
    /// The value in RON; a bare word is as good as a text in quotes.
    pub value: String,
    /// Who says so, for errors: `--set`, `--seed`.
    pub origin: String,
}

/// Adds the systems of [`Load`]. The world holds a scene already
/// ([`sr_scene::install`]) and a [`LoadRequest`] when the schedule runs.
pub fn install(world: &mut World) {
    world.init_resource::<LoadRequest>();
    stage::add_systems(
        world,
        Load,
        (
            parse::read_files.in_set(LoadSet::Parse),
            spawn::spawn_scene.in_set(LoadSet::Spawn),
            overrides::apply_overrides.in_set(LoadSet::Override),
            validate::validate_scene.in_set(LoadSet::Validate),
        ),
    );
}

#[cfg(test)]
mod tests;
