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

/// A closed box, of quads and of triangles.
fn boxes(min: Vec3, max: Vec3) -> [Accel; 2] {
    let corner = |i: u32| box_corner(min, max, i);
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
    [quads, triangles].map(|g| Accel::build(g, &BuildSettings::default()))
}

/// Bit k of `i` says which end of axis k.
fn box_corner(min: Vec3, max: Vec3, i: u32) -> Vec3 {
    let end = |k: usize| if i >> k & 1 == 0 { min[k] } else { max[k] };
    Vec3::new(end(0), end(1), end(2))
}

/// How many of so many rays from inside escape.
fn escapes_from_box(accel: &Accel, rays: u32, ray: impl Fn(u32) -> Ray + Sync) -> usize {
    let bounds = accel.bounds();
    let lost = |&i: &u32| {
        let ray = ray(i);
        let inside = ray.o.cmpgt(bounds.min).all() && ray.o.cmplt(bounds.max).all();
        inside && !(accel.closest_one(&ray).is_hit() && accel.occluded_one(&ray))
    };
    (0..rays).into_par_iter().filter(lost).count()
}

/// Walls that meet at right angles, whose boxes have no thickness and end at the very edges that
/// are aimed at, from 10⁻⁶ of the way from the edge to all of the way to the middle.
#[test]
fn no_ray_escapes_from_a_box_of_quads_or_triangles() {
    let (min, max) = (Vec3::splat(-5.0), Vec3::splat(5.0));
    for accel in boxes(min, max) {
        let ray = |i: u32| {
            let (a, axis) = (mix(i, 0) % 8, mix(i, 1) % 3);
            let b = box_corner(min, max, a ^ (1 << axis));
            let a = box_corner(min, max, a);
            let target = a + unit(i, 2) * (b - a);
            let inward = 10f32.powf(-6.0 * unit(i, 3));
            let o = (target + in_cube(i, 4)).clamp(0.98 * min, 0.98 * max);
            let o = target + (o - target) * inward;
            Ray {
                o,
                t_max: f32::INFINITY,
                d: target - o,
            }
        };
        assert_eq!(escapes_from_box(&accel, 600_000, ray), 0);
    }
}

/// Down a corridor, next to one of its long edges: there the edge tests, whose vertices are far,
/// are coarser than the slabs, whose planes are near. A box that were culled by what the slabs say
/// alone would lose the hit that the edge tests assign to its wall.
#[test]
fn no_ray_escapes_where_slabs_are_sharper_than_edge_tests() {
    let (min, max) = (Vec3::new(-10.0, -10.0, -1e3), Vec3::new(0.01, 0.01, 1e3));
    for accel in boxes(min, max) {
        let ray = |i: u32| {
            let target = Vec3::new(0.01, 0.01, 5.0 + 45.0 * unit(i, 0));
            // The resolution of the edge tests there is some 10⁻⁷.
            let target = target + in_cube(i, 1) * 3e-7;
            let o = in_cube(i, 4) * 1e-3;
            Ray {
                o,
                t_max: f32::INFINITY,
                d: target - o,
            }
        };
        assert_eq!(escapes_from_box(&accel, 300_000, ray), 0);
    }
}
