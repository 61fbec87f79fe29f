//! Shapes that are hard to hit: needles, edges that rays are aimed at, faces one upon the other.

use super::decades;
use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Kernels, Sweep};
use sr_pipeline::accel::oracle::brute_force_closest;
use sr_pipeline::accel::{Accel, BuildSettings, Geometry, QuadShape, Ray};
use sr_pipeline::glam::{Vec2, Vec3};

const RAYS: u32 = 20_000;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![needles::<K>(), edges::<K>(), decals::<K>()]
}

fn build(geometry: Geometry) -> Accel {
    Accel::build(geometry, &BuildSettings::default())
}

fn towards(o: Vec3, target: Vec3) -> Ray {
    Ray {
        o,
        t_max: f32::INFINITY,
        d: (target - o).normalize(),
    }
}

/// A number in [−1, 1).
fn signed(key: u32, i: u32) -> Vec3 {
    let (uc, u) = random(key, i);
    Vec3::new(u.x, u.y, uc) * 2.0 - 1.0
}

/// Strips of 1 by `width`, two triangles each, side by side in a plane that leans.
fn strips(width: f32, count: u32) -> Geometry {
    let mut geometry = Geometry::default();
    for i in 0..=count {
        let y = (i as f32 - 0.5 * count as f32) * width;
        geometry
            .positions
            .extend([Vec3::new(-0.5, y, 0.2), Vec3::new(0.5, y, -0.3)]);
    }
    let cells = (0..count).map(|i| 2 * i);
    geometry.triangles = cells
        .flat_map(|a| [[a, a + 1, a + 3], [a, a + 3, a + 2]])
        .collect();
    geometry
}

/// Where a ray meets needles, against the same in f64.
fn needles<K: Kernels>() -> Sweep {
    const STRIPS: u32 = 64;
    let aspects = [4.0f32, 16.0, 64.0, 256.0, 1e3, 1e4, 1e5, 1e6, 1e7];
    let points = aspects.map(|aspect| {
        let accel = build(strips(aspect.recip(), STRIPS));
        let mut worst = Worst::default();
        for i in 0..RAYS {
            let place = signed(31, i) * Vec3::new(0.45, 0.25 * STRIPS as f32 / aspect, 0.0);
            // On the plane that leans.
            let target = place + Vec3::new(0.0, 0.0, -0.05 - 0.5 * place.x);
            let ray = towards(Vec3::new(0.0, 0.0, 2.0) + signed(32, i), target);
            let (hit, exact) = (
                K::closest(&accel, &ray),
                brute_force_closest(accel.geometry(), &ray),
            );
            // In f64 the middle strips hold it for sure; by t, since two strips may claim an edge.
            let error = if hit.is_hit() {
                let p = accel.hit_point(&ray, &hit).p.as_dvec3();
                let on_ray = ray.o.as_dvec3() + ray.d.as_dvec3() * exact.t;
                (p - on_ray).length() / exact.t
            } else {
                f64::INFINITY
            };
            worst.see(error, || format!("{ray:?}: {hit:?}, truth {exact:?}"));
        }
        worst.at(aspect.into())
    });
    Sweep {
        name: "needles".into(),
        about: "Points at which rays meet a plane of needles side by side; a ray that falls between two of them is infinitely \
                wrong."
            .into(),
        parameter: "length over width".into(),
        error: "distance of the point from the true one, of the ray's length".into(),
        // 8 u of the coordinates' extent, times an aspect of 64 up to which they are solved in f32, at 45°.
        bound: 1e-4,
        holds: [4.0, 1.1e6],
        points: points.into(),
    }
}

/// Cells along the side of a floor.
const FLOOR: u32 = 32;

/// Rays at the edges of a floor in an axis plane, whose boxes are as flat and as tight as can be: between two of them is no
/// room for any rounding.
fn edges<K: Kernels>() -> Sweep {
    let points = decades(-1, 6).map(|far| {
        let place = Vec3::new(0.37, 0.0, -0.21) * far as f32;
        let accel = build(floor(place));
        let mut worst = Worst::default();
        for i in 0..RAYS {
            let (uc, u) = random(33, i);
            let line = |x: f32| (x * (FLOOR - 1) as f32).floor() + 1.0;
            let mut on_edge = Vec2::new(line(u.x), u.y * FLOOR as f32);
            if i % 2 == 0 {
                on_edge = Vec2::new(on_edge.y, on_edge.x);
            }
            let target = place + Vec3::new(on_edge.x, 0.0, on_edge.y);
            let o =
                place + Vec3::new(16.0, 12.0, 16.0) + 11.0 * Vec3::new(u.y - 0.5, uc, u.x - 0.5);
            // Not of unit length, which would round once more.
            let ray = Ray {
                o,
                t_max: f32::INFINITY,
                d: target - o,
            };
            if !K::closest(&accel, &ray).is_hit() {
                worst.count(|| format!("{ray:?}"));
            }
        }
        worst.at(far)
    });
    Sweep {
        name: "edges".into(),
        about: "Rays aimed at the edges of a floor of 32 × 32 cells in an axis plane: how many fall through.".into(),
        parameter: "distance of the floor from the origin, of a cell".into(),
        error: "rays that hit nothing".into(),
        bound: 0.0,
        holds: [0.09, 1.1e6],
        points: points.collect(),
    }
}

fn floor(place: Vec3) -> Geometry {
    let row = FLOOR + 1;
    let cells = (0..FLOOR).flat_map(|i| (0..FLOOR).map(move |j| i * row + j));
    Geometry {
        positions: (0..row)
            .flat_map(|i| (0..row).map(move |j| place + Vec3::new(i as f32, 0.0, j as f32)))
            .collect(),
        triangles: cells
            .flat_map(|a| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]])
            .collect(),
        ..Geometry::default()
    }
}

/// A quad in front of another, seen from a distance of about 1.
fn decals<K: Kernels>() -> Sweep {
    let points = decades(-9, -1).map(|gap| {
        let quad = |lift: f32, half: f32| QuadShape {
            corner: Vec3::new(-half, -half, lift - 0.3 * half),
            edge_u: Vec3::new(2.0 * half, 0.0, 0.6 * half),
            edge_v: Vec3::new(0.0, 2.0 * half, 0.0),
        };
        let accel = build(Geometry {
            quads: vec![quad(0.0, 1.0), quad(gap as f32, 0.5)],
            ..Geometry::default()
        });
        let mut worst = Worst::default();
        for i in 0..RAYS {
            let place = 0.4 * signed(34, i);
            let target = Vec3::new(place.x, place.y, 0.3 * place.x);
            let ray = towards(Vec3::new(0.0, 0.0, 1.5) + 0.5 * signed(35, i), target);
            if K::closest(&accel, &ray).prim != 1 {
                worst.count(|| format!("{ray:?}"));
            }
        }
        worst.at(gap)
    });
    Sweep {
        name: "decals".into(),
        about: "A sheet in front of a wall, seen from a distance of 1 to 2: how many rays see the wall.".into(),
        parameter: "distance of the sheet from the wall".into(),
        error: "rays that hit the wall".into(),
        bound: 0.0,
        // t rounds by some 10⁻⁷ of itself for each of both.
        holds: [0.9e-5, 0.11],
        points: points.collect(),
    }
}
