//! How to write an integrator that brings its own systems.
//!
//! Light tracing: paths start on the lights, and each of their surface points is connected to the
//! camera. It adds to arbitrary pixels, so it asks for splat buffers; sums there do not depend on
//! order, so threads may share them. What a camera ray sees of the environment, or through
//! mirrors and glass alone, cannot be connected and is missing: compare it with `Path` on scenes
//! without such sights. Pixels are boxes, whatever filter is set.

mod trace;

use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::Rect;
use sr_pipeline::prelude::*;
use sr_pipeline::rayon::prelude::*;
use sr_pipeline::settings::SamplerSettings;
use sr_pipeline::{RenderReport, SampleSource, Samples, TileReport};
use trace::LightTracing;

/// Particles from the lights.
pub struct LightTracer;

/// Settings, as written in RON between the parentheses.
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct LightTracerSettings {
    /// Most bounces; counted as for `Path`.
    pub max_depth: u32,
}

impl Default for LightTracerSettings {
    fn default() -> Self {
        Self { max_depth: 8 }
    }
}

impl Integrator for LightTracer {
    const NAME: &'static str = "LightTracer";
    const SUMMARY: &'static str = "paths from the lights, connected to the camera";
    const USES: SceneFeatures = SceneFeatures::ALL;
    const REQUIRES: &'static [Requirement] = &[Requirement {
        any_of: SceneFeatures::AREA_LIGHTS
            .union(SceneFeatures::DELTA_LIGHTS)
            .union(SceneFeatures::ENVIRONMENT),
        otherwise: "light tracing starts at the lights, and the scene has none",
    }];
    const SPLATS: bool = true;
    type Settings = LightTracerSettings;

    fn check(settings: &LightTracerSettings) -> Result<(), String> {
        if settings.max_depth > 1024 {
            return Err("`max_depth` must be at most 1024: there is no roulette here".into());
        }
        Ok(())
    }
}

/// The plug-in.
pub fn light_tracer(pipeline: &mut Pipeline) {
    pipeline.add_integrator::<LightTracer>();
    pipeline.add_integrator_systems::<LightTracer, _>(trace_pass);
}

/// One light path for each pixel of the picture and each sample of the pass.
fn trace_pass(
    scene: Res<'_, SealedScene>,
    pass: Res<'_, PassSpec>,
    choice: Res<'_, SelectedIntegrator>,
    sampler: Res<'_, SamplerSettings>,
    mut film: ResMut<'_, FilmResource>,
    mut report: ResMut<'_, RenderReport>,
) -> Result {
    let settings = choice
        .settings::<LightTracerSettings>()
        .ok_or("the settings are another integrator's")?;
    let film = &mut film.film;
    let tracing = LightTracing {
        scene: &scene,
        film,
        max_depth: settings.max_depth,
    };
    // The whole picture even when only a crop is kept: any path may land in it.
    let size = Rect::of_size(film.spec().width, film.spec().height);
    report.tiles.merge(match Samples::new(&sampler) {
        Samples::Sobol(s) => trace_rows(&tracing, size, *pass, s),
        Samples::Independent(s) => trace_rows(&tracing, size, *pass, s),
    });
    film.add_splat_samples(pass.indices());
    Ok(())
}

fn trace_rows(
    tracing: &LightTracing<'_>,
    size: Rect,
    pass: PassSpec,
    source: impl SampleSource,
) -> TileReport {
    let rows: Vec<TileReport> = (0..size.height())
        .into_par_iter()
        .map(|y| {
            let mut report = TileReport::default();
            for x in 0..size.width() {
                for sample in pass.indices() {
                    tracing.trace([x, y], sample, &source.at([x, y], sample), &mut report);
                }
            }
            report
        })
        .collect();
    let mut total = TileReport::default();
    for row in rows {
        total.merge(row);
    }
    total
}
