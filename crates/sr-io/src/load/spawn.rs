//! `Spawn`: documents and models become entities and settings.

use super::parse::Documents;
use super::session::{Session, in_session};
use super::settings::{DEFAULT_INTEGRATOR, Setting};
use crate::document::{Config, Scene};
use crate::ron::Pos;
use bevy_ecs::prelude::*;
use sr_scene::components::SourceSpan;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::lobes::LobeCatalog;
use sr_scene::settings::SceneFilm;

/// Replaces what an earlier run has spawned: models first, then the scene's entities, then the
/// configuration's sections.
pub(super) fn spawn_scene(world: &mut World) {
    let Some(mut documents) = world.remove_resource::<Documents>() else {
        return;
    };
    despawn_loaded(world);
    in_session(world, |session| {
        session.reset_settings();
        let mut model_cameras = Vec::new();
        for model in documents.models.drain(..) {
            let spawned = session.spawn_model(model, &documents.scene.origin);
            model_cameras.extend(spawned.cameras);
        }
        let entities = session.spawn_entities(&documents.scene);
        if let Some(film) = &documents.scene.film {
            let setting = Setting {
                steps: &[],
                value: film,
                origin: &documents.scene.origin,
                pos: film.pos,
            };
            session.set_resource::<SceneFilm>("film", &setting);
        }
        session.configure(&documents.config);
        session.choose_camera(&entities, &model_cameras);
    });
    world.insert_resource(documents);
}

/// Takes away what an earlier run has loaded, known by its place in a file.
fn despawn_loaded(world: &mut World) {
    let mut loaded = world.query_filtered::<Entity, With<SourceSpan>>();
    let loaded: Vec<Entity> = loaded.iter(world).collect();
    for entity in loaded {
        // Children go with their parents.
        let _ = world.try_despawn(entity);
    }
}

impl Session<'_> {
    fn spawn_entities(&mut self, scene: &Scene) -> Vec<Entity> {
        // All names before all components: these may name entities further down.
        let mut entities = Vec::with_capacity(scene.entities.len());
        for entry in &scene.entities {
            let mut name = entry.name.clone();
            let span = scene.origin.span(entry.pos);
            if self.names.entities.contains_key(&name) {
                let message = format!("a model brought an entity `{name}` already");
                self.error(span.clone(), &format!("entities.{name}"), message);
                name = self.names.unique(&name, false);
            }
            let entity = self
                .world
                .spawn((Name::new(name.clone()), span.clone()))
                .id();
            self.names.add_entity(&name, entity);
            self.places.record(format!("entities.{name}"), span);
            entities.push(entity);
        }
        // Materials are known by what they will have: a reference further up finds them first.
        for (entry, entity) in scene.entities.iter().zip(&entities) {
            let is_material = entry.components.iter().any(|(c, ..)| self.is_material(c));
            if is_material && !self.names.materials.contains_key(&entry.name) {
                self.names.materials.insert(entry.name.clone(), *entity);
            }
        }
        for (entry, entity) in scene.entities.iter().zip(&entities) {
            let path = format!("entities.{}", entry.name);
            self.assign_all(*entity, &entry.components, &path, &scene.origin);
        }
        entities
    }

    /// Whether a component makes a material of its entity.
    fn is_material(&self, component: &str) -> bool {
        let catalog = self.world.resource::<LobeCatalog>();
        catalog.get(component).is_some() || component == "Emission"
    }

    fn configure(&mut self, config: &Config) {
        let setting = |value| Setting {
            steps: &[],
            value,
            origin: &config.origin,
            pos: Pos { line: 1, column: 1 },
        };
        for (section, value) in &config.sections {
            self.set_section(section, &setting(value));
        }
        if let Some(value) = &config.integrator {
            self.set_integrator(&setting(value));
        }
        if !self.world.contains_resource::<SelectedIntegrator>() && config.integrator.is_none() {
            self.select_integrator(DEFAULT_INTEGRATOR, None);
        }
        if let Some(camera) = &config.camera {
            self.set_camera(camera, &config.origin);
        }
    }
}
