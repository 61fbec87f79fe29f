//! Seconds by stage.

use bevy_ecs::prelude::*;
use sr_scene::bevy_ecs;
use std::time::Instant;

/// Wall-clock seconds that each stage took. `integrate` is what comparisons use: the `Render`
/// schedule alone, without measuring and writing.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct StageSeconds {
    /// Reading files.
    pub load: f64,
    /// From entities to the sealed scene.
    pub compile: f64,
    /// All passes.
    pub integrate: f64,
    /// Error estimates between passes.
    pub measure: f64,
    /// Developing and writing.
    pub post: f64,
}

/// Runs `work` and adds its seconds to `total`.
pub(crate) fn timed<T>(total: &mut f64, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed().as_secs_f64();
    result
}
