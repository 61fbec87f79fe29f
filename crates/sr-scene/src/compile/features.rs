//! What the scene has and lacks.

use super::accel::AccelTable;
use super::geometry::GeometryTables;
use super::lights::LightTable;
use super::materials::MaterialTable;
use bevy_ecs::prelude::*;
use sr_render::SceneFeatures;
use sr_render::bsdf::LobeFlags;

/// The features of everything that is reachable.
#[derive(Resource, Clone, Copy)]
pub(super) struct FoundFeatures(pub SceneFeatures);

/// Looks at each table.
pub(super) fn find_features(
    accel: Res<'_, AccelTable>,
    tables: Res<'_, GeometryTables>,
    materials: Res<'_, MaterialTable>,
    lights: Res<'_, LightTable>,
    mut commands: Commands<'_, '_>,
) {
    let geometry = accel.0.geometry();
    let mut found = SceneFeatures::NONE;
    let mut set = |on: bool, feature| {
        if on {
            found |= feature;
        }
    };
    set(!geometry.triangles.is_empty(), SceneFeatures::TRIANGLES);
    set(!geometry.spheres.is_empty(), SceneFeatures::SPHERES);
    set(!geometry.quads.is_empty(), SceneFeatures::QUADS);
    set(!tables.normals.is_empty(), SceneFeatures::SMOOTH_NORMALS);
    for shape in &tables.shapes {
        let lobes = materials.materials[shape.material.index()].bsdf.flags();
        let smooth = lobes.contains(LobeFlags::DIFFUSE) || lobes.contains(LobeFlags::GLOSSY);
        set(smooth, SceneFeatures::SMOOTH_LOBES);
        set(lobes.contains(LobeFlags::DELTA), SceneFeatures::DELTA_LOBES);
        set(
            lobes.contains(LobeFlags::GLOSSY),
            SceneFeatures::GLOSSY_LOBES,
        );
        set(
            lobes.contains(LobeFlags::TRANSMISSION),
            SceneFeatures::TRANSMISSION,
        );
        set(shape.brush.is_some(), SceneFeatures::ANISOTROPY);
        set(shape.first_light.is_some(), SceneFeatures::AREA_LIGHTS);
    }
    for light in &lights.lights {
        set(light.is_delta(), SceneFeatures::DELTA_LIGHTS);
        set(
            light.is_infinite() && !light.is_delta(),
            SceneFeatures::ENVIRONMENT,
        );
    }
    set(lights.lights.len() > 1, SceneFeatures::MANY_LIGHTS);
    commands.insert_resource(FoundFeatures(found));
}
