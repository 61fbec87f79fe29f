//! `--stats`: the figures of a render as JSON, for scripts. docs/stats.md is the contract; a change
//! that could break a reader of it raises [`VERSION`].

use crate::failure::Failure;
use crate::replay::Replays;
use serde::Serialize;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::{ImageError, Reject, write_atomically};
use sr_pipeline::replay::SampleId;
use sr_pipeline::settings::{AdaptiveSettings, SamplerSettings};
use sr_pipeline::{
    Estimate, FilmResource, Pipeline, RenderReport, RenderScene, SealedScene, StageSeconds,
    StopReason, plan,
};
use std::io::Write;
use std::path::Path;

const VERSION: u32 = 1;

#[derive(Serialize)]
struct Stats {
    version: u32,
    seconds: Seconds,
    samples: u64,
    samples_per_pixel: u64,
    adaptive: Option<Adaptive>,
    clamp: Option<Clamp>,
    passes: u32,
    rays: Rays,
    rays_per_second: f64,
    samples_per_second: f64,
    peak_memory_bytes: Option<u64>,
    error: Option<Error>,
    rejected: Vec<Rejected>,
    left_out: Vec<LeftOut>,
    stop: &'static str,
    threads: usize,
    integrator: String,
    seed: u64,
    scene: Scene,
    config_hash: String,
}

#[derive(Serialize)]
struct Seconds {
    load: f64,
    compile: f64,
    integrate: f64,
    measure: f64,
    post: f64,
    over_budget: Option<f64>,
}

#[derive(Serialize)]
struct Adaptive {
    rule: String,
    tolerance: f64,
    samples_min: u64,
    samples_mean: f64,
    samples_max: u64,
    converged: f64,
    left_out: f64,
}

#[derive(Serialize)]
struct Clamp {
    limit: f32,
    samples: u64,
    removed: f64,
}

#[derive(Serialize)]
struct Rays {
    camera: u64,
    bounce: u64,
    shadow: u64,
}

#[derive(Serialize)]
struct Error {
    relmse: f64,
    std_error: Option<f64>,
    mse: f64,
}

#[derive(Serialize)]
struct Rejected {
    cause: &'static str,
    bounce: u32,
    material: Option<String>,
    count: u64,
    example: Example,
}

#[derive(Serialize)]
struct Example {
    x: u32,
    y: u32,
    sample: u64,
    replay: Option<String>,
}

#[derive(Serialize)]
struct LeftOut {
    what: String,
    reason: String,
}

#[derive(Serialize)]
struct Scene {
    triangles: usize,
    spheres: usize,
    quads: usize,
    shapes: usize,
    lights: usize,
    materials: usize,
    accel_bytes: usize,
    accel_nodes: usize,
}

/// Writes the figures, whole or not at all.
pub fn write(
    pipeline: &Pipeline,
    stop: StopReason,
    replays: &Replays<'_>,
    path: &Path,
) -> Result<(), Failure> {
    let stats = collect(pipeline, stop, replays);
    let json = serde_json::to_string_pretty(&stats)
        .map_err(|e| Failure::Work(format!("{}: {e}", path.display())))?;
    write_atomically(path, |file| {
        writeln!(file, "{json}").map_err(|source| ImageError::Io {
            path: path.to_owned(),
            source,
        })
    })
    .map_err(|e| Failure::Work(e.to_string()))
}

fn collect(pipeline: &Pipeline, stop: StopReason, replays: &Replays<'_>) -> Stats {
    let world = &pipeline.world;
    let report = world.resource::<RenderReport>();
    let seconds = *world.resource::<StageSeconds>();
    let scene: &RenderScene = world.resource::<SealedScene>();
    let rays = report.tiles.rays;
    Stats {
        version: VERSION,
        seconds: Seconds {
            load: seconds.load,
            compile: seconds.compile,
            integrate: seconds.integrate,
            measure: seconds.measure,
            post: seconds.post,
            over_budget: report.over_budget,
        },
        samples: report.samples,
        samples_per_pixel: report.samples_per_pixel,
        adaptive: adaptive(world),
        clamp: clamp(world),
        passes: report.passes,
        rays: Rays {
            camera: rays.camera,
            bounce: rays.bounce,
            shadow: rays.shadow,
        },
        rays_per_second: rays.total() as f64 / seconds.integrate,
        samples_per_second: report.samples as f64 / seconds.integrate,
        peak_memory_bytes: peak_memory(),
        error: world.resource::<Estimate>().0.map(|e| Error {
            relmse: e.relmse,
            std_error: e.relmse_std_error,
            mse: e.mse,
        }),
        rejected: rejected(report, scene, replays),
        left_out: plan(world)
            .into_iter()
            .filter(|item| !item.runs)
            .map(|item| LeftOut {
                what: item.what,
                reason: item.reason,
            })
            .collect(),
        stop: match stop {
            StopReason::Samples => "samples",
            StopReason::Seconds => "seconds",
            StopReason::TargetError => "target_error",
            StopReason::Converged => "converged",
            StopReason::Asked => "interrupted",
        },
        threads: pipeline.threads(),
        integrator: world.resource::<SelectedIntegrator>().name.clone(),
        seed: world.resource::<SamplerSettings>().seed,
        scene: scene_counts(scene),
        config_hash: sr_io::config_hash(&sr_io::resolved_config(world)),
    }
}

fn adaptive(world: &World) -> Option<Adaptive> {
    let settings = world.resource::<AdaptiveSettings>();
    let report = world.resource::<FilmResource>().film.adaptive_report()?;
    let (samples_min, samples_max) = report.range;
    Some(Adaptive {
        rule: format!("{:?}", settings.rule),
        tolerance: settings.tolerance,
        samples_min,
        samples_mean: report.taken as f64 / report.pixels as f64,
        samples_max,
        converged: report.converged as f64 / report.pixels as f64,
        left_out: report.left_out(),
    })
}

fn clamp(world: &World) -> Option<Clamp> {
    let film = &world.resource::<FilmResource>().film;
    let report = film.clamp_report()?;
    Some(Clamp {
        limit: film.spec().clamp?,
        samples: report.clamped,
        removed: report.removed_share(),
    })
}

fn rejected(report: &RenderReport, scene: &RenderScene, replays: &Replays<'_>) -> Vec<Rejected> {
    let entries = report.tiles.rejects.0.iter();
    entries
        .map(|(key, &(count, [x, y], sample))| Rejected {
            cause: match key.cause {
                Reject::NonFinite => "non_finite",
                Reject::Negative => "negative",
                Reject::OutOfRange => "out_of_range",
                Reject::NoSplats => "no_splats",
            },
            bounce: key.bounce,
            material: key.material.map(|m| scene.material(m).name.clone()),
            count,
            example: Example {
                x,
                y,
                sample,
                replay: replays.command(SampleId {
                    pixel: [x, y],
                    sample,
                }),
            },
        })
        .collect()
}

fn scene_counts(scene: &RenderScene) -> Scene {
    let geometry = scene.accel().geometry();
    let report = scene.accel().report();
    Scene {
        triangles: geometry.triangles.len(),
        spheres: geometry.spheres.len(),
        quads: geometry.quads.len(),
        shapes: scene.shape_count(),
        lights: scene.lights().len(),
        materials: scene.materials().len(),
        accel_bytes: report.bytes,
        accel_nodes: report.nodes,
    }
}

/// The most memory that the process has had resident; Linux tells.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024)
}
