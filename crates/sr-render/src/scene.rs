//! Flat tables and the ids into them.

use crate::{Brush, Camera, SceneFeatures};
use glam::{DVec3, Vec3};
use sr_accel::Accel;
use sr_bsdf::Bsdf;
use sr_light::{Light, LightSampler};
use sr_math::Bounds3;

macro_rules! id {
    ($(#[doc = $doc:literal])* $name:ident) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// As an index into its table.
            #[inline]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id! {
    /// A shape: one mesh, sphere or quad.
    ShapeId
}
id! {
    /// A material.
    MaterialId
}
id! {
    /// A light: one emissive triangle, sphere or quad, or one light without a surface.
    LightId
}

/// Shading normals of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShapeNormals {
    /// Index of the mesh's first vertex among all positions.
    pub first_vertex: u32,
    /// Index of the mesh's first normal in the table of normals.
    pub first_normal: u32,
}

impl ShapeNormals {
    /// The normals of a triangle's vertices.
    #[inline]
    pub fn of(&self, normals: &[Vec3], triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|v| normals[(v - self.first_vertex + self.first_normal) as usize])
    }

    /// Their sum: on the side of the triangle that its author calls outside.
    #[inline]
    pub fn sum(&self, normals: &[Vec3], triangle: [u32; 3]) -> Vec3 {
        self.of(normals, triangle).into_iter().sum()
    }
}

/// A mesh, sphere or quad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Its first primitive.
    pub first_prim: u32,
    /// Its material.
    pub material: MaterialId,
    /// The light of its first primitive when it glows; the others follow in order.
    pub first_light: Option<LightId>,
    /// Interpolated normals; unset for a faceted mesh and for analytic shapes.
    pub normals: Option<ShapeNormals>,
    /// Where its tangents lie; unset where no lobe asks for that.
    pub brush: Option<Brush>,
}

/// A material: how its surface scatters.
#[derive(Clone, Debug)]
pub struct Material {
    /// The lobe.
    pub bsdf: Bsdf,
    /// Its name, for messages.
    pub name: String,
}

/// The parts that `Compile` brings together.
pub struct SceneTables {
    /// Geometry and the structure over it.
    pub accel: Accel,
    /// Shapes in order of their primitives.
    pub shapes: Vec<Shape>,
    /// Names of the shapes, for messages.
    pub shape_names: Vec<String>,
    /// The shape of each primitive.
    pub prim_shape: Vec<ShapeId>,
    /// Unit vertex normals of the smooth meshes.
    pub normals: Vec<Vec3>,
    /// Materials that shapes refer to.
    pub materials: Vec<Material>,
    /// Lights: area lights first, in order of their shapes.
    pub lights: Vec<Light>,
    /// How one light is chosen.
    pub light_sampler: LightSampler,
    /// The camera.
    pub camera: Camera,
    /// What the scene has.
    pub features: SceneFeatures,
    /// World position of the origin of render space.
    pub origin: DVec3,
}

/// An immutable scene in render space: world axes, its origin at the camera.
pub struct RenderScene {
    tables: SceneTables,
    infinite_lights: Vec<LightId>,
    sphere: BoundingSphere,
}

/// A sphere around everything in the scene; radius 0 at the origin when there is nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere {
    /// In render space.
    pub center: Vec3,
    /// Metres.
    pub radius: f32,
}

impl BoundingSphere {
    /// Around a box.
    pub fn of(bounds: Bounds3) -> Self {
        let center = if bounds.is_empty() {
            Vec3::ZERO
        } else {
            bounds.center()
        };
        Self {
            center,
            radius: bounds.bounding_radius(),
        }
    }
}

impl RenderScene {
    /// Seals the tables.
    pub fn new(tables: SceneTables) -> Self {
        let infinite_lights = (0..tables.lights.len() as u32)
            .map(LightId)
            .filter(|l| {
                let light = &tables.lights[l.index()];
                light.is_infinite() && !light.is_delta()
            })
            .collect();
        Self {
            infinite_lights,
            sphere: BoundingSphere::of(tables.accel.bounds()),
            tables,
        }
    }

    /// Ray queries in batches.
    #[inline]
    pub fn accel(&self) -> &Accel {
        &self.tables.accel
    }

    /// The camera.
    #[inline]
    pub fn camera(&self) -> &Camera {
        &self.tables.camera
    }

    /// What the scene has.
    #[inline]
    pub fn features(&self) -> SceneFeatures {
        self.tables.features
    }

    /// A shape.
    #[inline]
    pub fn shape(&self, id: ShapeId) -> &Shape {
        &self.tables.shapes[id.index()]
    }

    /// The name of a shape, for messages.
    pub fn shape_name(&self, id: ShapeId) -> &str {
        &self.tables.shape_names[id.index()]
    }

    /// How many shapes there are.
    pub fn shape_count(&self) -> usize {
        self.tables.shapes.len()
    }

    /// The shape that a primitive belongs to.
    #[inline]
    pub fn shape_of(&self, prim: u32) -> ShapeId {
        self.tables.prim_shape[prim as usize]
    }

    /// A material.
    #[inline]
    pub fn material(&self, id: MaterialId) -> &Material {
        &self.tables.materials[id.index()]
    }

    /// All materials.
    pub fn materials(&self) -> &[Material] {
        &self.tables.materials
    }

    /// A light.
    #[inline]
    pub fn light(&self, id: LightId) -> &Light {
        &self.tables.lights[id.index()]
    }

    /// All lights.
    pub fn lights(&self) -> &[Light] {
        &self.tables.lights
    }

    /// How one light is chosen among all.
    #[inline]
    pub fn light_sampler(&self) -> &LightSampler {
        &self.tables.light_sampler
    }

    /// The lights that a ray meets when it leaves the scene.
    #[inline]
    pub fn infinite_lights(&self) -> &[LightId] {
        &self.infinite_lights
    }

    /// The light that a primitive is, when it glows.
    #[inline]
    pub fn light_of(&self, prim: u32) -> Option<LightId> {
        let shape = self.shape(self.shape_of(prim));
        shape
            .first_light
            .map(|l| LightId(l.0 + (prim - shape.first_prim)))
    }

    /// Vertex normals of the smooth meshes, addressed through [`ShapeNormals`].
    #[inline]
    pub fn normals(&self) -> &[Vec3] {
        &self.tables.normals
    }

    /// Centre of the sphere around everything, in render space.
    pub fn center(&self) -> Vec3 {
        self.sphere.center
    }

    /// Radius of the sphere around everything.
    pub fn radius(&self) -> f32 {
        self.sphere.radius
    }

    /// World position of the origin of render space.
    pub fn origin(&self) -> DVec3 {
        self.tables.origin
    }
}
