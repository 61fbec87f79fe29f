//! What things look like. Analytic shapes are real shapes, not tessellated.

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;

/// A triangle mesh in local coordinates.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct TriangleMesh {
    /// Vertex positions in metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit shading normals, one a vertex; empty for a faceted mesh.
    pub normals: Vec<[f32; 3]>,
    /// Three vertex indices a triangle, counter-clockwise seen from the front.
    pub indices: Vec<[u32; 3]>,
}

/// A sphere around the local origin.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Sphere {
    /// Radius in metres.
    pub radius: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}

/// A rectangle around the local origin in the XY plane; its front is local +Z.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Quad {
    /// Extent along local x in metres.
    pub width: f64,
    /// Extent along local y in metres.
    pub height: f64,
}

impl Default for Quad {
    fn default() -> Self {
        Self {
            width: 1.0,
            height: 1.0,
        }
    }
}

/// Query filter: entities that have a surface.
pub type IsShape = Or<(With<TriangleMesh>, With<Sphere>, With<Quad>)>;
