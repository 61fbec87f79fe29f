//! The borders between crates.
