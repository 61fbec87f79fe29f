//! Direct light, by one strategy or two.

use crate::wave::{
    LightStrategy, ScatterStrategy, WaveIntegrator, WaveSettings, check_light_samples, wave_stages,
};
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
    /// `Light` and `Hemisphere`, combined likewise.
    MisHemisphere,
}

/// Settings of [`Direct`].
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct DirectSettings {
    /// How light is found.
    pub strategy: Strategy,
    /// Samples at each surface, of the lights, of directions, or as many of each: points on lights that
    /// are chosen one by one, or, where `compile.light_selection` is `All`, on each light that is
    /// more than a point or a direction; and as many directions as points.
    pub light_samples: u32,
}

impl Default for DirectSettings {
    fn default() -> Self {
        Self {
            strategy: Strategy::default(),
            light_samples: 1,
        }
    }
}

impl Integrator for Direct {
    const NAME: &'static str = "Direct";
    const SUMMARY: &'static str = "emission and direct light, by a choice of strategies";
    const USES: SceneFeatures = SceneFeatures::ALL;
    type Settings = DirectSettings;

    fn check(settings: &DirectSettings) -> Result<(), String> {
        Self::wave(settings).map(drop)
    }

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
            Strategy::MisHemisphere => (LightStrategy::Mis, ScatterStrategy::Hemisphere),
        };
        check_light_samples(settings.light_samples)?;
        Ok(WaveSettings {
            max_depth: 1,
            roulette_from: u32::MAX,
            light,
            scatter,
            light_samples: settings.light_samples,
            spreads: true,
        })
    }
}
