//! The film as a resource, made from the settings.

use crate::integrator::IntegratorTable;
use bevy_ecs::prelude::*;
use sr_render::film::VarianceEstimator;
use sr_render::film::{Film, FilmSpec, Layer, Rect};
use sr_scene::bevy_ecs;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{
    AdaptiveSettings, FilmSettings, LayerName, SamplerName, SamplerSettings, SceneFilm,
};

/// What the passes add up.
#[derive(Resource)]
pub struct FilmResource {
    /// The film.
    pub film: Film,
    /// How its variance is to be read.
    pub estimator: VarianceEstimator,
}

/// The film that the settings and the selected integrator ask for.
///
/// # Errors
/// When no integrator is selected, or one that is not registered.
pub fn film_spec(world: &World) -> Result<FilmSpec, String> {
    let settings = world.resource::<FilmSettings>();
    let [width, height] = settings.size(*world.resource::<SceneFilm>());
    let crop = match settings.crop {
        Some([x0, y0, x1, y1]) => Rect { x0, y0, x1, y1 },
        None => Rect::of_size(width, height),
    };
    let selected = world
        .get_resource::<SelectedIntegrator>()
        .ok_or("no integrator is selected")?;
    let integrators = world.resource::<IntegratorTable>();
    Ok(FilmSpec {
        width,
        height,
        crop,
        replicas: world.resource::<SamplerSettings>().replicas,
        layers: settings.layers.iter().map(|l| layer(*l)).collect(),
        splats: integrators.entry(&selected.name)?.splats,
        adaptive: world.resource::<AdaptiveSettings>().spec(),
        clamp: settings.clamp,
    })
}

/// A film for the settings; an earlier one is dropped.
pub(crate) fn make_film(world: &mut World) -> Result<(), String> {
    let film = Film::new(film_spec(world)?).map_err(|e| e.to_string())?;
    let sampler = world.resource::<SamplerSettings>();
    // The samples of one low-discrepancy sequence are not independent; those of its independently
    // scrambled replicas are. With a single replica the sample variance is all there is: too large.
    let estimator = match (sampler.kind, sampler.replicas) {
        (SamplerName::Independent, _) | (SamplerName::Sobol, 0..=1) => VarianceEstimator::Samples,
        (SamplerName::Sobol, _) => VarianceEstimator::Replicas,
    };
    world.insert_resource(FilmResource { film, estimator });
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
        LayerName::Seconds => Layer::Seconds,
    }
}
