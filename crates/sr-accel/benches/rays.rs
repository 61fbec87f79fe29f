//! Millions of rays a second on one thread, for a closed mesh of 50 000 triangles.
//!
//! `camera` rays are coherent, `diffuse` rays leave the points that those hit in cosine-distributed
//! directions, `shadow` rays go from there to points of a small area. Each figure is the best of
//! five rounds; batches on the best instruction set, on none in particular, and single rays on the best
//! take turns, so that their ratios stand even where the machine is shared.

#[path = "../tests/suite/globe.rs"]
mod globe;

use glam::Vec3;
use sr_accel::{Accel, BuildSettings, Conservative, Hit, Ray, SimdLevel};
use sr_math::hash::{mix, unit_f32};
use sr_math::{Frame, offset_ray_origin};
use std::hint::black_box;
use std::time::Instant;

const SIDE: u32 = 768;
const ROUNDS: usize = 5;

fn camera(i: u32) -> Ray {
    // Tiles of 16 × 16, as a renderer takes them.
    let (tile, inside) = (i / 256, i % 256);
    let tiles = SIDE / 16;
    let x = (tile % tiles * 16 + inside % 16) as f32;
    let y = (tile / tiles * 16 + inside / 16) as f32;
    let d = Vec3::new(x - SIDE as f32 / 2.0, y - SIDE as f32 / 2.0, -(SIDE as f32));
    Ray {
        o: Vec3::new(0.0, 0.0, 2.6),
        t_max: f32::INFINITY,
        d,
    }
}

fn diffuse(accel: &Accel, ray: &Ray, hit: &Hit, i: u32) -> Ray {
    let point = accel.hit_point(ray, hit);
    let facing = if point.ng.dot(ray.d) < 0.0 { 1.0 } else { -1.0 };
    let (u, v) = (unit_f32(mix(i, 0)), unit_f32(mix(i, 1)));
    let (sin, cos) = (std::f32::consts::TAU * u).sin_cos();
    let local = Vec3::new(v.sqrt() * cos, v.sqrt() * sin, (1.0 - v).sqrt());
    let d = Frame::from_normal(point.ng * facing).to_world(local);
    Ray {
        o: offset_ray_origin(point.p, point.p_err, point.ng, d),
        t_max: f32::INFINITY,
        d,
    }
}

fn shadow(accel: &Accel, ray: &Ray, hit: &Hit, i: u32) -> Ray {
    let point = accel.hit_point(ray, hit);
    let light = Vec3::new(unit_f32(mix(i, 2)) - 0.5, 2.0, unit_f32(mix(i, 3)) + 1.0);
    let d = light - point.p;
    Ray {
        o: offset_ray_origin(point.p, point.p_err, point.ng, d),
        t_max: 0.999,
        d,
    }
}

/// The seconds of one call.
fn seconds(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64()
}

#[allow(clippy::print_stdout, reason = "the bench prints its table")]
fn report(name: &str, accel: &Accel, rays: &[Ray]) {
    let mut hits = vec![Hit::MISS; rays.len()];
    let mut any = vec![false; rays.len()];
    let mut best = [f64::INFINITY; 6];
    let portable = SimdLevel::Portable;
    for _ in 0..ROUNDS {
        let times = [
            seconds(|| accel.closest(rays, &mut hits)),
            seconds(|| accel.closest_with::<Conservative>(portable, rays, &mut hits)),
            seconds(|| {
                for (ray, hit) in rays.iter().zip(&mut hits) {
                    *hit = accel.closest_one(black_box(ray));
                }
            }),
            seconds(|| accel.occluded(rays, &mut any)),
            seconds(|| accel.occluded_with::<Conservative>(portable, rays, &mut any)),
            seconds(|| {
                for (ray, out) in rays.iter().zip(&mut any) {
                    *out = accel.occluded_one(black_box(ray));
                }
            }),
        ];
        black_box((&hits, &any));
        for (b, t) in best.iter_mut().zip(times) {
            *b = b.min(t);
        }
    }
    let [batch, portable, single, any, any_portable, any_single] =
        best.map(|t| rays.len() as f64 / t * 1e-6);
    println!(
        "{name:8} {batch:8.2} {:8.2} {:8.2} {any:10.2} {:8.2} {:8.2}",
        batch / portable,
        batch / single,
        any / any_portable,
        any / any_single,
    );
}

#[allow(clippy::print_stdout, reason = "the bench prints its table")]
fn main() {
    let accel = Accel::build(globe::globe(113, 224), &BuildSettings::default());
    println!("{:?}", accel.report());
    println!(
        "{:?}: Mrays/s of batches, and their ratio to portable ones and to single rays",
        SimdLevel::best()
    );
    println!("          closest portable   single   occluded portable   single");
    let rays: Vec<Ray> = (0..SIDE * SIDE).map(camera).collect();
    let mut hits = vec![Hit::MISS; rays.len()];
    accel.closest(&rays, &mut hits);
    let from_hits = |make: fn(&Accel, &Ray, &Hit, u32) -> Ray| -> Vec<Ray> {
        let all = rays.iter().zip(&hits).enumerate();
        all.filter(|(_, (_, hit))| hit.is_hit())
            .map(|(i, (ray, hit))| make(&accel, ray, hit, i as u32))
            .collect()
    };
    report("camera", &accel, &rays);
    report("diffuse", &accel, &from_hits(diffuse));
    report("shadow", &accel, &from_hits(shadow));
}
