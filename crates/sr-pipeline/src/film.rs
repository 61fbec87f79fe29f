//! The film as a resource, made from the settings.

use crate::integrator::IntegratorTable;
use bevy_ecs::prelude::*;
use sr_render::film::VarianceEstimator;
use sr_render::film::{Film, FilmSpec, Layer, Rect};
use sr_scene::bevy_ecs;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{FilmSettings, LayerName, SamplerName, SamplerSettings, SceneFilm};

/// What the passes add up.
#[derive(Resource)]
pub struct FilmResource {
    /// The film.
    pub film: Film,
    /// How its variance is to be read.
    pub estimator: VarianceEstimator,
}

/// A film for the settings; an earlier one is dropped.
pub(crate) fn make_film(
    settings: Res<'_, FilmSettings>,
    scene_film: Res<'_, SceneFilm>,
    sampler: Res<'_, SamplerSettings>,
    selected: Res<'_, SelectedIntegrator>,
    integrators: Res<'_, IntegratorTable>,
    mut commands: Commands<'_, '_>,
) -> Result {
    let [width, height] = settings.size(*scene_film);
    let crop = match settings.crop {
        Some([x0, y0, x1, y1]) => Rect { x0, y0, x1, y1 },
        None => Rect::of_size(width, height),
    };
    let film = Film::new(FilmSpec {
        width,
        height,
        crop,
        replicas: sampler.replicas,
        layers: settings.layers.iter().map(|l| layer(*l)).collect(),
        splats: integrators.entry(&selected.name)?.splats,
    })?;
    // The samples of one low-discrepancy sequence are not independent; those of its independently
    // scrambled replicas are. With a single replica the sample variance is all there is: too large.
    let estimator = match (sampler.kind, sampler.replicas) {
        (SamplerName::Independent, _) | (SamplerName::Sobol, 0..=1) => VarianceEstimator::Samples,
        (SamplerName::Sobol, _) => VarianceEstimator::Replicas,
    };
    commands.insert_resource(FilmResource { film, estimator });
    Ok(())
}

/// The film's layer of a name in RON.
pub(crate) fn layer(name: LayerName) -> Layer {
    match name {
        LayerName::Normal => Layer::Normal,
        LayerName::Depth => Layer::Depth,
        LayerName::Albedo => Layer::Albedo,
        LayerName::Ids => Layer::Ids,
        LayerName::Bounces => Layer::Bounces,
    }
}
