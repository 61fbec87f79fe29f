use super::*;
use sr_scene::components::{
    ActiveCamera, Lambert, LocalTransform, MaterialRef, MetallicRoughness, PerspectiveCamera,
    PointLight, Rgb, SourceSpan, TriangleMesh,
};

const TRIANGLES: &str = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no red.dark\nusemtl red.dark\n\
     f 1 2 3\no both\nusemtl red.dark\nf 1 2 3\nusemtl blue\nf 3 2 1\n";
const MATERIALS: &str = "newmtl red.dark\nKd 0.5 0 0\nnewmtl blue\nKd 0 0 0.5\n";

fn with_obj(scene: &str, sets: &[&str]) -> Loaded {
    let files = [
        ("a.scene.ron", scene),
        ("m/t.obj", TRIANGLES),
        ("m/t.mtl", MATERIALS),
    ];
    load(&files, sets)
}

/// Two nodes and two materials that share their names, a camera, a light, a node without name.
const GLTF: &str = r#"{
    "asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0, 3]}],
    "nodes": [
        {"name": "wall", "mesh": 0, "translation": [1, 2, 3], "children": [1, 2]},
        {"name": "wall", "mesh": 0},
        {"camera": 0},
        {"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}}
    ],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}],
    "materials": [{"name": "wall"}, {"name": "wall", "pbrMetallicRoughness": {"metallicFactor": 0}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 2}]}}
}"#;

#[test]
fn a_models_nodes_and_materials_become_named_entities() {
    let mut got = load(&[("box.gltf", GLTF)], &[]);
    assert!(got.ok, "{:#?}", got.said);
    let root = got.entity("box");
    assert_eq!(got.get::<ChildOf>("box/lamp").parent(), root);
    assert_eq!(got.get::<PointLight>("box/lamp").intensity, Rgb::splat(2.0));
    // A node and a material share the name: two spaces.
    let mut names = got
        .world
        .query::<(&Name, Has<TriangleMesh>, Has<MetallicRoughness>)>();
    let mut names: Vec<_> = names
        .iter(&got.world)
        .map(|(n, mesh, lobe)| (n.to_string(), mesh, lobe))
        .collect();
    names.sort();
    let expected = [
        ("box", false, false),
        ("box/lamp", false, false),
        ("box/node", false, false),
        ("box/wall", false, true),
        ("box/wall", true, false),
        ("box/wall#2", false, true),
        ("box/wall#2", true, false),
    ];
    let expected = expected.map(|(n, mesh, lobe)| (n.to_owned(), mesh, lobe));
    assert_eq!(names, expected);
    assert!(got.has::<ActiveCamera>("box/node"));
    assert!(got.has::<PerspectiveCamera>("box/node"));
}

#[test]
fn paths_tell_nodes_from_materials() {
    let sets = [
        "materials.box/wall#2.MetallicRoughness.roughness=0.25",
        "entities.box/wall.LocalTransform.translate=(4, 5, 6)",
        "camera.PerspectiveCamera.vfov_deg=33",
    ];
    let mut got = load(&[("box.gltf", GLTF)], &sets);
    assert!(got.ok, "{:#?}", got.said);
    let mut materials = got.world.query::<(&Name, &MetallicRoughness)>();
    let found =
        |m: (&Name, &MetallicRoughness)| (m.0.as_str() == "box/wall#2").then_some(m.1.roughness);
    assert_eq!(materials.iter(&got.world).find_map(found), Some(0.25));
    let mut nodes = got.world.query::<(&Name, &LocalTransform)>();
    let found = |n: (&Name, &LocalTransform)| (n.0.as_str() == "box/wall").then_some(n.1.translate);
    assert_eq!(
        nodes.iter(&got.world).find_map(found),
        Some([4.0, 5.0, 6.0])
    );
    assert_eq!(
        got.get::<PerspectiveCamera>("box/node").vfov_deg,
        Some(33.0)
    );
}

#[test]
fn parts_of_several_materials_hang_below_their_node() {
    let scene = r#"(
        models: [(name: "t", path: "m/t.obj", transform: (scale: 2, translate: (0, 1, 0)))],
        entities: {"gold": {"Lambert": ()}},
        overrides: {
            "materials.t/blue.Lambert.reflectance": (0, 0, 0.75),
            "materials.t/red.dark": {"Lambert": (reflectance: 0.125)},
            "entities.t/red.dark.MaterialRef": "gold",
        },
    )"#;
    let mut got = with_obj(scene, &[]).clean();
    let local = got.get::<LocalTransform>("t");
    assert_eq!((local.scale, local.translate), ([2.0; 3], [0.0, 1.0, 0.0]));
    let both = got.entity("t/both");
    assert_eq!(got.get::<ChildOf>("t/both#0").parent(), both);
    let blue = got.get::<MaterialRef>("t/both#1").0;
    let lambert = got.world.get::<Lambert>(blue).expect("a lobe");
    assert_eq!(lambert.reflectance, Rgb([0.0, 0.0, 0.75]));
    let red = got.get::<MaterialRef>("t/both#0").0;
    let lambert = got.world.get::<Lambert>(red).expect("a lobe");
    assert_eq!(lambert.reflectance, Rgb::splat(0.125));
    let span = got
        .world
        .get::<SourceSpan>(blue)
        .expect("a place")
        .to_string();
    assert!(span.ends_with("t.obj"), "{span}");
}

#[test]
fn a_models_material_can_be_replaced_as_a_whole() {
    let scene = r#"(
        models: [(path: "m/t.obj")],
        entities: {"gold": {"Lambert": ()}, "x": {"Sphere": (), "MaterialRef": "t/blue"}},
        overrides: {"entities.t.MaterialRef": "gold"},
    )"#;
    let mut got = with_obj(scene, &[]).clean();
    let gold = got.entity("gold");
    let mut meshes = got
        .world
        .query_filtered::<&MaterialRef, With<TriangleMesh>>();
    assert_eq!(meshes.iter(&got.world).count(), 3);
    assert!(meshes.iter(&got.world).all(|m| m.0 == gold));
    assert_ne!(got.get::<MaterialRef>("x").0, gold);
}

#[test]
fn a_dangling_material_name_lists_the_nearest() {
    let scene = r#"(
        models: [(name: "t", path: "m/t.obj"), (path: "m/u.obj"), (path: "m/t.mtl")],
        entities: {"x": {"Sphere": (), "MaterialRef": "t/blu"}, "y": {"Sphere": (), "MaterialRef": "u/blue"}},
        overrides: {
            "materials.t/red_dark.Lambert.reflectance": 0.5,
            "materials.u/red.Lambert.reflectance": 0.5,
        },
    )"#;
    let got = with_obj(scene, &[]);
    assert_eq!(
        got.said,
        [
            "a.scene.ron:2:55: error: models.u.path: `m/u.obj`: there is no such file; did you \
             mean `m/t.obj`?",
            "a.scene.ron:2:67: error: models: another model is called `t` already; give it a \
             `name` of its own",
            "a.scene.ron:3:55: error: entities.x.MaterialRef: there is no entity `t/blu`; did you \
             mean `t/blue`?",
            "a.scene.ron:5:13: error: materials.t/red_dark.Lambert.reflectance: there is no \
             material `t/red_dark`; did you mean `t/red.dark`?",
        ]
    );
}

#[test]
fn a_bare_model_is_a_scene() {
    let files = [("t.obj", TRIANGLES), ("t.mtl", MATERIALS)];
    let mut got = load(&files, &["entities.t.LocalTransform.scale=3"]).clean();
    assert_eq!(got.get::<LocalTransform>("t").scale, [3.0; 3]);
    let got = load(&[("c.ron", "(scene: \"t.obj\")"), files[0], files[1]], &[]);
    got.clean();
}

#[test]
fn the_scene_files_camera_comes_before_a_models() {
    let scene = r#"(models: [(path: "box.gltf")], entities: {"mine": {"PerspectiveCamera": ()}})"#;
    let mut got = load(&[("a.scene.ron", scene), ("box.gltf", GLTF)], &[]);
    assert!(got.ok && got.has::<ActiveCamera>("mine") && !got.has::<ActiveCamera>("box/node"));
}
