//! Pictures of one pixel, of one row, and parts of a picture.

use crate::suites::lobes::random;
use crate::worst::Worst;
use crate::{Bench, Kernels, Point, Sweep};
use sr_pipeline::Camera;
use sr_pipeline::glam::{Vec2, Vec3};
use sr_pipeline::sr_render::Projection;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![places::<K>(), rows(), crops()]
}

const WIDTHS: [u32; 7] = [1, 2, 64, 1024, 8192, 32_768, 65_536];

/// From a place on the film to a ray, and from a point of the ray back to the film.
fn places<K: Kernels>() -> Sweep {
    let points = WIDTHS.map(|width| {
        let size = Vec2::new(width as f32, 1.0);
        let camera = Camera {
            projection: Projection::Perspective {
                tan_half: Vec2::new(0.6, 0.6 / size.x),
            },
            right: Vec3::X,
            up: Vec3::Y,
            back: Vec3::Z,
            size,
            lens: None,
        };
        let mut worst = Worst::default();
        for i in 0..2000 {
            let film = random(64, i).1 * size;
            let ray = K::camera_ray(&camera, film, Vec2::ZERO);
            let back = camera.connect(ray.o + 3.0 * ray.d, Vec2::ZERO);
            // At the border itself rounding may lead outside.
            let at_border = film.min_element() < 1e-3 || (size - film).min_element() < 1e-3;
            let error = match back {
                Some(c) => f64::from((c.film - film).abs().max_element()),
                None if at_border => 0.0,
                None => f64::INFINITY,
            };
            worst.see(error, || format!("{film} becomes {back:?}"));
        }
        worst.at(width.into())
    });
    Sweep {
        name: "wide_pictures".into(),
        about: "A place on the film of a row of pixels, as a ray and back.".into(),
        parameter: "pixels across".into(),
        error: "distance on the film, pixels".into(),
        // Six roundings of 65 536 at most; places themselves are told apart by 1/256 there.
        bound: 0.03,
        holds: [1.0, 65_536.0],
        points: points.into(),
    }
}

/// A sphere of radiance 2 around the camera.
fn inside(film: &str) -> String {
    format!(
        "(film: ({film}), entities: {{\
         \"wall\": {{\"Lambert\": (reflectance: 0.5), \"Emission\": (radiance: 1, two_sided: true)}},\
         \"sphere\": {{\"Sphere\": (radius: 1), \"MaterialRef\": \"wall\"}},\
         \"camera\": {{\"PerspectiveCamera\": (hfov_deg: 90), \"LookAt\": (from: (0.2, 0.1, 0.5), to: (0, 0, 0)), \
         \"ActiveCamera\": ()}}}})"
    )
}

/// The largest difference of a pixel from 2, and infinity where there are too few or too many of them.
fn row(width: u32, height: u32) -> Result<f64, String> {
    let text = inside(&format!("width: {width}, height: {height}"));
    let set = [
        ("integrator", "PathBsdf(max_depth: 40, roulette_from: None)"),
        ("budget.samples", "2"),
    ];
    let picture = Bench::new(0).picture(&text, &set)?;
    if picture.len() != (width * height) as usize {
        return Err(format!("{} pixels", picture.len()));
    }
    let errors = picture.iter().map(|p| (f64::from(p.y) / 2.0 - 1.0).abs());
    Ok(errors.fold(0.0, f64::max))
}

fn rows() -> Sweep {
    let points = [1u32, 2, 63, 1025, 8191, 32_768].map(|long| {
        let mut worst = Worst::default();
        for (width, height) in [(long, 1), (1, long)] {
            let found = row(width, height);
            let error = *found.as_ref().unwrap_or(&f64::INFINITY);
            worst.see(error, || format!("{width} × {height}: {found:?}"));
        }
        worst.at(long.into())
    });
    Sweep {
        name: "rows".into(),
        about: "Pictures of 1 × 1 to 32768 × 1 and 1 × 32768 pixels of a closed sphere of radiance 2: each pixel is there and is 2."
            .into(),
        parameter: "pixels of the row or column".into(),
        error: "relative error of a pixel".into(),
        bound: 1e-6,
        holds: [1.0, 32_768.0],
        points: points.into(),
    }
}

const SIDE: usize = 24;

/// Something to see at every border.
fn busy() -> String {
    format!(
        "(film: (width: {SIDE}, height: {SIDE}), entities: {{\
         \"red\": {{\"Lambert\": (reflectance: (0.8, 0.3, 0.1))}},\
         \"floor\": {{\"Quad\": (width: 4, height: 4), \"LocalTransform\": (rotate_deg: (-90, 0, 0)), \"MaterialRef\": \"red\"}},\
         \"ball\": {{\"Sphere\": (radius: 0.8), \"LocalTransform\": (translate: (-0.9, 0.5, 0)), \"MaterialRef\": \"red\"}},\
         \"lamp\": {{\"PointLight\": (intensity: 4), \"LocalTransform\": (translate: (1, 2, 1))}},\
         \"camera\": {{\"PerspectiveCamera\": (hfov_deg: 40), \"LookAt\": (from: (0, 2, 3), to: (0, 0.3, 0)), \
         \"ActiveCamera\": ()}}}})"
    )
}

fn crops() -> Sweep {
    let pixels = |crop: &str| {
        let set = [
            ("integrator", "Path(max_depth: 3)"),
            ("budget.samples", "4"),
            ("film.filter", "Gaussian(radius: 1.5, sigma: 0.5)"),
            ("film.crop", crop),
        ];
        Bench::new(0).picture(&busy(), &set)
    };
    let whole = pixels("None");
    let points = [1, 2, 5, 16, 23, 24].map(|size| {
        let mut worst = Worst::default();
        let far = SIDE - size;
        for [x, y] in [[0, 0], [far, 0], [0, far], [far, far]] {
            let (x1, y1) = (x + size, y + size);
            let part = pixels(&format!("({x}, {y}, {x1}, {y1})"));
            let error = match (&whole, &part) {
                (Ok(whole), Ok(part)) => differing(whole, part, [x, y], size),
                _ => f64::INFINITY,
            };
            worst.see(error, || match part {
                Ok(_) => format!("from ({x}, {y})"),
                Err(why) => why,
            });
        }
        worst.at(size as f64)
    });
    Sweep {
        name: "crops".into(),
        about: "Parts of a picture at each of its corners, of a pixel and up to the whole, against the same pixels of the whole."
            .into(),
        parameter: "pixels of the part's side".into(),
        error: "share of pixels that differ in any bit".into(),
        bound: 0.0,
        holds: [1.0, SIDE as f64],
        points: Vec::<Point>::from(points),
    }
}

fn differing(whole: &[Vec3], part: &[Vec3], [x, y]: [usize; 2], size: usize) -> f64 {
    if part.len() != size * size {
        return f64::INFINITY;
    }
    let at = |i: usize| whole[(y + i / size) * SIDE + x + i % size];
    let differ = |(i, p): &(usize, &Vec3)| at(*i) != **p;
    part.iter().enumerate().filter(differ).count() as f64 / part.len() as f64
}
