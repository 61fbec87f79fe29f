//! Damaged buffers under a document that is right. Damage to whole files is a test of its own, in
//! `tests/hostile`.

use super::builder::*;
use super::*;
use serde_json::json;

/// A file that has something of everything.
fn seed() -> Builder {
    let mut b = Builder::square();
    let normals = b.accessor(&[0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127], I8, "VEC3", 4);
    b.json["accessors"][normals]["normalized"] = json!(true);
    b.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    let i = b.view(&bytes_of([1u16, 3].map(u16::to_le_bytes)));
    let v = b.view(&floats(&SQUARE[..2]));
    b.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": i, "componentType": U16},
        "values": {"bufferView": v},
    });
    let strip = b.accessor(
        &bytes_of([0u32, 1, 2, 3].map(u32::to_le_bytes)),
        U32,
        "SCALAR",
        4,
    );
    b.mesh(
        json!([{"attributes": {"POSITION": 0}, "indices": strip, "mode": 5, "material": 0},
                  {"attributes": {"POSITION": 0}, "mode": 6}]),
    );
    b.material(json!({
        "name": "m", "emissiveFactor": [1.0, 0.5, 0.25],
        "pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.5},
        "extensions": {"KHR_materials_ior": {"ior": 1.5},
                       "KHR_materials_transmission": {"transmissionFactor": 1.0},
                       "KHR_materials_volume": {"thicknessFactor": 1.0},
                       "KHR_materials_emissive_strength": {"emissiveStrength": 2.0}},
    }));
    b.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1.0, "ymag": 2.0, "znear": 0.0, "zfar": 9.0}},
    ]);
    b.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 2.0, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
    ]}});
    b.json["nodes"] = json!([
        {"mesh": 0, "children": [1, 2], "translation": [1.0, 2.0, 3.0], "rotation": [0.0, 0.0, 0.6, 0.8]},
        {"mesh": 1, "camera": 0, "scale": [1.0, -1.0, 2.0]},
        {"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 0}}, "children": [3]},
        {"mesh": 1},
    ]);
    b.json["scenes"] = json!([{"nodes": [0]}]);
    b.json["scene"] = json!(0);
    b
}

struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }
}

#[test]
fn damaged_data_ends_with_a_model_or_errors() {
    let whole = seed();
    let mut random = Random(5);
    for _ in 0..6000 {
        let mut b = Builder {
            json: whole.json.clone(),
            bin: whole.bin.clone(),
        };
        for _ in 0..1 + random.below(8) {
            let at = random.below(b.bin.len());
            b.bin[at] = [0, 1, 0x7f, 0x80, 0xff, random.below(256) as u8][random.below(6)];
        }
        if let Ok(model) = try_read(&b.glb()) {
            let finite = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5;
            let parts = model.nodes.iter().flat_map(|n| &n.parts);
            assert!(parts.flat_map(|p| &p.mesh.normals).all(finite));
        }
    }
}
