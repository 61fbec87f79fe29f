//! Materials have one lobe, and shapes have materials.

use super::super::session::Session;
use super::{check_power, complaint, is_from_text};
use bevy_ecs::prelude::*;
use sr_scene::components::{Emission, MaterialRef, Quad, SourceSpan, Sphere, TriangleMesh};
use sr_scene::diagnostics::Diagnostic;
use sr_scene::lobes::LobeCatalog;
use std::collections::HashSet;

type IsShape = Or<(With<TriangleMesh>, With<Sphere>, With<Quad>)>;

/// An entity with its lobes: the name of each, and what is wrong with it.
type Lobes = (Entity, Vec<(&'static str, Result<(), String>)>);

impl Session<'_> {
    pub(super) fn check_materials(&mut self) {
        self.check_each::<Emission>("Emission", |emission, complaints| {
            check_power("radiance", emission.radiance, complaints);
            if !(0.0..=f32::MAX).contains(&emission.strength) {
                complaints.push(("strength", complaint("must be finite and at least 0")));
            }
        });
        let materials = self.materials();
        for (entity, lobes) in &materials {
            self.check_lobes(*entity, lobes);
        }
        let with_lobe = |(entity, lobes): &Lobes| (!lobes.is_empty()).then_some(*entity);
        let valid: HashSet<Entity> = materials.iter().filter_map(with_lobe).collect();
        let used = self.check_references(&valid);
        self.check_shapes_of_their_own(&valid);
        self.tell_unused(&materials, &used);
    }

    /// Every entity with a lobe or a glow.
    fn materials(&mut self) -> Vec<Lobes> {
        let mut entities = self.world.query::<Entity>();
        let entities: Vec<Entity> = entities.iter(self.world).collect();
        let catalog = self.world.resource::<LobeCatalog>();
        entities
            .into_iter()
            .filter_map(|entity| {
                let entity = self.world.entity(entity);
                let lobes: Vec<_> = catalog
                    .of(entity)
                    .map(|(name, bsdf)| (name, bsdf.map(drop)))
                    .collect();
                let is_material = !lobes.is_empty() || entity.contains::<Emission>();
                is_material.then(|| (entity.id(), lobes))
            })
            .collect()
    }

    fn check_lobes(&mut self, entity: Entity, lobes: &[(&'static str, Result<(), String>)]) {
        for (name, result) in lobes {
            if let Err(problem) = result {
                let (field, message) = split_field(problem);
                let field = format!(".{name}{field}");
                self.invalid(entity, &field, complaint(message));
            }
        }
        match lobes {
            [] => {
                let message = "a material that glows needs a lobe too".to_owned();
                let hint = "add `\"Lambert\": (reflectance: 0)` for a black one";
                self.invalid(entity, ".Emission", (message, Some(hint)));
            }
            [_] => {}
            [first, others @ ..] => {
                for (name, _) in others {
                    let message = format!("the material is a {} already", first.0);
                    let hint = "a material has one lobe";
                    self.invalid(entity, &format!(".{name}"), (message, Some(hint)));
                }
            }
        }
    }

    /// Each `MaterialRef` leads to a material and stands on a shape. Returns what is used.
    fn check_references(&mut self, valid: &HashSet<Entity>) -> HashSet<Entity> {
        let mut query = self.world.query::<(
            Entity,
            &MaterialRef,
            Has<TriangleMesh>,
            Has<Sphere>,
            Has<Quad>,
        )>();
        let references: Vec<_> = query
            .iter(self.world)
            .map(|(entity, m, mesh, sphere, quad)| (entity, m.0, mesh || sphere || quad))
            .collect();
        let mut used = HashSet::new();
        for (entity, material, is_shape) in references {
            used.insert(material);
            let is_told = |s: &Self| s.world.get::<Emission>(material).is_some();
            if !valid.contains(&material) && !is_told(self) {
                let name = self
                    .world
                    .get::<Name>(material)
                    .map_or("unnamed", Name::as_str);
                let message = format!("`{name}` is no material: it has no lobe");
                let hint = "a lobe is a component such as `Lambert` or `Dielectric`";
                self.invalid(entity, ".MaterialRef", (message, Some(hint)));
            }
            if !is_shape {
                let warning = Diagnostic::warning("there is no shape to have this material")
                    .at(self.place(entity, ".MaterialRef"))
                    .field(format!("{}.MaterialRef", self.names.path(entity)));
                self.diagnostics.push(warning);
            }
        }
        used
    }

    /// A lobe on the shape itself would be passed over.
    fn check_shapes_of_their_own(&mut self, valid: &HashSet<Entity>) {
        let mut query = self.world.query_filtered::<Entity, IsShape>();
        let shapes: Vec<Entity> = query.iter(self.world).collect();
        for shape in shapes {
            if valid.contains(&shape) && self.material_of(shape) != Some(shape) {
                let catalog = self.world.resource::<LobeCatalog>();
                let lobe = catalog
                    .of(self.world.entity(shape))
                    .map(|(name, _)| name)
                    .next();
                let message = "the lobe stands on the shape and not on a material".to_owned();
                let hint = "make the material an entity of its own and name it in `MaterialRef`";
                let field = format!(".{}", lobe.unwrap_or_default());
                self.invalid(shape, &field, (message, Some(hint)));
            }
        }
    }

    /// A model brings more materials than are used as a rule; an author does not.
    fn tell_unused(&mut self, materials: &[Lobes], used: &HashSet<Entity>) {
        if self.names.lost_scene || !self.names.lost_models.is_empty() {
            return;
        }
        for (entity, _) in materials {
            let span = self.world.get::<SourceSpan>(*entity).cloned();
            // A shape with a lobe has been told about.
            let is_free = !used.contains(entity) && !self.is_shape(*entity);
            if is_from_text(span.as_ref()) && is_free {
                let notice = Diagnostic::notice("no shape has this material")
                    .at(span)
                    .field(self.names.path(*entity));
                self.diagnostics.push(notice);
            }
        }
    }
}

/// A lobe's complaint starts with its field in backticks: `` `alpha`: must be … ``.
fn split_field(problem: &str) -> (String, &str) {
    let named = problem
        .strip_prefix('`')
        .and_then(|rest| rest.split_once("`: "));
    match named {
        Some((field, message)) => (format!(".{field}"), message),
        None => (String::new(), problem),
    }
}
