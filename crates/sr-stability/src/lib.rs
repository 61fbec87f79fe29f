//! Checks of numerical stability: error against stiffness.
//!
//! A [`Suite`] looks at one theme, such as roughness or the scale of a scene. Each of its [`Sweep`]s drives
//! one parameter from the easy to the extreme, measures the error of the renderer's kernels against a truth in
//! closed form or in `f64`, and holds it against a stated bound; beyond the range that the bound is promised for
//! it goes on, to show where `f32` ends. What is examined is called through [`Kernels`], so that a test can put
//! a broken kernel in its place and see that a suite finds it.
//!
//! [`health`] looks at what one scene makes of the renderer's samples instead.

mod bench;
mod built_in;
mod check;
mod effort;
pub mod health;
mod kernels;
pub mod oracle;
mod rendered;
pub mod report;
pub mod suites;
mod sweep;
mod warps;
mod worst;

pub use bench::Bench;
pub use built_in::EXPERIMENTS;
pub use check::{CheckError, Checked, check, check_file};
pub use effort::Effort;
pub use kernels::{Kernels, Renderer, film_mean};
pub use rendered::rendered;
pub use suites::{Suite, suites};
pub use sweep::{Limit, Point, Sweep, Verdict};
pub use warps::{Shape, Warp};
