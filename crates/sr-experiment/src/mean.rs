//! The mean of a run's picture, for checks against what is known beforehand.

use crate::host::Host;
use crate::plan::Plan;
use crate::session;
use crate::words;
use sr_pipeline::{FilmResource, RenderReport, StopReason};

/// Mean luminance of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureMean {
    /// Over all pixels.
    pub mean: f64,
    /// Its standard error, from the variance that the film has measured.
    pub std_error: f64,
    /// Samples that the film refused.
    pub rejected: u64,
}

/// Makes one run of a plan and writes nothing; `None` when it was interrupted.
///
/// # Errors
/// What kept it from being made.
pub fn picture_mean(
    plan: &Plan,
    run: usize,
    host: &dyn Host,
) -> Result<Option<PictureMean>, String> {
    let of_run = &plan.runs[run];
    let changes = plan.points[of_run.point].changes(&plan.experiment, of_run.seed);
    let mut pipeline = session::open(&plan.experiment, changes, host)?;
    let stop = session::render(&mut pipeline, &words::run(plan, run), host);
    if stop.map_err(|e| host.explain(e))? == StopReason::Asked {
        return Ok(None);
    }
    let film = pipeline.world.resource::<FilmResource>();
    let image = film.film.resolve(film.estimator);
    let luminance = |p: &glam::Vec3| sr_film::luminance(p.as_dvec3());
    let pixels = image.rgb.pixels.len() as f64;
    let sum: f64 = image.rgb.pixels.iter().map(luminance).sum();
    // A luminance's variance is at most the weighted sum of those of its parts, their covariances at most
    // their geometric means: the square of the weighted sum of standard deviations bounds both.
    let deviation = |p: &glam::Vec3| sr_film::luminance(p.as_dvec3().map(f64::sqrt)).powi(2);
    let variance: f64 = image.variance_of_mean.pixels.iter().map(deviation).sum();
    Ok(Some(PictureMean {
        mean: sum / pixels,
        std_error: variance.sqrt() / pixels,
        rejected: pipeline
            .world
            .resource::<RenderReport>()
            .tiles
            .rejects
            .total(),
    }))
}
