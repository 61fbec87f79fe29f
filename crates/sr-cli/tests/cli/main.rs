//! The command line, as scripts and people meet it: the real binary in a folder of its own.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod adaptive;
mod analysis;
mod bad_input;
mod browser;
mod budget;
mod check;
mod clamp;
mod commands;
mod compare;
mod convergence;
mod errors;
mod experiment;
mod health;
mod output;
mod replay;
mod resume;
mod settings;
mod shipped;
mod stats;
mod support;
