//! The renderer's own estimate of its error.

use crate::film::FilmResource;
use bevy_ecs::prelude::*;
use sr_render::film::ErrorEstimate;
use sr_scene::bevy_ecs;

/// The last estimate, unset when there are too few samples for one.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Estimate(pub Option<ErrorEstimate>);

/// Estimates from the film's own variance.
pub(crate) fn estimate_error(film: Res<'_, FilmResource>, mut estimate: ResMut<'_, Estimate>) {
    estimate.0 = film.film.resolve(film.estimator).error_estimate();
}
