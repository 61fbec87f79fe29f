//! What happened during a render, counted without locks: each tile counts for itself, and the
//! counts are merged in the order of the tiles.

use bevy_ecs::prelude::*;
use sr_render::MaterialId;
use sr_render::film::Reject;
use sr_scene::bevy_ecs;
use std::collections::BTreeMap;

/// Rays by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub camera: u64,
    /// From a surface, to find the next one.
    pub bounce: u64,
    /// From a surface to a light or the camera, to find out whether it is seen.
    pub shadow: u64,
}

impl RayCounts {
    /// All kinds.
    pub const fn total(&self) -> u64 {
        self.camera + self.bounce + self.shadow
    }
}

/// Why and where a sample was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RejectKey {
    /// What was wrong with it.
    pub cause: Reject,
    /// Bounces of its path.
    pub bounce: u32,
    /// The material of its last surface.
    pub material: Option<MaterialId>,
}

/// Rejected samples by cause, bounce and material, each with one that can be replayed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rejects(pub BTreeMap<RejectKey, (u64, [u32; 2], u64)>);

impl Rejects {
    /// Counts one, of sample `sample` in pixel `pixel`.
    pub fn add(&mut self, key: RejectKey, pixel: [u32; 2], sample: u64) {
        self.0.entry(key).or_insert((0, pixel, sample)).0 += 1;
    }

    /// How many there are.
    pub fn total(&self) -> u64 {
        self.0.values().map(|(n, _, _)| n).sum()
    }
}

/// What one tile counted in one pass.
#[derive(Clone, Debug, Default)]
pub struct TileReport {
    /// Rays traced.
    pub rays: RayCounts,
    /// Samples rejected.
    pub rejects: Rejects,
}

impl TileReport {
    /// Adds the counts of another.
    pub fn merge(&mut self, other: Self) {
        self.rays.camera += other.rays.camera;
        self.rays.bounce += other.rays.bounce;
        self.rays.shadow += other.rays.shadow;
        for (key, (n, pixel, sample)) in other.rejects.0 {
            self.rejects.0.entry(key).or_insert((0, pixel, sample)).0 += n;
        }
    }
}

/// The counts of the whole render so far.
#[derive(Resource, Clone, Debug, Default)]
pub struct RenderReport {
    /// Rays and rejects of all tiles and passes.
    pub tiles: TileReport,
    /// Samples a pixel; the most that any got when sampling is adaptive.
    pub samples_per_pixel: u64,
    /// Samples of all pixels, those around a crop included that adaptive sampling decides by.
    pub samples: u64,
    /// Passes.
    pub passes: u32,
    /// Seconds of integration beyond the time budget, once the render is done: below 0 when the next
    /// pass would not have fitted. Unset where time neither ended the render nor was overrun.
    pub over_budget: Option<f64>,
}
