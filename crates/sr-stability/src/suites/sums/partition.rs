//! One picture, however its work is cut up.

use crate::{Bench, Point, Sweep};
use sr_film::Image;
use sr_pipeline::{FilmResource, LogPoints, RenderReport};
use std::ops::ControlFlow;

/// Light, glass and rough metal, at more tiles than threads and an odd size.
const SCENE: &str = r#"(film: (width: 70, height: 41), entities: {
    "matt": {"Lambert": (reflectance: 0.7)}, "gold": {"Conductor": (metal: "Au", alpha: 0.2)},
    "glass": {"Dielectric": (ior: 1.5)}, "glow": {"Lambert": (reflectance: 0), "Emission": (radiance: 8)},
    "floor": {"Quad": (width: 6, height: 6), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "matt"},
    "lamp": {"Quad": (width: 1, height: 1), "LocalTransform": (translate: (0, 3, 0), rotate_deg: (90, 0, 0)), "MaterialRef": "glow"},
    "left": {"Sphere": (radius: 0.6), "LocalTransform": (translate: (-0.7, 0.6, 0)), "MaterialRef": "gold"},
    "right": {"Sphere": (radius: 0.6), "LocalTransform": (translate: (0.7, 0.6, 0)), "MaterialRef": "glass"},
    "sky": {"Environment": (radiance: 0.2)},
    "camera": {"PerspectiveCamera": (vfov_deg: 40), "LookAt": (from: (0, 1.5, 4), to: (0, 0.6, 0)), "ActiveCamera": ()},
})"#;

/// Odd, and more than one block of the film's sums.
const SAMPLES: &str = "131";

/// The picture with so many threads, and the number of passes that it took.
fn picture(threads: usize, log: &LogPoints) -> Result<(Image, u32), String> {
    let mut pipeline = Bench::new(threads).scene(SCENE, &[("budget.samples", SAMPLES)])?;
    pipeline.world.insert_resource(log.clone());
    let stop = pipeline.render(|_| ControlFlow::Continue(()));
    stop.map_err(|e| e.to_string())?;
    let film = pipeline.world.resource::<FilmResource>();
    let passes = pipeline.world.resource::<RenderReport>().passes;
    Ok((film.film.resolve(film.estimator).rgb, passes))
}

/// The share of pixels that differ in any bit.
fn difference(a: &Image, b: &Image) -> f64 {
    let pairs = a.pixels.iter().zip(&b.pixels);
    let bits = |p: &glam::Vec3| p.to_array().map(f32::to_bits);
    let different = pairs.filter(|(a, b)| bits(a) != bits(b)).count();
    different as f64 / a.pixels.len() as f64
}

fn point(
    at: f64,
    one: &Result<(Image, u32), String>,
    other: Result<(Image, u32), String>,
) -> Point {
    match (one, other) {
        (Ok((a, _)), Ok((b, passes))) => {
            Point::new(at, difference(a, &b), format!("{passes} passes"))
        }
        (Err(why), _) => Point::new(at, f64::INFINITY, why.clone()),
        (_, Err(why)) => Point::new(at, f64::INFINITY, why),
    }
}

/// Threads; passes follow the clock, so each picture has others.
pub(super) fn threads() -> Sweep {
    let one = picture(1, &LogPoints::none());
    let points = [1usize, 2, 3, 8].map(|n| point(n as f64, &one, picture(n, &LogPoints::none())));
    Sweep {
        name: "threads".into(),
        about: "A picture does not depend on the number of threads, bit for bit.".into(),
        parameter: "threads".into(),
        error: "share of pixels that differ".into(),
        bound: 0.0,
        holds: [1.0, 8.0],
        points: points.to_vec(),
    }
}

/// As few passes as there are, and ever more, ended by doublings and by marks on the clock.
pub(super) fn passes() -> Sweep {
    let marks = |n: u32| LogPoints {
        doublings: true,
        seconds: (1..=n).map(|i| 1e-3 * f64::from(i)).collect(),
    };
    let one = picture(0, &LogPoints::none());
    let pictures =
        [LogPoints::none(), marks(0), marks(10), marks(1000)].map(|log| picture(0, &log));
    let at =
        |p: &Result<(Image, u32), String>| p.as_ref().map_or(1.0, |(_, passes)| f64::from(*passes));
    let points = pictures.into_iter().map(|p| point(at(&p), &one, p));
    Sweep {
        name: "passes".into(),
        about: "A picture does not depend on how its samples are dealt out to passes, bit for bit."
            .into(),
        parameter: "passes".into(),
        error: "share of pixels that differ".into(),
        bound: 0.0,
        holds: [1.0, f64::INFINITY],
        points: points.collect(),
    }
}
