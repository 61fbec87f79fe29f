//! Readers: files become entities, and every mistake in them is told with its place.
//!
//! [`ron`] reads text into a tree, [`reflect`] applies trees to components and settings,
//! [`document`] knows the frame of scene files and run configurations, and the systems of [`load`]
//! put it together in the [`Load`](sr_scene::schedule::Load) schedule. Model files come as plain
//! data ([`model`]), which one place makes entities of.

pub mod document;
mod file;
pub mod gltf;
pub mod load;
pub mod model;
mod normals;
pub mod obj;
pub mod polygon;
pub mod reflect;
mod report;
pub mod ron;

pub use load::{
    Change, LoadRequest, Override, ResolvedConfig, config_hash, install, nearest_file,
    resolved_config,
};
