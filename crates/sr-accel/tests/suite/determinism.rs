//! Answers do not depend on threads, on the tree, or on the company of a ray.

use crate::agreement::{ray_through, soup};
use crate::globe::globe;
use crate::icosphere::icosphere;
use crate::{direction, in_cube};
use glam::Vec3;
use rayon::prelude::*;
use sr_accel::{Accel, BuildSettings, Geometry, Hit, QuadShape, Quality, Ray, SphereShape};
use sr_math::hash::mix;

fn bits(h: &Hit) -> [u32; 4] {
    [h.t.to_bits(), h.u.to_bits(), h.v.to_bits(), h.prim]
}

fn all_bits(accel: &Accel, rays: &[Ray]) -> Vec<[u32; 4]> {
    let mut hits = vec![Hit::MISS; rays.len()];
    accel.closest(rays, &mut hits);
    hits.iter().map(bits).collect()
}

/// Large enough that the builder works in parallel, which it does from 100 000 and 300 000
/// primitives on; with as many spheres and quads again as there are rays that find them.
fn large() -> Geometry {
    let mut g = globe(400, 450);
    g.spheres = (0..2000)
        .map(|i| SphereShape {
            center: direction(i, 0) * 1.1,
            radius: 0.02,
        })
        .collect();
    g.quads = (0..2000)
        .map(|i| QuadShape {
            corner: direction(i, 2) * 0.9,
            edge_u: in_cube(i, 4) * 0.05,
            edge_v: in_cube(i, 7) * 0.05,
        })
        .collect();
    g
}

/// Half at random, half at vertices, where several triangles tie.
fn rays_for(g: &Geometry, count: u32) -> Vec<Ray> {
    let ray = |i: u32| {
        if i.is_multiple_of(2) {
            return ray_through(i);
        }
        let target = g.positions[mix(i, 0) as usize % g.positions.len()];
        let o = in_cube(i, 1) * 2.0;
        Ray {
            o,
            t_max: f32::INFINITY,
            d: target - o,
        }
    };
    (0..count).map(ray).collect()
}

#[test]
fn hits_are_bit_identical_for_1_2_and_7_threads() {
    let rays = rays_for(&large(), 100_000);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads are available");
        pool.install(|| all_bits(&Accel::build(large(), &BuildSettings::default()), &rays))
    };
    let one = run(1);
    assert!(one.iter().filter(|h| h[3] < u32::MAX).count() > 50_000);
    assert!(run(2) == one, "2 threads differ from 1");
    assert!(run(7) == one, "7 threads differ from 1");
}

#[test]
fn hits_are_bit_identical_for_every_build_quality() {
    let mut g = icosphere(4);
    let others = soup(0, 100, 100);
    (g.spheres, g.quads) = (others.spheres, others.quads);
    let rays = rays_for(&g, 200_000);
    let [a, b, c] = [Quality::Fast, Quality::Balanced, Quality::High]
        .map(|quality| all_bits(&Accel::build(g.clone(), &BuildSettings { quality }), &rays));
    assert!(a == b, "Fast differs from Balanced");
    assert!(c == b, "High differs from Balanced");
}

/// The tree against no tree: each primitive alone, the best hit of all taken by `t`, then by id.
/// A box that culls a hit shows here, and so does a tie broken by the order of the visit.
#[test]
fn hits_are_bit_identical_to_testing_every_primitive() {
    let mut g = icosphere(2);
    let others = soup(0, 40, 40);
    (g.spheres, g.quads) = (others.spheres, others.quads);
    // A twin of every fourth triangle, so that everything there ties.
    let twins: Vec<_> = g.triangles.iter().step_by(4).copied().collect();
    g.triangles.extend(twins);
    let alone: Vec<Accel> = (0..g.prim_count() as u32)
        .map(|prim| {
            let mut one = Geometry {
                positions: g.positions.clone(),
                ..Geometry::default()
            };
            match g.kind(prim) {
                sr_accel::Prim::Triangle(i) => one.triangles.push(g.triangles[i as usize]),
                sr_accel::Prim::Sphere(i) => one.spheres.push(g.spheres[i as usize]),
                sr_accel::Prim::Quad(i) => one.quads.push(g.quads[i as usize]),
            }
            Accel::build(one, &BuildSettings::default())
        })
        .collect();
    let rays = rays_for(&g, 40_000);
    let tree = all_bits(&Accel::build(g, &BuildSettings::default()), &rays);
    rays.par_iter().zip(&tree).for_each(|(ray, found)| {
        let mut best = Hit::MISS;
        for (prim, accel) in alone.iter().enumerate() {
            let hit = accel.closest_one(ray);
            if hit.is_hit() && hit.t < best.t {
                best = Hit {
                    prim: prim as u32,
                    ..hit
                };
            }
        }
        assert_eq!(*found, bits(&best), "{ray:?}");
    });
}

#[test]
fn coincident_triangles_give_the_smallest_id() {
    let g = Geometry {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]; 100],
        ..Geometry::default()
    };
    let accel = Accel::build(g, &BuildSettings::default());
    for i in 0..1000 {
        let o = in_cube(i, 0) + Vec3::Z * 2.0;
        let ray = Ray {
            o,
            t_max: f32::INFINITY,
            d: Vec3::new(0.3, 0.3, 0.0) - o,
        };
        assert_eq!(accel.closest_one(&ray).prim, 0);
    }
}
