//! Faces without area, and vertices that are no numbers: left out, and harmless to what is beside them.

use super::room::{Room, Walls, sealed};
use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Kernels, Point, Sweep};
use sr_pipeline::accel::{Accel, BuildSettings, Geometry, Ray};
use sr_pipeline::glam::Vec3;
use sr_pipeline::math::warp;

/// Of each kind of broken face so many, behind those that are sound.
fn broken(sound: &Geometry, count: u32) -> Geometry {
    let mut geometry = sound.clone();
    for i in 0..count {
        let (uc, u) = random(41, i);
        let (p, e) = (Vec3::new(u.x, u.y, uc) - 0.5, Vec3::new(0.25, -0.5, 1.0));
        let corners = [
            // In line, in one point, twice the same vertex.
            [p, p + e, p + 2.0 * e],
            [p; 3],
            [p, p + e, p + e],
            // Of no size, of no place, endless, and larger than can be squared.
            [p * 0.0, Vec3::splat(1e-45), Vec3::ZERO],
            [p, Vec3::NAN, p + e],
            [p, Vec3::splat(f32::INFINITY), p + e],
            [
                p,
                Vec3::new(f32::MAX, 0.0, 0.0),
                Vec3::new(f32::MIN, 0.0, 0.0),
            ],
        ];
        for triangle in corners {
            let first = geometry.positions.len() as u32;
            geometry.positions.extend(triangle);
            geometry.triangles.push([first, first + 1, first + 2]);
        }
        // A vertex that is not there.
        geometry.triangles.push([0, 1, u32::MAX]);
    }
    geometry
}

pub(super) fn sweep<K: Kernels>() -> Sweep {
    const RAYS: u32 = 2000;
    let build = |geometry| Accel::build(geometry, &BuildSettings::default());
    let points = [0u32, 1, 10, 100, 1000].map(|count| {
        let at = f64::from(count);
        let pipeline = match Room::new(Walls::Mesh).compiled() {
            Ok(pipeline) => pipeline,
            Err(why) => return Point::new(at, f64::INFINITY, why),
        };
        let alone = sealed(&pipeline.world).accel();
        let among = build(broken(alone.geometry(), count));
        let mut worst = Worst::default();
        for i in 0..RAYS {
            let ray = Ray {
                o: Vec3::ZERO,
                t_max: f32::INFINITY,
                d: Vec3::from(warp::uniform_sphere(random(42, i).1.to_array())),
            };
            let (a, b) = (K::closest(alone, &ray), K::closest(&among, &ray));
            if a != b || !a.is_hit() {
                worst.count(|| format!("{ray:?}: {b:?}, not {a:?}"));
            }
        }
        worst.at(at)
    });
    Sweep {
        name: "degenerate".into(),
        about: "Rays in a room, with triangles among its own that have no area, equal vertices, no numbers or no vertices at \
                all: hits that are not those without them."
            .into(),
        parameter: "broken triangles of each of eight kinds".into(),
        error: "hits that change".into(),
        bound: 0.0,
        holds: [0.0, 1000.0],
        points: points.into(),
    }
}
