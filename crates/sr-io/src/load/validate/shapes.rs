//! Shapes, where they are, and what they hang from.

use super::super::session::Session;
use super::{check_positive, complaint};
use bevy_ecs::prelude::*;
use sr_scene::components::{LocalTransform, Quad, Sphere, TriangleMesh};
use std::collections::HashSet;

impl Session<'_> {
    pub(super) fn check_shapes(&mut self) {
        self.check_each::<Sphere>("Sphere", |sphere, complaints| {
            check_positive("radius", sphere.radius, complaints);
        });
        self.check_each::<Quad>("Quad", |quad, complaints| {
            check_positive("width", quad.width, complaints);
            check_positive("height", quad.height, complaints);
        });
        self.check_each::<TriangleMesh>("TriangleMesh", |mesh, complaints| {
            if let Some(problem) = mesh_problem(mesh) {
                complaints.push(("", complaint(problem)));
            }
        });
        self.check_each::<LocalTransform>("LocalTransform", |local, complaints| {
            let finite = |values: &[f64]| values.iter().all(|v| v.is_finite());
            for (field, value) in [
                ("translate", &local.translate),
                ("rotate_deg", &local.rotate_deg),
                ("scale", &local.scale),
            ] {
                if !finite(value) {
                    complaints.push((field, complaint("must be finite")));
                }
            }
            if local.scale.contains(&0.0) {
                complaints.push(("scale", complaint("a scale of 0 leaves nothing")));
            }
            if local.matrix.as_ref().is_some_and(|m| !finite(m)) {
                complaints.push(("matrix", complaint("must be finite")));
            }
        });
        self.check_one_shape();
    }

    fn check_one_shape(&mut self) {
        let mut shapes = self
            .world
            .query::<(Entity, Has<TriangleMesh>, Has<Sphere>, Has<Quad>)>();
        let several: Vec<_> = shapes
            .iter(self.world)
            .map(|(entity, mesh, sphere, quad)| {
                let shapes = [(mesh, "TriangleMesh"), (sphere, "Sphere"), (quad, "Quad")];
                let shapes = shapes.into_iter().filter(|(has, _)| *has);
                (entity, shapes.map(|(_, name)| name).collect::<Vec<_>>())
            })
            .filter(|(_, shapes)| shapes.len() > 1)
            .collect();
        for (entity, shapes) in several {
            let message = format!("one thing has several shapes: {}", shapes.join(", "));
            let field = format!(".{}", shapes[1]);
            let hint = Some("make an entity of each, with `ChildOf` to keep them together");
            self.invalid(entity, &field, (message, hint));
        }
    }

    /// No entity may hang from itself, however far up: nothing would ever place it.
    pub(super) fn check_hierarchy(&mut self) {
        let mut query = self.world.query::<(Entity, &ChildOf)>();
        let mut children: Vec<Entity> = query.iter(self.world).map(|(e, _)| e).collect();
        children.sort_by_cached_key(|e| self.names.path(*e));
        let mut safe: HashSet<Entity> = HashSet::new();
        for start in children {
            let mut way = Vec::new();
            let mut on_way = HashSet::new();
            let mut next = Some(start);
            while let Some(entity) = next
                && !safe.contains(&entity)
            {
                if !on_way.insert(entity) {
                    let message = "the entity is its own ancestor";
                    self.invalid(entity, ".ChildOf", complaint(message));
                    break;
                }
                way.push(entity);
                next = self.world.get::<ChildOf>(entity).map(ChildOf::parent);
            }
            // Reported once, whatever else hangs from it.
            safe.extend(way);
        }
    }
}

fn mesh_problem(mesh: &TriangleMesh) -> Option<String> {
    let vertices = mesh.positions.len();
    if !mesh.normals.is_empty() && mesh.normals.len() != vertices {
        let normals = mesh.normals.len();
        return Some(format!(
            "there are {vertices} positions and {normals} normals"
        ));
    }
    let outside = |i: &u32| usize::try_from(*i).map_or(true, |i| i >= vertices);
    if let Some(index) = mesh.indices.iter().flatten().find(|i| outside(i)) {
        return Some(format!("index {index} of {vertices} vertices"));
    }
    let finite = |v: &[f32; 3]| v.iter().all(|x| x.is_finite());
    if !mesh.positions.iter().all(finite) || !mesh.normals.iter().all(finite) {
        return Some("positions and normals must be finite".into());
    }
    None
}
