//! A closed bumpy sphere of nearly equal triangles.

use glam::Vec3;
use sr_accel::Geometry;
use std::collections::HashMap;

/// 20 · 4ˡᵉᵛᵉˡ triangles around the origin, of radius about 1.
pub fn icosphere(level: u32) -> Geometry {
    let g = 0.5 * (1.0 + 5f32.sqrt());
    let mut positions: Vec<Vec3> = Vec::new();
    for (a, b) in [(1.0, g), (1.0, -g), (-1.0, g), (-1.0, -g)] {
        positions.extend([
            Vec3::new(a, b, 0.0),
            Vec3::new(0.0, a, b),
            Vec3::new(b, 0.0, a),
        ]);
    }
    for p in &mut positions {
        *p = p.normalize();
    }
    // The faces are the triples of vertices that are neighbours of one another.
    let near = |i: usize, j: usize| positions[i].distance(positions[j]) < 1.1;
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(i, j) && near(j, k) && near(i, k) {
                    let (p, q, r) = (positions[i], positions[j], positions[k]);
                    let outward = (q - p).cross(r - p).dot(p) > 0.0;
                    let (j, k) = if outward { (j, k) } else { (k, j) };
                    triangles.push([i as u32, j as u32, k as u32]);
                }
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    for _ in 0..level {
        triangles = divide(&mut positions, &triangles);
    }
    for p in &mut positions {
        let bump = (9.0 * p.x).sin() * (8.0 * p.y).cos() * (7.0 * p.z + 1.0).sin();
        *p *= 1.0 + 0.1 * bump;
    }
    Geometry {
        positions,
        triangles,
        ..Geometry::default()
    }
}

/// Each triangle into four; an edge's middle is shared by both its triangles.
fn divide(positions: &mut Vec<Vec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let p = (positions[a as usize] + positions[b as usize]).normalize();
            positions.push(p);
            positions.len() as u32 - 1
        })
    };
    let mut out = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        out.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    out
}
