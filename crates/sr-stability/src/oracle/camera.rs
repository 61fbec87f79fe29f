//! Camera rays in `f64`: the same place of the film and of the lens, the directions in `f64`.

use super::tree::Way;
use sr_pipeline::accel::PRIM_NONE;
use sr_pipeline::accel::oracle::Line;
use sr_pipeline::glam::{DVec2, DVec3};
use sr_pipeline::prelude::{Dim, Sampler};
use sr_pipeline::sampling::FilterSampler;
use sr_pipeline::sr_render::{Camera, Projection};

/// As [`sr_pipeline::camera_ray`]. What filter and aperture make of their numbers is the renderer's, in `f32`: it says
/// where the sample is, and not what is seen there.
pub(super) fn camera_way<S: Sampler>(
    camera: &Camera,
    filter: &FilterSampler,
    [x, y]: [u32; 2],
    sampler: &S,
) -> Way {
    let offset = filter.sample(sampler.d2(Dim::FILTER)).as_dvec2();
    let film = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) + offset;
    let point = camera.lens_point(|| sampler.d2(Dim::LENS)).as_dvec2();
    let (o, d) = through(camera, film, point);
    Way {
        line: Line {
            o,
            d,
            t_max: f64::INFINITY,
        },
        leaves: PRIM_NONE,
        reaches: PRIM_NONE,
    }
}

/// As [`Camera::ray_through`].
fn through(camera: &Camera, film: DVec2, point: DVec2) -> (DVec3, DVec3) {
    let size = camera.size.as_dvec2();
    let ndc = DVec2::new(2.0 * film.x / size.x - 1.0, 1.0 - 2.0 * film.y / size.y);
    let [right, up, back] = [camera.right, camera.up, camera.back].map(|v| v.as_dvec3());
    let across = |v: DVec2| right * v.x + up * v.y;
    let lens = camera
        .lens
        .map(|lens| (f64::from(lens.radius()), f64::from(lens.slope())));
    let (radius, slope) = lens.unwrap_or((0.0, 0.0));
    let (start, tilt) = (point * radius, point * -slope);
    let (o, d) = match camera.projection {
        Projection::Perspective { tan_half } => (start, ndc * tan_half.as_dvec2() + tilt),
        Projection::Orthographic { half } => (ndc * half.as_dvec2() + start, tilt),
    };
    (across(o), (across(d) - back).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_pipeline::glam::{Vec2, Vec3};
    use sr_pipeline::sr_render::{Aperture, Lens};

    #[test]
    fn rays_are_those_of_the_camera_but_for_rounding() {
        let lenses = [None, Lens::new(0.1, 3.0, Aperture::Round)];
        let tan_half = Vec2::new(0.4, 0.3);
        let projections = [
            Projection::Perspective { tan_half },
            Projection::Orthographic { half: tan_half },
        ];
        for (lens, projection) in lenses.into_iter().zip(projections) {
            let camera = Camera {
                projection,
                right: Vec3::new(0.6, 0.0, -0.8),
                up: Vec3::Y,
                back: Vec3::new(0.8, 0.0, 0.6),
                size: Vec2::new(64.0, 48.0),
                lens,
            };
            for (film, point) in [
                (Vec2::new(3.25, 40.5), Vec2::new(0.5, -0.25)),
                (Vec2::new(63.0, 0.125), Vec2::ZERO),
            ] {
                let narrow = camera.ray_through(film, point);
                let (o, d) = through(&camera, film.as_dvec2(), point.as_dvec2());
                // A dozen roundings of numbers up to 2.
                let bound = 12.0 * f64::from(f32::EPSILON);
                assert!((narrow.o.as_dvec3() - o).length() < bound);
                assert!((narrow.d.as_dvec3() - d).length() < bound);
            }
        }
    }
}
