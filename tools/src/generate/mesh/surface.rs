//! Free surfaces: a knot and a blob.

use super::Mesh;
use super::grid::{Ends, resolution, sweep};
use glam::DVec3;
use std::f64::consts::TAU;

/// Step of central differences in parameters and lengths of about 1: errors of about 10⁻¹⁰.
const STEP: f64 = 1e-5;

/// A tube along the (2, 3) torus knot, with five flutes that wind about it.
pub(super) fn knot(triangles: u64) -> Mesh {
    let mesh = sweep(resolution(triangles, 12.0), Ends::Meet, |s, t| {
        let d = |ds: f64, dt: f64| tube(s + ds, t + dt);
        let along = d(STEP, 0.0) - d(-STEP, 0.0);
        let around = d(0.0, STEP) - d(0.0, -STEP);
        (tube(s, t), along.cross(around).normalize())
    });
    mesh.standing(Some(1.0))
}

/// A point of the tube; its cross-section is a circle with a wave of five periods.
fn tube(s: f64, t: f64) -> DVec3 {
    let center = strand(s);
    let tangent = (strand(s + STEP) - strand(s - STEP)).normalize();
    // The normal of the torus that the knot lies on turns with it and closes with it.
    let core = DVec3::new(center.x, center.y, 0.0).normalize();
    let torus = center - core;
    let normal = (torus - tangent * torus.dot(tangent)).normalize();
    let binormal = tangent.cross(normal);
    // Against the tangent, so that the front is outside.
    let angle = -TAU * t;
    let radius = 0.28 + 0.045 * (5.0 * angle + 3.0 * TAU * s).cos();
    center + (normal * angle.cos() + binormal * angle.sin()) * radius
}

/// The knot: twice about the axis z, three times about the core of a torus, a lobe at the top.
fn strand(s: f64) -> DVec3 {
    let (twice, thrice) = (2.0 * TAU * s + 0.25 * TAU, 3.0 * TAU * s);
    let reach = 1.0 + 0.46 * thrice.cos();
    DVec3::new(
        reach * twice.cos(),
        reach * twice.sin(),
        0.46 * thrice.sin(),
    )
}

/// A ball whose radius follows Schoen's gyroid, `sin x cos y + sin y cos z + sin z cos x` (Schoen
/// 1970), on six grids.
pub(super) fn blob(triangles: u64) -> Mesh {
    let cells = ((triangles as f64 / 12.0).sqrt().round() as u32).max(3);
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            face(&mut mesh, cells, axis, side);
        }
    }
    mesh.standing(Some(1.0))
}

/// One face of the cube around the blob, pushed onto it. Angles, not lengths, are evenly spaced.
fn face(mesh: &mut Mesh, cells: u32, axis: usize, side: f64) {
    let first = mesh.positions.len() as u32;
    let at = |k: u32| (0.125 * TAU * (2.0 * f64::from(k) / f64::from(cells) - 1.0)).tan();
    for i in 0..=cells {
        for j in 0..=cells {
            let mut p = [0.0; 3];
            // Turned so that counter-clockwise is outside on both sides.
            p[axis] = side;
            p[(axis + 1) % 3] = at(i) * side;
            p[(axis + 2) % 3] = at(j);
            let way = DVec3::from_array(p).normalize();
            mesh.positions.push(way * reach(way));
            mesh.normals.push(blob_normal(way));
        }
    }
    for i in 0..cells {
        for j in 0..cells {
            let vertex = |i: u32, j: u32| first + i * (cells + 1) + j;
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

/// Radius of the blob in a direction.
fn reach(way: DVec3) -> f64 {
    let p = way * 4.2 + DVec3::new(0.4, 1.1, 0.7);
    let gyroid = p.x.sin() * p.y.cos() + p.y.sin() * p.z.cos() + p.z.sin() * p.x.cos();
    1.0 + 0.22 * gyroid
}

/// The gradient of `|p| − reach(p/|p|)` on the blob.
fn blob_normal(way: DVec3) -> DVec3 {
    let p = way * reach(way);
    let outside = |p: DVec3| p.length() - reach(p.normalize());
    let slope = |axis: DVec3| outside(p + axis * STEP) - outside(p - axis * STEP);
    DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize()
}
