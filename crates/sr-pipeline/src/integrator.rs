//! What every integrator says of itself, and how one is selected.

use crate::plan::PlanItem;
use crate::replay::MakeTracer;
use bevy_ecs::prelude::*;
use sr_render::SceneFeatures;
use sr_scene::bevy_ecs;
use sr_scene::bevy_reflect::{FromReflect, GetTypeRegistration, Reflect, TypePath};
use sr_scene::compile::SealedScene;
use sr_scene::diagnostics::{Diagnostic, Diagnostics, suggest};
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::AdaptiveSettings;
use std::collections::BTreeMap;

/// A feature without which an integrator makes no sense.
#[derive(Clone, Copy, Debug)]
pub struct Requirement {
    /// Any of these features satisfies it.
    pub any_of: SceneFeatures,
    /// What to tell the user when none is there.
    pub otherwise: &'static str,
}

/// An integrator's name, settings and relation to scenes.
pub trait Integrator: Send + Sync + 'static {
    /// Name in RON and on the command line.
    const NAME: &'static str;
    /// One line on what it is.
    const SUMMARY: &'static str;
    /// The scene features that it looks at; the others are left out of its work.
    const USES: SceneFeatures;
    /// What a scene must have; checked before the first pass.
    const REQUIRES: &'static [Requirement] = &[];
    /// Adds to arbitrary pixels, so that the film needs splat buffers.
    const SPLATS: bool = false;
    /// Its parameters, as written in RON between the parentheses.
    type Settings: Reflect + FromReflect + GetTypeRegistration + TypePath + Default + Clone;

    /// Whether the settings make sense together, or what is wrong with them; asked before the
    /// first pass.
    fn check(_settings: &Self::Settings) -> Result<(), String> {
        Ok(())
    }

    /// The stages that would run on a scene with these features, for `steradian plan`.
    fn stages(_settings: &Self::Settings, _features: SceneFeatures) -> Vec<PlanItem> {
        Vec::new()
    }
}

type Check = fn(&SelectedIntegrator) -> Result<(), String>;
type Stages = fn(&SelectedIntegrator, SceneFeatures) -> Vec<PlanItem>;

/// What the pipeline knows of a registered integrator.
#[derive(Clone, Copy)]
pub(crate) struct IntegratorEntry {
    pub uses: SceneFeatures,
    pub requires: &'static [Requirement],
    pub splats: bool,
    pub check: Check,
    pub stages: Stages,
    /// Traces single samples, if the integrator can.
    pub tracer: Option<MakeTracer>,
}

impl IntegratorEntry {
    pub fn of<I: Integrator>() -> Self {
        Self {
            uses: I::USES,
            requires: I::REQUIRES,
            splats: I::SPLATS,
            check: |selected| match selected.settings::<I::Settings>() {
                Some(settings) => I::check(settings),
                None => Err("the settings are another integrator's".into()),
            },
            stages: |selected, features| {
                let settings = selected.settings::<I::Settings>().cloned();
                I::stages(&settings.unwrap_or_default(), features)
            },
            tracer: None,
        }
    }
}

/// Every registered integrator.
#[derive(Resource, Default)]
pub(crate) struct IntegratorTable(pub BTreeMap<&'static str, IntegratorEntry>);

impl IntegratorTable {
    pub fn entry(&self, name: &str) -> Result<&IntegratorEntry, String> {
        self.0.get(name).ok_or_else(|| {
            let hint = suggest(name, self.0.keys().copied());
            format!("no integrator is called `{name}`; {hint}")
        })
    }
}

/// Run condition: the configuration names `I`.
pub fn selected<I: Integrator>(selected: Option<Res<'_, SelectedIntegrator>>) -> bool {
    selected.is_some_and(|s| s.name == I::NAME)
}

/// Refuses settings that make no sense, a scene that lacks what the selected integrator needs, and
/// adaptive sampling by an integrator that cannot.
pub(crate) fn check_requirements(
    scene: Res<'_, SealedScene>,
    selected: Res<'_, SelectedIntegrator>,
    table: Res<'_, IntegratorTable>,
    adaptive: Res<'_, AdaptiveSettings>,
    mut diagnostics: ResMut<'_, Diagnostics>,
) -> Result {
    let entry = table.entry(&selected.name)?;
    let field = format!("integrator.{}", selected.name);
    if let Err(problem) = (entry.check)(&selected) {
        diagnostics.push(Diagnostic::error(problem).field(&field));
    }
    if adaptive.is_on() && entry.splats {
        let message = format!(
            "adaptive sampling chooses how many samples a pixel gets, and `{}` adds to pixels that \
             chance chooses",
            selected.name
        );
        let diagnostic = Diagnostic::error(message).field("adaptive.rule");
        diagnostics
            .push(diagnostic.hint("set `adaptive.rule` to `Off`, or take another integrator"));
    }
    for requirement in entry.requires {
        if !scene.features().intersects(requirement.any_of) {
            diagnostics.push(Diagnostic::error(requirement.otherwise).field(&field));
        }
    }
    Ok(diagnostics.check()?)
}
