//! The node tree, with everything it places.

use super::camera::Camera;
use super::frame::Frame;
use super::geometry::{Shape, below_root};
use super::light::LightSource;
use super::material::Materials;
use super::mesh::Mesh;
use super::transform::{euler_degrees, frame_along};
use super::xml::{Reader, Xml, children, label, path, start, tag};
use glam::{DMat4, DVec3};
use roxmltree::NodeId;
use std::collections::HashMap;

/// Nodes in nodes in nodes: more than anybody builds, and no danger to the stack.
const MAX_DEPTH: usize = 128;

/// Nodes after following all `<instance_node>`; a few lines of text can ask for billions.
const MAX_NODES: usize = 200_000;

/// A node with meshes below it.
pub(crate) struct SceneNode {
    pub name: String,
    /// Node to parent.
    pub local: DMat4,
    pub meshes: Vec<MeshUse>,
    pub children: Vec<SceneNode>,
}

/// A mesh with the materials of its parts.
pub(crate) struct MeshUse {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Index into [`Materials::list`] by part.
    pub materials: Vec<usize>,
}

/// A sphere in the world.
pub(crate) struct PlacedSphere {
    pub name: String,
    pub centre: DVec3,
    pub radius: f64,
    pub material: usize,
}

/// A light in the world.
pub(crate) struct PlacedLight {
    pub name: String,
    pub position: DVec3,
    pub rotate_deg: [f64; 3],
    pub source: LightSource,
    /// Edge lengths of an area light.
    pub size: (f64, f64),
}

/// All that a file places.
pub(crate) struct Scene {
    pub frame: Frame,
    pub roots: Vec<SceneNode>,
    pub meshes: Vec<Mesh>,
    pub materials: Materials,
    pub spheres: Vec<PlacedSphere>,
    pub lights: Vec<PlacedLight>,
    /// Sum of the ambient lights.
    pub ambient: [f64; 3],
    pub cameras: Vec<Camera>,
}

/// The walk over the node tree.
pub(crate) struct Walker<'r, 'a> {
    reader: &'r mut Reader<'a>,
    scene: Scene,
    smooth: bool,
    shapes: HashMap<NodeId, Option<ShapeIndex>>,
    /// Nodes on the way from the root, to find circles.
    path: Vec<NodeId>,
    count: usize,
}

#[derive(Clone, Copy)]
enum ShapeIndex {
    Mesh(usize),
    Sphere { radius: f64 },
}

impl<'r, 'a> Walker<'r, 'a> {
    /// Read the scene of the document; `smooth` computes normals.
    pub fn read(reader: &'r mut Reader<'a>, frame: Frame, smooth: bool) -> Scene {
        let mut walker = Walker {
            reader,
            scene: Scene {
                frame,
                roots: Vec::new(),
                meshes: Vec::new(),
                materials: Materials::default(),
                spheres: Vec::new(),
                lights: Vec::new(),
                ambient: [0.0; 3],
                cameras: Vec::new(),
            },
            smooth,
            shapes: HashMap::new(),
            path: Vec::new(),
            count: 0,
        };
        if let Some(visual_scene) = walker.visual_scene() {
            let world = frame.matrix();
            for node in children(visual_scene, "node") {
                let root = walker.node(node, world);
                walker.scene.roots.extend(root);
            }
        }
        walker.scene
    }

    fn visual_scene(&mut self) -> Option<Xml<'a>> {
        if let Some(instance) = below_root(self.reader, &["scene", "instance_visual_scene"]) {
            return self.reader.resolve(instance, "url", &["visual_scene"]);
        }
        let root = self.reader.doc.root_element();
        let message = "the file names no scene to show";
        let only = path(root, &["library_visual_scenes", "visual_scene"]);
        if only.is_some() {
            let remedy = "the first <visual_scene> is taken";
            self.reader.diag.fault(start(root), message, remedy);
        } else {
            let hint =
                "it has no <visual_scene> either: is it COLLADA 1.4, exported with its scene?";
            self.reader.diag.error(start(root), message, hint);
        }
        only
    }

    /// One node and all below it; `None` when it leads to no mesh.
    fn node(&mut self, node: Xml<'a>, parent: DMat4) -> Option<SceneNode> {
        if self.path.contains(&node.id()) {
            let message = format!("node `{}` contains itself", label(node));
            let hint = "break the circle of <instance_node>";
            self.reader.diag.error(start(node), message, hint);
            return None;
        }
        self.count += 1;
        if self.path.len() == MAX_DEPTH || self.count > MAX_NODES {
            let message =
                format!("nodes nested deeper than {MAX_DEPTH}, or more than {MAX_NODES} of them");
            self.reader
                .diag
                .error(start(node), message, "flatten the scene");
            return None;
        }
        let local = self.reader.local_matrix(node)?;
        let world = parent * local;
        if world
            .to_cols_array()
            .iter()
            .any(|&x| !(x as f32).is_finite())
        {
            let message = "this place is beyond the range of 32-bit floats";
            let hint = "move the scene nearer to its origin";
            self.reader.diag.error(start(node), message, hint);
            return None;
        }
        self.path.push(node.id());
        let mut out = SceneNode {
            name: label(node).to_owned(),
            local,
            meshes: Vec::new(),
            children: Vec::new(),
        };
        for element in node.children().filter(|c| c.is_element()) {
            self.element(node, element, world, &mut out);
        }
        self.path.pop();
        (!out.meshes.is_empty() || !out.children.is_empty()).then_some(out)
    }

    fn element(&mut self, node: Xml<'a>, element: Xml<'a>, world: DMat4, out: &mut SceneNode) {
        match tag(element) {
            "node" => out.children.extend(self.node(element, world)),
            "instance_node" => {
                if let Some(target) = self.reader.resolve(element, "url", &["node"]) {
                    out.children.extend(self.node(target, world));
                }
            }
            "instance_geometry" => {
                out.meshes.extend(self.geometry(node, element, world));
            }
            "instance_light" => {
                self.light(node, element, world);
            }
            "instance_camera" => {
                self.camera(node, element, world);
            }
            "instance_controller" => {
                let name = label(node);
                let text = format!("dropped the skinned or morphed mesh of node `{name}`");
                self.reader.diag.note(text);
            }
            _ => {}
        }
    }

    fn geometry(&mut self, node: Xml<'a>, instance: Xml<'a>, world: DMat4) -> Option<MeshUse> {
        let target = self.reader.resolve(instance, "url", &["geometry"])?;
        let shape = match self.shapes.get(&target.id()) {
            Some(&known) => known,
            None => {
                let shape = self.reader.geometry(target, self.smooth);
                let shape = shape.map(|shape| match shape {
                    Shape::Sphere { radius } => ShapeIndex::Sphere { radius },
                    Shape::Mesh(mesh) => {
                        self.scene.meshes.push(mesh);
                        ShapeIndex::Mesh(self.scene.meshes.len() - 1)
                    }
                });
                self.shapes.insert(target.id(), shape);
                shape
            }
        };
        let bindings = self.bindings(instance);
        match shape? {
            ShapeIndex::Sphere { radius } => {
                self.sphere(node, radius, world, bindings.first().map(|b| b.1));
                None
            }
            ShapeIndex::Mesh(mesh) => {
                let symbols: Vec<Option<String>> = self.scene.meshes[mesh]
                    .parts
                    .iter()
                    .map(|p| p.symbol.clone())
                    .collect();
                if symbols.is_empty() {
                    return None;
                }
                let materials = symbols
                    .iter()
                    .map(|s| self.bound_material(node, s.as_deref(), &bindings))
                    .collect();
                Some(MeshUse { mesh, materials })
            }
        }
    }

    /// The (symbol, material) pairs of an instance.
    fn bindings(&mut self, instance: Xml<'a>) -> Vec<(&'a str, usize)> {
        let Some(common) = path(instance, &["bind_material", "technique_common"]) else {
            return Vec::new();
        };
        let mut out = Vec::new();
        for binding in children(common, "instance_material") {
            let symbol = binding.attribute("symbol").unwrap_or_default();
            if let Some(material) = self.reader.resolve(binding, "target", &["material"]) {
                let index = self.scene.materials.index(self.reader, material);
                out.push((symbol, index));
            }
        }
        out
    }

    fn bound_material(
        &mut self,
        node: Xml<'a>,
        symbol: Option<&str>,
        bindings: &[(&'a str, usize)],
    ) -> usize {
        let found = bindings.iter().find(|(s, _)| Some(*s) == symbol);
        // A part that names no symbol can only mean the one material there is.
        let found = found.or(match (symbol, bindings) {
            (None, [only]) => Some(only),
            _ => None,
        });
        if let Some(&(_, index)) = found {
            return index;
        }
        let Some(symbol) = symbol else {
            // No node's name: a file without materials would tell of every node.
            let text = "approximated parts without material by a grey diffuse surface";
            self.reader.diag.note(text);
            return self.scene.materials.default_index();
        };
        let name = label(node);
        if let &[(_, only)] = bindings {
            self.reader.diag.note(format!(
                "approximated node `{name}`: the material symbol `{symbol}` is not bound, the \
                 only material bound is used"
            ));
            return only;
        }
        self.reader.diag.note(format!(
            "approximated node `{name}`: the material symbol `{symbol}` is not bound, a grey \
             diffuse surface stands in"
        ));
        self.scene.materials.default_index()
    }

    fn sphere(&mut self, node: Xml<'a>, radius: f64, world: DMat4, material: Option<usize>) {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|e| world.transform_vector3(e));
        let lengths = axes.map(DVec3::length);
        let limit = self.rounding();
        let even = lengths
            .iter()
            .all(|l| (l - lengths[0]).abs() <= limit * lengths[0]);
        let square = [(0, 1), (1, 2), (2, 0)]
            .iter()
            .all(|&(i, j)| axes[i].dot(axes[j]).abs() <= limit * lengths[i] * lengths[j]);
        if !(even && square) {
            let message = format!("the sphere of node `{}` is not scaled evenly", label(node));
            let remedy = "it stays round, scaled as its x axis is";
            self.reader.diag.fault(start(node), message, remedy);
        }
        let radius = radius * lengths[0];
        if radius == 0.0 || !(radius as f32).is_normal() {
            let message = format!("the sphere of node `{}` has no usable size", label(node));
            let hint = "its matrix must not be singular";
            self.reader.diag.error(start(node), message, hint);
            return;
        }
        let material = material.unwrap_or_else(|| {
            self.reader.diag.note(format!(
                "approximated node `{}`: no material is bound, a grey diffuse surface stands in",
                label(node)
            ));
            self.scene.materials.default_index()
        });
        self.scene.spheres.push(PlacedSphere {
            name: label(node).to_owned(),
            centre: world.transform_point3(DVec3::ZERO),
            radius,
            material,
        });
    }

    /// By how much lengths and cosines of the axes can be off although the file means a
    /// similarity: numbers are written with at least six digits, so each matrix entry is off by
    /// 5·10⁻⁶ of itself at most, two columns meet in every comparison, and matrices multiply.
    fn rounding(&self) -> f64 {
        2.0 * 5e-6 * (self.path.len() + 1) as f64
    }

    fn light(&mut self, node: Xml<'a>, instance: Xml<'a>, world: DMat4) -> Option<()> {
        let light = self.reader.resolve(instance, "url", &["light"])?;
        let source = self.reader.light(light)?;
        if let LightSource::Ambient { radiance } = source {
            for (sum, x) in self.scene.ambient.iter_mut().zip(radiance) {
                *sum += x;
            }
            let name = label(light);
            self.reader.diag.note(if radiance == [0.0; 3] {
                format!("dropped the ambient light `{name}`: it is black")
            } else {
                format!("approximated the ambient light `{name}` by a constant environment")
            });
            return Some(());
        }
        let along = |v: DVec3| world.transform_vector3(v);
        let mut size = (0.0, 0.0);
        let frame = if matches!(source, LightSource::Area { .. }) {
            let (right, up) = (along(DVec3::NEG_X), along(DVec3::Y));
            size = (right.length(), up.length());
            self.rectangle(node, right, up, along(DVec3::NEG_Z))
        } else {
            // Lights shine along their own −Z in the file as well as in the scene.
            frame_along(along(DVec3::Z), along(DVec3::Y))
        };
        let Some([x, y, z]) = frame else {
            let message = format!("the light of node `{}` has no direction", label(node));
            let hint = "its matrix must not be singular";
            self.reader.diag.error(start(node), message, hint);
            return None;
        };
        self.scene.lights.push(PlacedLight {
            name: label(node).to_owned(),
            position: world.transform_point3(DVec3::ZERO),
            rotate_deg: euler_degrees(x, y, z),
            source,
            size,
        });
        Some(())
    }

    /// The frame of a rectangle with the given edges whose +Z is on the side of `toward`.
    fn rectangle(
        &mut self,
        node: Xml<'a>,
        right: DVec3,
        up: DVec3,
        toward: DVec3,
    ) -> Option<[DVec3; 3]> {
        let (x, y) = (right.try_normalize()?, up.try_normalize()?);
        let mut normal = x.cross(y).try_normalize()?;
        if x.dot(y).abs() > self.rounding() {
            let message = format!("the area light of node `{}` is no rectangle", label(node));
            let remedy = "it is made one";
            self.reader.diag.fault(start(node), message, remedy);
        }
        if normal.dot(toward) < 0.0 {
            normal = -normal;
        }
        frame_along(normal, y)
    }

    fn camera(&mut self, node: Xml<'a>, instance: Xml<'a>, world: DMat4) -> Option<()> {
        let camera = self.reader.resolve(instance, "url", &["camera"])?;
        let optics = self.reader.camera_optics(camera)?;
        self.scene.cameras.push(Camera {
            name: label(node).to_owned(),
            optics,
            world,
            metres: self.scene.frame.metres,
            at: start(node),
        });
        Some(())
    }
}

impl Scene {
    /// The box around meshes and spheres; `None` when there are none, or when the meshes are used
    /// so often that looking at every vertex would take too long.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut lo = DVec3::INFINITY;
        let mut hi = DVec3::NEG_INFINITY;
        let mut budget: usize = 200_000_000;
        let mut stack: Vec<(&SceneNode, DMat4)> = Vec::new();
        stack.extend(self.roots.iter().map(|r| (r, self.frame.matrix())));
        while let Some((node, parent)) = stack.pop() {
            let world = parent * node.local;
            for part in node.meshes.iter().flat_map(|m| &self.meshes[m.mesh].parts) {
                budget = budget.checked_sub(part.positions.len())?;
                for &p in &part.positions {
                    let p = world.transform_point3(p);
                    lo = lo.min(p);
                    hi = hi.max(p);
                }
            }
            stack.extend(node.children.iter().map(|c| (c, world)));
        }
        for s in &self.spheres {
            lo = lo.min(s.centre - s.radius);
            hi = hi.max(s.centre + s.radius);
        }
        lo.cmple(hi).all().then_some((lo, hi))
    }
}
