//! Building takes about linear time however the primitives lie, and the tree is right.

use crate::{direction, in_cube, unit};
use glam::Vec3;
use sr_accel::{Accel, BuildSettings, Geometry, Hit, QuadShape, Quality, Ray, SphereShape};

/// Sphere number `i` of `n`.
type Make = fn(u32, u32) -> SphereShape;

/// Sets of spheres that boxes tell little about, and one that they tell apart.
const SETS: [(&str, Make); 12] = [
    ("spread", |i, _| sphere(in_cube(i, 0), 0.01)),
    ("equal", |_, _| sphere(Vec3::ZERO, 0.5)),
    ("concentric, ascending", |i, n| {
        sphere(Vec3::ZERO, 0.1 + part(i, n))
    }),
    ("concentric, descending", |i, n| {
        sphere(Vec3::ZERO, 1.2 - part(i, n))
    }),
    ("concentric, in disorder", |i, _| {
        sphere(Vec3::ZERO, 0.1 + unit(i, 0))
    }),
    ("touching in one point", |i, n| {
        let r = 0.1 + part(i, n);
        sphere(r * Vec3::X, r)
    }),
    ("coincident but for rounding", |i, _| {
        sphere(Vec3::ONE + in_cube(i, 0) * 1e-7, 0.5)
    }),
    ("collinear, overlapping", |i, n| {
        sphere(part(i, n) * Vec3::X, 0.3)
    }),
    ("an even row without rounding", |i, _| {
        sphere(i as f32 * Vec3::X, 0.25)
    }),
    ("an even row of threes", |i, _| {
        sphere((i / 3) as f32 * Vec3::X, 0.1 * (i % 3 + 1) as f32)
    }),
    ("two clusters", |i, _| {
        sphere(Vec3::X * (i % 2) as f32 + in_cube(i, 0) * 1e-6, 1e-7)
    }),
    ("all sizes through one another", |i, _| {
        sphere(direction(i, 0) * unit(i, 2), unit(i, 3))
    }),
];

fn sphere(center: Vec3, radius: f32) -> SphereShape {
    SphereShape { center, radius }
}

fn part(i: u32, n: u32) -> f32 {
    i as f32 / n as f32
}

fn spheres(make: Make, n: u32) -> Geometry {
    Geometry {
        spheres: (0..n).map(|i| make(i, n)).collect(),
        ..Geometry::default()
    }
}

/// Two flat triangles, over and over.
fn flat_triangles(n: u32) -> Geometry {
    Geometry {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE - Vec3::Z],
        triangles: (0..n)
            .map(|i| [[0, 1, 2], [1, 3, 2]][i as usize % 2])
            .collect(),
        ..Geometry::default()
    }
}

/// A quad, over and over.
fn flat_quads(n: u32) -> Geometry {
    let quad = QuadShape {
        corner: Vec3::ZERO,
        edge_u: Vec3::X,
        edge_v: Vec3::Y,
    };
    Geometry {
        quads: vec![quad; n as usize],
        ..Geometry::default()
    }
}

fn build(make: Make, n: u32, quality: Quality) -> Accel {
    Accel::build(spheres(make, n), &BuildSettings { quality })
}

/// The best of some builds, in seconds.
fn seconds(geometry: &Geometry, quality: Quality) -> f64 {
    let time = |_| {
        let accel = Accel::build(geometry.clone(), &BuildSettings { quality });
        accel.report().seconds
    };
    (0..3).map(time).fold(f64::INFINITY, f64::min)
}

/// Eight times the primitives take eight times the time and a little; were it quadratic, 64 times.
/// The bound says 40, of the best of three builds each, and leaves small times alone, so that other
/// work on the machine raises no alarm.
fn assert_near_linear(name: &str, geometry: impl Fn(u32) -> Geometry) {
    let (few, many) = (geometry(5_000), geometry(40_000));
    for quality in [Quality::Fast, Quality::Balanced, Quality::High] {
        let small = seconds(&few, quality).max(5e-3);
        let large = seconds(&many, quality);
        assert!(
            large < 40.0 * small,
            "{name}, {quality:?}: {small} s, {large} s"
        );
    }
}

#[test]
fn no_set_takes_quadratic_time() {
    for (name, make) in SETS {
        assert_near_linear(name, |n| spheres(make, n));
    }
    assert_near_linear("flat triangles", flat_triangles);
    assert_near_linear("flat quads", flat_quads);
}

/// Against every sphere alone: the least `t`, then the least id, to the bit.
#[test]
fn sets_that_boxes_tell_little_about_are_hit_as_without_a_tree() {
    const COUNT: u32 = 200;
    let mut hits = 0;
    for (name, make) in SETS {
        let alone: Vec<Accel> = (0..COUNT)
            .map(|i| {
                Accel::build(
                    Geometry {
                        spheres: vec![make(i, COUNT)],
                        ..Geometry::default()
                    },
                    &BuildSettings::default(),
                )
            })
            .collect();
        let trees =
            [Quality::Fast, Quality::Balanced, Quality::High].map(|q| build(make, COUNT, q));
        for k in 0..500 {
            let target = make(k % COUNT, COUNT);
            let o = direction(k, 20) * 4.0;
            let towards = target.center + in_cube(k, 22) * target.radius - o;
            let ray = Ray {
                o,
                t_max: f32::INFINITY,
                d: towards,
            };
            let mut best = Hit::MISS;
            for (prim, accel) in alone.iter().enumerate() {
                let hit = accel.closest_one(&ray);
                if hit.is_hit() && hit.t < best.t {
                    let prim = prim as u32;
                    best = Hit { prim, ..hit };
                }
            }
            hits += usize::from(best.is_hit());
            for tree in &trees {
                assert_eq!(tree.closest_one(&ray), best, "{name} {ray:?}");
                assert_eq!(tree.occluded_one(&ray), best.is_hit());
            }
        }
    }
    assert!(hits > 2_500, "{hits}");
}
