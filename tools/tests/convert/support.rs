//! Reading the converter's results back.

use glam::{DMat4, DVec3, Mat4};
use sr_tools::convert::{Converted, Options, Problem, convert};
use std::path::{Path, PathBuf};

/// A file of this crate's fixtures.
pub fn fixture(name: &str) -> Vec<u8> {
    std::fs::read(fixture_path(name)).unwrap()
}

pub fn fixture_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fixtures")
        .join(name)
}

/// Convert with the defaults.
pub fn convert_fixture(name: &str) -> Converted {
    convert(&fixture(name), name, &Options::default()).unwrap()
}

/// Convert a fixture after replacing a text that occurs in it.
pub fn convert_changed(
    name: &str,
    changes: &[(&str, &str)],
    options: &Options,
) -> Result<Converted, Vec<Problem>> {
    let mut text = String::from_utf8(fixture(name)).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "`{from}` is not in {name}");
        text = text.replacen(from, to, 1);
    }
    convert(text.as_bytes(), name, options)
}

/// One mesh of a `.glb`, in the world.
#[derive(Debug)]
pub struct WorldPart {
    pub node: String,
    pub material: String,
    pub triangles: Vec<[DVec3; 3]>,
    pub normals: Vec<DVec3>,
    pub uvs: Vec<[f32; 2]>,
}

/// Read a `.glb` with validation, and place its meshes.
pub fn world_parts(glb: &[u8]) -> Vec<WorldPart> {
    let file = gltf::Gltf::from_slice(glb).expect("the .glb validates");
    let blob = file.blob.as_deref().unwrap_or_default();
    let mut out = Vec::new();
    let Some(scene) = file.default_scene() else {
        panic!("no default scene");
    };
    let mut stack: Vec<(gltf::Node<'_>, DMat4)> =
        scene.nodes().map(|n| (n, DMat4::IDENTITY)).collect();
    while let Some((node, parent)) = stack.pop() {
        let local = Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
        let world = parent * local;
        stack.extend(node.children().map(|c| (c, world)));
        let Some(mesh) = node.mesh() else { continue };
        for primitive in mesh.primitives() {
            out.push(part(&node, &primitive, blob, world));
        }
    }
    out.sort_by(|a, b| (&a.node, &a.material).cmp(&(&b.node, &b.material)));
    out
}

fn part(
    node: &gltf::Node<'_>,
    primitive: &gltf::Primitive<'_>,
    blob: &[u8],
    world: DMat4,
) -> WorldPart {
    let reader = primitive.reader(|_| Some(blob));
    let local: Vec<DVec3> = reader
        .read_positions()
        .expect("positions")
        .map(|p| DVec3::from_array(p.map(f64::from)))
        .collect();
    // The bounds that the accessor declares are those of the data.
    let bounds = primitive.bounding_box();
    let lo = local.iter().fold(DVec3::INFINITY, |a, &b| a.min(b));
    let hi = local.iter().fold(DVec3::NEG_INFINITY, |a, &b| a.max(b));
    assert_eq!(DVec3::from_array(bounds.min.map(f64::from)), lo);
    assert_eq!(DVec3::from_array(bounds.max.map(f64::from)), hi);
    let indices: Vec<usize> = reader
        .read_indices()
        .expect("indices")
        .into_u32()
        .map(|i| i as usize)
        .collect();
    let place = |i: usize| world.transform_point3(local[i]);
    let normal_matrix = world.inverse().transpose();
    let normal = |n: [f32; 3]| {
        let n = DVec3::from_array(n.map(f64::from));
        assert!((n.length() - 1.0).abs() < 1e-6, "{n} is not of unit length");
        normal_matrix.transform_vector3(n).normalize()
    };
    WorldPart {
        node: node.name().unwrap_or_default().to_owned(),
        material: primitive.material().name().unwrap_or_default().to_owned(),
        triangles: indices
            .chunks_exact(3)
            .map(|t| [place(t[0]), place(t[1]), place(t[2])])
            .collect(),
        normals: reader
            .read_normals()
            .into_iter()
            .flatten()
            .map(normal)
            .collect(),
        uvs: reader
            .read_tex_coords(0)
            .map(|t| t.into_f32().collect())
            .unwrap_or_default(),
    }
}

/// Sum of area vectors of triangles.
pub fn area(triangles: &[[DVec3; 3]]) -> DVec3 {
    triangles
        .iter()
        .map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a))
        .sum()
}

/// The components of an entity or override in a scene file; the text must be RON throughout.
pub fn entry(ron_text: &str, group: &str, name: &str) -> String {
    let value: ron::Value = ron::from_str(ron_text).expect("the scene file is RON");
    let ron::Value::Map(top) = value else {
        panic!("a scene file is a struct");
    };
    let key = |s: &str| ron::Value::String(s.to_owned());
    let group = top.iter().find(|(k, _)| **k == key(group)).expect(group).1;
    let ron::Value::Map(group) = group else {
        panic!("a group is a map");
    };
    let found = group.iter().find(|(k, _)| **k == key(name)).map(|(_, v)| v);
    ron::to_string(found.unwrap_or_else(|| panic!("no `{name}`"))).unwrap()
}

/// The line of a scene file that begins with a name.
pub fn line<'t>(ron_text: &'t str, name: &str) -> &'t str {
    let start = format!("\"{name}\": ");
    ron_text
        .lines()
        .find_map(|l| l.trim().strip_prefix(&start))
        .unwrap_or_else(|| panic!("no `{name}` in\n{ron_text}"))
        .trim_end_matches(',')
}
