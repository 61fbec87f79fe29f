//! A model file as plain data, between its reader and the entities it becomes.
//!
//! Readers of glTF and OBJ fill a [`Model`] and know nothing of worlds; one place spawns it.

use sr_scene::components::{
    Conductor, Dielectric, DirectionalLight, Emission, Lambert, LocalTransform, MetallicRoughness,
    Mirror, Orthographic, PerspectiveCamera, PointLight, SpotLight, ThinDielectric, TriangleMesh,
};
use sr_scene::diagnostics::Diagnostic;

/// What a model file holds.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Placement and content, parents before children.
    pub nodes: Vec<Node>,
    /// Materials that parts refer to by index.
    pub materials: Vec<Material>,
    /// What was left out, approximated or computed: warnings and notices.
    pub notes: Vec<Diagnostic>,
}

/// One node of the hierarchy.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// Its name in the file; may be empty or repeat.
    pub name: String,
    /// Index of the parent node, smaller than its own.
    pub parent: Option<usize>,
    /// Relative to the parent.
    pub transform: LocalTransform,
    /// What is seen here.
    pub parts: Vec<Part>,
    /// A camera that looks along local −Z.
    pub camera: Option<Camera>,
    /// A light that shines along local −Z.
    pub light: Option<Light>,
}

/// A mesh of one material.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Triangles in the node's frame.
    pub mesh: TriangleMesh,
    /// Index into the materials; unset means the default of the format.
    pub material: Option<usize>,
}

/// A material by its name in the file.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name; may be empty or repeat.
    pub name: String,
    /// How it scatters.
    pub lobe: Lobe,
    /// How it glows.
    pub emission: Option<Emission>,
}

/// The lobes that model files map to.
#[derive(Clone, Debug)]
pub enum Lobe {
    /// Diffuse.
    Lambert(Lambert),
    /// Specular.
    Mirror(Mirror),
    /// Glass.
    Dielectric(Dielectric),
    /// A pane.
    ThinDielectric(ThinDielectric),
    /// Metal.
    Conductor(Conductor),
    /// glTF's base material.
    MetallicRoughness(MetallicRoughness),
}

/// The cameras that model files know.
#[derive(Clone, Debug)]
pub enum Camera {
    /// Pinhole.
    Perspective(PerspectiveCamera),
    /// Parallel.
    Orthographic(Orthographic),
}

/// The lights that model files know.
#[derive(Clone, Debug)]
pub enum Light {
    /// From a point.
    Point(PointLight),
    /// In a cone.
    Spot(SpotLight),
    /// From afar.
    Directional(DirectionalLight),
}
