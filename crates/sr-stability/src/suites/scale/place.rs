//! Far from the origin: in a node above room and camera nothing changes; in the vertices themselves digits are lost.

use super::decades;
use super::room::{Room, Walls, sealed};
use crate::suites::lobes::random;
use crate::worst::{Worst, relative};
use crate::{Bench, Kernels, Point, Sweep};
use sr_pipeline::accel::{Accel, BuildSettings, Geometry, Ray};
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::math::warp;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![picture(), vertices(), baked::<K>()]
}

fn at(offset: f64) -> Room {
    Room {
        place: offset * DVec3::new(1.0, 0.7, -0.4),
        ..Room::new(Walls::Mesh)
    }
}

fn sweep(
    name: &str,
    about: &str,
    error: &str,
    bound: f64,
    of: impl Fn(f64) -> Result<f64, String>,
) -> Sweep {
    let points = decades(0, 9).map(|offset| match of(offset) {
        Ok(error) => Point::new(offset, error, ""),
        Err(why) => Point::new(offset, f64::INFINITY, why),
    });
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: "metres from the origin, room and camera in one node".into(),
        error: error.into(),
        bound,
        holds: [1.0, 1.1e7],
        points: points.collect(),
    }
}

/// A lamp in the room, so that pixels differ.
fn picture() -> Sweep {
    let pixels = |offset| {
        let text = at(offset).text("\"Lambert\": (reflectance: 0.8)").replacen(
            "\"camera\"",
            "\"glow\": {\"Lambert\": (), \"Emission\": (radiance: 10)},\
             \"lamp\": {\"Sphere\": (radius: 0.2), \"LocalTransform\": (translate: (-0.5, 0.6, -0.4)), \
             \"MaterialRef\": \"glow\", \"ChildOf\": \"place\"}, \"camera\"",
            1,
        );
        let set = [
            ("integrator", "Path(max_depth: 6)"),
            ("budget.samples", "16"),
        ];
        Bench::new(0).picture(&text, &set)
    };
    let home = pixels(0.0);
    let of = |offset| {
        let (home, here) = (home.as_ref().map_err(Clone::clone)?, pixels(offset)?);
        let squares = home.iter().zip(&here).map(|(a, b)| {
            let (a, b) = (a.as_dvec3(), b.as_dvec3());
            (b - a).length_squared() / a.length_squared()
        });
        Ok((squares.sum::<f64>() / home.len() as f64).sqrt())
    };
    sweep(
        "picture_at_offset",
        "The picture of a room that a transform in f64 moves with its camera, against the picture at home; the same random \
         numbers, and paths that part where a vertex rounds otherwise.",
        "root mean square of the pixels' relative change",
        // One path of 16 in a hundred pixels may part.
        1e-2,
        of,
    )
}

fn vertices() -> Sweep {
    let positions = |offset| {
        let pipeline = at(offset).compiled()?;
        Ok::<_, String>(sealed(&pipeline.world).accel().geometry().positions.clone())
    };
    let home = positions(0.0);
    let of = |offset| {
        let (home, here) = (home.as_ref().map_err(Clone::clone)?, positions(offset)?);
        let moved = home
            .iter()
            .zip(&here)
            .map(|(a, b)| (*b - *a).abs().max_element());
        Ok(f64::from(moved.fold(0.0, f32::max)))
    };
    sweep(
        "vertices_at_offset",
        "Vertices relative to the camera, of a room of 2 m that a transform in f64 moves with its camera.",
        "metres that a vertex moves",
        // Vertices lie up to 2 m from the camera: half an ulp there is 1.2·10⁻⁷, and 10⁷ m in f64 another 2·10⁻⁹.
        1.3e-7,
        of,
    )
}

/// The vertices are rounded at the offset, the camera is at the exact place.
fn baked<K: Kernels>() -> Sweep {
    const RAYS: u32 = 2000;
    let home = match Room::new(Walls::Mesh).compiled() {
        Ok(pipeline) => sealed(&pipeline.world).accel().geometry().clone(),
        Err(_) => Geometry::default(),
    };
    let exact = Accel::build(home.clone(), &BuildSettings::default());
    let points = decades(-3, 8).map(|offset| {
        let place = offset * DVec3::new(1.0, 0.7, -0.4);
        let baked = |p: &Vec3| ((p.as_dvec3() + place).as_vec3().as_dvec3() - place).as_vec3();
        let geometry = Geometry {
            positions: home.positions.iter().map(baked).collect(),
            ..home.clone()
        };
        let accel = Accel::build(geometry, &BuildSettings::default());
        let mut worst = Worst::default();
        for i in 0..RAYS {
            let ray = Ray {
                o: Vec3::ZERO,
                t_max: f32::INFINITY,
                d: Vec3::from(warp::uniform_sphere(random(23, i).1.to_array())),
            };
            let t = |accel| f64::from(K::closest(accel, &ray).t);
            worst.see(relative(t(&accel), t(&exact)), || format!("{:?}", ray.d));
        }
        worst.at(offset)
    });
    Sweep {
        name: "baked_offset".into(),
        about: "Distances in a room of 2 m whose vertices are stored in f32 at an offset: the digits that the file has not, no \
                renderer gets back."
            .into(),
        parameter: "metres from the origin, in the vertices".into(),
        error: "relative error of distance".into(),
        // Half an ulp of 10⁴ is 5·10⁻⁴, seen at up to 60° and from 0.7 m.
        bound: 2e-3,
        holds: [0.9e-3, 1.1e4],
        points: points.collect(),
    }
}
