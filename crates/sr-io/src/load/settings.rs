//! Sections of a configuration into their resources, and the integrator.

use super::session::Session;
use crate::reflect::{FieldPath, Origin, Step};
use crate::ron::{Node, Pos, Value};
use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_reflect::{PartialReflect, Reflect};
use sr_scene::diagnostics::{Diagnostic, suggest};
use sr_scene::integrator::{IntegratorCatalog, SelectedIntegrator};
use sr_scene::settings::{
    AdaptiveSettings, Budget, CompileSettings, FilmSettings, PostSettings, SamplerSettings,
    SceneFilm,
};

/// The integrator of a configuration that names none.
pub(super) const DEFAULT_INTEGRATOR: &str = "Path";

/// A value for a section or a field of it.
pub(super) struct Setting<'a> {
    /// The way to the field; empty for the whole section.
    pub steps: &'a [Step<'a>],
    pub value: &'a Node,
    pub origin: &'a Origin,
    /// Where the steps are written.
    pub pos: Pos,
}

impl Session<'_> {
    /// Every section starts from its defaults: a world can be loaded into again.
    pub fn reset_settings(&mut self) {
        self.world.insert_resource(FilmSettings::default());
        self.world.insert_resource(SamplerSettings::default());
        self.world.insert_resource(Budget::default());
        self.world.insert_resource(AdaptiveSettings::default());
        self.world.insert_resource(PostSettings::default());
        self.world.insert_resource(CompileSettings::default());
        self.world.insert_resource(SceneFilm::default());
        self.world.remove_resource::<SelectedIntegrator>();
    }

    /// Applies to a section of a configuration. `false` when there is no such section.
    pub fn set_section(&mut self, section: &str, setting: &Setting<'_>) -> bool {
        match section {
            "film" => self.set_resource::<FilmSettings>(section, setting),
            "sampler" => self.set_resource::<SamplerSettings>(section, setting),
            "budget" => self.set_resource::<Budget>(section, setting),
            "adaptive" => self.set_resource::<AdaptiveSettings>(section, setting),
            "post" => self.set_resource::<PostSettings>(section, setting),
            "compile" => self.set_resource::<CompileSettings>(section, setting),
            _ => return false,
        }
        true
    }

    /// Applies to a resource; `path` is what errors call it.
    pub fn set_resource<R>(&mut self, path: &str, setting: &Setting<'_>)
    where
        R: Resource<Mutability = Mutable> + Reflect + Clone,
    {
        let mut value = self.world.resource::<R>().clone();
        self.set_value(&mut value, path, setting);
        self.world.insert_resource(value);
    }

    fn set_value(&mut self, value: &mut dyn PartialReflect, path: &str, setting: &Setting<'_>) {
        let types = self.types();
        let registry = types.read();
        self.reflecting(&registry, setting.origin, false, |context| {
            context.apply_at(
                value,
                setting.steps,
                setting.pos,
                setting.value,
                &FieldPath::Root(path),
            );
        });
        let field = setting.steps.iter().fold(path.to_owned(), |p, s| match s {
            Step::Field(name) => format!("{p}.{name}"),
            Step::Index(index) => format!("{p}[{index}]"),
        });
        self.places
            .record(field, setting.origin.span(setting.value.pos));
    }

    /// `integrator: Path(max_depth: 5)`, or a field of it. Another integrator starts from its
    /// defaults; the same one keeps what is not named.
    pub fn set_integrator(&mut self, setting: &Setting<'_>) {
        if !setting.steps.is_empty() {
            let Some(mut selected) = self.world.remove_resource::<SelectedIntegrator>() else {
                return;
            };
            let settings = selected.settings.as_partial_reflect_mut();
            self.set_value(settings, "integrator", setting);
            self.world.insert_resource(selected);
            return;
        }
        let (name, value) = match &setting.value.value {
            Value::Name(name) => (name, Value::Unit),
            Value::Tuple {
                name: Some(name),
                items,
            } if items.is_empty() => (name, Value::Unit),
            Value::Struct {
                name: Some(name),
                fields,
            } => {
                let fields = fields.clone();
                (name, Value::Struct { name: None, fields })
            }
            other => {
                let message = format!("expected an integrator, found {}", other.describe());
                let hint = "write its name and settings, such as `Path(max_depth: 5)`";
                let diagnostic = Diagnostic::error(message)
                    .at(setting.origin.span(setting.value.pos))
                    .field("integrator")
                    .hint(hint);
                self.diagnostics.push(diagnostic);
                return;
            }
        };
        let span = setting.origin.span(setting.value.pos);
        if !self.select_integrator(name, Some(span)) {
            return;
        }
        let node = Node {
            value,
            pos: setting.value.pos,
        };
        let Some(mut selected) = self.world.remove_resource::<SelectedIntegrator>() else {
            return;
        };
        let setting = Setting {
            value: &node,
            ..*setting
        };
        let settings = selected.settings.as_partial_reflect_mut();
        self.set_value(settings, "integrator", &setting);
        self.world.insert_resource(selected);
    }

    /// Makes an integrator the selected one, with default settings unless it is already.
    pub fn select_integrator(
        &mut self,
        name: &str,
        span: Option<sr_scene::components::SourceSpan>,
    ) -> bool {
        let selected = self.world.get_resource::<SelectedIntegrator>();
        if selected.is_some_and(|s| s.name == name) {
            return true;
        }
        let catalog = &self.world.resource::<IntegratorCatalog>().0;
        let types = self.types();
        let registry = types.read();
        let settings = catalog
            .get(name)
            .and_then(|info| registry.get_type_data::<ReflectDefault>(info.settings))
            .map(ReflectDefault::default);
        if let Some(settings) = settings {
            self.world.insert_resource(SelectedIntegrator {
                name: name.to_owned(),
                settings,
            });
            return true;
        }
        let message = if catalog.contains_key(name) {
            format!("the settings of integrator `{name}` are registered without a default")
        } else {
            format!("there is no integrator `{name}`")
        };
        let hint = suggest(name, catalog.keys().copied());
        let diagnostic = Diagnostic::error(message)
            .at(span)
            .field("integrator")
            .hint(hint);
        self.diagnostics.push(diagnostic);
        false
    }
}
