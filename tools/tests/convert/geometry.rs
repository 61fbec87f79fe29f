//! Meshes: all spellings of polygons, sources, normals, materials, hierarchy, and the `.glb`.

use super::support::*;
use glam::DVec3;
use sr_tools::convert::{NormalsMode, Options, convert};

const TRIANGLES: &str = "<triangles count=\"2\"><input semantic=\"VERTEX\" source=\"#v1\" offset=\"0\"/><p>0 1 2 <!-- half --> 0 2 3</p></triangles>";

#[test]
fn every_primitive_kind_gives_the_same_square() {
    let converted = convert_fixture("shapes.dae");
    let parts = world_parts(&converted.glb);
    assert_eq!(parts.len(), 5);
    for part in parts {
        assert_eq!(part.triangles.len(), 2, "{}", part.node);
        assert_eq!(area(&part.triangles), DVec3::Z, "{}", part.node);
        assert!(part.normals.is_empty(), "the file has no normals");
    }
}

#[test]
fn accessors_skip_nameless_numbers_and_v_points_down() {
    let parts = world_parts(&convert_fixture("shapes.dae").glb);
    let polylist = parts.iter().find(|p| p.node == "polylist").unwrap();
    assert_eq!(
        polylist.uvs,
        [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]
    );
}

#[test]
fn concave_polygons_keep_their_area() {
    let positions = "0 0 0 1 0 0 1 1 0 0 1 0</float_array>
        <technique_common><accessor source=\"#p1a\" count=\"4\"";
    let arrow = "0 0 0 2 -1 0 0.5 0 0 2 1 0</float_array>
        <technique_common><accessor source=\"#p1a\" count=\"4\"";
    let polygon = TRIANGLES
        .replace("triangles", "polygons")
        .replace("count=\"2\"", "count=\"1\"")
        .replace("0 1 2 <!-- half --> 0 2 3", "0 1 2 3");
    let changes = [(positions, arrow), (TRIANGLES, &polygon)];
    let converted = convert_changed("shapes.dae", &changes, &Options::default()).unwrap();
    let parts = world_parts(&converted.glb);
    let part = parts.iter().find(|p| p.node == "triangles").unwrap();
    assert_eq!(area(&part.triangles), DVec3::Z * 0.5);
    for t in &part.triangles {
        assert!(area(std::slice::from_ref(t)).z > 0.0, "{t:?}");
    }
}

#[test]
fn holes_are_told_and_filled_when_lenient() {
    let hole = TRIANGLES
        .replace("triangles", "polygons")
        .replace("count=\"2\"", "count=\"1\"")
        .replace(
            "<p>0 1 2 <!-- half --> 0 2 3</p>",
            "<ph><p>0 1 2 3</p><h>0 1 2</h></ph>",
        );
    let changes = [(TRIANGLES, hole.as_str())];
    let problems = convert_changed("shapes.dae", &changes, &Options::default()).unwrap_err();
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].line, 10);
    assert!(
        problems[0].message.contains("hole"),
        "{}",
        problems[0].message
    );
    let lenient = Options {
        lenient: true,
        ..Default::default()
    };
    let converted = convert_changed("shapes.dae", &changes, &lenient).unwrap();
    assert_eq!(converted.report.warnings.len(), 1);
    let parts = world_parts(&converted.glb);
    let part = parts.iter().find(|p| p.node == "triangles").unwrap();
    assert_eq!(area(&part.triangles), DVec3::Z);
}

#[test]
fn hierarchy_unit_and_axes_place_the_meshes() {
    let parts = world_parts(&convert_fixture("room.dae").glb);
    // outer = T(100, 0, 0) · Rz(90°) · S(2, 1, 1), shared = T(0, 0, 50), in centimetres, Z up.
    let world = |[x, y, z]: [f64; 3]| {
        let file = DVec3::new(100.0 - y, 2.0 * x, z + 50.0);
        DVec3::new(file.x, file.z, -file.y) * 0.01
    };
    let red = parts
        .iter()
        .find(|p| p.node == "shared" && p.material == "Paint_red");
    let red = red.expect("the instance of the library node");
    let wanted = [
        [0.0, 0.0, 0.0],
        [100.0, 0.0, 0.0],
        [100.0, 100.0, 0.0],
        [0.0, 100.0, 0.0],
    ];
    for corner in red.triangles.iter().flatten() {
        let nearest = wanted.map(|w| world(w).distance(*corner)).into_iter();
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        // Matrices are read as f32.
        assert!(
            nearest < 1e-6,
            "{corner} is {nearest} away from all corners"
        );
    }
    assert!((area(&red.triangles) - DVec3::Y * 2.0).length() < 1e-5);
}

#[test]
fn parts_are_bound_to_materials_by_instance() {
    let parts = world_parts(&convert_fixture("room.dae").glb);
    let bound: Vec<(&str, &str)> = parts
        .iter()
        .map(|p| (p.node.as_str(), p.material.as_str()))
        .collect();
    let wanted = [
        ("again", "Paint_red"),
        ("again", "Wood"),
        ("shared", "Glow"),
        ("shared", "Paint_red"),
    ];
    assert_eq!(bound, wanted);
}

#[test]
fn instances_share_their_vertices() {
    let converted = convert_fixture("room.dae");
    let file = gltf::Gltf::from_slice(&converted.glb).unwrap();
    assert_eq!(file.meshes().count(), 2, "one by combination of materials");
    // Positions, normals, texture coordinates and indices of one part, no texture coordinates of
    // the other.
    assert_eq!(file.accessors().count(), 7);
}

#[test]
fn normals_are_of_unit_length_and_zero_ones_repaired() {
    // Position 3 has the normal 0 0 0 in the file; `world_parts` checks unit length.
    for part in world_parts(&convert_fixture("room.dae").glb) {
        assert!(!part.normals.is_empty());
        for n in part.normals {
            assert!((n - DVec3::Y).length() < 1e-6, "{n}");
        }
    }
}

#[test]
fn the_first_set_of_texture_coordinates_is_the_one_with_the_lowest_number() {
    let parts = world_parts(&convert_fixture("room.dae").glb);
    let wood = parts.iter().find(|p| p.material == "Wood").unwrap();
    assert_eq!(wood.uvs[0], [0.5, 0.75]);
    assert_eq!(wood.uvs[2], [0.75, 0.0]);
}

#[test]
fn smooth_normals_are_weighted_by_area_and_shared_by_position() {
    // A roof of two rectangles, 1 and 3 wide, that meet at a right angle; no normals in the file.
    let text = String::from_utf8(fixture("shapes.dae")).unwrap();
    let text = text
        .replace(
            "<float_array id=\"p1a\" count=\"12\">0 0 0 1 0 0 1 1 0 0 1 0</float_array>",
            "<float_array id=\"p1a\" count=\"18\">0 0 0 0 1 0 1 0 0 1 1 0 0 0 3 0 1 3</float_array>",
        )
        .replace("source=\"#p1a\" count=\"4\"", "source=\"#p1a\" count=\"6\"")
        .replace(TRIANGLES, "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v1\" offset=\"0\"/><p>0 2 3 0 3 1 0 5 4 0 1 5</p></triangles>");
    let options = Options {
        normals: Some(NormalsMode::Smooth),
        ..Default::default()
    };
    let parts = world_parts(&convert(text.as_bytes(), "roof.dae", &options).unwrap().glb);
    let roof = parts.iter().find(|p| p.node == "triangles").unwrap();
    // Around position 0: both triangles of the first wall (area 1/2 each, +Z) and both of the
    // second (3/2 each, normal ±X).
    let first = roof.normals[0];
    let wall = area(&roof.triangles[2..3]).normalize();
    let wanted = (DVec3::Z * 1.0 + wall * 3.0).normalize();
    assert!((first - wanted).length() < 1e-6, "{first} {wanted}");
}

#[test]
fn the_camera_of_the_glb_is_the_one_of_the_scene_file() {
    let converted = convert_fixture("room.dae");
    let file = gltf::Gltf::from_slice(&converted.glb).unwrap();
    let node = file.nodes().find(|n| n.camera().is_some()).unwrap();
    let framing = converted.report.file_framing.unwrap();
    let matrix = glam::Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
    assert!((matrix.w_axis.truncate() - framing.from).length() < 1e-6);
    let forward = -matrix.z_axis.truncate();
    assert!((forward - (framing.to - framing.from)).length() < 1e-6);
    let camera = node.camera().unwrap();
    let gltf::camera::Projection::Perspective(lens) = camera.projection() else {
        panic!("the camera is perspective");
    };
    assert!((lens.yfov() - 40f32.to_radians()).abs() < 1e-6);
    assert_eq!(lens.aspect_ratio(), Some(1.5));
}
