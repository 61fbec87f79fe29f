//! One mesh as binary glTF 2.0 (Khronos Group 2021, §3.6 accessors, §4.4 container): indices of 16
//! bits where they suffice, and no material, for the scene names one.

use super::Mesh;
use crate::convert::glb::container;
use glam::DVec3;
use serde_json::{Value, json};

const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The file's bytes; the one node has the mesh's name.
///
/// # Errors
/// A mesh of more than 4 GiB.
pub(super) fn encode(name: &str, mesh: &Mesh) -> Result<Vec<u8>, String> {
    let mut buffer = Buffer::default();
    let mut attributes = json!({"POSITION": buffer.vectors(&mesh.positions)});
    let (lo, hi) = bounds(&mesh.positions);
    buffer.accessors[0]["min"] = json!(lo);
    buffer.accessors[0]["max"] = json!(hi);
    if !mesh.normals.is_empty() {
        attributes["NORMAL"] = json!(buffer.vectors(&mesh.normals));
    }
    let indices = buffer.indices(mesh);
    let document = json!({
        "asset": {"version": "2.0", "generator": "steradian-tools generate"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": name, "mesh": 0}],
        "meshes": [{"name": name, "primitives": [{"attributes": attributes, "indices": indices}]}],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": buffer.bytes.len()}],
    });
    container(&document, buffer.bytes)
}

fn bounds(positions: &[DVec3]) -> ([f32; 3], [f32; 3]) {
    let rounded = positions.iter().map(|p| p.as_vec3());
    let ends = (glam::Vec3::INFINITY, glam::Vec3::NEG_INFINITY);
    let (lo, hi) = rounded.fold(ends, |(lo, hi), p| (lo.min(p), hi.max(p)));
    (lo.to_array(), hi.to_array())
}

/// The binary chunk, and what lies where.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn vectors(&mut self, vectors: &[DVec3]) -> usize {
        let rounded = vectors.iter().map(|v| v.as_vec3().to_array());
        let bytes: Vec<u8> = rounded.flatten().flat_map(f32::to_le_bytes).collect();
        self.accessor(&bytes, ARRAY_BUFFER, FLOAT, vectors.len(), "VEC3")
    }

    fn indices(&mut self, mesh: &Mesh) -> usize {
        let flat = mesh.triangles.iter().flatten();
        let count = 3 * mesh.triangles.len();
        // The largest number of each size is no index: it may restart strips.
        if mesh.positions.len() <= usize::from(u16::MAX) {
            let bytes: Vec<u8> = flat.flat_map(|i| (*i as u16).to_le_bytes()).collect();
            self.accessor(
                &bytes,
                ELEMENT_ARRAY_BUFFER,
                UNSIGNED_SHORT,
                count,
                "SCALAR",
            )
        } else {
            let bytes: Vec<u8> = flat.flat_map(|i| i.to_le_bytes()).collect();
            self.accessor(&bytes, ELEMENT_ARRAY_BUFFER, UNSIGNED_INT, count, "SCALAR")
        }
    }

    fn accessor(
        &mut self,
        bytes: &[u8],
        target: u32,
        kind: u32,
        count: usize,
        shape: &str,
    ) -> usize {
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": self.bytes.len(),
            "byteLength": bytes.len(),
            "target": target,
        }));
        self.bytes.extend(bytes);
        // Every view begins aligned to what any of them holds.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": kind,
            "count": count,
            "type": shape,
        }));
        self.accessors.len() - 1
    }
}
