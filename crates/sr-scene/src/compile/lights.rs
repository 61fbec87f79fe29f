//! Lights become a table: first the surfaces that glow, in order of their shapes, so that a
//! primitive finds its light by counting; then the lights without a surface.

use super::camera::RenderSpace;
use super::environment::{environment_light, white};
use super::geometry::GeometryTables;
use super::materials::MaterialTable;
use crate::components::{
    DirectionalLight, Emission, Environment, EnvironmentImage, PointLight, SpotLight,
    WorldTransform,
};
use crate::diagnostics::{Diagnostic, Diagnostics};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use sr_render::accel::Prim;
use sr_render::light;
use sr_render::light::Light;
use sr_render::{LightId, ShapeNormals};

/// All lights.
#[derive(Resource, Default)]
pub(super) struct LightTable {
    pub lights: Vec<Light>,
    /// The entity of each: the shape that glows, or the light itself; unset for the default.
    pub entities: Vec<Option<Entity>>,
}

type Bare<'a> = (
    Entity,
    &'a WorldTransform,
    Option<&'a PointLight>,
    Option<&'a SpotLight>,
    Option<&'a DirectionalLight>,
    Option<(&'a Environment, Option<&'a EnvironmentImage>)>,
);

type IsLight = Or<(
    With<PointLight>,
    With<SpotLight>,
    With<DirectionalLight>,
    With<Environment>,
)>;

/// Finds every light; a scene without any gets a white environment.
pub(super) fn collect_lights(
    bare: Query<Bare<'_>, IsLight>,
    emitters: Query<(), With<Emission>>,
    space: Res<'_, RenderSpace>,
    materials: Res<'_, MaterialTable>,
    mut tables: ResMut<'_, GeometryTables>,
    mut diagnostics: ResMut<'_, Diagnostics>,
    mut commands: Commands<'_, '_>,
) {
    let mut lights = Vec::new();
    let mut entities = Vec::new();
    let prim_count = tables.prim_shape.len() as u32;
    for i in 0..tables.shapes.len() {
        let shape = tables.shapes[i];
        let Some((radiance, two_sided)) = materials.emission[shape.material.index()] else {
            continue;
        };
        let end = tables
            .shapes
            .get(i + 1)
            .map_or(prim_count, |s| s.first_prim);
        tables.shapes[i].first_light = Some(LightId(lights.len() as u32));
        lights.extend(
            (shape.first_prim..end)
                .map(|prim| area_light(&tables, prim, shape.normals, radiance, two_sided)),
        );
        entities.resize(lights.len(), Some(tables.entities[i]));
    }
    let mut bare: Vec<_> = bare.iter().collect();
    bare.sort_unstable_by_key(|b| b.0.index());
    for b in &bare {
        lights.extend(bare_lights(b, space.origin));
        entities.resize(lights.len(), Some(b.0));
    }
    // A light that is turned off is a light: its author knows that it is dark.
    if lights.is_empty() && emitters.is_empty() {
        diagnostics.push(
            Diagnostic::notice("the scene has no light and gets a constant white environment")
                .hint("add an entity with `Environment`, or `Emission` on a material"),
        );
        lights.push(white());
        entities.push(None);
    }
    commands.insert_resource(LightTable { lights, entities });
}

fn area_light(
    tables: &GeometryTables,
    prim: u32,
    normals: Option<ShapeNormals>,
    radiance: Vec3,
    two_sided: bool,
) -> Light {
    let geometry = &tables.geometry;
    match geometry.kind(prim) {
        Prim::Triangle(t) => {
            let triangle = geometry.triangles[t as usize];
            let mut p = triangle.map(|v| geometry.positions[v as usize]);
            let ng = (p[1] - p[0]).cross(p[2] - p[0]);
            // The front is where the author's normals are, as for every surface point.
            if normals.is_some_and(|n| n.sum(&tables.normals, triangle).dot(ng) < 0.0) {
                p.swap(1, 2);
            }
            Light::Triangle(light::TriangleLight::new(p, radiance, two_sided))
        }
        Prim::Sphere(s) => {
            let sphere = &geometry.spheres[s as usize];
            Light::Sphere(light::SphereLight::new(
                sphere.center,
                sphere.radius,
                radiance,
                two_sided,
            ))
        }
        Prim::Quad(q) => {
            let q = &geometry.quads[q as usize];
            Light::Quad(light::QuadLight::new(
                q.corner, q.edge_u, q.edge_v, radiance, two_sided,
            ))
        }
    }
}

fn bare_lights<'a>(
    (_, world, point, spot, directional, environment): &Bare<'a>,
    origin: DVec3,
) -> impl Iterator<Item = Light> + 'a {
    let p = (world.0.w_axis.truncate() - origin).as_vec3();
    // Lights shine along local −Z.
    let back = world.0.z_axis.truncate().normalize_or(DVec3::Z).as_vec3();
    let point = point.map(|l| {
        Light::Point(light::PointLight {
            p,
            intensity: l.intensity.to_vec(),
        })
    });
    let spot = spot.map(|l| {
        Light::Spot(light::SpotLight {
            p,
            axis: -back,
            intensity: l.intensity.to_vec(),
            cos_inner: l.inner_deg.to_radians().cos(),
            cos_outer: l.outer_deg.to_radians().cos(),
        })
    });
    let directional = directional.map(|l| {
        Light::Directional(light::DirectionalLight {
            wi: back,
            irradiance: l.irradiance.to_vec(),
        })
    });
    let environment = environment.map(|(l, image)| environment_light(l, image, &world.0));
    [point, spot, directional, environment]
        .into_iter()
        .flatten()
}
