//! Vertices, faces, objects and groups.

use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn faces_count_from_one_or_backwards_and_may_look_ahead() {
    for face in ["f 1 2 3 4", "f -4 -3 -2 -1", "f 1 2 -2 4"] {
        let model = read(&format!("{SQUARE}{face}\n"));
        let mesh = &only_part(&model).mesh;
        assert_eq!(mesh.positions[2], [1.0, 1.0, 0.0]);
        assert_eq!(mesh.indices, [[0, 1, 2], [0, 2, 3]], "{face}");
        assert!(mesh.normals.is_empty(), "missing normals mean facets");
        assert!(model.notes.is_empty(), "{}", lines(&model.notes));
    }
    let model = read(&format!("f 1 2 3\n{SQUARE}"));
    assert_eq!(only_part(&model).mesh.positions.len(), 3);
}

#[test]
fn all_forms_of_corners_are_read() {
    let text = "vt 0 0\nvn 0 0 2\nvn 1 0 0\n";
    for face in [
        "f 1//1 2//1 3//1",
        "f 1/1/1 2/1/1 3/1/1",
        "f -4/-1/-2 -3/-1/-2 -2/-1/-2",
    ] {
        let model = read(&format!("{SQUARE}{text}{face}"));
        let mesh = &only_part(&model).mesh;
        assert_eq!(
            mesh.normals,
            [[0.0, 0.0, 1.0]; 3],
            "{face}: normals have length 1"
        );
    }
    assert!(
        only_part(&read(&format!("{SQUARE}{text}f 1/1 2/1 3/1")))
            .mesh
            .normals
            .is_empty()
    );
}

#[test]
fn corners_with_equal_normals_share_a_vertex() {
    let model = read(&format!(
        "{SQUARE}vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//2\nf 1//2 2//1 3//1\n"
    ));
    assert_eq!(only_part(&model).mesh.positions.len(), 5);
}

#[test]
fn faces_with_and_without_normals_do_not_mix() {
    let model = read(&format!(
        "{SQUARE}vn 1 0 0\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 3 4\nf 2//1 3//1 4//1\n"
    ));
    let parts = &model.nodes[0].parts;
    assert_eq!(parts.len(), 2);
    assert_eq!(parts[0].mesh.indices.len(), 2);
    assert_eq!(parts[0].mesh.normals, [[1.0, 0.0, 0.0]; 4]);
    assert_eq!(parts[1].mesh.indices.len(), 2);
    assert!(parts[1].mesh.normals.is_empty());
    let notes = lines(&model.notes);
    assert!(
        notes.contains("test.obj:8:1: warning: faces with normals at some corners only"),
        "{notes}"
    );
}

#[test]
fn concave_polygons_are_cut_without_overlap() {
    let arrow = "v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\n";
    for face in ["f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"] {
        let model = read(&format!("{arrow}{face}"));
        let mesh = &only_part(&model).mesh;
        let areas = mesh.indices.iter().map(|t| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        });
        let areas: Vec<f32> = areas.collect();
        assert_eq!(areas, [0.5, 0.5], "{face}");
    }
}

#[test]
fn polygons_that_cross_themselves_are_warned_of() {
    let model = read(&format!("o bow\n{SQUARE}f 1 3 2 4"));
    assert!(lines(&model.notes).contains("cross themselves may be drawn wrongly (object `bow`)"));
}

#[test]
fn objects_become_nodes_and_materials_parts() {
    let text = format!(
        "{SQUARE}o box one\nusemtl red\nf 1 2 3\ng ignored\nf 1 2 4\nusemtl blue\nf 1 3 4\n\
         usemtl red\nf 2 3 4\no two\nf 1 2 3 4\no box one\nf 1 3 2\n"
    );
    let model = read(&text);
    let seen: Vec<(&str, Vec<usize>)> = model
        .nodes
        .iter()
        .map(|n| {
            (
                n.name.as_str(),
                n.parts.iter().map(|p| p.mesh.indices.len()).collect(),
            )
        })
        .collect();
    assert_eq!(seen, [("box one", vec![4, 1]), ("two", vec![2])]);
    let names: Vec<_> = model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["red", "blue"]);
    let materials: Vec<_> = model.nodes[0].parts.iter().map(|p| p.material).collect();
    assert_eq!(materials, [Some(0), Some(1)]);
    assert!(
        lines(&model.notes).contains(
            ":6:8: warning: the file names no `mtllib`, its materials are grey (`red` and 1 more)"
        ),
        "{}",
        lines(&model.notes)
    );
}

#[test]
fn groups_are_nodes_when_there_are_no_objects() {
    let model = read(&format!(
        "{SQUARE}f 1 2 3\ng a b\nf 1 2 3\ng c\ng a b\nf 1 3 4\n"
    ));
    let names: Vec<_> = model.nodes.iter().map(|n| n.name.as_str()).collect();
    assert_eq!(names, ["test", "a b"], "empty groups are no nodes");
    assert_eq!(model.nodes[1].parts[0].mesh.indices.len(), 2);
    assert_eq!(model.materials[0].name, "default");
}

#[test]
fn polylines_and_points_are_not_drawn() {
    let model = read(&format!("{SQUARE}l 1 2 3\np 1\nl 1 2\nf 1 2 3\n"));
    assert_eq!(only_part(&model).mesh.indices.len(), 1);
    assert!(
        lines(&model.notes)
            .contains("5:1: warning: lines and points are not drawn (`l` and 2 more)")
    );
}

#[test]
fn weights_colours_continued_lines_and_odd_names_are_taken() {
    let text = "v 0 0 0 2\nv 2 \\\n  0 0 2 # a comment\nv 0 1 0 0.5 0.5 0.5\r\nv 9 9 9\no m\u{e4}ü #1\nf 1 2 3\r\n";
    let model = read(text);
    let mesh = &only_part(&model).mesh;
    assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model.nodes[0].name, "mäü #1");
    assert!(lines(&model.notes).contains("4:1: warning: vertex colours are not read"));
    // Latin-1 in a comment.
    try_read(b"# M\xfcller\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").unwrap();
}

#[test]
fn normals_without_direction_come_from_the_faces() {
    let model = read(&format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1"));
    assert_eq!(only_part(&model).mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    assert!(lines(&model.notes).contains("3 in object `test`"));
}
