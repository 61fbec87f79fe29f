//! Thin lenses: apertures from 0 to huge, focus from next to the lens to infinity.

use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Kernels, Point, Sweep};
use sr_pipeline::glam::{DVec2, DVec3, Vec2, Vec3};
use sr_pipeline::sr_render::{Aperture, Lens, Projection};
use sr_pipeline::{Camera, accel::Ray};

const RAYS: u32 = 2000;
const TAN_HALF: Vec2 = Vec2::new(0.5, 0.375);

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let apertures = [
        0.0, 1e-30, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e5, 1e6, 1e7,
    ];
    let focuses = [
        1e-9,
        1e-7,
        1e-6,
        1e-3,
        0.1,
        1.0,
        1e3,
        1e6,
        1e12,
        1e30,
        1e300,
        f64::INFINITY,
    ];
    let sweep = |name: &str, parameter: &str, holds, points: Vec<Point>| {
        Sweep {
        name: name.into(),
        about: "Rays through points of the lens: where they start, of its radius, and their angle, against f64.".into(),
        parameter: parameter.into(),
        error: "error of origin and angle".into(),
        // Two sums and three products of numbers up to twice the longest of both, and the unit length.
        bound: 8.0 * f64::from(f32::EPSILON),
        holds,
        points,
    }
    };
    vec![
        sweep(
            "aperture",
            "radius of the aperture, of the distance in focus",
            [0.0, 1.1e6],
            apertures.map(|r| point::<K>(r, r, 1.0)).into(),
        ),
        sweep(
            "focus",
            "distance in focus, of the radius of the aperture",
            [0.9e-6, f64::INFINITY],
            focuses.map(|f| point::<K>(f, 1.0, f)).into(),
        ),
    ]
}

fn camera(lens: Option<Lens>) -> Camera {
    Camera {
        projection: Projection::Perspective { tan_half: TAN_HALF },
        right: Vec3::X,
        up: Vec3::Y,
        back: Vec3::Z,
        size: Vec2::new(64.0, 48.0),
        lens,
    }
}

fn point<K: Kernels>(at: f64, radius: f64, focus: f64) -> Point {
    let lens = Lens::new(radius, focus, Aperture::Round);
    // A lens without radius is a pinhole.
    if lens.is_none() && radius > 0.0 {
        return Point::new(at, f64::INFINITY, "refused, with the field and what to do");
    }
    let camera = camera(lens);
    let mut worst = Worst::default();
    for i in 0..RAYS {
        let film = random(62, i).1 * camera.size;
        let on_lens = camera.lens_point(|| random(63, i).1);
        let ray = K::camera_ray(&camera, film, on_lens);
        worst.see(off(&ray, film, on_lens, radius, focus), || {
            format!("film {film}, lens {on_lens}: {ray:?}")
        });
    }
    worst.at(at)
}

/// The textbook's: from the point of the lens to where the pinhole's ray meets the plane in focus.
fn off(ray: &Ray, film: Vec2, on_lens: Vec2, radius: f64, focus: f64) -> f64 {
    let ndc = (film.as_dvec2() / DVec2::new(32.0, 24.0) - 1.0) * DVec2::new(1.0, -1.0);
    let through = ndc * TAN_HALF.as_dvec2();
    let start = on_lens.as_dvec2() * f64::from(radius as f32);
    // In f64 a difference of places at the focus would lose what a focus at infinity leaves.
    let slope = through - start / focus;
    let exact = DVec3::new(slope.x, slope.y, -1.0).normalize();
    let origin = (ray.o.as_dvec3() - start.extend(0.0)).length();
    let origin = if radius > 0.0 {
        origin / radius
    } else {
        origin
    };
    let angle = ray.d.as_dvec3().cross(exact).length() / ray.d.as_dvec3().length();
    origin.max(angle)
}
