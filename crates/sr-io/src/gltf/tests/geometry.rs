//! Accessors and primitives.

use super::builder::*;
use super::*;
use serde_json::json;

const TWO_TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

#[test]
fn every_index_type_is_read() {
    let indices = [0u8, 1, 2, 0, 2, 3];
    let wide16 = bytes_of(indices.map(|i| u16::from(i).to_le_bytes()));
    let wide32 = bytes_of(indices.map(|i| u32::from(i).to_le_bytes()));
    for (bytes, component) in [(indices.to_vec(), U8), (wide16, U16), (wide32, U32)] {
        let mut b = Builder::square();
        let a = b.accessor(&bytes, component, "SCALAR", 6);
        b.json["meshes"][0]["primitives"][0]["indices"] = json!(a);
        let model = read(&b.glb());
        let mesh = &only_part(&model).mesh;
        assert_eq!(mesh.indices, TWO_TRIANGLES, "component type {component}");
        assert_eq!(mesh.positions, SQUARE);
        assert!(mesh.normals.is_empty(), "missing normals mean facets");
        assert!(model.notes.is_empty(), "{}", lines(&model.notes));
    }
}

/// A non-indexed triangle with positions in the given form.
fn positions_of(bytes: &[u8], component: u32, normalized: bool) -> [[f32; 3]; 3] {
    let mut b = Builder::new();
    let a = b.accessor(bytes, component, "VEC3", 3);
    b.json["accessors"][a]["normalized"] = json!(normalized);
    b.json["accessors"][a]["min"] = json!([0, 0, 0]);
    b.json["accessors"][a]["max"] = json!([1, 1, 1]);
    b.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    b.mesh(json!([{"attributes": {"POSITION": a}}]));
    b.node(json!({"mesh": 0}));
    let model = read(&b.embedded());
    let mesh = &only_part(&model).mesh;
    assert_eq!(mesh.indices, [[0, 1, 2]]);
    mesh.positions.clone().try_into().unwrap()
}

#[test]
fn every_attribute_type_is_read_plain_and_normalised() {
    let signed = [-128i8, -127, 0, 127, 64, 1, 2, 3, 4];
    let unsigned = [0u8, 255, 51, 1, 2, 3, 4, 5, 6];
    let plain = positions_of(&signed.map(|x| x as u8), I8, false);
    assert_eq!(plain[0], [-128.0, -127.0, 0.0]);
    let scaled = positions_of(&signed.map(|x| x as u8), I8, true);
    assert_eq!(scaled[0], [-1.0, -1.0, 0.0]);
    assert_eq!(scaled[1][0], 1.0);
    assert_eq!(positions_of(&unsigned, U8, false)[0], [0.0, 255.0, 51.0]);
    assert_eq!(positions_of(&unsigned, U8, true)[0], [0.0, 1.0, 0.2]);
    let signed = bytes_of([-32768i16, -32767, 32767, 0, 1, 2, 3, 4, 5].map(i16::to_le_bytes));
    assert_eq!(positions_of(&signed, I16, true)[0], [-1.0, -1.0, 1.0]);
    assert_eq!(
        positions_of(&signed, I16, false)[0],
        [-32768.0, -32767.0, 32767.0]
    );
    let unsigned = bytes_of([65535u16, 0, 13107, 0, 1, 2, 3, 4, 5].map(u16::to_le_bytes));
    assert_eq!(positions_of(&unsigned, U16, true)[0], [1.0, 0.0, 0.2]);
    assert_eq!(
        positions_of(&unsigned, U16, false)[0],
        [65535.0, 0.0, 13107.0]
    );
}

#[test]
fn interleaved_attributes_follow_their_stride() {
    let mut b = Builder::new();
    let rows: Vec<[f32; 6]> = SQUARE.map(|[x, y, z]| [x, y, z, 0.0, 0.0, 2.0]).to_vec();
    let view = b.view(&floats(&rows));
    b.json["bufferViews"][view]["byteStride"] = json!(24);
    for offset in [0, 12] {
        b.push(
            "accessors",
            json!({"bufferView": view, "byteOffset": offset, "componentType": F32,
                   "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 1, 1]}),
        );
    }
    b.mesh(json!([{"attributes": {"POSITION": 0, "NORMAL": 1}, "mode": 6}]));
    b.node(json!({"mesh": 0}));
    let model = read(&b.embedded());
    let mesh = &only_part(&model).mesh;
    assert_eq!(mesh.positions, SQUARE);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 4], "normals have length 1");
    assert_eq!(mesh.indices, [[1, 2, 0], [2, 3, 0]]);
}

#[test]
fn sparse_accessors_replace_elements_of_a_view_or_of_zeros() {
    for with_view in [true, false] {
        let mut b = Builder::square();
        let moved = [[9.0, 1.0, 0.0], [0.0, 9.0, 5.0f32]];
        let indices = b.view(&bytes_of([1u16, 3].map(u16::to_le_bytes)));
        let values = b.view(&floats(&moved));
        let accessor = &mut b.json["accessors"][0];
        accessor["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": indices, "componentType": U16},
            "values": {"bufferView": values},
        });
        if !with_view {
            accessor.as_object_mut().unwrap().remove("bufferView");
        }
        let model = read(&b.embedded());
        let p = &only_part(&model).mesh.positions;
        assert_eq!((p[1], p[3]), (moved[0], moved[1]));
        let untouched = if with_view { SQUARE[2] } else { [0.0; 3] };
        assert_eq!(p[2], untouched);
    }
}

#[test]
fn strips_and_fans_keep_their_winding() {
    let strip = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 2.0, 0.0f32],
    ];
    let mut b = Builder::new();
    let positions = b.positions(&strip);
    b.mesh(json!([{"attributes": {"POSITION": positions}, "mode": 5}]));
    b.node(json!({"mesh": 0}));
    let model = read(&b.embedded());
    let mesh = &only_part(&model).mesh;
    assert_eq!(mesh.indices, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
    for t in &mesh.indices {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(area > 0.0, "{t:?} is turned over");
    }
}

#[test]
fn triangles_that_only_join_strips_are_left_out() {
    let mut b = Builder::square();
    let a = b.accessor(&[0, 1, 3, 3, 0, 0, 1, 2], U8, "SCALAR", 8);
    b.json["meshes"][0]["primitives"][0]["indices"] = json!(a);
    b.json["meshes"][0]["primitives"][0]["mode"] = json!(5);
    let model = read(&b.embedded());
    assert_eq!(only_part(&model).mesh.indices, [[0, 1, 3], [0, 2, 1]]);
}

#[test]
fn points_and_lines_are_warned_of_once() {
    let mut b = Builder::square();
    for mode in 0..4 {
        let primitives = b.json["meshes"][0]["primitives"].as_array_mut().unwrap();
        primitives.push(json!({"attributes": {"POSITION": 0}, "mode": mode}));
    }
    let model = read(&b.embedded());
    assert_eq!(only_part(&model).mesh.indices, TWO_TRIANGLES);
    assert_eq!(model.notes.len(), 1);
    let note = model.notes[0].to_string();
    assert!(
        note.contains("points and lines are not drawn (meshes[0].primitives[1] and 3 more)"),
        "{note}"
    );
}

#[test]
fn a_primitive_keeps_only_the_vertices_it_uses() {
    let mut b = Builder::new();
    let cloud: Vec<[f32; 3]> = (0..100).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
    let positions = b.positions(&cloud);
    let mut primitives = Vec::new();
    for triangle in [[99u8, 0, 50], [7, 8, 9]] {
        let indices = b.accessor(&triangle, U8, "SCALAR", 3);
        primitives.push(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    }
    b.mesh(json!(primitives));
    b.node(json!({"mesh": 0}));
    let model = read(&b.embedded());
    let parts = &model.nodes[0].parts;
    assert_eq!(parts.len(), 2);
    for (part, triangle) in parts.iter().zip([[99usize, 0, 50], [7, 8, 9]]) {
        assert_eq!(part.mesh.positions.len(), 3);
        let corners = part.mesh.indices[0].map(|v| part.mesh.positions[v as usize]);
        assert_eq!(corners, triangle.map(|v| cloud[v]));
    }
}

#[test]
fn normals_without_direction_come_from_the_faces() {
    let mut b = Builder::square();
    let normals = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [f32::NAN; 3]];
    let a = b.accessor(&floats(&normals), F32, "VEC3", 4);
    b.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(a);
    let model = read(&b.embedded());
    let up = [0.0, 0.0, 1.0];
    assert_eq!(
        only_part(&model).mesh.normals,
        [up, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], up]
    );
    let notes = lines(&model.notes);
    assert!(
        notes.contains("notice: normals without direction") && notes.contains("2 in meshes[0]"),
        "{notes}"
    );
}

#[test]
fn corners_that_make_no_triangle_are_warned_of() {
    let mut b = Builder::square();
    b.json["accessors"][1]["count"] = json!(5);
    let model = read(&b.embedded());
    assert_eq!(only_part(&model).mesh.indices, [[0, 1, 2]]);
    assert!(lines(&model.notes).contains("make no whole triangle"));
}

#[test]
fn zeros_that_no_index_asks_for_cost_nothing() {
    let mut b = Builder::square();
    let indices = b.view(&bytes_of([0u32, 1, 2, 3].map(u32::to_le_bytes)));
    let values = b.view(&floats(&SQUARE));
    b.json["accessors"][0] = json!({
        "componentType": F32, "type": "VEC3", "count": 4_000_000_000u32,
        "min": [0, 0, 0], "max": [1, 1, 1],
        "sparse": {
            "count": 4,
            "indices": {"bufferView": indices, "componentType": U32},
            "values": {"bufferView": values},
        },
    });
    let model = read(&b.embedded());
    assert_eq!(only_part(&model).mesh.positions, SQUARE);
    // Without indices, every one of them is a corner.
    b.json["meshes"][0]["primitives"][0]
        .as_object_mut()
        .unwrap()
        .remove("indices");
    let errors = errors(&b.embedded());
    assert!(
        errors.contains("above 64 MiB") && errors.contains("meshes[0].primitives[0].indices"),
        "{errors}"
    );
}
