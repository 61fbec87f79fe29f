//! Ten million rays from inside closed meshes at their edges and vertices: none is lost.
//!
//! Ordinary triangle tests lose about a tenth of such rays, so every one that escapes is a defect
//! and no rate is tolerated.

use crate::globe::globe;
use crate::icosphere::icosphere;
use crate::{in_cube, unit};
use glam::Vec3;
use rayon::prelude::*;
use sr_accel::{Accel, BuildSettings, Geometry, Hit, QuadShape, Ray};
use sr_math::hash::mix;

const BATCH: u32 = 4096;

/// Moves and scales a mesh, then counts the rays of so many batches that escape from it.
fn escapes(mut mesh: Geometry, scale: f32, offset: Vec3, batches: u32) -> usize {
    for p in &mut mesh.positions {
        *p = *p * scale + offset;
    }
    let accel = Accel::build(mesh, &BuildSettings::default());
    (0..batches)
        .into_par_iter()
        .map(|batch| {
            let rays: Vec<Ray> = (0..BATCH)
                .map(|i| ray_at_edge(accel.geometry(), scale, offset, mix(batch, i)))
                .collect();
            let mut hits = vec![Hit::MISS; rays.len()];
            accel.closest(&rays, &mut hits);
            let mut occluded = vec![false; rays.len()];
            // Any-hit takes other ways through the tree; an eighth of the batches is enough.
            if batch % 8 == 0 {
                accel.occluded(&rays, &mut occluded);
            } else {
                occluded.fill(true);
            }
            let lost = |(hit, shadow): (&Hit, &bool)| !hit.is_hit() || !shadow;
            hits.iter().zip(&occluded).filter(|&p| lost(p)).count()
        })
        .sum()
}

/// From within a third of the radius, half of the rays to a vertex, half to a point on an edge.
fn ray_at_edge(mesh: &Geometry, scale: f32, offset: Vec3, key: u32) -> Ray {
    let t = mesh.triangles[mix(key, 0) as usize % mesh.triangles.len()];
    let corner = mix(key, 1) as usize;
    let [a, b] = [corner % 3, (corner + 1) % 3].map(|k| mesh.positions[t[k] as usize]);
    let target = if key & 1 == 0 {
        a
    } else {
        a + unit(key, 2) * (b - a)
    };
    let o = offset + in_cube(key, 3) * (0.2 * scale);
    Ray {
        o,
        t_max: f32::INFINITY,
        d: target - o,
    }
}

#[test]
fn no_ray_escapes_from_an_icosphere() {
    assert_eq!(escapes(icosphere(5), 1.0, Vec3::ZERO, 1300), 0);
}

#[test]
fn no_ray_escapes_through_needles_at_the_poles() {
    assert_eq!(escapes(globe(100, 200), 1.0, Vec3::ZERO, 500), 0);
}

#[test]
fn no_ray_escapes_far_from_the_origin() {
    let away = Vec3::new(0.8, -0.9, 1.0);
    assert_eq!(escapes(icosphere(5), 1e3, away * 1e5, 250), 0);
    assert_eq!(escapes(icosphere(5), 1e3, away * 1e6, 250), 0);
    assert_eq!(escapes(icosphere(4), 1e-3, away, 150), 0);
}

/// The walls of a box that meet at right angles, from points very near to an edge and far from it:
/// boxes of no thickness whose borders are the very edges that are aimed at.
#[test]
fn no_ray_escapes_from_a_box_of_quads_or_triangles() {
    let corner = |i: u32| {
        let bit = |k: u32| if i >> k & 1 == 0 { -1.0 } else { 1.0 };
        Vec3::new(bit(0), bit(1), bit(2)) * 5.0
    };
    let mut quads = Geometry::default();
    let mut triangles = Geometry {
        positions: (0..8).map(corner).collect(),
        ..Geometry::default()
    };
    for axis in 0..3u32 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for base in [0, 1 << axis] {
            quads.quads.push(QuadShape {
                corner: corner(base),
                edge_u: corner(base | u) - corner(base),
                edge_v: corner(base | v) - corner(base),
            });
            let (a, b, c, d) = (base, base | u, base | u | v, base | v);
            triangles.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    for g in [quads, triangles] {
        let accel = Accel::build(g, &BuildSettings::default());
        let lost = (0..600_000u32).into_par_iter().filter(|&i| {
            let (a, axis) = (mix(i, 0) % 8, mix(i, 1) % 3);
            let (a, b) = (corner(a), corner(a ^ (1 << axis)));
            let target = a + unit(i, 2) * (b - a);
            // From 10⁻⁶ to all of the way to the middle, and to the side along the edge.
            let inward = 10f32.powf(-6.0 * unit(i, 3));
            let o = (target + in_cube(i, 4)).clamp(Vec3::splat(-4.9), Vec3::splat(4.9));
            let o = target + (o - target) * inward;
            let ray = Ray {
                o,
                t_max: f32::INFINITY,
                d: target - o,
            };
            let inside = o.abs().max_element() < 5.0;
            inside && !(accel.closest_one(&ray).is_hit() && accel.occluded_one(&ray))
        });
        assert_eq!(lost.count(), 0);
    }
}
