//! Reference points on the light itself, where rounding decides on which side they lie.

use glam::{Quat, Vec2, Vec3};
use sr_light::{Light, QuadLight, SphereLight, TriangleLight};
use sr_math::hash;

fn u(i: u32, k: u32) -> f32 {
    hash::unit_f32(hash::mix(i, k))
}

/// Whatever is returned from such a point can be computed with.
#[test]
fn samples_seen_from_the_light_itself_are_finite() {
    for i in 0..200_000u32 {
        let turn = if i % 2 == 0 {
            Quat::from_rotation_x(std::f32::consts::FRAC_PI_2)
        } else {
            Quat::from_euler(
                glam::EulerRot::XYZ,
                6.0 * u(i, 0),
                6.0 * u(i, 1),
                6.0 * u(i, 2),
            )
        };
        let corner = Vec3::new(u(i, 3), u(i, 4), -5.0 * u(i, 5)) * 4.0;
        let (a, b) = (
            turn * Vec3::X * (0.1 + u(i, 6)),
            turn * Vec3::Y * (0.1 + u(i, 7)),
        );
        let (s, t) = (u(i, 8), u(i, 9));
        let radius = 0.1 + u(i, 6);
        let on_sphere = corner + (turn * Vec3::Z) * radius;
        let lights = [
            (
                Light::Quad(QuadLight::new(corner, a, b, Vec3::ONE, true)),
                corner + (s * a + t * b),
            ),
            (
                Light::Triangle(TriangleLight::new(
                    [corner, corner + a, corner + b],
                    Vec3::ONE,
                    true,
                )),
                corner + (s * (1.0 - t) * a + t * b),
            ),
            (
                Light::Sphere(SphereLight::new(corner, radius, Vec3::ONE, true)),
                on_sphere,
            ),
        ];
        for (light, p) in lights {
            let Some(sample) = light.sample_li(p, Vec2::new(u(i, 10), u(i, 11))) else {
                continue;
            };
            let arrives = sample.radiance / sample.pdf;
            assert!(
                arrives.is_finite() && sample.pdf.is_finite(),
                "{i} {light:?} {p}: {sample:?}"
            );
            let unit = (sample.wi.length() - 1.0).abs() < 1e-5;
            assert!(
                unit && sample.p.is_finite(),
                "{i} {light:?} {p}: {sample:?}"
            );
            let pdf = light.pdf_li(p, sample.wi, sample.dist, sample.ng);
            assert!(pdf.is_finite(), "{i} {light:?} {p}: {pdf}");
        }
    }
}
