//! Unidirectional path tracing with next-event estimation.

use crate::wave::{
    LightStrategy, ScatterStrategy, WaveIntegrator, WaveSettings, check_light_samples, wave_stages,
};
use sr_pipeline::PlanItem;
use sr_pipeline::prelude::*;

/// Path tracing: at each surface one light is sampled and one direction by the lobe, and the two
/// are combined by the power heuristic (Veach 1997, §9.2.4).
pub struct Path;

/// Settings of [`Path`] and [`PathBsdf`](crate::PathBsdf).
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct PathSettings {
    /// Most bounces: 0 sees emission only, 1 adds direct light. Unset: as many as roulette lets
    /// live.
    pub max_depth: Option<u32>,
    /// Roulette starts after this many bounces. Unset: never, which needs a `max_depth`.
    pub roulette_from: Option<u32>,
    /// Light samples at each surface: points on lights that are chosen one by one, or, where
    /// `compile.light_selection` is `All`, on each light that is more than a point or a direction.
    pub light_samples: u32,
}

impl Default for PathSettings {
    fn default() -> Self {
        Self {
            max_depth: None,
            roulette_from: Some(4),
            light_samples: 1,
        }
    }
}

/// Most bounces without an end or roulette: a closed box of mirrors takes them all.
const CERTAIN_BOUNCES: u32 = 65_536;

impl PathSettings {
    pub(crate) fn wave(&self, light: LightStrategy) -> Result<WaveSettings, String> {
        // The bounces that a path may take before anything ends it.
        let certain = self
            .max_depth
            .unwrap_or(u32::MAX)
            .min(self.roulette_from.unwrap_or(u32::MAX));
        if certain > CERTAIN_BOUNCES {
            return Err(format!(
                "between mirrors such paths hardly end; set `max_depth` or `roulette_from` to \
                 {CERTAIN_BOUNCES} or less"
            ));
        }
        check_light_samples(self.light_samples)?;
        Ok(WaveSettings {
            max_depth: self.max_depth.unwrap_or(u32::MAX),
            roulette_from: self.roulette_from.unwrap_or(u32::MAX),
            light,
            scatter: ScatterStrategy::Bsdf,
            light_samples: self.light_samples,
            spreads: false,
        })
    }
}

impl Integrator for Path {
    const NAME: &'static str = "Path";
    const SUMMARY: &'static str =
        "path tracing with light sampling and multiple importance sampling";
    const USES: SceneFeatures = SceneFeatures::ALL;
    type Settings = PathSettings;

    fn check(settings: &PathSettings) -> Result<(), String> {
        Self::wave(settings).map(drop)
    }

    fn stages(settings: &PathSettings, features: SceneFeatures) -> Vec<PlanItem> {
        wave_stages(Self::wave(settings), features)
    }
}

impl WaveIntegrator for Path {
    fn wave(settings: &PathSettings) -> Result<WaveSettings, String> {
        settings.wave(LightStrategy::Mis)
    }
}
