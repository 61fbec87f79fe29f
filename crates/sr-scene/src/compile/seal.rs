//! All tables move into one immutable scene.

use super::accel::AccelTable;
use super::camera::RenderSpace;
use super::features::FoundFeatures;
use super::geometry::GeometryTables;
use super::lights::LightTable;
use super::materials::MaterialTable;
use crate::settings::{CompileSettings, LightSelectionName};
use bevy_ecs::prelude::*;
use sr_render::light::{LightSampler, LightSelection};
use sr_render::{BoundingSphere, LightId, MaterialId, RenderScene, SceneTables, ShapeId};
use std::ops::Deref;
use std::sync::Arc;

/// The scene that integrators see. Nothing changes it; compiling again replaces it.
#[derive(Resource, Clone)]
pub struct SealedScene(pub Arc<RenderScene>);

impl Deref for SealedScene {
    type Target = RenderScene;
    fn deref(&self) -> &RenderScene {
        &self.0
    }
}

/// The entities that the tables of the sealed scene were made of: for messages, which name and place
/// them. Whoever traces rays has no use for it.
#[derive(Resource, Clone, Debug, Default)]
pub struct SceneSources {
    shapes: Vec<Entity>,
    materials: Vec<Option<Entity>>,
    lights: Vec<Option<Entity>>,
}

impl SceneSources {
    /// Of a shape.
    pub fn shape(&self, id: ShapeId) -> Option<Entity> {
        self.shapes.get(id.index()).copied()
    }

    /// Of a material; the default one has none.
    pub fn material(&self, id: MaterialId) -> Option<Entity> {
        self.materials.get(id.index()).copied().flatten()
    }

    /// Of a light: the shape that glows, or an entity that is nothing but a light. A white environment
    /// that nobody asked for has none.
    pub fn light(&self, id: LightId) -> Option<Entity> {
        self.lights.get(id.index()).copied().flatten()
    }
}

/// Takes the tables out of the world.
pub(super) fn seal(world: &mut World) -> Result {
    let missing = "a table is missing although its system has run";
    let space = world.remove_resource::<RenderSpace>().ok_or(missing)?;
    let materials = world.remove_resource::<MaterialTable>().ok_or(missing)?;
    let geometry = world.remove_resource::<GeometryTables>().ok_or(missing)?;
    let lights = world.remove_resource::<LightTable>().ok_or(missing)?;
    let accel = world.remove_resource::<AccelTable>().ok_or(missing)?;
    let features = world.remove_resource::<FoundFeatures>().ok_or(missing)?;
    let selection = match world.resource::<CompileSettings>().light_selection {
        LightSelectionName::Uniform => LightSelection::Uniform,
        LightSelectionName::Power => LightSelection::Power,
        LightSelectionName::Spatial => LightSelection::Spatial,
        LightSelectionName::All => LightSelection::All,
    };
    let sphere = BoundingSphere::of(accel.0.bounds());
    let light_sampler = LightSampler::new(&lights.lights, selection, sphere.center, sphere.radius);
    let scene = RenderScene::new(SceneTables {
        accel: accel.0,
        shapes: geometry.shapes,
        shape_names: geometry.names,
        prim_shape: geometry.prim_shape,
        normals: geometry.normals,
        materials: materials.materials,
        lights: lights.lights,
        light_sampler,
        camera: space.camera,
        features: features.0,
        origin: space.origin,
    });
    world.insert_resource(SceneSources {
        shapes: geometry.entities,
        materials: materials.entities,
        lights: lights.entities,
    });
    world.insert_resource(SealedScene(Arc::new(scene)));
    Ok(())
}
