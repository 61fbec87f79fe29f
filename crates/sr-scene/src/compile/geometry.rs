//! Shapes become flat arrays in render space: transforms in f64, the result in f32.

use super::camera::RenderSpace;
use super::materials::MaterialTable;
use crate::components::{
    IsShape, MaterialRef, Quad, SourceSpan, Sphere, TriangleMesh, WorldTransform,
};
use crate::diagnostics::{Diagnostic, Diagnostics};
use bevy_ecs::prelude::*;
use glam::{DMat3, DMat4, DVec3, Vec3};
use rayon::prelude::*;
use sr_render::accel::{Geometry, MAX_PRIMS, QuadShape, SphereShape};
use sr_render::bsdf::Bsdf;
use sr_render::{Brush, Shape, ShapeId, ShapeNormals};

/// Everything that has a surface.
#[derive(Resource, Default)]
pub(super) struct GeometryTables {
    pub geometry: Geometry,
    pub shapes: Vec<Shape>,
    pub names: Vec<String>,
    /// The entity of each shape.
    pub entities: Vec<Entity>,
    pub prim_shape: Vec<ShapeId>,
    pub normals: Vec<Vec3>,
}

type Source<'a> = (
    Entity,
    &'a WorldTransform,
    Option<&'a TriangleMesh>,
    Option<&'a Sphere>,
    Option<&'a Quad>,
    Option<&'a MaterialRef>,
    Option<&'a Name>,
    Option<&'a SourceSpan>,
);

/// Bakes every shape into the tables: meshes, then spheres, then quads, each in spawn order.
pub(super) fn bake_geometry(
    sources: Query<Source<'_>, IsShape>,
    space: Res<'_, RenderSpace>,
    materials: Res<'_, MaterialTable>,
    mut diagnostics: ResMut<'_, Diagnostics>,
    mut commands: Commands<'_, '_>,
) -> Result {
    let mut sources: Vec<Source<'_>> = sources.iter().collect();
    // Query order follows archetypes; tables follow the file.
    sources.sort_unstable_by_key(|s| s.0.index());
    check_counts(&sources, &mut diagnostics);
    diagnostics.check()?;
    let mut tables = GeometryTables::default();
    let mut fail = |s: &Source<'_>, field: &str, message: &str, hint: &str| {
        let problem = Diagnostic::error(message).at(s.7.cloned()).field(field);
        diagnostics.push(problem.hint(hint));
    };
    let far = "in f32, seen from the camera, it is not finite";
    let nearer = "make it smaller, or bring it nearer to the camera";
    for s in &sources {
        if let Some(mesh) = s.2 {
            let first = tables.geometry.positions.len();
            let (triangles, normals) = bake_mesh(&mut tables, mesh, &s.1.0, space.origin);
            if !tables.geometry.positions[first..]
                .par_iter()
                .all(|p| p.is_finite())
            {
                fail(s, "TriangleMesh", far, nearer);
            }
            add_shape(&mut tables, &materials, s, triangles, normals);
        }
    }
    for s in &sources {
        if let Some(sphere) = s.3 {
            match bake_sphere(sphere, &s.1.0, space.origin) {
                Some(sphere) if !(sphere.center.is_finite() && sphere.radius.is_finite()) => {
                    fail(s, "Sphere", far, nearer);
                }
                Some(sphere) if sphere.radius <= 0.0 => {
                    fail(
                        s,
                        "Sphere",
                        "its radius rounds to 0 in f32",
                        "make it larger",
                    );
                }
                Some(sphere) => tables.geometry.spheres.push(sphere),
                None => fail(
                    s,
                    "Sphere",
                    "the transform makes an ellipsoid of the sphere",
                    "scale it by the same factor along all axes, or use a mesh",
                ),
            }
            add_shape(&mut tables, &materials, s, 1, None);
        }
    }
    for s in &sources {
        if let Some(quad) = s.4 {
            let quad = bake_quad(quad, &s.1.0, space.origin);
            let corners = quad.corner + quad.edge_u + quad.edge_v;
            if !corners.is_finite() || !quad.edge_u.cross(quad.edge_v).is_finite() {
                fail(s, "Quad", far, nearer);
            }
            tables.geometry.quads.push(quad);
            add_shape(&mut tables, &materials, s, 1, None);
        }
    }
    diagnostics.check()?;
    commands.insert_resource(tables);
    Ok(())
}

/// Tables are addressed by `u32`, and the acceleration structure has a limit of its own.
fn check_counts(sources: &[Source<'_>], diagnostics: &mut Diagnostics) {
    let meshes = || sources.iter().filter_map(|s| s.2);
    let vertices: usize = meshes().map(|m| m.positions.len()).sum();
    let triangles: usize = meshes().map(|m| m.indices.len()).sum();
    let analytic = sources.iter().filter(|s| s.2.is_none()).count();
    let prims = triangles + analytic;
    if prims > MAX_PRIMS || u32::try_from(vertices).is_err() {
        diagnostics.push(
            Diagnostic::error(format!(
                "{prims} primitives with {vertices} vertices are more than a scene can hold"
            ))
            .hint(format!(
                "{MAX_PRIMS} primitives and {} vertices are the limit",
                u32::MAX
            )),
        );
    }
}

fn add_shape(
    tables: &mut GeometryTables,
    materials: &MaterialTable,
    source: &Source<'_>,
    prims: usize,
    normals: Option<ShapeNormals>,
) {
    let id = ShapeId(tables.shapes.len() as u32);
    let material = materials.id(source.5);
    tables.shapes.push(Shape {
        first_prim: tables.prim_shape.len() as u32,
        material,
        first_light: None,
        normals,
        brush: brush(&materials.materials[material.index()].bsdf, &source.1.0),
    });
    tables
        .names
        .push(source.6.map_or("unnamed", |n| n.as_str()).to_owned());
    tables.entities.push(source.0);
    tables
        .prim_shape
        .resize(tables.prim_shape.len() + prims, id);
}

/// Marks around the shape's local Y axis, for a lobe that they matter to.
fn brush(bsdf: &Bsdf, world: &DMat4) -> Option<Brush> {
    let [x, y] = [world.x_axis, world.y_axis].map(|a| a.truncate());
    bsdf.brush().map(|rotation| Brush::new(y, x, rotation))
}

/// Number of triangles, and where the shading normals are.
fn bake_mesh(
    tables: &mut GeometryTables,
    mesh: &TriangleMesh,
    world: &DMat4,
    origin: DVec3,
) -> (usize, Option<ShapeNormals>) {
    let to_render = DMat4::from_translation(-origin) * *world;
    let linear = DMat3::from_mat4(to_render);
    let mirrored = linear.determinant() < 0.0;
    let first_vertex = tables.geometry.positions.len() as u32;
    tables
        .geometry
        .positions
        .par_extend(mesh.positions.par_iter().map(|p| {
            to_render
                .transform_point3(Vec3::from_array(*p).as_dvec3())
                .as_vec3()
        }));
    tables
        .geometry
        .triangles
        .par_extend(mesh.indices.par_iter().map(|t| {
            let [a, b, c] = t.map(|v| v + first_vertex);
            // A mirror turns the winding round; swapping back keeps the front in front.
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
    let normals = (!mesh.normals.is_empty()).then(|| {
        let first_normal = tables.normals.len() as u32;
        // Normals go with the cofactor matrix, which exists for singular transforms too.
        let cofactor = cofactor(&linear);
        tables.normals.par_extend(mesh.normals.par_iter().map(|n| {
            (cofactor * Vec3::from_array(*n).as_dvec3())
                .normalize_or_zero()
                .as_vec3()
        }));
        ShapeNormals {
            first_vertex,
            first_normal,
        }
    });
    (mesh.indices.len(), normals)
}

/// The matrix that transforms normals, `det(M) · M⁻ᵀ`, with the sign that keeps them outside
/// under a mirror.
fn cofactor(m: &DMat3) -> DMat3 {
    let c = DMat3::from_cols(
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    );
    if m.determinant() < 0.0 { -c } else { c }
}

/// `None` when it is no sphere any more.
fn bake_sphere(sphere: &Sphere, world: &DMat4, origin: DVec3) -> Option<SphereShape> {
    let axes = [world.x_axis, world.y_axis, world.z_axis].map(|a| a.truncate());
    let scale = axes[0].length();
    // What a chain of f64 products can do to equal scales; an authored difference is larger.
    let tolerance = 1e-9 * scale;
    let uniform = axes.iter().all(|a| (a.length() - scale).abs() <= tolerance)
        && axes[0].dot(axes[1]).abs() <= tolerance * scale
        && axes[0].dot(axes[2]).abs() <= tolerance * scale
        && axes[1].dot(axes[2]).abs() <= tolerance * scale;
    uniform.then(|| SphereShape {
        center: (world.w_axis.truncate() - origin).as_vec3(),
        radius: (sphere.radius * scale) as f32,
    })
}

fn bake_quad(quad: &Quad, world: &DMat4, origin: DVec3) -> QuadShape {
    let edge_u = world.x_axis.truncate() * quad.width;
    let edge_v = world.y_axis.truncate() * quad.height;
    let corner = world.w_axis.truncate() - origin - 0.5 * (edge_u + edge_v);
    let mirrored = DMat3::from_mat4(*world).determinant() < 0.0;
    let (u, v) = if mirrored {
        (edge_v, edge_u)
    } else {
        (edge_u, edge_v)
    };
    QuadShape {
        corner: corner.as_vec3(),
        edge_u: u.as_vec3(),
        edge_v: v.as_vec3(),
    }
}

/// The world-space box around a shape, or `None` when it is empty.
pub(super) fn world_bounds(
    world: &DMat4,
    mesh: Option<&TriangleMesh>,
    sphere: Option<&Sphere>,
    quad: Option<&Quad>,
) -> Option<(DVec3, DVec3)> {
    let mut corners: Vec<DVec3> = Vec::new();
    if let Some(mesh) = mesh {
        corners.extend(
            mesh.positions
                .iter()
                .map(|p| Vec3::from_array(*p).as_dvec3()),
        );
    }
    if let Some(sphere) = sphere {
        // Where the sphere reaches furthest along each world axis: along that row of the matrix.
        let rows = DMat3::from_mat4(*world).transpose();
        for row in [rows.x_axis, rows.y_axis, rows.z_axis] {
            let furthest = row.normalize_or_zero() * sphere.radius;
            corners.extend([furthest, -furthest]);
        }
    }
    if let Some(quad) = quad {
        let half = DVec3::new(0.5 * quad.width, 0.5 * quad.height, 0.0);
        let flip = DVec3::new(-1.0, 1.0, 1.0);
        corners.extend([half, -half, half * flip, -half * flip]);
    }
    corners
        .iter()
        .map(|c| world.transform_point3(*c))
        .filter(|p| p.is_finite())
        .map(|p| (p, p))
        .reduce(|(lo, hi), (a, b)| (lo.min(a), hi.max(b)))
}
