//! Irradiance by `sample_li` against closed forms, and what a sample promises about its point.

mod common;

use common::{Shape, numbers};
use glam::{DVec3, Vec2, Vec3};
use sr_light::{
    DirectionalLight, Light, PointLight, QuadLight, SphereLight, SpotLight, TriangleLight,
};
use std::f64::consts::PI;

fn u(i: u32) -> Vec2 {
    Vec2::new(numbers(i, 2), numbers(i, 3))
}

/// Mean irradiance on a surface with normal `n` at `p`, and its standard error.
fn irradiance(light: &Light, p: Vec3, n: DVec3, samples: u32) -> (f64, f64) {
    let (mut sum, mut square) = (0.0, 0.0);
    for i in 0..samples {
        let e = light.sample_li(p, u(i)).map_or(0.0, |s| {
            f64::from(s.radiance.x) * s.wi.as_dvec3().dot(n).max(0.0) / f64::from(s.pdf)
        });
        sum += e;
        square += e * e;
    }
    let n = f64::from(samples);
    let mean = sum / n;
    (mean, ((square / n - mean * mean).max(0.0) / n).sqrt())
}

/// Lambert's formula: irradiance from a polygon of unit radiance above the horizon is half the sum of
/// the angles of its edges, each times the cosine between the edge's plane and `n`.
fn polygon_irradiance(p: DVec3, n: DVec3, corners: &[DVec3]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: f64 = edges
        .map(|(a, b)| {
            let (a, b) = (*a - p, *b - p);
            let cross = a.cross(b);
            cross.length().atan2(a.dot(b)) * cross.normalize().dot(n)
        })
        .sum();
    0.5 * sum.abs()
}

/// Agreement within 5 standard errors and a millionth: 20 figures, a false alarm of 10⁻⁵; the errors
/// are 0.1 % or less, so a bias of 0.5 % is found.
fn agree(name: &str, p: Vec3, (mean, error): (f64, f64), exact: f64) {
    assert!(error < 2e-3 * exact, "{name} {p}: noise {error} of {exact}");
    let bound = 5.0 * error + 1e-6 * exact;
    assert!(
        (mean - exact).abs() < bound,
        "{name} {p}: {mean} is not {exact} ± {error}"
    );
}

#[test]
fn flat_lights_match_lamberts_formula() {
    // Light over the receiver, both seen from the side: from near to far, steep to grazing.
    for p in [
        [0.1, 0.0, 0.2],
        [2.0, 0.3, -1.0],
        [4.0, 0.97, 0.5],
        [50.0, 0.0, 30.0],
    ] {
        let p = Vec3::from(p);
        let n = DVec3::new(-0.28, 0.96, 0.0);
        let (corner, e, f) = (
            Vec3::new(-0.5, 1.0, -0.3),
            Vec3::new(1.0, 0.0, 0.0),
            Vec3::new(0.0, 0.0, 0.6),
        );
        let c = [corner, corner + e, corner + e + f, corner + f];
        let exact = c.map(Vec3::as_dvec3);
        let quad = Light::Quad(QuadLight::new(corner, e, f, Vec3::ONE, false));
        let mean = irradiance(&quad, p, n, 400_000);
        agree("quad", p, mean, polygon_irradiance(p.as_dvec3(), n, &exact));
        let corners = [c[0], c[1], c[2]];
        let triangle = Light::Triangle(TriangleLight::new(corners, Vec3::ONE, false));
        let mean = irradiance(&triangle, p, n, 400_000);
        agree(
            "triangle",
            p,
            mean,
            polygon_irradiance(p.as_dvec3(), n, &exact[..3]),
        );
    }
}

/// A sphere above the horizon gives π sin²θ cos θn, from a near one that fills a sixth of the sky to
/// 10⁻¹² steradian and below. Near the limit directions are rounded more coarsely than the cone, so
/// the cosine is known to an ulp and no better; the rest is exact.
#[test]
fn spheres_match_the_closed_form_at_every_size() {
    let n = DVec3::new(0.0, 0.0, 1.0);
    for exponent in 0..8 {
        let distance = 2.0 * 10f32.powi(exponent);
        let center = distance * Vec3::new(0.48, -0.36, 0.8);
        let light = Light::Sphere(SphereLight::new(center, 1.0, Vec3::ONE, false));
        let p = Vec3::new(0.125, 0.25, -0.5);
        let to_center = center.as_dvec3() - p.as_dvec3();
        let sin2 = to_center.length_squared().recip();
        let exact = PI * sin2 * to_center.normalize().dot(n);
        agree("sphere", p, irradiance(&light, p, n, 100_000), exact);
    }
}

/// From inside a sphere of radiance L any surface receives πL; on its own wall every sample says so.
#[test]
fn the_inside_of_a_sphere_is_uniform() {
    let light = Light::Sphere(SphereLight::new(Vec3::ZERO, 2.0, Vec3::ONE, true));
    for p in [
        Vec3::ZERO,
        Vec3::new(0.1, -0.2, 0.3),
        Vec3::new(0.0, 0.0, -1.9999),
    ] {
        agree("inside", p, irradiance(&light, p, DVec3::Z, 1_000_000), PI);
    }
}

/// The wall as its own light, whichever side rounding has put the point on: every sample says π but for
/// the rounding δ of the point, of an ulp of the centre. A wall at distance d then errs by rδ/d² in
/// each cosine, and the share of such walls grows with d: on average 2 δ/r · ln(2r/d) of the nearest
/// of 2000, about 10 δ/r, most of it from a few samples. 64 leaves room for those; the cone, which is
/// the near wall, would leave 1.3 % of noise against this bound of 0.08 %.
#[test]
fn the_wall_of_a_sphere_is_lit_by_the_far_wall() {
    let (center, radius) = (Vec3::new(30.0, -7.0, 4.0), 0.3);
    let light = Light::Sphere(SphereLight::new(center, radius, Vec3::ONE, true));
    let bound = 64.0 * f64::from(f32::EPSILON * center.length() / radius);
    for i in 0..100 {
        let s = light
            .sample_li(Vec3::new(31.0, -6.0, 4.5), u(i))
            .expect("the light is seen");
        let (mean, _) = irradiance(&light, s.p, -s.ng.as_dvec3(), 2_000);
        assert!((mean / PI - 1.0).abs() < bound, "{}: {mean}", s.p);
    }
}

fn area_lights(two_sided: bool) -> [(Light, Shape); 4] {
    let corners = [[-0.5, 1.0, -0.4], [0.6, 1.2, -0.5], [0.4, 0.9, 0.5]].map(Vec3::from);
    let (corner, e, f) = (
        Vec3::new(10.0, -3.0, 7.0),
        Vec3::new(1.0, 0.5, 0.0),
        Vec3::new(-0.3, 0.6, 0.9),
    );
    let (center, radius) = (Vec3::new(-5.0, 100.0, 3.0), 2.5);
    let skew = Vec3::new(0.3, 0.3, 0.3);
    [
        (
            Light::Triangle(TriangleLight::new(corners, Vec3::ONE, two_sided)),
            Shape::triangle(corners),
        ),
        (
            Light::Quad(QuadLight::new(corner, e, f, Vec3::ONE, two_sided)),
            Shape::quad(corner, e, f),
        ),
        (
            Light::Quad(QuadLight::new(corner, e, skew, Vec3::ONE, two_sided)),
            Shape::quad(corner, e, skew),
        ),
        (
            Light::Sphere(SphereLight::new(center, radius, Vec3::ONE, two_sided)),
            Shape::sphere(center, radius),
        ),
    ]
}

/// A reference point somewhere about the light, from close by to far off.
fn about(shape: &Shape, i: u32) -> Vec3 {
    let direction = Vec3::from([4, 5, 6].map(|k| numbers(i, k) - 0.5)).normalize();
    shape.center() + shape.size() * 10f32.powf(4.0 * numbers(i, 7) - 1.5) * direction
}

#[test]
fn the_density_of_a_sample_is_what_pdf_li_says_of_it() {
    for (light, shape) in area_lights(true) {
        let mut found = 0;
        for i in 0..50_000 {
            let p = about(&shape, i);
            let Some(s) = light.sample_li(p, u(i)) else {
                continue;
            };
            found += 1;
            assert!(s.pdf > 0.0 && s.pdf.is_finite());
            assert!((s.wi.length() - 1.0).abs() < 1e-6);
            let pdf = light.pdf_li(p, s.wi, s.dist, s.ng);
            assert!(pdf == s.pdf, "{light:?} {p}: {pdf} {}", s.pdf);
        }
        assert!(found > 45_000, "{found}");
    }
}

/// The error of the point across the surface is within its bound, measured in `f64`.
#[test]
fn points_are_on_the_light_to_within_their_bound() {
    for (light, shape) in area_lights(true) {
        for i in 0..50_000 {
            let p = about(&shape, i);
            let Some(s) = light.sample_li(p, u(i)) else {
                continue;
            };
            let q = s.p.as_dvec3();
            let (ng, off) = match &shape {
                Shape::Flat { corner, .. } => {
                    let ng = shape.surface([0.5, 0.5]).1;
                    (ng, (q - *corner).dot(ng))
                }
                Shape::Sphere { center, radius } => {
                    let arm = q - *center;
                    (arm.normalize(), arm.length() - radius)
                }
            };
            let bound = ng.abs().dot(s.p_err.as_dvec3());
            assert!(off.abs() <= bound, "{light:?}: {off} > {bound}");
            assert!(s.ng.as_dvec3().dot(ng).abs() > 1.0 - 1e-6);
            // Direction and distance lead to the point.
            let end = p.as_dvec3() + f64::from(s.dist) * s.wi.as_dvec3();
            let scale = f64::from(s.dist + s.p.length() + p.length());
            assert!(
                (end - q).length() < 1e-5 * scale,
                "{light:?} {p}: {end} {q}"
            );
        }
    }
}

#[test]
fn one_sided_lights_are_dark_from_behind_and_all_are_from_their_plane() {
    for (one, two) in area_lights(false).into_iter().zip(area_lights(true)) {
        let ((light, shape), (both, _)) = (one, two);
        let ng = match &shape {
            Shape::Flat { .. } => shape.surface([0.5, 0.5]).1.as_vec3(),
            Shape::Sphere { .. } => Vec3::Y,
        };
        assert_eq!(light.le(ng, ng), Vec3::ONE);
        assert_eq!(light.le(-ng, ng), Vec3::ZERO);
        assert_eq!(both.le(-ng, ng), Vec3::ONE);
        // Behind a flat light, or within a sphere.
        let behind = shape.center() - 0.5 * shape.size() * ng;
        let half = Vec2::splat(0.4);
        assert!(light.sample_li(behind, half).is_none());
        assert_eq!(light.pdf_li(behind, ng, 0.5 * shape.size(), ng), 0.0);
        let s = both.sample_li(behind, half).expect("two sides");
        assert!(both.pdf_li(behind, s.wi, s.dist, s.ng) > 0.0);
        assert!((light.power(Vec3::ZERO, 1.0) * 2.0 - both.power(Vec3::ZERO, 1.0)).length() < 1e-4);
        if let Shape::Flat { corner, edges, .. } = &shape {
            for k in 2..20 {
                let p = (*corner + f64::from(k) * edges[0] - edges[1]).as_vec3();
                let pdf = both
                    .sample_li(p, half)
                    .map_or(0.0, |s| both.pdf_li(p, s.wi, s.dist, s.ng));
                assert!(pdf.is_finite());
            }
            assert!(both.sample_li(corner.as_vec3(), half).is_none());
        }
    }
}

#[test]
fn lights_without_a_surface_follow_their_definitions() {
    let p = Vec3::new(1.0, 2.0, 3.0);
    let half = Vec2::splat(0.5);
    let point = Light::Point(PointLight {
        p,
        intensity: Vec3::new(8.0, 4.0, 0.0),
    });
    let s = point
        .sample_li(Vec3::new(1.0, 0.0, 3.0), half)
        .expect("lit");
    assert_eq!(
        (s.radiance, s.pdf, s.dist),
        (Vec3::new(2.0, 1.0, 0.0), 1.0, 2.0)
    );
    assert!(s.is_delta && point.is_delta() && s.wi == Vec3::Y);
    assert!(point.sample_li(p, half).is_none());
    assert_eq!(point.pdf_li(Vec3::ZERO, s.wi, 1.0, s.ng), 0.0);

    let sun = Light::Directional(DirectionalLight {
        wi: Vec3::Y,
        irradiance: Vec3::ONE,
    });
    let s = sun.sample_li(p, half).expect("lit");
    assert_eq!(
        (s.wi, s.dist, s.radiance),
        (Vec3::Y, f32::INFINITY, Vec3::ONE)
    );
    assert!(sun.is_infinite() && sun.bounds().is_none());

    let spot = |cos_inner, cos_outer| SpotLight {
        p,
        axis: Vec3::NEG_Y,
        intensity: Vec3::ONE,
        cos_inner,
        cos_outer,
    };
    let wide = spot(0.9, 0.5);
    assert_eq!(
        [1.0, 0.9, 0.5, 0.1].map(|c| wide.falloff(c)),
        [1.0, 1.0, 0.0, 0.0]
    );
    assert!((wide.falloff(0.7f32) - 0.25).abs() < 1e-6);
    // Coinciding cones keep a ramp of 0.001.
    assert!((spot(0.5, 0.5).falloff(0.5005f32) - 0.25).abs() < 1e-4);
    assert!(Light::Spot(wide).sample_li(p + Vec3::X, half).is_none());
    let s = Light::Spot(wide)
        .sample_li(p - 2.0 * Vec3::Y, half)
        .expect("lit");
    assert_eq!(s.radiance, Vec3::splat(0.25));
}
