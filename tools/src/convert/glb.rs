//! Binary glTF 2.0: meshes, the node tree, the camera, and materials with nothing but a base
//! colour, so that any viewer shows something.
//!
//! Khronos Group 2021, "glTF 2.0 Specification", §4.4 (container), §3.6 (accessors). The axes and
//! the unit of the file are one matrix on a node above all others; the camera is placed in the
//! world, for its frame must be orthonormal and the file's need not be.

use super::camera::{Framing, View};
use super::material::{Lobe, Material};
use super::mesh::Part;
use super::nodes::{MeshUse, Scene, SceneNode};
use super::transform::frame_along;
use glam::{DMat4, DVec3};
use serde_json::{Value, json};
use std::collections::HashMap;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The lists of a glTF document under construction.
#[derive(Default)]
struct Writer {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    /// Accessors of the parts of a mesh of the scene, once written.
    parts: HashMap<usize, Vec<Value>>,
    /// glTF meshes by mesh of the scene and materials.
    uses: HashMap<(usize, Vec<usize>), usize>,
    /// glTF index of a material.
    materials: HashMap<usize, usize>,
}

/// The file's bytes. `names` are those of the scene's materials.
pub(crate) fn write(
    scene: &Scene,
    names: &[String],
    camera: Option<&Framing>,
) -> Result<Vec<u8>, String> {
    let mut writer = Writer::default();
    let mut materials = Vec::new();
    for index in mesh_materials(scene) {
        writer.materials.insert(index, materials.len());
        materials.push(material(&scene.materials.list[index], &names[index]));
    }
    let mut roots: Vec<usize> = scene.roots.iter().map(|r| writer.node(r, scene)).collect();
    let to_world = scene.frame.matrix();
    if !roots.is_empty() && to_world != DMat4::IDENTITY {
        writer.nodes.push(json!({
            "name": "axes_and_unit",
            "matrix": to_world.to_cols_array(),
            "children": roots,
        }));
        roots = vec![writer.nodes.len() - 1];
    }
    if let Some(framing) = camera {
        let matrix = camera_matrix(framing);
        let node = json!({"name": "camera", "camera": 0, "matrix": matrix.to_cols_array()});
        writer.nodes.push(node);
        roots.push(writer.nodes.len() - 1);
    }
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "steradian-tools convert"},
        "scene": 0,
        "scenes": [{"name": "scene"}],
    });
    // glTF forbids empty lists.
    let bin = std::mem::take(&mut writer.bin);
    let buffers = match bin.len() {
        0 => Vec::new(),
        n => vec![json!({"byteLength": n})],
    };
    let lists = [
        ("nodes", writer.nodes),
        ("meshes", writer.meshes),
        ("materials", materials),
        ("accessors", writer.accessors),
        ("bufferViews", writer.views),
        ("buffers", buffers),
        ("cameras", camera.map(lens).into_iter().collect()),
    ];
    for (name, list) in lists {
        if !list.is_empty() {
            document[name] = Value::Array(list);
        }
    }
    if !roots.is_empty() {
        document["scenes"][0]["nodes"] = json!(roots);
    }
    container(&document, bin)
}

/// Materials that meshes use, in their order in the scene.
pub(crate) fn mesh_materials(scene: &Scene) -> Vec<usize> {
    let mut used = vec![false; scene.materials.list.len()];
    let mut stack: Vec<&SceneNode> = scene.roots.iter().collect();
    while let Some(node) = stack.pop() {
        for &m in node.meshes.iter().flat_map(|m| &m.materials) {
            used[m] = true;
        }
        stack.extend(&node.children);
    }
    (0..used.len()).filter(|&i| used[i]).collect()
}

impl Writer {
    fn node(&mut self, node: &SceneNode, scene: &Scene) -> usize {
        let mut children: Vec<usize> = Vec::new();
        let mut out = json!({"name": node.name});
        if node.local != DMat4::IDENTITY {
            out["matrix"] = json!(node.local.to_cols_array());
        }
        // A glTF node holds one mesh; more of them become nodes below.
        match node.meshes.as_slice() {
            [only] => out["mesh"] = json!(self.mesh(only, scene)),
            several => {
                for (i, mesh) in several.iter().enumerate() {
                    let mesh = self.mesh(mesh, scene);
                    let name = format!("{}.{}", node.name, i + 1);
                    self.nodes.push(json!({"name": name, "mesh": mesh}));
                    children.push(self.nodes.len() - 1);
                }
            }
        }
        for child in &node.children {
            children.push(self.node(child, scene));
        }
        if !children.is_empty() {
            out["children"] = json!(children);
        }
        self.nodes.push(out);
        self.nodes.len() - 1
    }

    fn mesh(&mut self, mesh: &MeshUse, scene: &Scene) -> usize {
        let key = (mesh.mesh, mesh.materials.clone());
        if let Some(&index) = self.uses.get(&key) {
            return index;
        }
        let source = &scene.meshes[mesh.mesh];
        if !self.parts.contains_key(&mesh.mesh) {
            let parts = source.parts.iter().map(|p| self.part(p)).collect();
            self.parts.insert(mesh.mesh, parts);
        }
        let mut primitives = self.parts[&mesh.mesh].clone();
        for (primitive, material) in primitives.iter_mut().zip(&mesh.materials) {
            primitive["material"] = json!(self.materials[material]);
        }
        let out = json!({"name": source.name, "primitives": primitives});
        self.meshes.push(out);
        self.uses.insert(key, self.meshes.len() - 1);
        self.meshes.len() - 1
    }

    /// The accessors of one part, as a primitive without material.
    fn part(&mut self, part: &Part) -> Value {
        let positions: Vec<[f32; 3]> = part.positions.iter().map(single).collect();
        let mut lo = [f32::INFINITY; 3];
        let mut hi = [f32::NEG_INFINITY; 3];
        for p in &positions {
            for k in 0..3 {
                lo[k] = lo[k].min(p[k]);
                hi[k] = hi[k].max(p[k]);
            }
        }
        let accessor = self.floats(&positions, "VEC3");
        self.accessors[accessor]["min"] = json!(lo);
        self.accessors[accessor]["max"] = json!(hi);
        let mut attributes = json!({"POSITION": accessor});
        if let Some(normals) = &part.normals {
            let normals: Vec<[f32; 3]> = normals.iter().map(single).collect();
            attributes["NORMAL"] = json!(self.floats(&normals, "VEC3"));
        }
        if let Some(uvs) = &part.uvs {
            let uvs: Vec<[f32; 2]> = uvs.iter().map(|uv| uv.map(|x| x as f32)).collect();
            attributes["TEXCOORD_0"] = json!(self.floats(&uvs, "VEC2"));
        }
        let bytes = part
            .triangles
            .iter()
            .flatten()
            .flat_map(|i| i.to_le_bytes());
        let view = self.view(bytes, ELEMENT_ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": UNSIGNED_INT,
            "count": 3 * part.triangles.len(),
            "type": "SCALAR",
        }));
        json!({"attributes": attributes, "indices": self.accessors.len() - 1})
    }

    fn floats<const N: usize>(&mut self, tuples: &[[f32; N]], kind: &str) -> usize {
        let bytes = tuples.iter().flatten().flat_map(|x| x.to_le_bytes());
        let view = self.view(bytes, ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": FLOAT,
            "count": tuples.len(),
            "type": kind,
        }));
        self.accessors.len() - 1
    }

    /// All elements are four bytes wide, so every view begins aligned.
    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: u32) -> usize {
        let offset = self.bin.len();
        self.bin.extend(bytes);
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": offset,
            "byteLength": self.bin.len() - offset,
            "target": target,
        }));
        self.views.len() - 1
    }
}

fn single(v: &DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

/// The world matrix of a camera.
fn camera_matrix(framing: &Framing) -> DMat4 {
    let [x, y, z] = frame_along(framing.from - framing.to, framing.up).unwrap_or([
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
    ]);
    let column = |v: DVec3| v.extend(0.0);
    DMat4::from_cols(column(x), column(y), column(z), framing.from.extend(1.0))
}

fn lens(framing: &Framing) -> Value {
    let aspect = framing.film.0 as f64 / framing.film.1 as f64;
    let distance = (framing.to - framing.from).length();
    let (near, far) = (distance * 1e-2, distance * 1e4);
    let perspective = |yfov: f64| {
        json!({
            "name": "camera",
            "type": "perspective",
            "perspective": {"yfov": yfov, "aspectRatio": aspect, "znear": near, "zfar": far},
        })
    };
    let orthographic = |xmag: f64, ymag: f64| {
        json!({
            "name": "camera",
            "type": "orthographic",
            "orthographic": {"xmag": xmag, "ymag": ymag, "znear": near, "zfar": far},
        })
    };
    match framing.view {
        View::Hfov(h) => perspective(2.0 * ((h.to_radians() / 2.0).tan() / aspect).atan()),
        View::Vfov(v) => perspective(v.to_radians()),
        View::Width(w) => orthographic(w / 2.0, w / 2.0 / aspect),
        View::Height(h) => orthographic(h / 2.0 * aspect, h / 2.0),
    }
}

/// A stand-in for a lobe in viewers that know glTF only.
fn material(material: &Material, name: &str) -> Value {
    let (color, metallic, roughness) = match &material.surface.lobe {
        Lobe::Lambert { reflectance } => (*reflectance, 0.0, 1.0),
        Lobe::Mirror { reflectance } => (*reflectance, 1.0, 0.0),
        Lobe::Refraction { transmittance, .. } | Lobe::Dielectric { transmittance, .. } => {
            (*transmittance, 0.0, 0.0)
        }
        Lobe::RoughDielectric {
            transmittance,
            alpha,
            ..
        } => (*transmittance, 0.0, alpha.sqrt()),
        // Reflectance at normal incidence; glTF's roughness is the root of α.
        Lobe::Conductor { eta, k, alpha } => {
            let f0 = |i: usize| {
                let (n, k2) = (eta[i], k[i] * k[i]);
                ((n - 1.0).powi(2) + k2) / ((n + 1.0).powi(2) + k2)
            };
            ([f0(0), f0(1), f0(2)], 1.0, alpha.sqrt())
        }
    };
    let [r, g, b] = color;
    let mut out = json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": metallic,
            "roughnessFactor": roughness,
        },
    });
    match material.surface.emission {
        Some(radiance) => {
            // Between 0 and 1 without an extension: the colour, not the strength.
            let brightest = radiance.into_iter().fold(1.0, f64::max);
            out["emissiveFactor"] = json!(radiance.map(|x| x / brightest));
        }
        None => out["doubleSided"] = json!(true),
    }
    out
}

/// Header, JSON chunk, binary chunk.
pub(crate) fn container(document: &Value, mut bin: Vec<u8>) -> Result<Vec<u8>, String> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut chunks = vec![(*b"JSON", text)];
    if !bin.is_empty() {
        chunks.push((*b"BIN\0", bin));
    }
    let size = chunks.iter().fold(12, |n, (_, data)| n + 8 + data.len());
    let word = |n: usize| {
        u32::try_from(n)
            .map(u32::to_le_bytes)
            .map_err(|_| "the meshes take more than the 4 GiB that a .glb can hold".to_owned())
    };
    let mut out = Vec::with_capacity(size);
    out.extend_from_slice(b"glTF");
    out.extend_from_slice(&2u32.to_le_bytes());
    out.extend_from_slice(&word(size)?);
    for (kind, data) in chunks {
        out.extend_from_slice(&word(data.len())?);
        out.extend_from_slice(&kind);
        out.extend_from_slice(&data);
    }
    Ok(out)
}
