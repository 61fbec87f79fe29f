//! `Validate`: what does not fit together, all of it, each with its place.

mod adaptive;
mod cameras;
mod lenses;
mod lights;
mod maps;
mod materials;
mod settings;
mod shapes;

use super::parse::Documents;
use super::session::{Session, in_session};
use bevy_ecs::prelude::*;
use sr_scene::components::{Rgb, SourceSpan};
use sr_scene::diagnostics::{Diagnostic, Diagnostics};
use std::path::Path;
use std::sync::Arc;

/// Looks at the whole scene and ends the stage when anything, here or before, is wrong.
pub(super) fn validate_scene(world: &mut World) -> Result {
    let documents = world.remove_resource::<Documents>();
    in_session(world, |session| {
        session.check_shapes();
        session.check_hierarchy();
        session.check_materials();
        session.check_lights();
        session.read_maps();
        session.check_cameras();
        session.check_settings();
        if let Some(documents) = &documents {
            session.keep_resolved(documents);
        }
        let first = documents.map(|d| [d.config.origin.name, d.scene.origin.name]);
        sort(
            &mut session.diagnostics,
            first.into_iter().flatten().collect(),
        );
    });
    Ok(world.resource::<Diagnostics>().check()?)
}

/// Line by line within each file; further files in the order in which they first have a problem.
fn sort(diagnostics: &mut [Diagnostic], mut files: Vec<Arc<Path>>) {
    for span in diagnostics.iter().filter_map(|d| d.span.as_ref()) {
        if !files.contains(&span.file) {
            files.push(span.file.clone());
        }
    }
    diagnostics.sort_by_key(|d| match &d.span {
        None => (files.len(), 0, 0),
        Some(span) => {
            let file = files.iter().position(|f| *f == span.file);
            (file.unwrap_or(files.len()), span.line, span.column)
        }
    });
}

/// What is wrong with a field: message and, when there is any, advice.
type Complaint = (String, Option<&'static str>);

fn complaint(message: impl Into<String>) -> Complaint {
    (message.into(), None)
}

impl Session<'_> {
    /// Reports a field of an entity, such as `.Sphere.radius`, unless it could not even be set: one
    /// mistake is told once.
    fn invalid(&mut self, entity: Entity, field: &str, (message, hint): Complaint) {
        let path = format!("{}{field}", self.names.path(entity));
        if self.places.is_faulty(&path) {
            return;
        }
        let mut diagnostic = Diagnostic::error(message)
            .at(self.place(entity, field))
            .field(path);
        diagnostic.hint = hint.map(Into::into);
        self.diagnostics.push(diagnostic);
    }

    /// Reports a field of a setting, such as `film.width`, unless it could not even be set.
    fn invalid_setting(&mut self, field: &str, (message, hint): Complaint) {
        if self.places.is_faulty(field) {
            return;
        }
        let mut diagnostic = Diagnostic::error(message)
            .at(self.places.find(field).cloned())
            .field(field);
        diagnostic.hint = hint.map(Into::into);
        self.diagnostics.push(diagnostic);
    }

    /// Looks at a component of each entity that has it; `check` names fields without their dot,
    /// or nothing for the component itself.
    fn check_each<C: Component>(
        &mut self,
        component: &str,
        check: impl Fn(&C, &mut Vec<(&'static str, Complaint)>),
    ) {
        let mut query = self.world.query::<(Entity, &C)>();
        let mut found = Vec::new();
        let mut complaints = Vec::new();
        for (entity, value) in query.iter(self.world) {
            check(value, &mut complaints);
            found.extend(complaints.drain(..).map(|(field, c)| (entity, field, c)));
        }
        for (entity, field, complaint) in found {
            let dot = if field.is_empty() { "" } else { "." };
            self.invalid(entity, &format!(".{component}{dot}{field}"), complaint);
        }
    }
}

/// Power cannot be negative.
fn check_power(field: &'static str, value: Rgb, complaints: &mut Vec<(&'static str, Complaint)>) {
    if !value.within(0.0, f32::MAX) {
        let message = "each channel must be finite and at least 0";
        complaints.push((field, complaint(message)));
    }
}

/// Lengths and the like.
fn check_positive(
    field: &'static str,
    value: f64,
    complaints: &mut Vec<(&'static str, Complaint)>,
) {
    if !(value > 0.0 && value.is_finite()) {
        complaints.push((
            field,
            complaint(format!("{value} must be finite and above 0")),
        ));
    }
}

/// The place that the entity was read from.
fn is_from_text(span: Option<&SourceSpan>) -> bool {
    span.is_some_and(|s| s.line > 0)
}
