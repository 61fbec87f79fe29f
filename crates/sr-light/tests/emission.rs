//! `sample_le` carries the light's power, and its rays are those of the light.

mod common;

use common::numbers;
use glam::{Mat3, Vec2, Vec3};
use sr_light::{
    ConstantEnvironment, DirectionalLight, EnvironmentMap, EnvironmentSampling, ImageEnvironment,
    Light, PointLight, QuadLight, SphereLight, SpotLight, TriangleLight,
};

const CENTER: Vec3 = Vec3::new(1.0, -2.0, 0.5);
const RADIUS: f32 = 3.0;

fn spot(cos_inner: f32, cos_outer: f32) -> Light {
    Light::Spot(SpotLight {
        p: Vec3::X,
        axis: Vec3::new(0.6, 0.0, -0.8),
        intensity: Vec3::new(1.0, 2.0, 3.0),
        cos_inner,
        cos_outer,
    })
}

/// A grey map in the colour of the other lights: sampling in proportion to its luminance is in
/// proportion to each channel.
fn map(l: Vec3) -> Light {
    let texels = (0..8 * 4).map(|i| Vec3::splat(numbers(i, 9)));
    let map = EnvironmentMap::new(8, 4, texels.collect()).expect("a map");
    Light::ImageEnvironment(ImageEnvironment {
        map: map.into(),
        to_map: Mat3::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), 1.0),
        scale: l,
        sampling: EnvironmentSampling::Importance,
    })
}

fn lights() -> Vec<(&'static str, Light)> {
    let l = Vec3::new(1.0, 2.0, 3.0);
    let corners = [[-0.5, 1.0, -0.4], [0.6, 1.2, -0.5], [0.4, 0.9, 0.5]].map(Vec3::from);
    let (e, f) = (Vec3::new(1.0, 0.5, 0.0), Vec3::new(-0.3, 0.6, 0.9));
    let mut all = vec![
        (
            "point",
            Light::Point(PointLight {
                p: Vec3::X,
                intensity: l,
            }),
        ),
        (
            "sun",
            Light::Directional(DirectionalLight {
                wi: Vec3::Y,
                irradiance: l,
            }),
        ),
        (
            "sky",
            Light::Environment(ConstantEnvironment { radiance: l }),
        ),
        ("map", map(l)),
        ("spot", spot(0.9, 0.5)),
        ("wide spot", spot(0.1, -0.7)),
        ("spot without plateau", spot(1.0, 0.8)),
        ("sharp spot", spot(0.95, 0.95)),
        ("spot narrower than the least ramp", spot(0.9999, 0.9995)),
    ];
    for two_sided in [false, true] {
        all.push((
            "triangle",
            Light::Triangle(TriangleLight::new(corners, l, two_sided)),
        ));
        all.push((
            "quad",
            Light::Quad(QuadLight::new(Vec3::X, e, f, l, two_sided)),
        ));
        all.push((
            "sphere",
            Light::Sphere(SphereLight::new(Vec3::X, 0.7, l, two_sided)),
        ));
    }
    all
}

/// Every kind of light is sampled in proportion to what it emits, so each single ray carries the whole
/// power: no statistics are needed. The bound is some twenty roundings, and a few hundred ulp where a
/// spot of 2° is cut from cosines near 1.
#[test]
fn every_ray_carries_the_whole_power() {
    for (name, light) in lights() {
        let power = light.power(CENTER, RADIUS);
        let mut found = 0;
        for i in 0..10_000 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| numbers(i, k));
            let Some(e) = light.sample_le(Vec2::new(a, b), Vec2::new(c, d), CENTER, RADIUS) else {
                continue;
            };
            found += 1;
            let flux = e.radiance * (e.ng.dot(e.d).abs() / (e.pdf_pos * e.pdf_dir));
            let error = (flux / power - 1.0).abs().max_element();
            // The cosine is taken anew from a rotated direction: an ulp of 1.
            let bound = 2e-6 + 1e-6 / e.ng.dot(e.d).abs();
            assert!(error < bound, "{name} {i}: {flux} of {power}");
            assert!((e.d.length() - 1.0).abs() < 1e-6);
            assert_eq!(e.is_delta_direction, name == "sun");
            assert_eq!(
                e.is_delta_position,
                name.contains("spot") || name == "point"
            );
        }
        assert!(found > 9_990, "{name}: {found}");
    }
}

/// The rays are those that `sample_li` sees, from the other end: the falloff of a spot averages to its
/// power over the sphere by a midpoint rule, which knows nothing of the sampling.
#[test]
fn the_power_of_a_spot_is_the_integral_of_its_falloff() {
    for (name, light) in lights() {
        let Light::Spot(spot) = light else { continue };
        let n = 1 << 20;
        let sum: f64 = (0..n)
            .map(|i| {
                let cos = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(n);
                f64::from(spot.falloff(cos as f32))
            })
            .sum();
        let integral = 4.0 * std::f64::consts::PI * sum / f64::from(n);
        let error = f64::from(light.power(CENTER, RADIUS).x) / integral - 1.0;
        // f32 cosines leave the narrow ones 2⁻²⁴ of 5·10⁻⁴.
        assert!(error.abs() < 1e-3, "{name}: {error}");
    }
}

#[test]
fn infinite_lights_cover_the_scene_from_outside() {
    for (name, light) in lights().into_iter().filter(|(_, l)| l.is_infinite()) {
        let mut nearest = f32::INFINITY;
        for i in 0..10_000 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| numbers(i, k));
            let e = light
                .sample_le(Vec2::new(a, b), Vec2::new(c, d), CENTER, RADIUS)
                .expect("a scene of some size");
            let before = e.o - CENTER;
            assert!(before.length() >= RADIUS * 0.999_999, "{name}");
            // The ray's nearest approach to the centre is within the sphere.
            let closest = (before - before.dot(e.d) * e.d).length();
            assert!(closest <= RADIUS * 1.000_001, "{name}: {closest}");
            assert!(before.dot(e.d) < 0.0);
            nearest = nearest.min(closest);
        }
        assert!(nearest < 0.1 * RADIUS);
        let half = Vec2::splat(0.5);
        assert!(light.sample_le(half, half, CENTER, 0.0).is_none());
    }
}

/// Two-sided lights send half of their rays each way, one-sided ones none backward.
#[test]
fn rays_leave_on_the_emitting_sides() {
    for (name, light) in lights()
        .into_iter()
        .filter(|(_, l)| !l.is_delta() && !l.is_infinite())
    {
        let mut front = 0;
        for i in 0..1024u32 {
            let u = Vec2::new((i as f32 + 0.5) / 1024.0, 0.3);
            let e = light
                .sample_le(Vec2::splat(0.3), u, CENTER, RADIUS)
                .expect("inside the square");
            front += u32::from(e.d.dot(e.ng) > 0.0);
            assert_ne!(light.le(e.d, e.ng), Vec3::ZERO, "{name}");
        }
        assert!(front == 1024 || front == 512, "{name}: {front}");
    }
}
