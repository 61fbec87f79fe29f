//! Direct light, by one strategy or two.

use crate::wave::{LightStrategy, ScatterStrategy, WaveIntegrator, WaveSettings, wave_stages};
use sr_pipeline::PlanItem;
use sr_pipeline::prelude::*;

/// Emission and one bounce.
pub struct Direct;

/// How [`Direct`] finds the light that reaches a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Strategy {
    /// A point on a light.
    Light,
    /// A direction in proportion to the lobe.
    Bsdf,
    /// A direction uniform over the hemisphere (over the sphere for lobes that let light through).
    Hemisphere,
    /// `Light` and `Bsdf`, combined by the power heuristic.
    #[default]
    Mis,
}

/// Settings of [`Direct`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct DirectSettings {
    /// How light is found.
    pub strategy: Strategy,
}

impl Integrator for Direct {
    const NAME: &'static str = "Direct";
    const SUMMARY: &'static str = "emission and direct light, by a choice of strategies";
    const USES: SceneFeatures = SceneFeatures::ALL;
    type Settings = DirectSettings;

    fn stages(settings: &DirectSettings, features: SceneFeatures) -> Vec<PlanItem> {
        wave_stages(Self::wave(settings), features)
    }
}

impl WaveIntegrator for Direct {
    fn wave(settings: &DirectSettings) -> Result<WaveSettings, String> {
        let (light, scatter) = match settings.strategy {
            Strategy::Light => (LightStrategy::Only, ScatterStrategy::Bsdf),
            Strategy::Bsdf => (LightStrategy::DeltaOnly, ScatterStrategy::Bsdf),
            Strategy::Hemisphere => (LightStrategy::DeltaOnly, ScatterStrategy::Hemisphere),
            Strategy::Mis => (LightStrategy::Mis, ScatterStrategy::Bsdf),
        };
        Ok(WaveSettings {
            max_depth: 1,
            roulette_from: u32::MAX,
            light,
            scatter,
        })
    }
}
