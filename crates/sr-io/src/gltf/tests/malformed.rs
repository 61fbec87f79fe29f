//! Files that must end with an error that names what is wrong.

use super::builder::*;
use super::*;
use serde_json::{Value, json};

/// A rich file with one value replaced; the errors must mention all of `wanted`.
fn check(pointer: &str, value: Value, wanted: &[&str]) {
    let mut b = Builder::square();
    b.json["materials"] = json!([{}]);
    b.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]);
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = b.json.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        parent => parent[key] = value,
    }
    let text = errors(&b.embedded());
    for w in wanted {
        assert!(text.contains(w), "{pointer}: no `{w}` in:\n{text}");
    }
}

#[test]
fn indices_that_lead_nowhere() {
    check(
        "/nodes/0/mesh",
        json!(5),
        &["nodes[0].mesh: there is nothing at this index"],
    );
    check("/nodes/0/camera", json!(5), &["nodes[0].camera"]);
    check(
        "/meshes/0/primitives/0/material",
        json!(1),
        &["primitives[0].material"],
    );
    check(
        "/meshes/0/primitives/0/indices",
        json!(9),
        &["primitives[0].indices"],
    );
    check(
        "/meshes/0/primitives/0/attributes/POSITION",
        json!(9),
        &["POSITION: there is no such accessor"],
    );
    check(
        "/accessors/0/bufferView",
        json!(9),
        &["accessors[0].bufferView"],
    );
    check(
        "/bufferViews/0/buffer",
        json!(9),
        &["bufferViews[0].buffer"],
    );
    check("/scenes", json!([{"nodes": [7]}]), &["scenes[0].nodes"]);
}

#[test]
fn accessors_that_do_not_fit_their_bytes() {
    check(
        "/accessors/0/count",
        json!(5),
        &[
            "meshes[0].primitives[0].attributes.POSITION",
            "5 elements end behind",
        ],
    );
    check(
        "/accessors/0/count",
        json!(u64::MAX),
        &["18446744073709551615 elements end behind"],
    );
    check("/accessors/0/count", json!(0), &["has no elements"]);
    check(
        "/accessors/0/byteOffset",
        json!(u64::MAX),
        &["end behind the view 0"],
    );
    check(
        "/accessors/0/byteOffset",
        json!(1),
        &["end behind the view 0"],
    );
    check(
        "/bufferViews/0/byteLength",
        json!(1u64 << 40),
        &["ends behind its buffer"],
    );
    check(
        "/bufferViews/0/byteOffset",
        json!(u64::MAX),
        &["ends behind its buffer"],
    );
    check(
        "/bufferViews/0/byteStride",
        json!(4),
        &["12 bytes do not fit a stride of 4"],
    );
    check(
        "/bufferViews/0/byteStride",
        json!(1),
        &["bufferViews[0].byteStride"],
    );
    check(
        "/bufferViews/0/byteStride",
        json!(16),
        &["end behind the view 0"],
    );
}

#[test]
fn accessors_of_the_wrong_type() {
    check(
        "/accessors/0/type",
        json!("VEC2"),
        &["Vec2 of F32 cannot be positions"],
    );
    check(
        "/accessors/0/componentType",
        json!(U32),
        &["Vec3 of U32 cannot be positions"],
    );
    check(
        "/accessors/0/componentType",
        json!(1),
        &["accessors[0].componentType: the value is not valid"],
    );
    check(
        "/accessors/1/componentType",
        json!(F32),
        &["Scalar of F32 cannot be indices"],
    );
    check(
        "/accessors/1/componentType",
        json!(I8),
        &["Scalar of I8 cannot be indices"],
    );
    check(
        "/accessors/1/normalized",
        json!(true),
        &["normalised Scalar of U8 cannot be indices"],
    );
    check(
        "/meshes/0/primitives/0/attributes/NORMAL",
        json!(1),
        &["attributes.NORMAL", "cannot be normals"],
    );
}

#[test]
fn values_that_cannot_be_drawn() {
    let mut b = Builder::square();
    let a = b.accessor(&[0, 1, 4, 0, 2, 255], U8, "SCALAR", 6);
    b.json["meshes"][0]["primitives"][0]["indices"] = json!(a);
    assert!(errors(&b.embedded()).contains("index 2 is 4, but there are 4 vertices"));
    let a = b.accessor(&[0, 1, 2, 0, 2, 255], U8, "SCALAR", 6);
    b.json["meshes"][0]["primitives"][0]["indices"] = json!(a);
    assert!(errors(&b.embedded()).contains("index 5 is 255, the restart value"));

    let mut positions = SQUARE;
    positions[3][1] = f32::INFINITY;
    let mut b = Builder::square();
    let a = b.positions(&positions);
    b.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(a);
    let text = errors(&b.embedded());
    assert!(text.contains("position 3 is not finite"), "{text}");

    let mut b = Builder::square();
    let a = b.accessor(&floats(&SQUARE[..3]), F32, "VEC3", 3);
    b.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(a);
    assert!(errors(&b.embedded()).contains("not as many normals as positions"));
}

#[test]
fn sparse_accessors_whose_indices_are_wrong() {
    let sparse = |indices: [u16; 2], count: u64| {
        let mut b = Builder::square();
        let i = b.view(&bytes_of(indices.map(u16::to_le_bytes)));
        let v = b.view(&floats(&SQUARE[..2]));
        b.json["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": {"bufferView": i, "componentType": U16},
            "values": {"bufferView": v},
        });
        errors(&b.embedded())
    };
    assert!(sparse([3, 1], 2).contains("`sparse`: its indices do not rise"));
    assert!(sparse([1, 1], 2).contains("`sparse`: its indices do not rise"));
    assert!(sparse([1, 4], 2).contains("or end behind the accessor"));
    assert!(sparse([1, 2], 3).contains("3 elements end behind"));
    assert!(sparse([1, 2], u64::MAX).contains("18446744073709551615 of 4 elements cannot differ"));
    assert!(sparse([1, 2], 0).contains("0 of 4 elements"));
}

#[test]
fn hierarchies_that_are_no_trees() {
    check(
        "/nodes",
        json!([{"children": [1]}, {"children": [0]}]),
        &["nodes[0]: this node is its own ancestor"],
    );
    check("/nodes", json!([{"children": [0]}]), &["its own ancestor"]);
    check(
        "/nodes",
        json!([{"children": [2]}, {"children": [2]}, {}]),
        &["nodes[1].children: node 2 is a child of node 0"],
    );
    check(
        "/nodes",
        json!([{"children": [1, 1]}, {}]),
        &["is a child of node 0 already"],
    );
    check(
        "/scenes",
        json!([{"nodes": [0, 0]}]),
        &["node 0 is listed twice"],
    );
    let mut b = Builder::new();
    b.json["nodes"] = json!([{"children": [1]}, {}]);
    b.json["scenes"] = json!([{"nodes": [1]}]);
    assert!(errors(&b.embedded()).contains("node 1 has a parent"));
}

#[test]
fn a_hierarchy_may_be_as_deep_as_it_likes() {
    let mut b = Builder::new();
    let depth = 100_000;
    b.json["nodes"] = (0..depth)
        .map(|i| json!({"children": [i + 1]}))
        .chain([json!({})])
        .collect();
    assert_eq!(read(&b.embedded()).nodes.len(), depth + 1);
}

#[test]
fn numbers_that_place_nothing() {
    check(
        "/nodes/0/rotation",
        json!([0, 0, 0, 0]),
        &["nodes[0]: `rotation` is a quaternion of length 0"],
    );
    check(
        "/nodes/0/translation",
        json!([1e39, 0, 0]),
        &["nodes[0]: `translation` has inf"],
    );
    let mut matrix = [0.0; 16];
    matrix[15] = 2.0;
    check("/nodes/0/matrix", json!(matrix), &["is not affine"]);
    check(
        "/materials/0/emissiveFactor",
        json!([-1, 0, 0]),
        &["materials[0].emissiveFactor"],
    );
    let ior = json!({"KHR_materials_ior": {"ior": 0.5}});
    check(
        "/materials/0/extensions",
        ior,
        &["materials[0].extensions.KHR_materials_ior.ior: must be at least 1"],
    );
    let bad =
        |yfov: f32| json!([{"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.1}}]);
    for yfov in [0.0, -1.0, 3.2] {
        let mut b = Builder::new();
        b.json["cameras"] = bad(yfov);
        b.node(json!({"camera": 0}));
        assert!(errors(&b.embedded()).contains("cameras[0].perspective.yfov"));
    }
}

#[test]
fn required_extensions_and_versions_that_are_not_read() {
    let draco = json!([
        "KHR_materials_ior",
        "KHR_draco_mesh_compression",
        "ACME_new"
    ]);
    check(
        "/extensionsRequired",
        draco,
        &[
            "extensionsRequired[1]: the file requires `KHR_draco_mesh_compression` (compressed meshes), which is not read",
            "extensionsRequired[2]: the file requires `ACME_new`, which is not read",
        ],
    );
    check(
        "/asset/version",
        json!("1.0"),
        &["asset.version: glTF 1.0, only glTF 2"],
    );
    check("/asset/minVersion", json!("2.1"), &["asset.minVersion"]);
}

#[test]
fn buffers_that_cannot_be_had() {
    check(
        "/buffers",
        json!([{"byteLength": 90}]),
        &["buffers[0]: has no `uri`"],
    );
    check(
        "/buffers",
        json!([{"byteLength": 90, "uri": "/dev/zero"}]),
        &["an absolute path"],
    );
    check(
        "/buffers",
        json!([{"byteLength": 90, "uri": "https://x/y.bin"}]),
        &["`https://x/y.bin` is not a path"],
    );
    check(
        "/buffers",
        json!([{"byteLength": 90, "uri": "data:;base64,AAAA"}]),
        &["has 3 bytes, but its `byteLength` is 90"],
    );
    check(
        "/buffers",
        json!([{"byteLength": 90, "uri": "data:;base64,A*"}]),
        &["not valid base64"],
    );
}

#[test]
fn json_that_is_none_has_its_line() {
    let text = errors(b"{\"asset\":\n {\"version\": \"2.0\"},\n \"nodes\": [}\n");
    assert!(
        text.contains("nowhere/test.gltf:3:12: error: not a valid glTF document:"),
        "{text}"
    );
    let text = errors(b"{\n\"nodes\": 3}");
    assert!(
        text.contains("test.gltf:2:10: error:") && text.contains("expected a sequence"),
        "{text}"
    );
    assert!(errors(b"").contains("error"));
    assert!(errors(b"v 1 2 3").contains("not a valid glTF document"));
}

#[test]
fn binary_files_cut_anywhere() {
    let whole = Builder::square().glb();
    read(&whole);
    for length in 0..whole.len() {
        errors(&whole[..length]);
        if length < 12 {
            continue;
        }
        // The same with a header that admits it; the last bytes are padding.
        let mut cut = whole[..length].to_vec();
        cut[8..12].copy_from_slice(&(length as u32).to_le_bytes());
        errors(&cut);
    }
    let mut old = whole.clone();
    old[4] = 1;
    assert!(errors(&old).contains("binary glTF of version 1"));
    let mut longer = whole.clone();
    longer[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(errors(&longer).contains("the file is cut short"));
}

#[test]
fn meshes_instanced_beyond_measure_are_refused() {
    let mut b = Builder::new();
    let cloud: Vec<[f32; 3]> = (0..3000).map(|i| [i as f32, 1.0, (i % 7) as f32]).collect();
    let positions = b.positions(&cloud);
    b.mesh(json!([{"attributes": {"POSITION": positions}, "mode": 5}]));
    let embedded = |b: &mut Builder, n: usize| {
        b.json["nodes"] = (0..n).map(|_| json!({"mesh": 0})).collect();
        b.glb()
    };
    assert_eq!(read(&embedded(&mut b, 500)).nodes.len(), 500);
    let text = errors(&embedded(&mut b, 20_000));
    assert!(
        text.contains("meshes[0]") && text.contains("shared too often"),
        "{text}"
    );
}

#[test]
fn all_problems_come_in_one_go() {
    let mut b = Builder::square();
    b.json["nodes"] = json!([{"mesh": 3}, {"camera": 1}]);
    b.json["asset"]["version"] = json!("3.0");
    b.json["extensionsRequired"] = json!(["ACME_new"]);
    assert_eq!(errors(&b.embedded()).lines().count(), 4);
}

#[test]
fn a_panic_would_become_an_error_that_names_the_file() {
    let e = crate::gltf::guarded(Path::new("x.glb"), || panic!("as a test")).unwrap_err();
    assert!(
        lines(&e).starts_with("x.glb: error: this file makes the glTF reader fail"),
        "{}",
        lines(&e)
    );
}
