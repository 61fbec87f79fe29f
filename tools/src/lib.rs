//! Tools that make scenes for Steradian, out of other people's files and out of numbers.
//!
//! The binary `steradian-tools` is a thin shell around this library, so that tests can call what
//! it does. Nothing here prints except [`cli`].

pub mod cli;
pub mod convert;
pub mod envmap_debug;
pub mod generate;
