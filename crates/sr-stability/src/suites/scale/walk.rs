//! Walks from wall to wall of a closed room: rays that hit the wall that they leave, and rays that get out.

use super::decades;
use super::room::{Room, Walls, sealed};
use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Effort, Kernels, Point, Sweep};
use sr_pipeline::accel::Ray;
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::math::{Frame, warp};
use sr_pipeline::{RenderScene, SurfacePoint};

/// Steps of a walk, after which another begins at the camera.
const STEPS: u32 = 64;
/// A point as near to another wall, in units of the room, is not walked from: within twice its error it may be on either
/// side of that wall, and no offset along its own normal helps.
const EDGE: f64 = 1e-5;

pub(super) fn sweeps<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let walks = effort.choose(32, 1024);
    let mut all = Vec::new();
    for (name, walls) in [
        ("mesh", Walls::Mesh),
        ("quads", Walls::Quads),
        ("sphere", Walls::Sphere),
    ] {
        let room = Room::new(walls);
        let scaled = |s: f64| Room {
            scale: DVec3::splat(s),
            ..room
        };
        let moved = |x: f64| Room {
            place: x * DVec3::new(1.0, 0.7, -0.4),
            ..room
        };
        let mirrored = |s: f64| Room {
            scale: DVec3::new(-s, s, s),
            ..room
        };
        let around = format!("in a closed room of a {name}");
        let sweep =
            |what: &str, parameter: &str, [from, to]: [i32; 2], room: &dyn Fn(f64) -> Room| {
                // Three decades further at either end, where there is one.
                let beyond = if from < 0 { 3 } else { 0 };
                let values = decades(from - beyond, to + 3);
                let points = values.map(|x| point::<K>(x, &room(x), walks));
                Sweep {
                    name: format!("{name}_{what}"),
                    about: format!(
                        "Walks {around}: rays that hit the wall that they leave, or get out."
                    ),
                    parameter: parameter.into(),
                    error: "self-hits and leaks".into(),
                    bound: 0.0,
                    holds: [0.9 * 10f64.powi(from), 1.1 * 10f64.powi(to)],
                    points: points.collect(),
                }
            };
        all.push(sweep("at_scale", "half the room, metres", [-6, 7], &scaled));
        all.push(sweep(
            "at_offset",
            "metres from the origin, room and camera in one node",
            [0, 7],
            &moved,
        ));
        let about_mirrored = sweep(
            "mirrored",
            "half the room, metres, under a negative determinant",
            [-6, 6],
            &mirrored,
        );
        all.push(Sweep {
            name: format!("mirrored_{name}"),
            ..about_mirrored
        });
    }
    all.push(slab::<K>(walks));
    all.push(coincident::<K>(walks));
    all
}

fn slab<K: Kernels>(walks: u32) -> Sweep {
    let points = decades(-7, 0).map(|thickness| {
        let room = Room {
            scale: DVec3::new(1.0, 1.0, thickness),
            ..Room::new(Walls::Mesh)
        };
        point::<K>(thickness, &room, walks)
    });
    Sweep {
        name: "slab".into(),
        about: "Walks within a slab of this thickness that is 1 long.".into(),
        parameter: "thickness".into(),
        error: "self-hits and leaks".into(),
        bound: 0.0,
        // A point's error is some 10⁻⁶ of the longest edge.
        holds: [0.9e-4, 1.0],
        points: points.collect(),
    }
}

fn coincident<K: Kernels>(walks: u32) -> Sweep {
    let points = decades(-9, 10).map(|scale| {
        let room = Room {
            scale: DVec3::splat(scale),
            ..Room::new(Walls::Doubled)
        };
        point::<K>(scale, &room, walks)
    });
    Sweep {
        name: "coincident".into(),
        about: "Walks in a room whose every face is there twice; always the first of both is to be hit.".into(),
        parameter: "half the room, metres".into(),
        error: "self-hits, leaks and hits of the second face".into(),
        bound: 0.0,
        holds: [0.9e-6, 1.1e7],
        points: points.collect(),
    }
}

fn point<K: Kernels>(at: f64, room: &Room, walks: u32) -> Point {
    match room.compiled() {
        Err(why) => Point::new(at, f64::INFINITY, why),
        Ok(pipeline) => {
            let scene = sealed(&pipeline.world);
            let mut walk = Walk {
                room,
                scene,
                wrong: Worst::default(),
            };
            (0..walks).for_each(|i| walk.go::<K>(i));
            walk.wrong.at(at)
        }
    }
}

/// One walk after another, and what goes wrong on the way.
struct Walk<'a> {
    room: &'a Room,
    scene: &'a RenderScene,
    wrong: Worst,
}

impl Walk<'_> {
    fn go<K: Kernels>(&mut self, number: u32) {
        let (_, u) = random(21, number);
        let d = Vec3::from(warp::uniform_sphere(u.to_array()));
        let mut ray = Ray {
            o: Vec3::ZERO,
            t_max: f32::INFINITY,
            d,
        };
        let mut last: Option<SurfacePoint> = None;
        for step in 0..STEPS {
            let hit = K::closest(self.scene.accel(), &ray);
            if !hit.is_hit() {
                return self.wrong.count(|| format!("{ray:?} gets out"));
            }
            let here = self.scene.surface(&ray, &hit);
            if let Some(last) = last {
                self.look_back::<K>(&last, &here, hit.t);
            }
            if self.room.walls == Walls::Doubled && self.scene.shape_name(here.shape) != "room" {
                self.wrong.count(|| format!("{ray:?} hits the second face"));
            }
            if self.is_at_an_edge(&here) {
                return;
            }
            ray = K::spawn_ray(&here, direction(&here, number * STEPS + step));
            last = Some(here);
        }
    }

    /// Whether the last step led across the room, both ends see one another, and nothing is seen through the wall.
    fn look_back<K: Kernels>(&mut self, from: &SurfacePoint, to: &SurfacePoint, t: f32) {
        if !self.is_across(from, to, t) {
            return self
                .wrong
                .count(|| format!("hits the wall that it leaves at {:?}, after {t:e}", from.p));
        }
        let is_seen = |q: Vec3, q_err: Vec3| {
            let w = (q - to.p).normalize();
            let ray = K::spawn_ray_to(to, w, q, q_err, from.ng);
            (!K::occluded(self.scene.accel(), &ray), ray)
        };
        let (seen, ray) = is_seen(from.p, from.p_err);
        // On a sphere a grazing step may be as short as the rounding of its ends.
        if self.wall(from) != self.wall(to) && !seen {
            self.wrong.count(|| format!("{ray:?} is blocked"));
        }
        let out = self.room.world(0.1 * self.room.local(from.p));
        let beyond = (from.p.as_dvec3() + out).as_vec3();
        let (through, ray) = is_seen(beyond, Vec3::ZERO);
        // It leaves the room by the far wall, not by its own.
        let inwards = inside(to).dot(beyond - to.p) > 0.0;
        if inwards && through {
            self.wrong.count(|| format!("{ray:?} gets out"));
        }
    }

    /// Of a box: another wall. Of a sphere: the far end of the chord.
    fn is_across(&self, from: &SurfacePoint, to: &SurfacePoint, t: f32) -> bool {
        if self.room.walls != Walls::Sphere {
            return self.wall(from) != self.wall(to);
        }
        let radius = self.room.scale.abs().max_element();
        let cos = from.ng.as_dvec3().dot(to.wo.as_dvec3()).abs();
        f64::from(t) > 2.0 * radius * (cos - 1e-4)
    }

    /// Axis and side of the box's wall; of a sphere none, so that all points are apart whose chord is long enough to say.
    fn wall(&self, point: &SurfacePoint) -> [i64; 3] {
        let local = self.room.local(point.p);
        if self.room.walls == Walls::Sphere {
            return (local * 1e3).round().as_i64vec3().to_array();
        }
        let distance = (DVec3::ONE - local.abs()) * self.room.scale;
        let axis = distance.abs().min_position();
        std::array::from_fn(|k| i64::from(k == axis) * local[k].signum() as i64)
    }

    fn is_at_an_edge(&self, point: &SurfacePoint) -> bool {
        let near = EDGE / self.room.scale.abs() * self.room.scale.abs().max_element();
        let within = self.room.local(point.p).abs().cmpgt(DVec3::ONE - near);
        self.room.walls != Walls::Sphere && within.bitmask().count_ones() > 1
    }
}

/// The normal towards where the ray came from.
fn inside(here: &SurfacePoint) -> Vec3 {
    let side = here.ng.dot(here.wo);
    if side < 0.0 { -here.ng } else { here.ng }
}

/// Into the room, every second one at grazing angles.
fn direction(here: &SurfacePoint, number: u32) -> Vec3 {
    let (uc, u) = random(22, number);
    let local = if number.is_multiple_of(2) {
        Vec3::from(warp::cosine_hemisphere(u.to_array()))
    } else {
        let z = 10f32.powf(-6.0 * uc);
        let (sin, cos) = (std::f32::consts::TAU * u.x).sin_cos();
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::new(r * cos, r * sin, z)
    };
    Frame::from_normal(inside(here)).to_world(local).normalize()
}
