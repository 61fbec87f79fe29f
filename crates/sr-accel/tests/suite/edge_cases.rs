//! The ends of the domain: nothing, one thing, useless things, useless rays.

use crate::{direction, in_cube, signed, unit};
use glam::Vec3;
use sr_accel::oracle::brute_force_closest;
use sr_accel::{Accel, BuildSettings, Geometry, Hit, QuadShape, Ray, SphereShape};

fn build(g: Geometry) -> Accel {
    Accel::build(g, &BuildSettings::default())
}

fn ray(o: Vec3, d: Vec3) -> Ray {
    Ray {
        o,
        t_max: f32::INFINITY,
        d,
    }
}

fn triangle(p: [Vec3; 3]) -> Geometry {
    Geometry {
        positions: p.to_vec(),
        triangles: vec![[0, 1, 2]],
        ..Geometry::default()
    }
}

const BIG_TRIANGLE: [Vec3; 3] = [
    Vec3::new(-1.0, -1.0, 0.0),
    Vec3::new(3.0, -1.0, 0.0),
    Vec3::new(-1.0, 3.0, 0.0),
];

#[test]
fn empty_geometry_is_missed() {
    let accel = build(Geometry::default());
    let r = ray(Vec3::ZERO, Vec3::X);
    assert!(accel.bounds().is_empty());
    assert_eq!(accel.closest_one(&r), Hit::MISS);
    assert!(!accel.occluded_one(&r));
    let (mut hits, mut any) = (
        [Hit {
            prim: 7,
            ..Hit::MISS
        }; 3],
        [true; 3],
    );
    accel.closest(&[r; 3], &mut hits);
    accel.occluded(&[r; 3], &mut any);
    assert_eq!((hits, any), ([Hit::MISS; 3], [false; 3]));
    accel.closest(&[], &mut []);
}

#[test]
fn every_small_number_of_primitives_builds_and_is_found() {
    for count in 1..80u32 {
        let spheres = (0..count).map(|i| SphereShape {
            center: Vec3::new(i as f32, 0.0, 0.0),
            radius: 0.4,
        });
        let g = Geometry {
            spheres: spheres.collect(),
            ..Geometry::default()
        };
        let accel = build(g);
        assert_eq!(accel.report().prims, count as usize);
        for i in 0..count {
            let hit = accel.closest_one(&ray(Vec3::new(i as f32, 2.0, 0.0), -Vec3::Y));
            assert_eq!(hit.prim, i);
        }
        let along = accel.closest_one(&ray(Vec3::new(-2.0, 0.0, 0.0), Vec3::X));
        assert_eq!(along.prim, 0);
        assert!((along.t - 1.6).abs() <= 2.0 * f32::EPSILON);
    }
}

#[test]
fn rays_that_are_not_rays_miss() {
    let accel = build(triangle(BIG_TRIANGLE));
    let good = ray(Vec3::Z, -Vec3::Z);
    assert!(accel.occluded_one(&good));
    let mut bad = Vec::new();
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let mut r = good;
            r.o[axis] = x;
            bad.push(r);
            let mut r = good;
            r.d[axis] = x;
            bad.push(r);
        }
    }
    for t_max in [f32::NAN, 0.0, -1.0, f32::NEG_INFINITY] {
        bad.push(Ray { t_max, ..good });
    }
    for zero in [0.0, -0.0] {
        bad.push(ray(Vec3::Z, Vec3::splat(zero)));
    }
    for r in bad {
        assert_eq!(accel.closest_one(&r), Hit::MISS, "{r:?}");
        assert!(!accel.occluded_one(&r));
    }
}

#[test]
fn t_max_is_included_and_zero_is_not() {
    let accel = build(triangle(BIG_TRIANGLE));
    let r = ray(Vec3::new(0.1, 0.2, 2.0), -Vec3::Z);
    assert!(accel.occluded_one(&Ray { t_max: 2.0, ..r }));
    let short = Ray {
        t_max: 2.0f32.next_down(),
        ..r
    };
    assert!(!accel.occluded_one(&short));
    assert!(!accel.occluded_one(&ray(Vec3::new(0.1, 0.2, 0.0), Vec3::Z)));
}

#[test]
fn useless_primitives_are_left_out_and_counted() {
    let mut g = triangle(BIG_TRIANGLE);
    g.positions.extend([Vec3::NAN, Vec3::splat(f32::INFINITY)]);
    let bad_vertices = [[0, 1, 3], [4, 1, 2], [0, 1, 99]];
    let no_area = [[0, 0, 1], [1, 1, 1]];
    g.triangles.splice(0..0, bad_vertices);
    g.triangles.extend(no_area);
    let sphere = |radius| SphereShape {
        center: Vec3::new(0.0, 0.0, -1.0),
        radius,
    };
    g.spheres = [0.0, -1.0, f32::NAN, f32::INFINITY].map(sphere).to_vec();
    let quad = |edge_v| QuadShape {
        corner: Vec3::ZERO,
        edge_u: Vec3::X,
        edge_v,
    };
    g.quads = [Vec3::ZERO, 2.0 * Vec3::X, Vec3::splat(f32::NAN)]
        .map(quad)
        .to_vec();
    let accel = build(g);
    let report = accel.report();
    assert_eq!(report.prims, 1);
    assert_eq!(report.left_out_non_finite, 3 + 2 + 1);
    assert_eq!(report.left_out_degenerate, 2 + 2 + 2);
    // Ids are those of the geometry as given.
    assert_eq!(accel.closest_one(&ray(Vec3::Z, -Vec3::Z)).prim, 3);
}

#[test]
fn axis_parallel_rays_hit_flat_boxes_from_every_side() {
    // A wall of triangles in each axis plane; their boxes have no thickness.
    for axis in 0..3 {
        let turn = |a: f32, b: f32| {
            let mut p = Vec3::ZERO;
            p[(axis + 1) % 3] = a;
            p[(axis + 2) % 3] = b;
            p
        };
        let mut g = Geometry::default();
        for i in 0..=8 {
            for j in 0..=8 {
                g.positions.push(turn(i as f32 - 4.0, j as f32 - 4.0));
            }
        }
        for i in 0..8 {
            for j in 0..8 {
                let a = i * 9 + j;
                g.triangles.extend([[a, a + 9, a + 10], [a, a + 10, a + 1]]);
            }
        }
        let accel = build(g);
        for i in 0..3000 {
            // Half of them at exact grid lines.
            let at = |k| {
                let x = signed(i, k) * 4.0;
                if i % 2 == 0 { x } else { x.round() }
            };
            for side in [3.0, -3.0] {
                for zero in [0.0, -0.0] {
                    let mut d = Vec3::splat(zero);
                    d[axis] = -side;
                    let mut o = turn(at(0), at(1));
                    o[axis] = side;
                    let hit = accel.closest_one(&ray(o, d));
                    assert!(hit.is_hit() && hit.t == 1.0, "{o} {d} {hit:?}");
                    assert!(!accel.occluded_one(&ray(o, -d)));
                    // In the plane: the wall has no thickness to be hit.
                    let mut d = Vec3::splat(zero);
                    d[(axis + 1) % 3] = 1.0;
                    let o = turn(-9.0, at(1));
                    let _either = accel.closest_one(&ray(o, d));
                }
            }
        }
    }
}

#[test]
fn needles_are_hit_where_f64_says_so() {
    let (mut hits, mut rims) = (0, 0);
    for i in 0..20_000 {
        let (a, b) = (in_cube(i, 0), in_cube(i, 3));
        let thin = 10f32.powf(-1.0 - 3.0 * unit(i, 6));
        let p = [a, b, a + unit(i, 7) * (b - a) + direction(i, 8) * thin];
        let accel = build(triangle(p));
        let target = (p[0] + p[1] + p[2]) / 3.0;
        let o = in_cube(i, 10) * 3.0;
        let r = ray(o, target - o);
        let exact = brute_force_closest(accel.geometry(), &r);
        let hit = accel.closest_one(&r);
        // Aimed at a needle 10⁻⁴ thin, seen from the side even thinner: some are a matter of
        // rounding in f32.
        if hit.prim != exact.prim {
            rims += 1;
        } else if hit.is_hit() {
            hits += 1;
            assert!((f64::from(hit.t) - exact.t).abs() < 2.0 * f64::from((b - a).length()));
        }
    }
    assert!(hits > 19_000 && rims < 400, "{hits} hits, {rims} undecided");
}

#[test]
fn extreme_coordinates_do_not_panic() {
    for size in [1e-40f32, 1e-30, 1e-20, 1e15, 1e30, 1e38] {
        let g = Geometry {
            positions: (0..30).map(|i| in_cube(i, 0) * size).collect(),
            triangles: (0..10).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            spheres: vec![SphereShape {
                center: Vec3::ZERO,
                radius: size,
            }],
            quads: vec![QuadShape {
                corner: Vec3::ZERO,
                edge_u: Vec3::X * size,
                edge_v: Vec3::Y * size,
            }],
        };
        let accel = build(g);
        for i in 0..2000 {
            let o = in_cube(i, 10) * size;
            for length in [1e-38, 1.0, 1e38] {
                let r = ray(o, direction(i, 20) * length);
                let hit = accel.closest_one(&r);
                assert_eq!(hit.is_hit(), accel.occluded_one(&r));
                assert!(!hit.is_hit() || (hit.t > 0.0 && hit.t.is_finite()));
            }
        }
    }
}
