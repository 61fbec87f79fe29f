//! The pass system: tiles in parallel, each as waves.

use super::replay::tracer;
use super::{Outcome, Scratch, Wave, WaveIntegrator};
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::{Film, FilmTile, Layer};
use sr_pipeline::prelude::*;
use sr_pipeline::replay::Nobody;
use sr_pipeline::sampling::FilterSampler;
use sr_pipeline::settings::{FilmSettings, SamplerSettings};
use sr_pipeline::{
    MaterialId, RenderReport, SampleSource, Samples, TileReport, camera_ray, deposit,
    filter_sampler, render_tiles,
};
use std::ops::Range;

/// About how many paths a wave has: enough to keep ray queries busy, few enough for the cache.
const WAVE_SIZE: usize = 4096;

/// Registers a wave integrator, its pass system and its tracer of single samples.
pub fn add<I: WaveIntegrator>(pipeline: &mut Pipeline) {
    pipeline.add_integrator::<I>();
    pipeline.add_integrator_systems::<I, _>(render_pass::<I>);
    pipeline.add_tracer::<I>(tracer::<I>);
}

fn render_pass<I: WaveIntegrator>(
    scene: Res<'_, SealedScene>,
    pass: Res<'_, PassSpec>,
    choice: Res<'_, SelectedIntegrator>,
    film_settings: Res<'_, FilmSettings>,
    sampler: Res<'_, SamplerSettings>,
    mut film: ResMut<'_, FilmResource>,
    mut report: ResMut<'_, RenderReport>,
) -> Result {
    let settings = choice
        .settings::<I::Settings>()
        .ok_or("the settings are another integrator's")?;
    let job = Job {
        wave: Wave::new(&scene, I::wave(settings)?, I::USES),
        filter: filter_sampler(&film_settings)?,
        samples: pass.indices(),
    };
    let film = &mut film.film;
    report.tiles.merge(match Samples::new(&sampler) {
        Samples::Sobol(s) => job.run(film, s),
        Samples::Independent(s) => job.run(film, s),
    });
    Ok(())
}

struct Job<'a> {
    wave: Wave<'a>,
    filter: FilterSampler,
    samples: Range<u64>,
}

impl Job<'_> {
    fn run<Src: SampleSource>(&self, film: &mut Film, source: Src) -> TileReport {
        render_tiles(film, |tile| {
            let mut report = TileReport::default();
            let mut scratch = Scratch::default();
            let mut outcome = Outcome::default();
            let pixels = tile.active_pixels();
            if pixels.is_empty() {
                return report;
            }
            let step = (WAVE_SIZE / pixels.len()).max(1) as u64;
            let mut first = self.samples.start;
            while first < self.samples.end {
                let samples = first..(first + step).min(self.samples.end);
                self.generate(tile, &pixels, &samples, source, &mut scratch);
                outcome.reset(scratch.paths.len());
                self.wave
                    .run(&mut scratch, &mut outcome, &mut report.rays, &mut Nobody);
                add_to_film(tile, &pixels, &samples, &outcome, &mut report);
                first = samples.end;
            }
            report
        })
    }

    /// Camera rays, the samples of a pixel next to one another.
    fn generate<Src: SampleSource>(
        &self,
        tile: &FilmTile,
        pixels: &[usize],
        samples: &Range<u64>,
        source: Src,
        scratch: &mut Scratch<Src::Sampler>,
    ) {
        scratch.paths.clear();
        let camera = self.wave.scene.camera();
        for &pixel in pixels {
            let (x, y) = tile.pixel(pixel);
            for sample in samples.clone() {
                let sampler = source.at([x, y], sample);
                let ray = camera_ray(camera, &self.filter, (x, y), &sampler);
                scratch.paths.push(ray, sampler);
            }
        }
    }
}

/// Deposits each path, pixel by pixel in the order of the samples.
fn add_to_film(
    tile: &mut FilmTile,
    pixels: &[usize],
    samples: &Range<u64>,
    outcome: &Outcome,
    report: &mut TileReport,
) {
    let wants_bounces = tile.has_layer(Layer::Bounces);
    let mut slot = 0;
    for &pixel in pixels {
        for sample in samples.clone() {
            let bounces = outcome.bounces[slot];
            let material = outcome.material[slot];
            let material = (material != u32::MAX).then_some(MaterialId(material));
            let radiance = outcome.radiance[slot];
            deposit(tile, pixel, sample, radiance, bounces, material, report);
            if wants_bounces {
                // A count is finite, so nothing is refused.
                let _ = tile.add_layer(pixel, Layer::Bounces, sample, Vec3::splat(bounces as f32));
            }
            slot += 1;
        }
    }
}
