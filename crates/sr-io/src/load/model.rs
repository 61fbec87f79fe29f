//! A model's nodes, parts and materials as entities.

use super::parse::{Format, LoadedModel};
use super::session::Session;
use crate::model::{Camera, Light, Lobe, Material, Node, Part};
use crate::reflect::{FieldPath, Origin};
use bevy_ecs::prelude::*;
use sr_scene::components::{Lambert, LocalTransform, MaterialRef, MetallicRoughness, SourceSpan};

/// What one model has become, as far as others ask.
pub(super) struct SpawnedModel {
    /// Its cameras, in the order of the file.
    pub cameras: Vec<Entity>,
}

impl Session<'_> {
    /// Spawns a model. `origin` is the scene file, which has the model's transform.
    pub fn spawn_model(&mut self, loaded: LoadedModel, origin: &Origin) -> SpawnedModel {
        let LoadedModel {
            name,
            file,
            entry,
            transform,
            format,
            model,
        } = loaded;
        let mut local = LocalTransform::default();
        if let Some(node) = &transform {
            let types = self.types();
            let registry = types.read();
            let path = format!("models.{name}.transform");
            self.reflecting(&registry, origin, false, |context| {
                context.apply(&mut local, node, &FieldPath::Root(&path));
            });
            let known_as = format!("entities.{name}.LocalTransform");
            self.places.alias(&path, &known_as);
        }
        let mut spawner = Spawner {
            session: self,
            model: &name,
            file: &file,
            format,
            materials: Vec::new(),
            default_material: None,
            cameras: Vec::new(),
        };
        let root = spawner.spawn_thing(&name, None, local, entry.as_ref());
        for material in model.materials {
            spawner.spawn_material(material);
        }
        let mut nodes: Vec<(Entity, String)> = Vec::with_capacity(model.nodes.len());
        for node in model.nodes {
            let parent = node.parent.and_then(|p| nodes.get(p));
            let parent = parent.map_or(root, |(entity, _)| *entity);
            nodes.push(spawner.spawn_node(node, parent));
        }
        SpawnedModel {
            cameras: spawner.cameras,
        }
    }
}

struct Spawner<'a, 'w> {
    session: &'a mut Session<'w>,
    model: &'a str,
    file: &'a SourceSpan,
    format: Format,
    materials: Vec<Entity>,
    default_material: Option<Entity>,
    cameras: Vec<Entity>,
}

impl Spawner<'_, '_> {
    fn spawn_thing(
        &mut self,
        name: &str,
        parent: Option<Entity>,
        local: LocalTransform,
        span: Option<&SourceSpan>,
    ) -> Entity {
        let span = span.unwrap_or(self.file).clone();
        let bundle = (Name::new(name.to_owned()), local, span);
        let mut entity = self.session.world.spawn(bundle);
        if let Some(parent) = parent {
            entity.insert(ChildOf(parent));
        }
        let entity = entity.id();
        self.session.names.add_entity(name, entity);
        entity
    }

    fn spawn_node(&mut self, node: Node, parent: Entity) -> (Entity, String) {
        let name = if node.name.is_empty() {
            "node"
        } else {
            &node.name
        };
        let name = format!("{}/{name}", self.model);
        let name = self.session.names.unique(&name, false);
        let entity = self.spawn_thing(&name, Some(parent), node.transform, None);
        let mut commands = self.session.world.entity_mut(entity);
        let is_camera = node.camera.is_some();
        match node.camera {
            Some(Camera::Perspective(camera)) => drop(commands.insert(camera)),
            Some(Camera::Orthographic(camera)) => drop(commands.insert(camera)),
            None => {}
        }
        if is_camera {
            self.cameras.push(entity);
        }
        match node.light {
            Some(Light::Point(light)) => drop(commands.insert(light)),
            Some(Light::Spot(light)) => drop(commands.insert(light)),
            Some(Light::Directional(light)) => drop(commands.insert(light)),
            None => {}
        }
        let several = node.parts.len() > 1;
        for (i, part) in node.parts.into_iter().enumerate() {
            let holder = if several {
                let part_name = self.session.names.unique(&format!("{name}#{i}"), false);
                let local = LocalTransform::default();
                self.spawn_thing(&part_name, Some(entity), local, None)
            } else {
                entity
            };
            self.insert_part(part, holder);
        }
        (entity, name)
    }

    fn insert_part(&mut self, part: Part, entity: Entity) {
        let material = part.material.and_then(|m| self.materials.get(m).copied());
        let material = material.unwrap_or_else(|| self.default_material());
        let bundle = (part.mesh, MaterialRef(material));
        self.session.world.entity_mut(entity).insert(bundle);
    }

    fn spawn_material(&mut self, material: Material) {
        let name = if material.name.is_empty() {
            "material"
        } else {
            &material.name
        };
        let entity = self.spawn_lobe(name, material.lobe);
        if let Some(emission) = material.emission {
            self.session.world.entity_mut(entity).insert(emission);
        }
        self.materials.push(entity);
    }

    fn spawn_lobe(&mut self, name: &str, lobe: Lobe) -> Entity {
        let name = format!("{}/{name}", self.model);
        let name = self.session.names.unique(&name, true);
        let bundle = (Name::new(name.clone()), self.file.clone());
        let mut entity = self.session.world.spawn(bundle);
        match lobe {
            Lobe::Lambert(lobe) => entity.insert(lobe),
            Lobe::Mirror(lobe) => entity.insert(lobe),
            Lobe::Dielectric(lobe) => entity.insert(lobe),
            Lobe::ThinDielectric(lobe) => entity.insert(lobe),
            Lobe::Conductor(lobe) => entity.insert(lobe),
            Lobe::MetallicRoughness(lobe) => entity.insert(lobe),
        };
        let entity = entity.id();
        self.session.names.add_material(&name, entity);
        entity
    }

    /// What the format gives to parts without material.
    fn default_material(&mut self) -> Entity {
        if let Some(entity) = self.default_material {
            return entity;
        }
        let lobe = match self.format {
            Format::Gltf => Lobe::MetallicRoughness(MetallicRoughness::default()),
            Format::Obj => Lobe::Lambert(Lambert::default()),
        };
        let entity = self.spawn_lobe("default", lobe);
        self.default_material = Some(entity);
        entity
    }
}
