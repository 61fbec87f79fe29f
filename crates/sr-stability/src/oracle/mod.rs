//! The same paths again in `f64`: where does rounding lead a path of this scene elsewhere?
//!
//! A sample is traced by the renderer, under a record, and once more in `f64`, with the same random numbers. Both are
//! compared step by step until they part. That they part is no error by itself: a number that falls next to an edge
//! between two surfaces, or two lobes, falls on the other side of it, and a path that is reflected by curved surfaces
//! doubles its rounding error at each. It must be rare, as likely to either side, and start late; and until then the two
//! must be the same path.

mod camera;
mod result;
mod steps;
mod trace;
mod tree;
mod vertex;

pub use result::{Difference, Largest, Mean, Oracle, Parting};
pub use steps::Cause;

use result::Compared;
use sr_integrators::wave::{WaveIntegrator, WaveSettings};
use sr_integrators::{Path, PathBsdf, PathSettings};
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::check_colour;
use sr_pipeline::prelude::{Integrator, Pipeline, SealedScene};
use sr_pipeline::rayon::prelude::*;
use sr_pipeline::replay::{Record, SampleId, SampleTracer};
use sr_pipeline::settings::{FilmSettings, SamplerSettings};
use sr_pipeline::{RenderScene, Samples, SurfacePoint, film_spec, filter_sampler};
use sr_stats::SplitMix;
use trace::Tracer;
use vertex::{Vertex, distance_off};

/// Traces samples of a compiled scene in both precisions and compares them.
///
/// # Errors
/// When the scene is not compiled, the selected integrator is none that is known in `f64`, or a pixel lies outside of the
/// picture.
pub fn rerun(pipeline: &Pipeline, samples: &[SampleId]) -> Result<Oracle, String> {
    let tracer = pipeline.tracer().map_err(|e| e.to_string())?;
    rerun_against(pipeline, tracer.as_ref(), samples)
}

/// [`rerun`] with another tracer in the place of the selected integrator's, such as a broken one.
///
/// # Errors
/// As those of [`rerun`].
pub fn rerun_against(
    pipeline: &Pipeline,
    narrow: &dyn SampleTracer,
    samples: &[SampleId],
) -> Result<Oracle, String> {
    let world = &pipeline.world;
    let scene = world
        .get_resource::<SealedScene>()
        .ok_or("the scene is not compiled")?;
    let film = film_spec(world)?;
    let outside = |id: &&SampleId| id.pixel[0] >= film.width || id.pixel[1] >= film.height;
    if let Some(id) = samples.iter().find(outside) {
        let (width, height) = (film.width, film.height);
        return Err(format!(
            "there is no sample {id}: the picture has {width} × {height} pixels"
        ));
    }
    let settings = settings(world.get_resource::<SelectedIntegrator>())?;
    let filter = filter_sampler(world.resource::<FilmSettings>())?;
    let numbers = Samples::new(world.resource::<SamplerSettings>());
    let wide = Tracer::new(scene, settings, filter, numbers);
    let one = |id: &SampleId| compare(scene, narrow, &wide, *id);
    let compared: Vec<Compared> = pipeline.install(|| samples.par_iter().map(one).collect());
    Ok(Oracle::of(&compared))
}

/// `count` samples all over the picture, or its crop, of the first `samples` of each pixel; always the same ones.
///
/// # Errors
/// When the film cannot be made.
pub fn spread(pipeline: &Pipeline, count: usize, samples: u64) -> Result<Vec<SampleId>, String> {
    let crop = film_spec(&pipeline.world)?.crop;
    let mut random = SplitMix::new(0x0f64);
    let mut below = |n: u64| (random.uniform() * n as f64) as u64;
    let ids = (0..count).map(|_| SampleId {
        pixel: [(crop.x0, crop.width()), (crop.y0, crop.height())]
            .map(|(first, n)| first + below(n.into()) as u32),
        sample: below(samples.max(1)),
    });
    Ok(ids.collect())
}

/// What the wave of the selected integrator does.
fn settings(selected: Option<&SelectedIntegrator>) -> Result<WaveSettings, String> {
    let selected = selected.ok_or("no integrator is selected")?;
    let wave = match selected.name.as_str() {
        Path::NAME => Path::wave,
        PathBsdf::NAME => PathBsdf::wave,
        other => {
            return Err(format!(
                "paths can be traced in f64 as `Path` and `PathBsdf` do it, and the integrator is `{other}`; set \
                 `integrator` to `Path(…)`, for direct light with `max_depth: 1`"
            ));
        }
    };
    let settings = selected.settings::<PathSettings>();
    wave(settings.ok_or("the settings are another integrator's")?)
}

fn compare(
    scene: &RenderScene,
    narrow: &dyn SampleTracer,
    wide: &Tracer<'_>,
    id: SampleId,
) -> Compared {
    let record = Record::new();
    let radiance = narrow.trace(id, &record).radiance;
    let (steps, points) = steps::recorded(&record.take());
    let traced = wide.trace(id);
    let parting = steps::parting(scene, &steps, &traced.steps);
    let together = parting.map_or(usize::MAX, |(step, _)| step);
    let off_surface = largest(points.iter().map(|p| off_surface(scene, p)));
    let pairs = points.iter().zip(&traced.vertices).take(together);
    Compared {
        id,
        parting: parting.map(|(step, cause)| (step as u32, cause)),
        is_refused: check_colour(radiance).is_err(),
        radiance: [radiance.as_dvec3(), traced.radiance],
        off_surface,
        apart: largest(pairs.map(|(a, b)| apart(a, b))),
    }
}

/// The largest of some errors, and its place.
fn largest(errors: impl Iterator<Item = f64>) -> (f64, u32) {
    let errors = errors.map(|e| if e.is_nan() { f64::INFINITY } else { e });
    let first = (0.0, 0);
    errors
        .zip(0..)
        .fold(first, |a, b| if b.0 > a.0 { b } else { a })
}

/// In units of a bound; nothing of nothing is nothing.
fn share(error: f64, bound: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / bound }
}

/// How far a hit lies off the surface that it stands for, in units of the distance that a ray which leaves it is moved by.
fn off_surface(scene: &RenderScene, point: &SurfacePoint) -> f64 {
    let off = distance_off(scene.accel().geometry(), point.prim, point.p.as_dvec3());
    let claimed = point.ng.as_dvec3().abs().dot(point.p_err.as_dvec3());
    share(off, claimed)
}

/// How far two points of the same surface lie apart, in units of the length of what the hit says of its error.
fn apart(narrow: &SurfacePoint, wide: &Vertex) -> f64 {
    let distance = narrow.p.as_dvec3().distance(wide.p);
    share(distance, narrow.p_err.as_dvec3().length())
}
