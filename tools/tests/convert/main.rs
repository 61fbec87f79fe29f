//! The COLLADA converter, by theme.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "all of this is test code, its helpers too"
)]

mod course;
mod errors;
mod geometry;
mod hostile;
mod program;
mod scene;
mod support;
