//! Environment maps in pictures: where a texel is seen, what sampling by the map is worth, and the
//! classic assignment's own scene against another renderer.

use crate::references::{
    Known, TILE, compare, folders, judge, moments, reference_noise, replicas, sample_factor,
};
use glam::{DQuat, DVec3};
use sr_experiment::relmse;
use sr_integrators::{Direct, DirectSettings, Path, PathSettings, Strategy};
use sr_pipeline::film_kernel::{Image, Precision, read_image, write_image_exr};
use sr_pipeline::light::{EnvironmentMap, direction_of};
use sr_pipeline::prelude::*;
use sr_scene::components::*;
use sr_tests::Job;
use sr_tools::generate::{Sky, SkyArgs};

fn image(map: &Image) -> EnvironmentImage {
    let map = EnvironmentMap::new(map.width, map.height, map.pixels.clone());
    EnvironmentImage(map.expect("a map").into())
}

fn camera(world: &mut World, from: DVec3, to: DVec3, hfov_deg: f64) {
    world.spawn((
        PerspectiveCamera {
            hfov_deg: Some(hfov_deg),
            vfov_deg: None,
        },
        LookAt {
            from: from.to_array(),
            to: to.to_array(),
            up: [0.1, 1.0, 0.2],
        },
        ActiveCamera,
    ));
}

/// Every texel of a map, each of its own colour, is seen where the convention puts it: as it is, mirrored,
/// turned by one texel (45°) by either way of turning, mirrored and turned.
#[test]
fn every_texel_is_seen_in_its_direction() {
    let (width, height) = (8u32, 4u32);
    let colour = |x: u32, y: u32| Vec3::new(1.0 + x as f32, 1.0 + y as f32, 0.5);
    let texels = (0..width * height).map(|i| colour(i % width, i / width));
    let map = Image {
        width,
        height,
        pixels: texels.collect(),
    };
    let image = image(&map);
    for (flip_u, rotation_deg, transform_deg) in [
        (false, 0.0, 0.0),
        (true, 0.0, 0.0),
        (false, 45.0, 0.0),
        (false, 0.0, 45.0),
        (true, 45.0, 45.0),
    ] {
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
            let column = if flip_u { width - 1 - x } else { x };
            let u = (f64::from(column) + 0.5) / f64::from(width);
            let v = (f64::from(y) + 0.5) / f64::from(height);
            let in_map = DVec3::from(direction_of([u, v]));
            let turn = DQuat::from_rotation_y(f64::to_radians(rotation_deg + transform_deg));
            let rendered = Job::with_threads([1, 1], 4, 1, 1)
                .integrator::<Path>(PathSettings::default())
                .scene(|world| {
                    camera(world, DVec3::ZERO, turn * in_map, 0.01);
                    let environment = Environment {
                        flip_u,
                        rotation_deg,
                        ..Default::default()
                    };
                    let transform = LocalTransform {
                        rotate_deg: [0.0, transform_deg, 0.0],
                        ..Default::default()
                    };
                    world.spawn((environment, image.clone(), transform));
                })
                .render();
            let seen = rendered.image.rgb.pixels[0];
            // A pixel of 0.01° reaches 10⁻⁴ of the way to the next texel.
            assert!(
                (seen - colour(x, y)).abs().max_element() < 2e-3,
                "{flip_u} {rotation_deg} {transform_deg}: {seen} for {x}, {y}"
            );
        }
    }
}

/// A ball and a floor under a map, direct light by light samples alone.
fn under(
    image: &EnvironmentImage,
    sampling: EnvironmentSampling,
    samples: u64,
    seed: u64,
) -> Image {
    let settings = DirectSettings {
        strategy: Strategy::Light,
        ..Default::default()
    };
    let job = Job::new([48, 36], samples, seed)
        .integrator::<Direct>(settings)
        .scene(|world| {
            camera(
                world,
                DVec3::new(0.0, 2.0, 5.0),
                DVec3::new(0.0, 0.3, 0.0),
                40.0,
            );
            let grey = world.spawn(Lambert::default()).id();
            world.spawn((Sphere { radius: 1.0 }, MaterialRef(grey)));
            let floor = LocalTransform {
                translate: [0.0, -1.0, 0.0],
                rotate_deg: [-90.0, 0.0, 0.0],
                ..Default::default()
            };
            let wide = Quad {
                width: 200.0,
                height: 200.0,
            };
            world.spawn((wide, floor, MaterialRef(grey)));
            let environment = Environment {
                sampling,
                ..Default::default()
            };
            world.spawn((environment, image.clone()));
        });
    job.render().image.rgb
}

fn sky(sun_elevation: f64, turbidity: f64, no_sun: bool) -> EnvironmentImage {
    let args = SkyArgs {
        output: "unused.exr".into(),
        sun_elevation,
        sun_azimuth: 60.0,
        turbidity,
        ground_albedo: 0.3,
        width: 256,
        no_sun,
    };
    image(&Sky::new(&args).expect("a sky").image(args.width))
}

/// At equal numbers of light samples, relMSE of uniform samples over that of samples by the map. Measured
/// were 8000 under a sun, which is the price of finding a disk of 0.00007 sr by chance, and 6 under haze
/// without one, which is brighter above than the ground is below.
#[test]
fn sampling_by_the_map_pays_under_the_sun_and_under_haze() {
    let factor = |name: &str, image: &EnvironmentImage, samples: u64| {
        let [uniform, importance] = [
            EnvironmentSampling::Uniform,
            EnvironmentSampling::Importance,
        ];
        let reference = under(image, importance, 2048, 1);
        let error = |sampling| {
            let of = |seed| relmse(&under(image, sampling, samples, seed), &reference);
            (2..6).map(|seed| of(seed).expect("one size")).sum::<f64>() / 4.0
        };
        let errors = [error(uniform), error(importance)];
        let factor = errors[0] / errors[1];
        eprintln!(
            "{name}: relMSE uniform {:.3e}, by the map {:.3e}, factor {factor:.2}",
            errors[0], errors[1]
        );
        factor
    };
    assert!(factor("sunny", &sky(40.0, 3.0, false), 64) > 100.0);
    assert!(factor("haze", &sky(80.0, 10.0, true), 64) > 3.0);
}

/// How the other renderer lays rows: it looks up row v·(H − 1), so that the first and last one lie on the
/// poles; found by comparing the reference's background, in which its columns lie as ours do. The same
/// function of v in rows as ours lie, `fine` times as many: it is linear between them but for the
/// two around a kink.
fn with_rows_on_the_poles(map: &Image, fine: u32) -> Image {
    let height = fine * (map.height - 1);
    let mut out = Image::filled(map.width, height, Vec3::ZERO);
    for y in 0..height {
        let at = (y as f32 + 0.5) / fine as f32;
        let (above, t) = (at.floor(), at.fract());
        for x in 0..map.width {
            let [a, b] = [0, 1].map(|k| map.pixel(x, above as u32 + k));
            out.pixels[(y * map.width + x) as usize] = a.lerp(b, t);
        }
    }
    out
}

/// Tiles that show some of the map, of a picture that is black where it does not.
fn tiles_with_background(picture: &Image) -> Vec<(u32, u32)> {
    let shows = |x: u32, y: u32| {
        let mut pixels = (0..TILE * TILE).map(|i| (x * TILE + i % TILE, y * TILE + i / TILE));
        pixels.any(|(x, y)| picture.pixel(x, y) != Vec3::ZERO)
    };
    let tiles =
        (0..picture.height / TILE).flat_map(|y| (0..picture.width / TILE).map(move |x| (x, y)));
    tiles.filter(|(x, y)| shows(*x, *y)).collect()
}

/// The reference has no halves to take its noise from, but its own figure of relMSE. Both renderers trace
/// paths and sample the map, so the noise is taken to lie where ours does: our variance, scaled to that
/// figure. Ours is that of independent samples, as most of the reference's are.
///
/// Tiles that show the map are left out of the test by tiles: the kinks that its rows get here, which
/// nobody sees in the light of it, are well above the noise there. Where a texel is seen is tested above.
#[test]
fn bunny_unlit_under_the_sunset_agrees_with_another_renderer() {
    let Some((refs, scenes)) = folders() else {
        return;
    };
    let name = "bunny_unlit_sunset";
    let samples = 4 * sample_factor();
    let read = |path: std::path::PathBuf| read_image(&path).unwrap_or_else(|e| panic!("{e}"));
    let reference = read(refs.join(format!("{name}_d6.exr")));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let map = with_rows_on_the_poles(&read(scenes.join("sunset.exr")), 9);
    let file = folder.path().join("sunset.exr");
    write_image_exr(&file, &map, Precision::Float, &[]).unwrap_or_else(|e| panic!("{e}"));
    let dae = scenes.join("bunny_unlit.dae");
    let scene = sr_tests::convert(&dae, folder.path(), Some("sunset.exr"));
    let images = replicas(&scene, samples, &[("sampler.kind", "Independent")]);
    let depth_0 = [("integrator", "Path(max_depth: 0)")];
    let background = &replicas(&scene, 1, &depth_0)[0];
    let noise = reference_noise(&refs, name);
    let variance: Vec<DVec3> = (0..reference.pixels.len())
        .map(|i| moments(&images, i).m2)
        .collect();
    let pixels = variance.iter().zip(&reference.pixels);
    let ours: f64 = pixels
        .map(|(v, r)| (*v / (r.as_dvec3().powf(2.0) + 0.01)).element_sum() / 3.0)
        .sum();
    let scale = noise / (ours / variance.len() as f64);
    // Two pictures whose difference says that variance.
    let half = |sign: f32| {
        let mut half = reference.clone();
        for (p, v) in half.pixels.iter_mut().zip(&variance) {
            *p += sign * (*v * scale).map(f64::sqrt).as_vec3();
        }
        half
    };
    let left_out = tiles_with_background(background);
    let result = compare(&images, &reference, [&half(1.0), &half(-1.0)], &left_out);
    let known = Known {
        name,
        picture: &reference,
        noise,
        bias: 0.0,
        tiles: 700,
    };
    judge(&known, samples, &result);
}
