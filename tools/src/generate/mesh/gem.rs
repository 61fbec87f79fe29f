//! Cut stones: convex and faceted, every facet a plane of its own.

use super::Mesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// A facet, counter-clockwise from outside; vertices are its own, for facets share no normals.
fn facet(mesh: &mut Mesh, corners: &[DVec3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    let fan = 1..corners.len() as u32 - 1;
    mesh.triangles
        .extend(fan.map(|k| [first, first + k, first + k + 1]));
}

/// At an angle about the axis y, counted from +z towards +x in sixteenths.
fn around(sixteenth: usize, radius: f64, y: f64) -> DVec3 {
    let (sin, cos) = (TAU / 16.0 * (sixteenth % 16) as f64).sin_cos();
    DVec3::new(radius * sin, y, radius * cos)
}

/// The 57 facets of the round brilliant with the proportions of Tolkowsky (1919, "Diamond
/// Design"): table 53 % of the width, crown 34.5°, pavilion 40.75°; stars reach half way to the
/// girdle, lower halves three quarters down. The point is at the origin, so that each of the eight
/// main facets below passes through it; one rises along +z.
pub(super) fn brilliant() -> Mesh {
    let (crown, pavilion) = (34.5f64.to_radians().tan(), 40.75f64.to_radians().tan());
    let (table, girdle) = (0.53, 0.02);
    let eighth = (TAU / 16.0).cos();
    // In radii, above the point; halved at the end.
    let below = pavilion;
    let above = below + girdle;
    let top = above + (1.0 - table) * crown;
    // A point of the edge between two main facets lies on both planes, `eighth` as far along each.
    let on_crown = |radius: f64| above + (1.0 - radius * eighth) * crown;
    let on_pavilion = |radius: f64| radius * eighth * pavilion;
    let star = 0.5 * (1.0 + table * eighth);
    let half = 0.25;
    let mut mesh = Mesh::default();
    facet(
        &mut mesh,
        &[0, 2, 4, 6, 8, 10, 12, 14].map(|k| around(k, table, top)),
    );
    for main in (0..16).step_by(2) {
        let [before, after, next] = [main + 15, main + 1, main + 2];
        let upper = |k| around(k, star, on_crown(star));
        let lower = |k| around(k, half, on_pavilion(half));
        let rim = |k| [around(k, 1.0, below), around(k, 1.0, above)];
        let corner = around(main, table, top);
        facet(
            &mut mesh,
            &[corner, upper(before), rim(main)[1], upper(after)],
        );
        facet(&mut mesh, &[corner, upper(after), around(next, table, top)]);
        facet(&mut mesh, &[upper(after), rim(main)[1], rim(after)[1]]);
        facet(&mut mesh, &[upper(after), rim(after)[1], rim(next)[1]]);
        facet(
            &mut mesh,
            &[rim(main)[0], rim(after)[0], rim(after)[1], rim(main)[1]],
        );
        facet(
            &mut mesh,
            &[rim(after)[0], rim(next)[0], rim(next)[1], rim(after)[1]],
        );
        facet(&mut mesh, &[rim(main)[0], lower(after), rim(after)[0]]);
        facet(&mut mesh, &[lower(after), rim(next)[0], rim(after)[0]]);
        facet(
            &mut mesh,
            &[rim(main)[0], lower(before), DVec3::ZERO, lower(after)],
        );
    }
    for p in &mut mesh.positions {
        *p *= 0.5;
    }
    mesh
}

/// Sizes and heights of the steps of [`step_cut`], from the flat end to the table.
const STEPS: [(f64, f64); 7] = [
    (0.06, 0.0),
    (0.42, 0.18),
    (0.76, 0.39),
    (1.0, 0.58),
    (1.0, 0.61),
    (0.87, 0.71),
    (0.72, 0.78),
];

/// Rectangles with cut corners, one over the other.
pub(super) fn step_cut() -> Mesh {
    let (long, wide, cut) = (0.65, 0.5, 0.2);
    let outline = [
        [long, -wide + cut],
        [long, wide - cut],
        [long - cut, wide],
        [cut - long, wide],
        [-long, wide - cut],
        [-long, cut - wide],
        [cut - long, -wide],
        [long - cut, -wide],
    ];
    let ring = |(size, y): (f64, f64)| outline.map(|[x, z]| DVec3::new(size * x, y, size * z));
    let mut mesh = Mesh::default();
    let rings = STEPS.map(ring);
    let mut table = rings[STEPS.len() - 1];
    table.reverse();
    facet(&mut mesh, &rings[0]);
    facet(&mut mesh, &table);
    for pair in rings.windows(2) {
        for k in 0..8 {
            let next = (k + 1) % 8;
            facet(
                &mut mesh,
                &[pair[0][k], pair[1][k], pair[1][next], pair[0][next]],
            );
        }
    }
    mesh
}
