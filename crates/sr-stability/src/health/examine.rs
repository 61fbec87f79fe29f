//! The examination itself.

use super::found::{
    BrightSample, Brightest, FirstDefect, Health, Kurtosis, Rejected, RejectedKind, UnevenPixel,
};
use super::grid::Grid;
use super::route::route;
use super::survey::{Survey, blocks};
use super::top::{Bright, TOLD};
use super::{Stopped, findings, passes};
use crate::oracle::{Oracle, rerun, spread};
use crate::{CheckError, Effort};
use sr_experiment::{ErrorMap, Host};
use sr_pipeline::bevy_reflect::ReflectRef;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::replay::{Event, Replay, SampleId};
use sr_pipeline::settings::SamplerSettings;
use sr_pipeline::{Pipeline, Progress, RejectKey, RenderScene, SealedScene, film_spec};
use std::time::Instant;

/// Samples a pixel, short and long.
const SAMPLES: [u64; 2] = [64, 1024];
/// Samples in all, about: a larger picture is looked at in steps.
const MOST_SAMPLES: [u64; 2] = [1 << 22, 1 << 26];
/// Samples in all that are traced in `f64` too, when that is asked for.
const WIDE_SAMPLES: [usize; 2] = [1 << 12, 1 << 16];

/// How to examine.
#[derive(Clone, Copy)]
pub struct Examination<'a> {
    /// How deep to dig.
    pub effort: Effort,
    /// Trace some samples in `f64` too, and compare.
    pub oracle: bool,
    /// The command that replays a sample.
    pub replay: &'a dyn Fn(SampleId) -> String,
    /// Who is told of progress, and says when to stop.
    pub host: &'a dyn Host,
}

impl Examination<'_> {
    /// Some samples a pixel are done.
    pub(super) fn told(&self, samples: u64, survey: &Survey) -> Result<(), Stopped> {
        self.host.pass(&Progress {
            samples,
            mean_samples: samples as f64,
            active: 1.0,
            seconds: survey.begun.elapsed().as_secs_f64(),
            fraction: samples as f64 / survey.samples as f64,
            ends_by: None,
            error: None,
            target: None,
        });
        if self.host.stopped() {
            Err(Stopped)
        } else {
            Ok(())
        }
    }
}

/// Takes samples of a compiled scene and looks at them. What the scene says of film and samples counts, but
/// for the clamp, adaptive sampling and the budget: samples are looked at as they are made.
///
/// # Errors
/// A render that fails, or that somebody ended.
pub fn examine(pipeline: &mut Pipeline, how: &Examination<'_>) -> Result<Health, CheckError> {
    let begun = Instant::now();
    let samples = how.effort.choose(SAMPLES[0], SAMPLES[1]);
    how.host.begin("health", Some(samples));
    let taken = take(pipeline, samples, how);
    how.host.end();
    let (survey, left_out) = taken?;
    let mut health = health(pipeline, &survey, left_out, how)?;
    if how.oracle {
        match wide(pipeline, samples, how.effort) {
            Ok(oracle) => health.oracle = Some(oracle),
            Err(why) => health
                .left_out
                .push(format!("the same paths in f64: {why}")),
        }
    }
    health.findings = findings::findings(&health);
    health.seconds = begun.elapsed().as_secs_f64();
    Ok(health)
}

/// The same paths in `f64`, or why not.
fn wide(pipeline: &Pipeline, samples: u64, effort: Effort) -> Result<Oracle, String> {
    let count = effort.choose(WIDE_SAMPLES[0], WIDE_SAMPLES[1]);
    rerun(pipeline, &spread(pipeline, count, samples)?)
}

/// The samples, and why some of what could be said cannot.
fn take(
    pipeline: &mut Pipeline,
    samples: u64,
    how: &Examination<'_>,
) -> Result<(Survey, Vec<String>), CheckError> {
    let spec = film_spec(&pipeline.world).map_err(CheckError::Work)?;
    let most = how.effort.choose(MOST_SAMPLES[0], MOST_SAMPLES[1]);
    let mut left_out = Vec::new();
    let no_tracer = match pipeline.tracer() {
        Ok(tracer) => {
            let mut survey = Survey::new(Grid::within(spec.crop, samples, most), samples);
            for block in blocks(samples) {
                survey.trace(pipeline, &*tracer, &block);
                how.told(block.end, &survey)
                    .map_err(|Stopped| CheckError::Interrupted)?;
            }
            return Ok((survey, left_out));
        }
        Err(why) => why.to_string(),
    };
    left_out.push(format!(
        "the ways of light, how paths ended, and commands that replay samples: {no_tracer}"
    ));
    if spec.splats {
        left_out.push(
            "single samples: light reaches pixels that chance chooses, so a sample is what a pixel gets in a pass of one"
                .into(),
        );
    }
    let mut survey = Survey::new(Grid::whole(spec.crop), samples);
    passes::render(pipeline, &mut survey, how)?;
    Ok((survey, left_out))
}

fn health(
    pipeline: &Pipeline,
    survey: &Survey,
    mut left_out: Vec<String>,
    how: &Examination<'_>,
) -> Result<Health, CheckError> {
    let world = &pipeline.world;
    let spec = film_spec(world).map_err(CheckError::Work)?;
    let reader = Reader {
        scene: world.resource::<SealedScene>(),
        pipeline,
        survey,
        command: how.replay,
    };
    let paths = survey.tally.paths(depth_is_a_setting(pipeline));
    let taken: f64 = survey.pixels.iter().map(|m| m.count()).sum();
    if paths.is_none() && left_out.is_empty() && taken > 0.0 {
        left_out.push(
            "the ways of light and how paths ended: the integrator tells rays and surfaces, and nothing of weights"
                .into(),
        );
    }
    let (kurtosis, map) = reader.kurtosis();
    let selected = world.get_resource::<SelectedIntegrator>();
    Ok(Health {
        integrator: selected.map_or_else(String::new, |s| s.name.clone()),
        seed: world.resource::<SamplerSettings>().seed,
        size: [spec.width, spec.height],
        pixels: survey.pixels.len() as u64,
        step: survey.grid.step,
        samples: survey.samples,
        mean: survey.light() / taken.max(1.0),
        rejected: reader.rejected(),
        brightest: reader.brightest(),
        kurtosis,
        paths,
        oracle: None,
        left_out,
        findings: Vec::new(),
        seconds: 0.0,
        map,
    })
}

/// Whether the limit of bounces is the author's and not the integrator's.
fn depth_is_a_setting(pipeline: &Pipeline) -> bool {
    let selected = pipeline.world.get_resource::<SelectedIntegrator>();
    let Some(ReflectRef::Struct(settings)) = selected.map(|s| s.settings.reflect_ref()) else {
        return false;
    };
    settings.field("max_depth").is_some()
}

/// Makes figures of a survey.
struct Reader<'a> {
    scene: &'a RenderScene,
    pipeline: &'a Pipeline,
    survey: &'a Survey,
    command: &'a dyn Fn(SampleId) -> String,
}

impl Reader<'_> {
    fn again(&self, id: SampleId) -> Option<Replay> {
        self.pipeline.replay(id).ok()
    }

    fn rejected(&self) -> Rejected {
        let kind = |(key, (count, pixel, sample)): (&RejectKey, &(u64, [u32; 2], u64))| {
            let id = SampleId {
                pixel: *pixel,
                sample: *sample,
            };
            let again = self.again(id);
            RejectedKind {
                count: *count,
                cause: key.cause.to_string(),
                bounces: key.bounce,
                material: key.material.map(|m| self.scene.material(m).name.clone()),
                first_defect: again.as_ref().and_then(first_defect),
                example: id.to_string(),
                replay: again.map(|_| (self.command)(id)),
            }
        };
        let mut kinds: Vec<RejectedKind> = self.survey.rejects.0.iter().map(kind).collect();
        kinds.sort_by_key(|k| std::cmp::Reverse(k.count));
        Rejected {
            count: self.survey.rejects.total(),
            kinds,
        }
    }

    fn brightest(&self) -> Brightest {
        let top = &self.survey.top;
        let all = self.survey.light();
        let (light, excess) = top.light(&self.survey.pixels);
        let part = |x: f64| if all > 0.0 { x / all } else { 0.0 };
        Brightest {
            count: top.count() as u64,
            light: part(light),
            excess: part(excess),
            worst: top.told().iter().map(|b| self.bright(b)).collect(),
        }
    }

    fn bright(&self, bright: &Bright) -> BrightSample {
        let id = SampleId {
            pixel: self.survey.grid.pixel(bright.pixel),
            sample: bright.sample,
        };
        let again = self.again(id);
        let route = again.as_ref().and_then(|r| route(&r.events, self.scene));
        let (kind, material, route) = route.map_or((None, None, None), |r| {
            (Some(r.kind), r.material, Some(r.text))
        });
        BrightSample {
            luminance: bright.luminance,
            of_pixel: bright.luminance / self.survey.pixels[bright.pixel].sum(),
            kind,
            material,
            route,
            example: id.to_string(),
            replay: again.map(|_| (self.command)(id)),
        }
    }

    /// The figures, and those of each pixel.
    fn kurtosis(&self) -> (Kurtosis, ErrorMap) {
        let survey = self.survey;
        let of = survey.pixels.iter().map(|m| m.kurtosis());
        let map = ErrorMap {
            width: survey.grid.columns(),
            height: survey.grid.rows(),
            values: of.map(|k| k.map_or(f32::NAN, |k| k as f32)).collect(),
        };
        let noisy = survey.pixels.iter().enumerate();
        let noisy = noisy.filter_map(|(i, m)| Some((m.kurtosis()?, i)));
        let mut noisy: Vec<(f64, usize)> = noisy.collect();
        noisy.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        let at = |q: f64| {
            let last = noisy.len().checked_sub(1)?;
            Some(noisy[(q * last as f64).round() as usize].0)
        };
        let half = 0.5 * survey.samples as f64;
        let by_one = noisy.iter().filter(|(k, _)| *k > half).count();
        let uneven = |(kurtosis, i): &(f64, usize)| UnevenPixel {
            pixel: survey.grid.pixel(*i),
            kurtosis: *kurtosis,
            mean: survey.pixels[*i].sum() / survey.pixels[*i].count(),
        };
        let kurtosis = Kurtosis {
            pixels: noisy.len() as u64,
            median: at(0.5),
            percentile_99: at(0.99),
            max: at(1.0),
            by_one_sample: by_one as f64 / noisy.len().max(1) as f64,
            worst: noisy.iter().rev().take(TOLD).map(uneven).collect(),
        };
        (kurtosis, map)
    }
}

fn first_defect(replay: &Replay) -> Option<FirstDefect> {
    let (step, what) = replay.first_defect()?;
    let is_surface = |e: &&Event| matches!(e, Event::Surface { .. });
    Some(FirstDefect {
        what: what.to_owned(),
        vertex: replay.events[..=step].iter().filter(is_surface).count(),
    })
}
