//! Lenses that can be made, and that something can be in focus of.

use super::super::session::Session;
use super::{check_positive, complaint};
use bevy_ecs::prelude::*;
use sr_scene::components::{Focus, Orthographic, PerspectiveCamera, ThinLens};
use sr_scene::diagnostics::Diagnostic;
use sr_scene::lobes::LobeCatalog;

impl Session<'_> {
    pub(super) fn check_lenses(&mut self) {
        self.check_each::<ThinLens>("ThinLens", |lens, complaints| {
            let radius = lens.aperture_radius;
            if !(radius >= 0.0 && radius.is_finite()) {
                let message = format!("{radius} must be finite and at least 0");
                complaints.push(("aperture_radius", complaint(message)));
            }
            match (lens.focus_distance, lens.focus) {
                (Some(distance), None) if distance == f64::INFINITY => {}
                (Some(distance), None) => check_positive("focus_distance", distance, complaints),
                (None, Some(_)) => {}
                (None, None) if radius <= 0.0 => {}
                (None, None) => {
                    let message = "an aperture needs something to be in focus".to_owned();
                    let hint = "give `focus_distance` in metres, or `focus`: `Entity(\"name\")` or \
                                `At((x, y))`";
                    complaints.push(("", (message, Some(hint))));
                }
                (Some(_), Some(_)) => {
                    let message = "both `focus` and `focus_distance` are given".to_owned();
                    complaints.push(("focus", (message, Some("give one"))));
                }
            }
            if matches!(lens.blades, 1 | 2) {
                let message = format!("{} corners make no polygon", lens.blades);
                complaints.push(("blades", (message, Some("3 or more make one, 0 is round"))));
            }
            if !lens.rotation_deg.is_finite() {
                complaints.push(("rotation_deg", complaint("must be finite")));
            }
        });
        self.check_what_is_in_focus();
        self.tell_lenses_without_camera();
    }

    /// A material has no place.
    fn check_what_is_in_focus(&mut self) {
        let mut lenses = self.world.query::<(Entity, &ThinLens)>();
        let focused: Vec<(Entity, Entity)> = lenses
            .iter(self.world)
            .filter_map(|(entity, lens)| match lens.focus {
                Some(Focus::Entity(focus)) => Some((entity, focus)),
                _ => None,
            })
            .collect();
        for (camera, focus) in focused {
            let catalog = self.world.resource::<LobeCatalog>();
            let focused = self.world.get_entity(focus);
            let is_material = focused.is_ok_and(|e| catalog.of(e).next().is_some());
            if is_material && !self.is_shape(focus) {
                let name = self.world.get::<Name>(focus);
                let name = name.map_or("unnamed", Name::as_str);
                let message = format!("`{name}` is a material, which is nowhere");
                let hint = "name a shape, a model, or anything that is placed";
                self.invalid(camera, ".ThinLens.focus", (message, Some(hint)));
            }
        }
    }

    fn tell_lenses_without_camera(&mut self) {
        let mut idle = self.world.query_filtered::<Entity, (
            With<ThinLens>,
            Without<PerspectiveCamera>,
            Without<Orthographic>,
        )>();
        let idle: Vec<Entity> = idle.iter(self.world).collect();
        for entity in idle {
            let path = self.names.path(entity);
            // The camera of a configuration has been told about already.
            if path != "camera" {
                let warning = Diagnostic::warning("there is no camera to have this lens")
                    .at(self.place(entity, ".ThinLens"))
                    .field(format!("{path}.ThinLens"));
                self.diagnostics.push(warning);
            }
        }
    }
}
