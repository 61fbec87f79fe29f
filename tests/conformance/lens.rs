//! The thin lens: the shape of its blur in closed form, what is in focus, and method against method.

use example_light_tracer::{LightTracer, LightTracerSettings};
use sr_integrators::{Path, PathBsdf, PathSettings};
use sr_pipeline::film_kernel::{FilmImage, Image};
use sr_pipeline::prelude::*;
use sr_scene::components::*;
use sr_tests::{
    Job, Scene,
    agree::{assert_same, pictures},
    repository,
};

const SIDE: u32 = 64;

/// At the origin, looking along −Z; what is seen at distance 1 is 1 m wide.
fn camera(lens: ThinLens) -> impl Bundle {
    let hfov_deg = Some(2.0 * 0.5f64.atan().to_degrees());
    let projection = PerspectiveCamera {
        hfov_deg,
        vfov_deg: None,
    };
    (projection, LookAt::default(), lens, ActiveCamera)
}

fn parallel(lens: ThinLens) -> impl Bundle {
    let projection = Orthographic {
        width: Some(2.0),
        height: None,
    };
    (projection, LookAt::default(), lens, ActiveCamera)
}

fn lens(aperture_radius: f64, focus_distance: f64) -> ThinLens {
    ThinLens {
        aperture_radius,
        focus_distance: Some(focus_distance),
        ..Default::default()
    }
}

/// A glowing square that faces the camera, as small as a point. (A sphere would look the larger, in
/// the plane of the film, the farther from the axis it is seen.)
fn spark(world: &mut World, depth: f64) {
    let glow = Emission {
        radiance: Rgb::splat(1.0),
        ..Default::default()
    };
    let black = Lambert {
        reflectance: Rgb::splat(0.0),
    };
    let material = world.spawn((black, glow)).id();
    world.spawn((
        Quad {
            width: 1e-3,
            height: 1e-3,
        },
        LocalTransform::from_translation([0.0, 0.0, -depth]),
        MaterialRef(material),
    ));
}

/// Where the light of a picture lies, in units of `radius` around its middle: mean of x and y,
/// of r² and r⁴, and of (x + iy)³, y upwards; and the share of light within 1.05.
struct Blur {
    middle: [f64; 2],
    r2: f64,
    r4: f64,
    cube: [f64; 2],
    within: f64,
}

fn blur(image: &Image, radius: f64) -> Blur {
    let mut b = Blur {
        middle: [0.0; 2],
        r2: 0.0,
        r4: 0.0,
        cube: [0.0; 2],
        within: 0.0,
    };
    let mut total = 0.0;
    for py in 0..image.height {
        for px in 0..image.width {
            let w = f64::from(image.pixel(px, py).x);
            let at = |p: u32, n: u32| (f64::from(p) + 0.5 - 0.5 * f64::from(n)) / radius;
            let (x, y) = (at(px, image.width), -at(py, image.height));
            let r2 = x * x + y * y;
            total += w;
            b.middle = [b.middle[0] + w * x, b.middle[1] + w * y];
            b.r2 += w * r2;
            b.r4 += w * r2 * r2;
            b.cube[0] += w * (x * x * x - 3.0 * x * y * y);
            b.cube[1] += w * (3.0 * x * x * y - y * y * y);
            b.within += if r2 < 1.05 * 1.05 { w } else { 0.0 };
        }
    }
    Blur {
        middle: b.middle.map(|m| m / total),
        r2: b.r2 / total,
        r4: b.r4 / total,
        cube: b.cube.map(|c| c / total),
        within: b.within / total,
    }
}

/// The picture of a spark by light tracing, which finds it through the lens: 16 paths for each
/// pixel.
fn spark_picture(camera: impl Bundle, depth: f64) -> FilmImage {
    let settings = LightTracerSettings { max_depth: 0 };
    let job = Job::new([SIDE, SIDE], 16, 3).integrator::<LightTracer>(settings);
    let rendered = job
        .scene(|world| {
            world.spawn(camera);
            spark(world, depth);
        })
        .render();
    assert_eq!(rendered.report.tiles.rejects.total(), 0);
    rendered.image
}

/// 65 536 splats of equal weight: standard errors are 1/256 of the spread of what is averaged, 0.5
/// for a coordinate and at most 0.5 for the others, so 0.01 is 5σ; pixels instead of places add
/// 1/(6 · 19²) = 5·10⁻⁴ to r² of the smallest. A radius off by 1.5 % would be seen.
fn check_disk(image: &Image, radius: f64) {
    let b = blur(image, radius);
    assert!(
        b.middle[0].abs() < 0.01 && b.middle[1].abs() < 0.01,
        "{:?}",
        b.middle
    );
    assert!((b.r2 - 0.5).abs() < 0.01, "{}", b.r2);
    assert!((b.r4 - 1.0 / 3.0).abs() < 0.01, "{}", b.r4);
    assert!(b.cube[0].hypot(b.cube[1]) < 0.01, "{:?}", b.cube);
    assert_eq!(b.within, 1.0);
}

/// A point at depth z through a lens of radius R focused at f is a disk of radius R |1/z − 1/f| at
/// distance 1, evenly bright, on either side of the focus; so does the path tracer see it.
#[test]
fn a_point_out_of_focus_is_the_disk_of_confusion() {
    for (radius, focus, depth) in [(0.9, 3.0, 1.5), (0.9, 1.5, 3.0), (0.6, f64::INFINITY, 2.0)] {
        let expected = radius * f64::abs(1.0 / depth - 1.0 / focus) * f64::from(SIDE);
        let image = spark_picture(camera(lens(radius, focus)), depth);
        check_disk(&image.rgb, expected);
    }
    // For parallel rays R |1 − z/f|, in metres; what is seen is 2 m wide.
    let image = spark_picture(parallel(lens(0.6, 2.0)), 4.0);
    check_disk(&image.rgb, 0.6 * 0.5 * f64::from(SIDE));
}

/// A spark behind the focus shows the aperture as it stands, one in front of it upside down:
/// for a triangle with a corner at angle φ the mean of (x + iy)³ is e^{3iφ}/10, of the radius of
/// its corners, and the mean of r² is 1/4. The bounds are those of the disk.
#[test]
fn the_blur_has_the_shape_of_the_aperture() {
    for (focus, depth, sign) in [(1.5, 3.0, 1.0), (3.0, 1.5, -1.0)] {
        for rotation_deg in [0.0, 40.0] {
            let triangle = ThinLens {
                blades: 3,
                rotation_deg,
                ..lens(0.9, focus)
            };
            let image = spark_picture(camera(triangle), depth);
            let b = blur(&image.rgb, 0.3 * f64::from(SIDE));
            let (sin, cos) = (3.0 * (90.0 + rotation_deg)).to_radians().sin_cos();
            let off = (b.cube[0] - 0.1 * sign * cos).hypot(b.cube[1] - 0.1 * sign * sin);
            assert!(off < 0.01, "{rotation_deg} {sign}: {:?}", b.cube);
            assert!((b.r2 - 0.25).abs() < 0.01, "{}", b.r2);
            assert_eq!(b.within, 1.0);
        }
    }
}

/// Glowing quads in one plane at depth 2, like tiles with gaps.
fn tiles(world: &mut World) {
    for i in 0..5 {
        for j in 0..5 {
            let radiance = Rgb([0.2 * i as f32 + 0.1, 0.2 * j as f32 + 0.1, 0.5]);
            let glow = Emission {
                radiance,
                ..Default::default()
            };
            let material = world.spawn((Lambert::default(), glow)).id();
            let center = [f64::from(i) * 0.4 - 0.8, f64::from(j) * 0.4 - 0.8, -2.0];
            world.spawn((
                Quad {
                    width: 0.31,
                    height: 0.23,
                },
                LocalTransform::from_translation(center),
                MaterialRef(material),
            ));
        }
    }
}

fn tiles_through(camera: impl Bundle) -> Image {
    let glow_only = PathSettings {
        max_depth: Some(0),
        ..Default::default()
    };
    let job = Job::new([SIDE, SIDE], 16, 7).integrator::<Path>(glow_only);
    let scene = job.scene(|world| {
        world.spawn(camera);
        tiles(world);
    });
    scene.render().image.rgb
}

/// Every sample of a plane in focus sees what the pinhole's sees, so the pictures are equal, but
/// for samples that rounding moves over an edge: of 65 536, of which the edges' neighbourhood of
/// 10⁻⁶ m holds about 1. Out of focus most pixels differ.
#[test]
fn the_plane_of_focus_is_as_sharp_as_through_a_pinhole() {
    let unequal = |a: &Image, b: &Image| {
        let pairs = a.pixels.iter().zip(&b.pixels);
        pairs.filter(|(a, b)| a != b).count()
    };
    let pinhole = tiles_through(camera(ThinLens::default()));
    for blades in [0, 6] {
        let through = |focus| {
            tiles_through(camera(ThinLens {
                blades,
                ..lens(0.3, focus)
            }))
        };
        assert!(unequal(&pinhole, &through(2.0)) <= 3);
        assert!(unequal(&pinhole, &through(1.5)) > 1000);
    }
    let pinhole = tiles_through(parallel(ThinLens::default()));
    assert!(unequal(&pinhole, &tiles_through(parallel(lens(0.3, 2.0)))) <= 3);
    assert!(unequal(&pinhole, &tiles_through(parallel(lens(0.3, 1.5)))) > 1000);
}

/// A scene of the repository with some overrides, small.
fn load(scene: &str, overrides: &[(&str, &str)]) -> Scene {
    let path = repository().join("scenes").join(scene);
    let small = [("film.width", "64"), ("film.height", "48")];
    Scene::load(&path, &[&small, overrides].concat())
}

const BOXES: &str = "cornell_boxes/cornell_boxes.scene.ron";

#[test]
fn an_aperture_of_radius_0_is_the_pinhole_bit_for_bit() {
    let picture = |overrides: &[(&str, &str)]| load(BOXES, overrides).render(8, 1).image.rgb;
    let pinhole = picture(&[]);
    let closed = "(aperture_radius: 0, focus: At((32, 24)), blades: 5)";
    assert!(picture(&[("camera.ThinLens", closed)]) == pinhole);
    let open = "(aperture_radius: 1e-3, focus: At((32, 24)), blades: 5)";
    assert!(picture(&[("camera.ThinLens", open)]) != pinhole);
}

#[test]
fn light_tracing_agrees_with_path_through_a_lens() {
    let blurred = (
        "camera.ThinLens",
        "(aperture_radius: 0.3, focus_distance: 3.3, blades: 5)",
    );
    let parallel = (
        "camera",
        r#"{"Orthographic": (width: 2), "LookAt": (from: (0, 1, 4.3), to: (0, 1, 0)),
            "ThinLens": (aperture_radius: 0.3, focus_distance: 3.3)}"#,
    );
    for change in [blurred, parallel] {
        let mut path = load(BOXES, &[change, ("integrator", "Path(max_depth: 3)")]);
        let mut tracer = load(
            BOXES,
            &[change, ("integrator", "LightTracer(max_depth: 3)")],
        );
        assert_same(
            &format!("{}: Path and LightTracer", change.0),
            &pictures(&mut path, 32, 1),
            &pictures(&mut tracer, 64, 2),
        );
    }
}

/// The same radiance from everywhere stays what it is.
#[test]
fn a_lens_is_invisible_in_a_furnace() {
    let settings = PathSettings {
        light_samples: 1,
        max_depth: Some(8),
        roulette_from: None,
    };
    let rendered = Job::new([16, 12], 16, 1)
        .integrator::<PathBsdf>(settings)
        .scene(|world| {
            world.spawn(camera(lens(0.5, 2.0)));
            let white = Lambert {
                reflectance: Rgb::splat(1.0),
            };
            let material = world.spawn(white).id();
            world.spawn((
                Sphere { radius: 0.7 },
                LocalTransform::from_translation([0.0, 0.0, -2.0]),
                MaterialRef(material),
            ));
            world.spawn(Environment::default());
        })
        .render();
    // Every path brings back 1: cosine-distributed directions have weight 1, up to rounding.
    for pixel in &rendered.image.rgb.pixels {
        assert!((*pixel - Vec3::ONE).abs().max_element() < 1e-5, "{pixel}");
    }
}

/// Distance of focus of a scene, seen from `eye` on the z axis.
fn focus(change: &str, eye: f64) -> f64 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("focus.scene.ron");
    let text = r#"(film: (width: 64, height: 48), entities: {
        "m": {"Lambert": ()},
        "near": {"Sphere": (radius: 0.5), "LocalTransform": (translate: (0.25, 0, 3)), "MaterialRef": "m"},
        "wall": {"Quad": (width: 9, height: 9), "LocalTransform": (translate: (0, 0, -3)), "MaterialRef": "m"},
        "group": {"LocalTransform": (translate: (0, 0, 1))},
        "left": {"Sphere": (radius: 0.1), "LocalTransform": (translate: (-1, 0, 0), rotate_deg: (30, 20, 10)), "ChildOf": "group", "MaterialRef": "m"},
        "right": {"Sphere": (radius: 0.1), "LocalTransform": (translate: (1, 0, -1)), "ChildOf": "group", "MaterialRef": "m"},
        "spot": {"LocalTransform": (translate: (1, 2, 2.5))},
        "camera": {"PerspectiveCamera": (hfov_deg: 40), "LookAt": (from: (0.25, 0, 7), to: (0.25, 0, 0)), "ActiveCamera": ()},
    })"#;
    std::fs::write(&path, text).expect("a file in a temporary folder");
    let lens = format!("(aperture_radius: 0.1, {change})");
    let from = format!("(0.25, 0, {eye})");
    let to = format!("(0.25, 0, {})", eye - 1.0);
    let changes = [
        ("camera.ThinLens", lens.as_str()),
        ("camera.LookAt.from", &from),
        ("camera.LookAt.to", &to),
    ];
    let mut scene = Scene::load(&path, &changes);
    let camera = *scene.world().resource::<SealedScene>().camera();
    camera.lens.expect("a lens").focus_distance()
}

#[test]
fn the_focus_is_found() {
    for (change, expected) in [
        ("focus_distance: 5", 5.0),
        // The middle of the sphere, and what is seen of it next to the axis.
        ("focus: Entity(\"near\")", 4.0),
        ("focus: At((32, 24))", 3.5),
        // Depth, not distance.
        ("focus: At((0, 0))", 10.0),
        ("focus: Entity(\"wall\")", 10.0),
        // Both children; and what has no shape.
        ("focus: Entity(\"group\")", 6.5),
        ("focus: Entity(\"spot\")", 4.5),
    ] {
        let found = focus(change, 7.0);
        // The pixel's centre lies 0.0057 off the axis at distance 1: on the sphere 4·10⁻⁴ deeper.
        assert!((found - expected).abs() < 1e-3, "{change}: {found}");
    }
}

#[test]
#[should_panic(expected = "the ray through pixel (63, 0) meets nothing; choose a pixel")]
fn a_focus_on_nothing_is_refused() {
    let away = [
        (
            "camera.ThinLens",
            "(aperture_radius: 0.1, focus: At((63, 0)))",
        ),
        ("camera.LookAt", "(from: (0, 1, 9), to: (0, 1, 0))"),
    ];
    load(BOXES, &away);
}

#[test]
#[should_panic(expected = "the middle of `near` is not in front of the camera, but at -4 m")]
fn a_focus_behind_the_camera_is_refused() {
    focus("focus: Entity(\"near\")", -1.0);
}
