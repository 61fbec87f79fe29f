use super::*;
use std::collections::HashMap;

const ALL: &[Shape] = &[
    Shape::Knot,
    Shape::Blob,
    Shape::Ring,
    Shape::Pawn,
    Shape::Brilliant,
    Shape::StepCut,
];

/// Corners by place: vertices that only normals tell apart are one.
fn places(mesh: &Mesh) -> Vec<[u64; 3]> {
    // 2⁻³⁰ m tells vertices apart and is far above the rounding of one computed twice; adding 0
    // makes one zero of two.
    let grid = |x: f64| ((x * 2f64.powi(30)).round() + 0.0).to_bits();
    let places = mesh.positions.iter();
    places.map(|p| p.to_array().map(grid)).collect()
}

/// Each edge is walked once in each direction: no hole, and one outside.
#[test]
fn every_mesh_is_closed_and_its_front_is_outside() {
    for &shape in ALL {
        let mesh = build(shape, None);
        let places = places(&mesh);
        let mut edges: HashMap<_, i32> = HashMap::new();
        let mut volume = 0.0;
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            assert!(
                (b - a).cross(c - a).length() > 1e-12,
                "{shape:?}: {a} {b} {c}"
            );
            volume += a.dot(b.cross(c)) / 6.0;
            for k in 0..3 {
                let [from, to] = [t[k], t[(k + 1) % 3]].map(|i| places[i as usize]);
                assert!(from != to, "{shape:?}");
                *edges.entry((from, to)).or_default() += 1;
                *edges.entry((to, from)).or_default() -= 1;
            }
        }
        assert!(edges.values().all(|n| *n == 0), "{shape:?} is open");
        assert!(volume > 0.05 && volume < 1.0, "{shape:?}: {volume}");
    }
}

#[test]
fn every_mesh_stands_on_the_ground_over_the_origin() {
    for &shape in ALL {
        let mesh = build(shape, None);
        let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let ends = mesh
            .positions
            .iter()
            .fold(first, |(lo, hi), p| (lo.min(*p), hi.max(*p)));
        assert!(ends.0.y.abs() < 1e-12, "{shape:?}: {}", ends.0);
        let middle = 0.5 * (ends.0 + ends.1);
        assert!(middle.x.hypot(middle.z) < 0.1, "{shape:?}: {middle}");
        assert!(mesh.normals.iter().all(|n| n.is_normalized()), "{shape:?}");
    }
}

/// Normals point to the side that the triangles do.
#[test]
fn normals_follow_the_surface() {
    for &shape in ALL {
        let mesh = build(shape, None);
        if mesh.normals.is_empty() {
            continue;
        }
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let face = (b - a).cross(c - a).normalize();
            for i in t {
                let n = mesh.normals[*i as usize];
                // 84°: in the pawn's neck, which is a crease, a triangle turns far.
                assert!(face.dot(n) > 0.1, "{shape:?}: {a} {face} {n}");
            }
        }
    }
}

/// The facets of a stone are plane, and it is convex.
#[test]
fn stones_are_convex() {
    for shape in [Shape::Brilliant, Shape::StepCut] {
        let mesh = build(shape, None);
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let n = (b - a).cross(c - a).normalize();
            for p in &mesh.positions {
                assert!((*p - a).dot(n) < 1e-12, "{shape:?}: {a} {n} {p}");
            }
        }
    }
    let mains_and_stars = 57 + 16;
    let triangles = build(Shape::Brilliant, None).triangles.len();
    // A table of 6 triangles, 16 kites and 16 girdle facets of 2, 40 facets of 1; 73 facets.
    assert_eq!(triangles, 6 + 2 * (mains_and_stars - 1 - 40) + 40);
}

#[test]
fn a_size_can_be_asked_for() {
    for shape in [Shape::Knot, Shape::Blob, Shape::Ring, Shape::Pawn] {
        for wanted in [1_000u64, 50_000] {
            let got = build(shape, Some(wanted)).triangles.len() as f64 / wanted as f64;
            assert!((0.85..1.15).contains(&got), "{shape:?} {wanted}: {got}");
        }
    }
    let args = |shape, triangles| MeshArgs {
        shape,
        output: "x.glb".into(),
        triangles,
    };
    assert!(encode(&args(Shape::Knot, Some(99))).is_err());
    assert!(encode(&args(Shape::Brilliant, Some(1000))).is_err());
}

/// What lies in `scenes/` is what the commands in the scene files make.
#[test]
fn the_meshes_of_the_scenes_are_these() {
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    for (shape, file) in [
        (Shape::Knot, "cornell_knot/knot.glb"),
        (Shape::Blob, "unlit/blob.glb"),
        (Shape::Ring, "caustics/ring.glb"),
        (Shape::Pawn, "focus_row/pawn.glb"),
        (Shape::Brilliant, "gems/brilliant.glb"),
        (Shape::StepCut, "gems/step_cut.glb"),
    ] {
        let args = MeshArgs {
            shape,
            output: scenes.join(file),
            triangles: None,
        };
        let (bytes, _) = encode(&args).expect("arguments that make sense");
        let committed = std::fs::read(&args.output).expect("a file of the repository");
        assert!(bytes == committed, "{file} is not what is made today");
    }
}
