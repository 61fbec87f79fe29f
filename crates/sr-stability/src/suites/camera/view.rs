//! Directions of camera rays, for angles of view from 10⁻³° to nearly 180°.

use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Bench, Kernels, Point, Sweep};
use sr_pipeline::glam::{DVec2, DVec3, Vec2};
use sr_pipeline::{Camera, SealedScene};

const WIDTH: f64 = 1024.0;
const HEIGHT: f64 = 768.0;
/// Degrees across the picture.
const ANGLES: [f64; 14] = [
    1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0, 60.0, 120.0, 170.0, 179.0, 179.9, 179.99,
];

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    let parameter = "angle of view, degrees";
    vec![
        Sweep {
            name: "field_of_view".into(),
            about: "Directions of the rays of a picture of 1024 × 768, against f64 from the angle of view.".into(),
            parameter: parameter.into(),
            error: "angle, radian".into(),
            // A coordinate of a unit vector rounds by 3·10⁻⁸, after five roundings of its own.
            bound: 4.0 * f64::from(f32::EPSILON),
            holds: [0.9e-3, 179.9],
            points: ANGLES.map(|a| point::<K>(a, |error| error.angle)).into(),
        },
        Sweep {
            name: "field_of_view_in_pixels".into(),
            about: "The same in pixels of the picture: a direction in f32 is told from the next by 6·10⁻⁸ radian, which of a \
                    view below 0.1° is more than a tenth of a pixel."
                .into(),
            parameter: parameter.into(),
            error: "distance on the film, pixels".into(),
            bound: 0.1,
            holds: [0.09, 179.9],
            points: ANGLES.map(|a| point::<K>(a, |error| error.pixels)).into(),
        },
    ]
}

/// How far a ray is off.
struct Off {
    angle: f64,
    pixels: f64,
}

fn camera(degrees: f64) -> Result<Camera, String> {
    let text = format!(
        "(film: (width: {WIDTH}, height: {HEIGHT}), entities: {{\"camera\": {{\"PerspectiveCamera\": (hfov_deg: {degrees:?}), \
         \"LookAt\": (from: (1, 2, 3), to: (-1, 0.5, 0.2)), \"ActiveCamera\": ()}}}})"
    );
    let pipeline = Bench::new(1).scene(&text, &[])?;
    Ok(*pipeline.world.resource::<SealedScene>().camera())
}

fn point<K: Kernels>(degrees: f64, of: impl Fn(&Off) -> f64) -> Point {
    let camera = match camera(degrees) {
        Ok(camera) => camera,
        Err(why) => return Point::new(degrees, f64::INFINITY, why),
    };
    let mut worst = Worst::default();
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5]].map(Vec2::from);
    let others = (0..2000).map(|i| random(61, i).1);
    for u in corners.into_iter().chain(others) {
        let film = u * camera.size;
        let error = off(
            &camera,
            degrees,
            film,
            K::camera_ray(&camera, film, Vec2::ZERO).d.as_dvec3(),
        );
        worst.see(of(&error), || format!("{film}"));
    }
    worst.at(degrees)
}

/// Of a direction, from where the film has it: the camera's axes are taken as they are rounded.
fn off(camera: &Camera, degrees: f64, film: Vec2, found: DVec3) -> Off {
    let [right, up, back] = [camera.right, camera.up, camera.back].map(|v| v.as_dvec3());
    // Metres of a pixel on the plane at distance 1.
    let pixel = 2.0 * (0.5 * degrees).to_radians().tan() / WIDTH;
    let place = film.as_dvec2() - 0.5 * DVec2::new(WIDTH, HEIGHT);
    let exact = right * (place.x * pixel) - up * (place.y * pixel) - back;
    let depth = found.dot(-back);
    let on_film = DVec2::new(found.dot(right), -found.dot(up)) / (depth * pixel);
    Off {
        angle: found.cross(exact).length() / (found.length() * exact.length()),
        pixels: (on_film - place).length(),
    }
}
