//! Scenes whose radiance is known in closed form.

use sr_integrators::{Direct, DirectSettings, Path, PathBsdf, PathSettings, Strategy};
use sr_pipeline::prelude::*;
use sr_scene::components::*;
use sr_tests::Job;

fn camera(world: &mut World) {
    world.spawn((
        PerspectiveCamera {
            hfov_deg: Some(40.0),
            vfov_deg: None,
        },
        LookAt {
            from: [0.0, 0.0, 4.0],
            to: [0.0; 3],
            up: [0.0, 1.0, 0.0],
        },
        ActiveCamera,
    ));
}

/// A closed faceted mesh: an octahedron, each face cut in four twice, on the unit sphere.
fn gem() -> TriangleMesh {
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for x in [Vec3::X, -Vec3::X] {
        for y in [Vec3::Y, -Vec3::Y] {
            for z in [Vec3::Z, -Vec3::Z] {
                let outward = x.cross(y).dot(z) > 0.0;
                triangles.push(if outward { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    for _ in 0..2 {
        triangles = triangles
            .iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [*a + *b, *b + *c, *c + *a].map(Vec3::normalize);
                [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
            })
            .collect();
    }
    TriangleMesh {
        positions: triangles.iter().flatten().map(|p| p.to_array()).collect(),
        normals: Vec::new(),
        indices: (0..triangles.len() as u32)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect(),
    }
}

/// A closed shape of one lobe under a constant environment of radiance 1.
fn furnace(lobe: impl Bundle, shape: impl Bundle) -> impl FnOnce(&mut World) {
    move |world| {
        camera(world);
        let material = world.spawn(lobe).id();
        world.spawn((shape, MaterialRef(material)));
        world.spawn(Environment::default());
    }
}

fn path(max_depth: Option<u32>) -> PathSettings {
    PathSettings {
        max_depth,
        ..Default::default()
    }
}

/// Every path brings radiance 1 back, so the whole picture is 1. Two-sided test at 4σ of the
/// film's own error estimate (false alarm 6·10⁻⁵); the bound on σ says that an object off by 1 %
/// would be seen.
fn check_invisible<B: Bundle + Clone>(name: &str, lobe: B) {
    check_shape(
        &format!("{name} sphere"),
        lobe.clone(),
        Sphere { radius: 1.0 },
    );
    check_shape(&format!("{name} gem"), lobe, gem());
}

fn check_shape(name: &str, lobe: impl Bundle, shape: impl Bundle) {
    let job = Job::new([64, 48], 64, 1).integrator::<Path>(path(None));
    let rendered = job.scene(furnace(lobe, shape)).render();
    let (mean, sigma) = rendered.mean();
    assert!(sigma < 2.5e-3, "{name}: σ {sigma}");
    assert!(
        (mean - 1.0).abs() < 4.0 * sigma + 1e-6,
        "{name}: {mean} ± {sigma}"
    );
    assert_eq!(rendered.report.tiles.rejects.total(), 0, "{name}");
}

#[test]
fn white_lambert_is_invisible_in_a_furnace() {
    check_invisible(
        "Lambert",
        Lambert {
            reflectance: Rgb::splat(1.0),
        },
    );
}

#[test]
fn white_mirror_is_invisible_in_a_furnace() {
    check_invisible("Mirror", Mirror::default());
}

#[test]
fn clear_glass_is_invisible_in_a_furnace() {
    check_invisible("Dielectric", Dielectric::default());
    check_invisible("ThinDielectric", ThinDielectric::default());
}

/// Inside a closed sphere that glows with Le and reflects ρ, radiance is Le/(1−ρ) everywhere.
/// 4σ of the film's estimate, and never looser than 1 % of the answer.
#[test]
fn closed_glowing_sphere_gives_le_over_one_minus_rho() {
    for rho in [0.0f32, 0.5, 0.9, 0.99] {
        for use_lights in [true, false] {
            let mut job = Job::new([24, 16], 512, 2);
            job = if use_lights {
                job.integrator::<Path>(path(None))
            } else {
                job.integrator::<PathBsdf>(path(None))
            };
            let rendered = job
                .scene(|world| {
                    camera(world);
                    let material = world
                        .spawn((
                            Lambert {
                                reflectance: Rgb::splat(rho),
                            },
                            Emission {
                                radiance: Rgb::splat(0.5),
                                two_sided: true,
                                ..Default::default()
                            },
                        ))
                        .id();
                    world.spawn((Sphere { radius: 10.0 }, MaterialRef(material)));
                })
                .render();
            let (mean, sigma) = rendered.mean();
            let truth = 0.5 / (1.0 - f64::from(rho));
            assert!(sigma < 2.5e-3 * truth, "ρ {rho}: σ {sigma}");
            assert!(
                (mean - truth).abs() < 4.0 * sigma + 1e-6 * truth,
                "ρ {rho}, lights {use_lights}: {mean} ± {sigma}, expected {truth}"
            );
        }
    }
}

/// One bounce off a Lambert plane under a constant environment is ρ, whatever the strategy.
#[test]
fn all_direct_strategies_agree_with_the_closed_form() {
    for strategy in [
        Strategy::Light,
        Strategy::Bsdf,
        Strategy::Hemisphere,
        Strategy::Mis,
        Strategy::MisHemisphere,
    ] {
        let rendered = Job::new([32, 24], 64, 3)
            .integrator::<Direct>(DirectSettings {
                strategy,
                ..Default::default()
            })
            .scene(|world| {
                camera(world);
                let material = world
                    .spawn(Lambert {
                        reflectance: Rgb::splat(0.7),
                    })
                    .id();
                world.spawn((
                    Quad {
                        width: 100.0,
                        height: 100.0,
                    },
                    MaterialRef(material),
                ));
                world.spawn(Environment {
                    radiance: Rgb::splat(2.0),
                    ..Default::default()
                });
            })
            .render();
        let (mean, sigma) = rendered.mean();
        assert!(sigma < 0.01, "{strategy:?}: σ {sigma}");
        assert!(
            (mean - 1.4).abs() < 4.0 * sigma + 1e-5,
            "{strategy:?}: {mean} ± {sigma}"
        );
    }
}
