//! Writes small glTF files.

use base64::Engine;
use serde_json::{Value, json};

pub(super) const I8: u32 = 5120;
pub(super) const U8: u32 = 5121;
pub(super) const I16: u32 = 5122;
pub(super) const U16: u32 = 5123;
pub(super) const U32: u32 = 5125;
pub(super) const F32: u32 = 5126;

/// A unit right triangle in the XY plane, then a fourth corner that makes it a square.
pub(super) const SQUARE: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
];

/// A document and its one buffer.
pub(super) struct Builder {
    pub(super) json: Value,
    pub(super) bin: Vec<u8>,
}

pub(super) fn bytes_of<const N: usize>(numbers: impl IntoIterator<Item = [u8; N]>) -> Vec<u8> {
    numbers.into_iter().flatten().collect()
}

pub(super) fn floats<const N: usize>(vectors: &[[f32; N]]) -> Vec<u8> {
    bytes_of(vectors.iter().flatten().map(|x| x.to_le_bytes()))
}

impl Builder {
    pub(super) fn new() -> Self {
        Self {
            json: json!({
                "asset": {"version": "2.0"},
                "accessors": [], "bufferViews": [], "meshes": [], "nodes": [],
            }),
            bin: Vec::new(),
        }
    }

    /// One node with a mesh of one primitive: a square of two triangles, without normals.
    pub(super) fn square() -> Self {
        let mut b = Self::new();
        let positions = b.positions(&SQUARE);
        let indices = b.accessor(&[0, 1, 2, 0, 2, 3], U8, "SCALAR", 6);
        b.mesh(json!([{"attributes": {"POSITION": positions}, "indices": indices}]));
        b.node(json!({"mesh": 0}));
        b
    }

    pub(super) fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let items = self.json[list].as_array_mut().unwrap();
        items.push(value);
        items.len() - 1
    }

    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.bin.len().is_multiple_of(4) {
            self.bin.push(0xee);
        }
        let offset = self.bin.len();
        self.bin.extend(bytes);
        self.push(
            "bufferViews",
            json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}),
        )
    }

    pub(super) fn accessor(
        &mut self,
        bytes: &[u8],
        component: u32,
        kind: &str,
        count: usize,
    ) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count}),
        )
    }

    pub(super) fn positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let a = self.accessor(&floats(positions), F32, "VEC3", positions.len());
        self.json["accessors"][a]["min"] = json!([-1e3, -1e3, -1e3]);
        self.json["accessors"][a]["max"] = json!([1e3, 1e3, 1e3]);
        a
    }

    pub(super) fn mesh(&mut self, primitives: Value) -> usize {
        self.push("meshes", json!({"primitives": primitives}))
    }

    pub(super) fn node(&mut self, node: Value) -> usize {
        self.push("nodes", node)
    }

    pub(super) fn material(&mut self, material: Value) -> usize {
        self.push("materials", material)
    }

    /// The document with its buffer as a `data:` URI, or as it was set.
    pub(super) fn embedded(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json["buffers"].is_null() && !self.bin.is_empty() {
            let data = base64::engine::general_purpose::STANDARD.encode(&self.bin);
            let uri = format!("data:application/octet-stream;base64,{data}");
            json["buffers"] = json!([{"byteLength": self.bin.len(), "uri": uri}]);
        }
        serde_json::to_vec_pretty(&json).unwrap()
    }

    /// A binary file.
    pub(super) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json["buffers"].is_null() && !self.bin.is_empty() {
            json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        }
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = self.bin.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let mut file = Vec::new();
        let length = 12 + 8 + text.len() + 8 + bin.len();
        file.extend(b"glTF");
        file.extend(2u32.to_le_bytes());
        file.extend((length as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", text), (b"BIN\0", bin)] {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}
