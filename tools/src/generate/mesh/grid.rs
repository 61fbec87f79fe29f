//! Surfaces over a rectangle of two parameters, closed in the second or in both.

use super::Mesh;
use glam::DVec3;

/// How the first parameter ends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// It begins again.
    Meet,
    /// At a point each.
    Poles,
}

/// Rows and columns of about so many triangles, `ratio` times as many rows as columns.
pub(super) fn resolution(triangles: u64, ratio: f64) -> (u32, u32) {
    let columns = (triangles as f64 / 2.0 / ratio).sqrt().max(3.0).round();
    let rows = (triangles as f64 / 2.0 / columns).max(3.0).round();
    (rows as u32, columns as u32)
}

/// The surface `at(s, t)`, position and normal of unit length, both parameters from 0 to 1; `∂s ×
/// ∂t` must point outside.
pub(super) fn sweep(
    (rows, columns): (u32, u32),
    ends: Ends,
    at: impl Fn(f64, f64) -> (DVec3, DVec3),
) -> Mesh {
    let mut mesh = Mesh::default();
    let lines = if ends == Ends::Meet { rows } else { rows + 1 };
    for i in 0..lines {
        for j in 0..columns {
            let (p, n) = at(
                f64::from(i) / f64::from(rows),
                f64::from(j) / f64::from(columns),
            );
            mesh.positions.push(p);
            mesh.normals.push(n);
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            let vertex = |i: u32, j: u32| (i % lines) * columns + j % columns;
            let [a, b] = [vertex(i, j), vertex(i, j + 1)];
            let [c, d] = [vertex(i + 1, j), vertex(i + 1, j + 1)];
            let first_is_pole = ends == Ends::Poles && i == 0;
            let last_is_pole = ends == Ends::Poles && i + 1 == rows;
            // A pole is a whole row of vertices at one place.
            if !last_is_pole {
                mesh.triangles.push([a, c, d]);
            }
            if !first_is_pole {
                mesh.triangles.push([a, d, b]);
            }
        }
    }
    mesh
}
