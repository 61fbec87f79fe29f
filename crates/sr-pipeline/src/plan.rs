//! What runs, what is left out, and why.

use crate::integrator::IntegratorTable;
use crate::layers;
use bevy_ecs::prelude::*;
use sr_render::light::{Light, LightSelection};
use sr_render::{Camera, RenderScene, SceneFeatures};
use sr_scene::bevy_ecs;
use sr_scene::compile::SealedScene;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{AdaptiveSettings, FilmSettings, LayerName};

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanItem {
    /// A stage, system or feature.
    pub what: String,
    /// It runs; otherwise it is left out.
    pub runs: bool,
    /// Why.
    pub reason: String,
}

impl PlanItem {
    /// Runs when `condition` holds, with a reason for each case.
    pub fn when(what: &str, condition: bool, because: &str, otherwise: &str) -> Self {
        Self {
            what: what.into(),
            runs: condition,
            reason: if condition { because } else { otherwise }.into(),
        }
    }
}

/// The plan for a world whose scene is sealed.
pub fn plan(world: &World) -> Vec<PlanItem> {
    let (Some(scene), Some(selected)) = (
        world.get_resource::<SealedScene>(),
        world.get_resource::<SelectedIntegrator>(),
    ) else {
        return Vec::new();
    };
    let Ok(entry) = world.resource::<IntegratorTable>().entry(&selected.name) else {
        return Vec::new();
    };
    let has = scene.features();
    let mut items: Vec<PlanItem> = SceneFeatures::TABLE
        .iter()
        .map(|(name, feature)| {
            let reason = match (has.contains(*feature), entry.uses.contains(*feature)) {
                (true, true) => format!("the scene has it and `{}` uses it", selected.name),
                (true, false) => format!("`{}` does not look at it", selected.name),
                (false, _) => "the scene has none".into(),
            };
            PlanItem {
                what: format!("feature: {name}"),
                runs: (has & entry.uses).contains(*feature),
                reason,
            }
        })
        .collect();
    items.push(light_selection(scene, entry.uses));
    items.extend((entry.stages)(selected, has & entry.uses));
    items.push(lens_item(scene.camera()));
    let film_settings = world.resource::<FilmSettings>();
    let layers = layers::wants_first_hit(film_settings);
    items.push(PlanItem::when(
        "stage: layers of the first hit",
        layers,
        "`film.layers` asks for some",
        "`film.layers` asks for none of them",
    ));
    items.push(PlanItem::when(
        "film: seconds by tile",
        film_settings.layers.contains(&LayerName::Seconds),
        "`film.layers` asks for `Seconds`",
        "`film.layers` does not ask for `Seconds`: no clock is read within a pass",
    ));
    items.push(PlanItem::when(
        "stage: adaptive sampling",
        world.resource::<AdaptiveSettings>().is_on(),
        "`adaptive.rule` says how pixels are found that have enough samples",
        "`adaptive.rule` is `Off`: every pixel gets the same number of samples",
    ));
    items.push(clamp_item(world.resource::<FilmSettings>()));
    let report = scene.accel().report();
    let lost = report.left_out_degenerate + report.left_out_non_finite;
    if lost > 0 {
        items.push(PlanItem {
            what: format!("geometry: {lost} primitives"),
            runs: false,
            reason: "they have no area".into(),
        });
    }
    let has_map = |light: &Light| matches!(light, Light::ImageEnvironment(_));
    items.push(PlanItem::when(
        "environment: tables for sampling",
        scene.lights().iter().any(has_map),
        "an environment has a map",
        "no environment has a map",
    ));
    items.push(PlanItem::when(
        "film: splat buffers",
        entry.splats,
        "the integrator adds to arbitrary pixels",
        "the integrator adds to its own pixels only",
    ));
    items
}

fn lens_item(camera: &Camera) -> PlanItem {
    let because = camera.lens.map(|lens| {
        let (radius, focus) = (lens.radius(), lens.focus_distance());
        format!("an aperture of radius {radius} m, in focus at {focus:.6} m")
    });
    PlanItem::when(
        "stage: points of the lens",
        because.is_some(),
        because.as_deref().unwrap_or_default(),
        "the camera is a pinhole: it has no `ThinLens`, or one of `aperture_radius` 0",
    )
}

fn clamp_item(film: &FilmSettings) -> PlanItem {
    let because = film.clamp.map(|limit| {
        format!("`film.clamp` is {limit}: the picture is biased, it lacks what is cut off")
    });
    PlanItem::when(
        "film: clamp of bright samples",
        because.is_some(),
        because.as_deref().unwrap_or_default(),
        "`film.clamp` is not set",
    )
}

/// How lights are chosen in the end.
fn light_selection(scene: &RenderScene, uses: SceneFeatures) -> PlanItem {
    let any = SceneFeatures::AREA_LIGHTS
        .union(SceneFeatures::DELTA_LIGHTS)
        .union(SceneFeatures::ENVIRONMENT);
    let sampler = scene.light_sampler();
    let selection = sampler.selection();
    let asked = format!("`compile.light_selection` is `{selection:?}`");
    let (runs, reason) = match selection {
        _ if !uses.intersects(any) => (false, "the integrator does not look at lights".into()),
        _ if scene.lights().len() < 2 => (false, "there is no second light".into()),
        LightSelection::All => (true, format!("{asked}: every light at every surface")),
        LightSelection::Uniform | LightSelection::Power => {
            (true, format!("{asked}: alike at every surface"))
        }
        LightSelection::Spatial if !sampler.depends_on_receiver() => {
            (false, "one light at most is not dark".into())
        }
        LightSelection::Spatial => match sampler.tree_levels() {
            0 => (true, format!("{asked}: by what each brings to a surface")),
            n => (true, format!("{asked}: by a tree of {n} levels")),
        },
    };
    PlanItem {
        what: "choice among lights".into(),
        runs,
        reason,
    }
}
