//! Hits against brute force in f64.

use crate::{direction, in_cube, signed, unit};
use glam::Vec3;
use sr_accel::oracle::{OracleHit, brute_force_closest};
use sr_accel::{Accel, BuildSettings, Geometry, Hit, Prim, QuadShape, Ray, SphereShape};

/// Triangles, spheres and quads of sizes from 0.03 to 0.3 in the cube [−1, 1]³.
pub fn soup(triangles: u32, spheres: u32, quads: u32) -> Geometry {
    let mut g = Geometry::default();
    let size = |i: u32| 0.03 * 10f32.powf(unit(i, 90));
    for i in 0..triangles {
        let middle = in_cube(i, 0);
        let at = g.positions.len() as u32;
        g.triangles.push([at, at + 1, at + 2]);
        g.positions
            .extend([10, 20, 30].map(|k| middle + size(i) * in_cube(i, k)));
    }
    for i in 0..spheres {
        g.spheres.push(SphereShape {
            center: in_cube(i, 40),
            radius: size(i),
        });
    }
    for i in 0..quads {
        g.quads.push(QuadShape {
            corner: in_cube(i, 50),
            edge_u: in_cube(i, 60) * size(i),
            edge_v: in_cube(i, 70) * size(i),
        });
    }
    g
}

/// A ray through the cube, some of them limited, none of unit length.
pub fn ray_through(i: u32) -> Ray {
    let o = in_cube(i, 0) * 3.0;
    Ray {
        o,
        t_max: if i.is_multiple_of(4) {
            unit(i, 7)
        } else {
            f32::INFINITY
        },
        d: (in_cube(i, 3) - o) * (2.0 + signed(i, 8)),
    }
}

/// Whether two hits say the same but for the rounding of `t`.
fn same(hit: &Hit, exact: &OracleHit, tolerance: f64) -> bool {
    hit.prim == exact.prim && (!hit.is_hit() || (f64::from(hit.t) - exact.t).abs() <= tolerance)
}

/// Where they differ, a ray within the tests' resolution must give the same answer in f64: the
/// origin moved by γ₁₆ of the scene's size, in one of many directions. A wrong formula differs for
/// more than the one ray in 2000 that may touch a rim.
#[test]
fn all_shapes_agree_with_brute_force_in_f64() {
    let accel = Accel::build(soup(250, 60, 60), &BuildSettings::default());
    let rays: Vec<Ray> = (0..30_000).map(ray_through).collect();
    let mut hits = vec![Hit::MISS; rays.len()];
    accel.closest(&rays, &mut hits);
    let (mut found, mut rims) = (0, 0);
    for (i, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
        let exact = brute_force_closest(accel.geometry(), ray);
        found += usize::from(hit.is_hit());
        // The errors of `t` grow at grazing angles; a hit elsewhere differs by far more.
        if same(hit, &exact, 1e-4) {
            continue;
        }
        rims += 1;
        let agrees = (0..2000).any(|k| {
            let moved = Ray {
                o: ray.o + direction(i as u32, 100 + 2 * k) * (4.0 * 1e-6),
                ..*ray
            };
            same(hit, &brute_force_closest(accel.geometry(), &moved), 1e-3)
        });
        assert!(agrees, "ray {i}: {ray:?}\n{hit:?}\n{exact:?}");
    }
    assert!(found > 10_000, "{found} hits test nothing");
    assert!(rims <= 15, "{rims} rays at a rim");
}

#[test]
fn u_and_v_are_those_of_f64() {
    let accel = Accel::build(soup(250, 0, 100), &BuildSettings::default());
    let mut compared = 0;
    for i in 0..20_000 {
        let ray = ray_through(i);
        let hit = accel.closest_one(&ray);
        let exact = brute_force_closest(accel.geometry(), &ray);
        if !hit.is_hit() || hit.prim != exact.prim {
            continue;
        }
        let ng = accel.hit_point(&ray, &hit).ng;
        let cos = ng.dot(ray.d.normalize()).abs();
        // Points 4 away, seen with 10 u: that on an edge of 0.003 at least.
        let bound = 10.0 * 6e-8 * 4.0 / (0.003 * f64::from(cos));
        let (du, dv) = (f64::from(hit.u) - exact.u, f64::from(hit.v) - exact.v);
        assert!(du.abs() < bound && dv.abs() < bound, "{hit:?} {exact:?}");
        compared += 1;
    }
    assert!(compared > 5_000);
}

#[test]
fn any_hit_agrees_with_the_closest_hit() {
    let accel = Accel::build(soup(400, 80, 80), &BuildSettings::default());
    let rays: Vec<Ray> = (0..200_000).map(ray_through).collect();
    let mut hits = vec![Hit::MISS; rays.len()];
    let mut occluded = vec![false; rays.len()];
    accel.closest(&rays, &mut hits);
    accel.occluded(&rays, &mut occluded);
    for (i, (hit, any)) in hits.iter().zip(&occluded).enumerate() {
        assert_eq!(hit.is_hit(), *any, "ray {i}");
        if i % 16 == 0 {
            assert_eq!(accel.closest_one(&rays[i]), *hit);
            assert_eq!(accel.occluded_one(&rays[i]), *any);
        }
        // Limited to just before its hit it hits nothing, limited to its hit it does.
        if hit.is_hit() {
            let limited = |t_max| Ray { t_max, ..rays[i] };
            assert!(!accel.occluded_one(&limited(hit.t.next_down())));
            assert!(accel.occluded_one(&limited(hit.t)));
            assert_eq!(accel.closest_one(&limited(hit.t)), *hit);
        }
    }
}

#[test]
fn hit_points_lie_on_the_ray_and_on_the_surface_they_name() {
    let accel = Accel::build(soup(200, 100, 100), &BuildSettings::default());
    let g = accel.geometry();
    for i in 0..50_000 {
        let ray = ray_through(i);
        let hit = accel.closest_one(&ray);
        if !hit.is_hit() {
            continue;
        }
        let point = accel.hit_point(&ray, &hit);
        let p = point.p.as_dvec3();
        assert!((f64::from(point.ng.length()) - 1.0).abs() < 1e-6);
        let ng = point.ng.as_dvec3();
        let (off, n) = match g.kind(hit.prim) {
            Prim::Triangle(k) => {
                let [a, b, c] = g.triangle_vertices(k).map(|p| p.as_dvec3());
                let n = (b - a).cross(c - a).normalize();
                (n.dot(p - a), n)
            }
            Prim::Quad(k) => {
                let q = &g.quads[k as usize];
                let n = q.edge_u.as_dvec3().cross(q.edge_v.as_dvec3()).normalize();
                (n.dot(p - q.corner.as_dvec3()), n)
            }
            Prim::Sphere(k) => {
                let s = &g.spheres[k as usize];
                let from = p - s.center.as_dvec3();
                (from.length() - f64::from(s.radius), from.normalize())
            }
        };
        assert!(n.dot(ng) > 1.0 - 1e-6, "normal {ng} against {n}");
        let bound = n.abs().dot(point.p_err.as_dvec3());
        assert!(off.abs() <= bound, "{off} off, {bound} promised");
        let along = (p - ray.o.as_dvec3()).cross(ray.d.as_dvec3()).length();
        let off_ray = along / f64::from(ray.d.length());
        let cos = f64::from(point.ng.dot(ray.d.normalize()).abs());
        assert!(off_ray < 4e-6 / cos.max(1e-3), "{off_ray} off the ray");
    }
}

#[test]
fn a_quad_is_parametrised_from_its_corner() {
    let quad = QuadShape {
        corner: Vec3::new(1.0, 2.0, 3.0),
        edge_u: Vec3::new(2.0, 0.0, 0.0),
        edge_v: Vec3::new(1.0, 4.0, 0.0),
    };
    let g = Geometry {
        quads: vec![quad],
        ..Geometry::default()
    };
    let accel = Accel::build(g, &BuildSettings::default());
    for (u, v) in [
        (0.25, 0.75),
        (0.75, 0.25),
        (0.0, 0.0),
        (1.0, 1.0),
        (0.5, 0.5),
    ] {
        let p = quad.corner + u * quad.edge_u + v * quad.edge_v;
        for side in [1.0, -1.0] {
            let d = Vec3::new(0.0, 0.0, -side);
            let ray = Ray {
                o: p - 2.0 * d,
                t_max: 10.0,
                d,
            };
            let hit = accel.closest_one(&ray);
            assert_eq!((hit.t, hit.u, hit.v, hit.prim), (2.0, u, v, 0));
            assert_eq!(accel.hit_point(&ray, &hit).ng, Vec3::Z);
        }
    }
}
