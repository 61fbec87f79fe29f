//! Shading normals as files have them, made into unit vectors.

use sr_scene::components::TriangleMesh;

/// Gives normals length 1, and those that have none, or are not finite, the direction of the faces
/// around them. Returns how many those were.
pub(crate) fn unit_normals(mesh: &mut TriangleMesh) -> usize {
    let mut without = Vec::new();
    for (v, n) in mesh.normals.iter_mut().enumerate() {
        match unit(n.map(f64::from)) {
            Some(u) => *n = u,
            None => without.push(v),
        }
    }
    if without.is_empty() {
        return 0;
    }
    // Summed over faces, weighted by area; computed for all vertices, but this is rare.
    let mut sums = vec![[0.0f64; 3]; mesh.positions.len()];
    for triangle in &mesh.indices {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize].map(f64::from));
        let normal = cross(minus(b, a), minus(c, a));
        for &v in triangle {
            for (sum, n) in sums[v as usize].iter_mut().zip(normal) {
                *sum += n;
            }
        }
    }
    for &v in &without {
        // Without area around it any direction will do.
        mesh.normals[v] = unit(sums[v]).unwrap_or([0.0, 0.0, 1.0]);
    }
    without.len()
}

fn unit(v: [f64; 3]) -> Option<[f32; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| (x / length) as f32))
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_between_faces_gets_their_normals_weighted_by_area() {
        // Three triangles around the origin, in the coordinate planes; the one in z = 0 is larger.
        let mut mesh = TriangleMesh {
            positions: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]],
            normals: vec![
                [0.0; 3],
                [3.0, 0.0, 0.0],
                [0.0, 1e-30, 0.0],
                [0.0, f32::INFINITY, 1.0],
            ],
            indices: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]],
        };
        assert_eq!(unit_normals(&mut mesh), 2);
        let third = [1.0 / 6f32.sqrt(), 1.0 / 6f32.sqrt(), 2.0 / 6f32.sqrt()];
        let close = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(close(mesh.normals[0], third), "{:?}", mesh.normals[0]);
        assert_eq!(mesh.normals[1], [1.0, 0.0, 0.0]);
        assert_eq!(
            mesh.normals[2],
            [0.0, 1.0, 0.0],
            "short is not the same as none"
        );
        let half = 0.5f32.sqrt();
        assert!(
            close(mesh.normals[3], [half, half, 0.0]),
            "{:?}",
            mesh.normals[3]
        );
    }
}
