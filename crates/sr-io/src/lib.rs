//! Readers: RON, glTF and OBJ into entities, with source spans in every error

pub mod model;
pub mod reflect;
pub mod ron;
