//! Samples by passes of the render, for integrators that cannot trace a single one.

use super::survey::Survey;
use super::{Examination, Stopped};
use crate::CheckError;
use sr_pipeline::film_kernel::{Film, FilmSpec, VarianceEstimator};
use sr_pipeline::glam::Vec3;
use sr_pipeline::{FilmResource, PassSpec, Pipeline, Render, RenderReport, film_spec};

/// Renders the samples one a pass, each onto a film of its own.
pub(super) fn render(
    pipeline: &mut Pipeline,
    survey: &mut Survey,
    how: &Examination<'_>,
) -> Result<(), CheckError> {
    // Samples as the integrator makes them: neither cut down, nor left to adaptive sampling.
    let spec = FilmSpec {
        clamp: None,
        adaptive: None,
        layers: Vec::new(),
        ..film_spec(&pipeline.world).map_err(CheckError::Work)?
    };
    pipeline.world.insert_resource(RenderReport::default());
    for sample in 0..survey.samples {
        let values = pass(pipeline, &spec, sample, how)?;
        survey.add_picture(sample, values.into_iter());
        how.told(sample + 1, survey)
            .map_err(|Stopped| CheckError::Interrupted)?;
    }
    let report = pipeline.world.resource::<RenderReport>();
    survey.rejects = report.tiles.rejects.clone();
    Ok(())
}

/// What one sample makes of each pixel; `None` where it was refused.
fn pass(
    pipeline: &mut Pipeline,
    spec: &FilmSpec,
    sample: u64,
    how: &Examination<'_>,
) -> Result<Vec<Option<Vec3>>, CheckError> {
    let film = Film::new(spec.clone()).map_err(|e| CheckError::Work(e.to_string()))?;
    let estimator = VarianceEstimator::Samples;
    let world = &mut pipeline.world;
    world.insert_resource(FilmResource { film, estimator });
    world.insert_resource(PassSpec {
        first_sample: sample,
        samples: 1,
    });
    let ran = pipeline.run(Render);
    ran.map_err(|e| CheckError::Work(how.host.explain(e)))?;
    let film = &pipeline.world.resource::<FilmResource>().film;
    let image = film.resolve(estimator);
    let values = image.rgb.pixels.into_iter().zip(image.sample_count);
    Ok(values.map(|(v, n)| (n > 0).then_some(v)).collect())
}
