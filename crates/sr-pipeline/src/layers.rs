//! Layers of the first hit, for any integrator: the same camera rays again, only when asked for.

use crate::film::FilmResource;
use crate::pass::PassSpec;
use crate::report::{RenderReport, TileReport};
use crate::tiles::{SampleSource, Samples, camera_ray, filter_sampler, render_tiles};
use bevy_ecs::prelude::*;
use glam::Vec3;
use sr_render::RenderScene;
use sr_render::accel::{Hit, Ray};
use sr_render::film::{Film, FilmTile, Layer};
use sr_render::sampling::FilterSampler;
use sr_scene::bevy_ecs;
use sr_scene::compile::SealedScene;
use sr_scene::settings::{FilmSettings, LayerName, SamplerSettings};

/// A layer is wanted that the first hit decides.
pub(crate) fn wants_first_hit(settings: &FilmSettings) -> bool {
    let of_paths = |l: &LayerName| matches!(l, LayerName::Bounces | LayerName::Seconds);
    settings.layers.iter().any(|l| !of_paths(l))
}

/// Adds the pass's first hits to the film's layers.
pub(crate) fn add_first_hits(
    scene: Res<'_, SealedScene>,
    pass: Res<'_, PassSpec>,
    settings: Res<'_, FilmSettings>,
    sampler: Res<'_, SamplerSettings>,
    mut film: ResMut<'_, FilmResource>,
    mut report: ResMut<'_, RenderReport>,
) -> Result {
    let filter = filter_sampler(&settings)?;
    let film = &mut film.film;
    report.tiles.merge(match Samples::new(&sampler) {
        Samples::Sobol(s) => run(&scene, film, &filter, *pass, s),
        Samples::Independent(s) => run(&scene, film, &filter, *pass, s),
    });
    Ok(())
}

fn run(
    scene: &RenderScene,
    film: &mut Film,
    filter: &FilterSampler,
    pass: PassSpec,
    samples: impl SampleSource,
) -> TileReport {
    render_tiles(film, |tile| {
        let mut report = TileReport::default();
        let mut rays: Vec<Ray> = Vec::new();
        let mut hits: Vec<Hit> = Vec::new();
        for pixel in tile.active_pixels() {
            let (x, y) = tile.pixel(pixel);
            rays.clear();
            rays.extend(pass.indices().map(|sample| {
                camera_ray(scene.camera(), filter, (x, y), &samples.at([x, y], sample))
            }));
            hits.clear();
            hits.resize(rays.len(), Hit::MISS);
            scene.accel().closest(&rays, &mut hits);
            report.rays.camera += rays.len() as u64;
            for ((sample, ray), hit) in pass.indices().zip(&rays).zip(&hits) {
                add(scene, tile, pixel, sample, ray, hit);
            }
        }
        report
    })
}

/// A miss adds zeros to normal and albedo, which then tell coverage, nothing to depth, and no ids.
fn add(scene: &RenderScene, tile: &mut FilmTile, pixel: usize, sample: u64, ray: &Ray, hit: &Hit) {
    // Geometry is finite, so nothing is refused; radiance is where health is counted.
    let mut add = |layer, value| {
        let _ = tile.add_layer(pixel, layer, sample, value);
    };
    if !hit.is_hit() {
        add(Layer::Normal, Vec3::ZERO);
        add(Layer::Albedo, Vec3::ZERO);
        add(Layer::Ids, Vec3::NEG_ONE);
        return;
    }
    let point = scene.surface(ray, hit);
    let ids = Vec3::new(point.shape.0 as f32, point.material.0 as f32, 0.0);
    add(Layer::Normal, point.frame.n);
    add(Layer::Depth, Vec3::splat(scene.camera().depth(point.p)));
    add(Layer::Albedo, scene.bsdf(&point).albedo());
    add(Layer::Ids, ids);
}
