//! Path tracing without light sampling: slow, simple, the cross-check of everything else.

use crate::path::PathSettings;
use crate::wave::{LightStrategy, WaveIntegrator, WaveSettings, wave_stages};
use sr_pipeline::PlanItem;
use sr_pipeline::prelude::*;

/// Path tracing that finds lights by chance. Only lights that no ray can meet (point, spot,
/// directional) are sampled, so that it agrees with [`Path`](crate::Path) on every scene.
pub struct PathBsdf;

impl Integrator for PathBsdf {
    const NAME: &'static str = "PathBsdf";
    const SUMMARY: &'static str = "path tracing by lobe sampling alone, as a cross-check";
    const USES: SceneFeatures = SceneFeatures::ALL;
    type Settings = PathSettings;

    fn check(settings: &PathSettings) -> Result<(), String> {
        Self::wave(settings).map(drop)
    }

    fn stages(settings: &PathSettings, features: SceneFeatures) -> Vec<PlanItem> {
        wave_stages(Self::wave(settings), features)
    }
}

impl WaveIntegrator for PathBsdf {
    fn wave(settings: &PathSettings) -> Result<WaveSettings, String> {
        settings.wave(LightStrategy::DeltaOnly)
    }
}
