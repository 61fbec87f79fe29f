//! Bits that must not change: with threads, passes, crops, and the order of work.

mod replay;

use sr_integrators::{Direct, DirectSettings, Path, PathSettings};
use sr_pipeline::LogPoints;
use sr_pipeline::film_kernel::{FilmImage, Layer};
use sr_pipeline::prelude::*;
use sr_scene::components::*;
use sr_scene::settings::{
    AdaptiveRule, AdaptiveSettings, Budget, CompileSettings, FilmSettings, LayerName,
    LightSelectionName, SamplerSettings,
};
use sr_tests::Job;

/// A box with a mirror, a glass and a metal sphere, seen through a lens: every stage of the wave has
/// work.
fn scene(world: &mut World) {
    world.spawn((
        PerspectiveCamera {
            hfov_deg: Some(60.0),
            vfov_deg: None,
        },
        LookAt {
            from: [0.1, 0.2, 2.5],
            to: [0.0; 3],
            up: [0.0, 1.0, 0.0],
        },
        ThinLens {
            aperture_radius: 0.05,
            focus_distance: Some(2.0),
            blades: 6,
            ..Default::default()
        },
        ActiveCamera,
    ));
    let wall = world
        .spawn(Lambert {
            reflectance: Rgb([0.7, 0.6, 0.5]),
        })
        .id();
    let lamp = world
        .spawn((
            Lambert::default(),
            Emission {
                two_sided: true,
                ..Default::default()
            },
        ))
        .id();
    let lobes = [
        world.spawn(Mirror::default()).id(),
        world.spawn(Dielectric::default()).id(),
        world
            .spawn(Conductor {
                alpha: Some(0.2),
                ..Default::default()
            })
            .id(),
    ];
    for (i, lobe) in lobes.into_iter().enumerate() {
        world.spawn((
            Sphere { radius: 0.4 },
            LocalTransform::from_translation([i as f64 - 1.0, -0.3, 0.0]),
            MaterialRef(lobe),
        ));
    }
    world.spawn((
        Quad {
            width: 6.0,
            height: 6.0,
        },
        LocalTransform {
            translate: [0.0, -0.7, 0.0],
            rotate_deg: [-90.0, 0.0, 0.0],
            ..Default::default()
        },
        MaterialRef(wall),
    ));
    world.spawn((
        Quad {
            width: 1.0,
            height: 1.0,
        },
        LocalTransform {
            translate: [0.0, 1.5, 0.0],
            rotate_deg: [90.0, 0.0, 0.0],
            ..Default::default()
        },
        MaterialRef(lamp),
    ));
    world.spawn(Environment {
        radiance: Rgb([0.1, 0.2, 0.3]),
        ..Default::default()
    });
}

const SIZE: [u32; 2] = [70, 50];

/// Renders with `threads` threads after `change`; 64 samples unless changed.
fn render(threads: usize, change: impl FnOnce(&mut World)) -> FilmImage {
    let settings = PathSettings {
        max_depth: Some(8),
        ..Default::default()
    };
    let mut job = Job::with_threads(SIZE, 64, 5, threads)
        .integrator::<Path>(settings)
        .scene(scene);
    change(job.world());
    job.render().image
}

fn bits(image: &FilmImage) -> Vec<[u32; 6]> {
    image
        .rgb
        .pixels
        .iter()
        .zip(&image.variance_of_mean.pixels)
        .map(|(a, b)| [a.x, a.y, a.z, b.x, b.y, b.z].map(f32::to_bits))
        .collect()
}

#[test]
fn threads_do_not_change_a_bit() {
    let one = bits(&render(1, |_| ()));
    for threads in [2, 7] {
        assert!(bits(&render(threads, |_| ())) == one, "{threads} threads");
    }
}

#[test]
fn one_pass_of_64_equals_sixteen_of_4() {
    let passes = |n: u32| {
        render(2, move |world| {
            world.resource_mut::<Budget>().pass_samples = Some(n)
        })
    };
    let whole = bits(&passes(64));
    for n in [4, 7] {
        assert!(bits(&passes(n)) == whole, "passes of {n}");
    }
}

#[test]
fn a_crop_is_that_part_of_the_picture() {
    let whole = render(2, |_| ());
    let [x0, y0, x1, y1] = [5u32, 9, 43, 34];
    let crop = render(2, |world| {
        world.resource_mut::<FilmSettings>().crop = Some([x0, y0, x1, y1]);
    });
    assert_eq!([crop.width, crop.height], [x1 - x0, y1 - y0]);
    let (whole, crop) = (bits(&whole), bits(&crop));
    for y in y0..y1 {
        for x in x0..x1 {
            let a = crop[((y - y0) * (x1 - x0) + x - x0) as usize];
            assert_eq!(a, whole[(y * SIZE[0] + x) as usize], "pixel {x}, {y}");
        }
    }
}

/// Samples go where they are wanted, in blocks of 4 × 4 that the crop below cuts.
fn adaptive(world: &mut World) {
    world.insert_resource(AdaptiveSettings {
        rule: AdaptiveRule::Folds,
        tolerance: 0.1,
        batch: 16,
        min_samples: 16,
        ..Default::default()
    });
    world.resource_mut::<SamplerSettings>().replicas = 4;
}

#[test]
fn adaptive_pictures_depend_on_neither_threads_nor_passes_nor_crops() {
    let with = |threads, change: &dyn Fn(&mut World)| {
        render(threads, |world| {
            adaptive(world);
            change(world);
        })
    };
    let picture = with(1, &|_| ());
    let share = |n| picture.sample_count.iter().filter(|c| **c == n).count();
    let (fewest, most) = (share(16), share(64));
    assert!(fewest > 100 && most > 100, "{fewest} {most}: not adaptive");
    let bits_and_counts = |image: &FilmImage| (bits(image), image.sample_count.clone());
    let whole = bits_and_counts(&picture);
    for (threads, pass) in [(2, None), (7, Some(3)), (2, Some(16)), (2, Some(1))] {
        let other = with(threads, &|world| {
            world.resource_mut::<Budget>().pass_samples = pass;
        });
        assert!(
            bits_and_counts(&other) == whole,
            "{threads} threads, {pass:?}"
        );
    }
    let [x0, y0, x1, y1] = [5u32, 9, 43, 34];
    let crop = with(2, &|world| {
        world.resource_mut::<FilmSettings>().crop = Some([x0, y0, x1, y1]);
    });
    let crop = bits_and_counts(&crop);
    for (i, at) in (y0..y1)
        .flat_map(|y| (x0..x1).map(move |x| (y * SIZE[0] + x) as usize))
        .enumerate()
    {
        assert_eq!((crop.0[i], crop.1[i]), (whole.0[at], whole.1[at]), "{i}");
    }
}

#[test]
fn layers_do_not_change_the_picture() {
    let plain = bits(&render(2, |_| ()));
    let with_layers = render(2, |world| {
        world.resource_mut::<FilmSettings>().layers = vec![
            LayerName::Normal,
            LayerName::Depth,
            LayerName::Ids,
            LayerName::Bounces,
            LayerName::Seconds,
        ];
    });
    assert_eq!(with_layers.layers.len(), 5);
    assert_eq!(with_layers.layers[0].layer, Layer::Normal);
    assert!(bits(&with_layers) == plain);
}

/// Neither do looks at it: errors at common sample counts are the same.
#[test]
fn log_points_do_not_change_the_picture() {
    let plain = bits(&render(2, |_| ()));
    for points in [
        LogPoints::none(),
        LogPoints {
            doublings: true,
            seconds: (1..100).map(|i| 0.01 * f64::from(i)).collect(),
        },
    ] {
        let other = render(2, |world| {
            world.insert_resource(points.clone());
        });
        assert!(bits(&other) == plain, "{points:?}");
    }
}

/// Several samples of every light make more shadow rays than wait at once, and several directions more
/// paths than a wave has: neither where they are cut nor the threads show.
#[test]
fn light_samples_do_not_depend_on_threads_or_passes() {
    let picture = |threads, pass: u32| {
        let settings = DirectSettings {
            light_samples: 5,
            ..Default::default()
        };
        let mut job = Job::with_threads(SIZE, 8, 5, threads)
            .integrator::<Direct>(settings)
            .scene(scene);
        let world = job.world();
        world.resource_mut::<Budget>().pass_samples = Some(pass);
        world.resource_mut::<CompileSettings>().light_selection = LightSelectionName::All;
        bits(&job.render().image)
    };
    let one = picture(1, 8);
    assert!(picture(7, 8) == one && picture(2, 3) == one);
}

#[test]
fn another_seed_is_another_picture() {
    let a = render(2, |_| ());
    let b = render(2, |world| {
        world.resource_mut::<SamplerSettings>().seed = 6;
    });
    assert!(bits(&a) != bits(&b));
}
