//! `steradian plan`: a render up to its first pass, as text.

use crate::Context;
use crate::args::SceneArgs;
use crate::failure::Failure;
use crate::session::Session;
use crate::units;
use sr_io::reflect::to_ron;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::FilmSpec;
use sr_pipeline::settings::{
    AdaptiveRule, AdaptiveSettings, Budget, FilmSettings, SamplerSettings,
};
use sr_pipeline::{Pipeline, PlanItem, RenderScene, SealedScene, film_spec, most_samples, plan};
use sr_scene::components::{Environment, EnvironmentImage};
use std::fmt::Write;

/// Loads, compiles and tells.
pub fn run(args: &SceneArgs, context: &Context<'_>) -> Result<(), Failure> {
    let mut session = Session::new(args, context)?;
    let loaded = session.pipeline.load();
    session.settle(loaded)?;
    let compiled = session.pipeline.compile();
    session.settle(compiled)?;
    let world = &session.pipeline.world;
    let spec = film_spec(world).map_err(Failure::Input)?;
    let mut text = String::new();
    for (what, line) in heads(&session.pipeline, &spec) {
        let _ = writeln!(text, "{what:12}{line}");
    }
    let items = plan(world);
    for (title, runs) in [("runs", true), ("left out", false)] {
        let _ = write!(text, "\n{title}\n{}", lines(&items, runs));
    }
    context.console.say(text.trim_end());
    Ok(())
}

/// What is rendered, how and with what.
fn heads(pipeline: &Pipeline, spec: &FilmSpec) -> Vec<(&'static str, String)> {
    let world = &pipeline.world;
    let scene: &RenderScene = world.resource::<SealedScene>();
    let selected = world.resource::<SelectedIntegrator>();
    let settings = to_ron(selected.settings.as_partial_reflect());
    let sampler = world.resource::<SamplerSettings>();
    let tree = scene.accel().report();
    let film_bytes = spec.bytes().unwrap_or(0);
    let mut heads = vec![("scene", contents(scene))];
    heads.extend(maps(world).map(|line| ("environment", line)));
    heads.extend([
        ("film", film(world, spec)),
        ("budget", budget(world, spec)),
        ("adaptive", adaptive(world.resource::<AdaptiveSettings>())),
        ("integrator", format!("{}{settings}", selected.name)),
        (
            "sampler",
            format!(
                "{:?}, seed {}, {}",
                sampler.kind,
                sampler.seed,
                units::counted(sampler.replicas.into(), "replica")
            ),
        ),
        (
            "memory",
            format!(
                "film {}, acceleration {} ({})",
                units::bytes(film_bytes),
                units::bytes(tree.bytes as u64),
                units::counted(tree.nodes as u64, "node")
            ),
        ),
        ("threads", pipeline.threads().to_string()),
    ]);
    heads
}

/// The maps of environments, each once.
fn maps(world: &World) -> impl Iterator<Item = String> {
    let mut lines: Vec<String> = Vec::new();
    if let Some(mut query) = world.try_query::<(&Environment, &EnvironmentImage)>() {
        for (environment, image) in query.iter(world) {
            let name = match &environment.map {
                Some(path) => path.display().to_string(),
                None => "made by a program".to_owned(),
            };
            let line = format!(
                "{name}: {} × {}, {} with the tables for sampling",
                image.0.width(),
                image.0.height(),
                units::bytes(image.0.bytes() as u64)
            );
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    lines.into_iter()
}

fn contents(scene: &RenderScene) -> String {
    let geometry = scene.accel().geometry();
    let counts = [
        (geometry.triangles.len(), "triangle"),
        (geometry.spheres.len(), "sphere"),
        (geometry.quads.len(), "quad"),
        (scene.materials().len(), "material"),
        (scene.lights().len(), "light"),
    ];
    let counts = counts.iter().filter(|(n, _)| *n > 0);
    let texts: Vec<String> = counts
        .map(|(n, what)| units::counted(*n as u64, what))
        .collect();
    texts.join(", ")
}

fn film(world: &World, spec: &FilmSpec) -> String {
    let settings = world.resource::<FilmSettings>();
    let mut text = format!("{} × {} pixels", spec.width, spec.height);
    if let Some([x0, y0, x1, y1]) = settings.crop {
        let pixels = units::counted(spec.crop.pixel_count(), "pixel");
        let _ = write!(text, ", of which {x0},{y0},{x1},{y1} ({pixels})");
    }
    let _ = write!(text, ", filter {}", to_ron(&settings.filter));
    if let Some(limit) = settings.clamp {
        let _ = write!(text, ", samples clamped at {limit}: biased");
    }
    if !settings.layers.is_empty() {
        let _ = write!(text, ", layers {}", to_ron(&settings.layers));
    }
    text
}

fn adaptive(settings: &AdaptiveSettings) -> String {
    let AdaptiveSettings {
        rule,
        tolerance,
        confidence,
        batch,
        min_samples,
        block,
        floor,
    } = settings;
    let goal = format!(
        "tolerance {tolerance} at {} %, batches of {batch}",
        100.0 * confidence
    );
    match rule {
        AdaptiveRule::Off => "off".into(),
        AdaptiveRule::Course => format!("Course: {goal}; biased"),
        AdaptiveRule::Folds => format!(
            "Folds: {goal} from {} on, blocks of {block} × {block}, floor {floor}",
            units::counted((*min_samples).into(), "sample")
        ),
    }
}

fn budget(world: &World, spec: &FilmSpec) -> String {
    let budget = world.resource::<Budget>();
    let adaptive = world.resource::<AdaptiveSettings>();
    let most = if adaptive.is_on() { "at most " } else { "" };
    let pixels = spec.crop.pixel_count();
    let samples = |n: u64| {
        let total = units::grouped(n.saturating_mul(pixels));
        format!(
            "{most}{} a pixel, {total} in all",
            units::counted(n, "sample")
        )
    };
    let parts: Vec<String> = [
        most_samples(budget, adaptive).map(samples),
        budget.seconds.map(units::duration),
        budget
            .target_error
            .map(|e| format!("estimated relMSE {e:e}")),
    ]
    .into_iter()
    .flatten()
    .collect();
    match parts.len() {
        0 | 1 => parts.concat(),
        _ => format!("{}; whichever is first", parts.join(" or ")),
    }
}

/// The items that run, or those that do not, with the reasons.
fn lines(items: &[PlanItem], runs: bool) -> String {
    let width = items
        .iter()
        .map(|i| i.what.chars().count())
        .max()
        .unwrap_or(0);
    items
        .iter()
        .filter(|i| i.runs == runs)
        .map(|i| format!("  {:width$}  {}\n", i.what, i.reason))
        .collect()
}
