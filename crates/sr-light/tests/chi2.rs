//! `sample_li` follows `pdf_li`: χ², near, far, at grazing and from within.
//!
//! 200,000 samples a case. The family of 21 cases has a false-alarm rate of 10⁻⁴; a relative error of
//! the density of 3 % over half of the light is found in each.

mod common;

use common::{Shape, numbers};
use glam::{Vec2, Vec3};
use sr_light::{ConstantEnvironment, Light, QuadLight, SphereLight, TriangleLight};
use sr_stats::{SphereBins, chi2_test, sidak};

const SAMPLES: u32 = 200_000;
const CASES: usize = 21;

fn u(i: u32) -> Vec2 {
    Vec2::new(numbers(i, 0), numbers(i, 1))
}

fn judge(name: &str, p: Vec3, counts: &[u64], expected: &[f64]) {
    let p_value = chi2_test(counts, expected, 5.0).p_value;
    assert!(p_value > sidak(1e-4, CASES), "{name} from {p}: {p_value}");
}

/// Cells a side of a flat light.
const CELLS: usize = 24;

/// Flat lights have their bins on the surface, where grazing makes no slivers: the density per area is
/// `pdf_li · cos/dist²`.
fn check_flat(name: &str, light: Light, shape: &Shape, p: Vec3) {
    let mut counts = vec![0; CELLS * CELLS];
    for i in 0..SAMPLES {
        let s = light.sample_li(p, u(i)).expect("the light is seen");
        // The direction counts, not the point: it is what the density is about.
        let [a, b] = shape
            .coordinates_along(p.as_dvec3(), s.wi.as_dvec3())
            .map(|x| ((x * CELLS as f64) as usize).min(CELLS - 1));
        counts[a * CELLS + b] += 1;
    }
    let density = |a: f64, b: f64| {
        let (q, ng, per_area) = shape.surface([a, b]);
        let d = q - p.as_dvec3();
        let dist = d.length();
        let wi = (d / dist).as_vec3();
        let pdf = f64::from(light.pdf_li(p, wi, dist as f32, ng.as_vec3()));
        pdf * (d / dist).dot(ng).abs() / (dist * dist) * per_area
    };
    let expected: Vec<f64> = (0..CELLS * CELLS)
        .map(|cell| {
            let mass = common::integrate_cell([cell / CELLS, cell % CELLS], CELLS, density);
            mass * f64::from(SAMPLES)
        })
        .collect();
    let total = expected.iter().sum::<f64>() / f64::from(SAMPLES);
    assert!((total - 1.0).abs() < 1e-4, "{name} from {p}: {total}");
    judge(name, p, &counts, &expected);
}

/// Reference points for a light of size 1 about the origin that faces +Y: near, far (area sampling),
/// two at grazing, and all but touching.
const POINTS: [Vec3; 5] = [
    Vec3::new(0.2, 0.15, -0.1),
    Vec3::new(300.0, 1000.0, -400.0),
    Vec3::new(2.0, 0.02, 0.5),
    Vec3::new(-0.6, 0.003, 0.7),
    Vec3::new(0.1, 0.01, 0.05),
];

#[test]
fn triangles() {
    let corners = [[-0.5, 0.0, -0.4], [0.4, 0.0, 0.5], [0.6, 0.0, -0.5]].map(Vec3::from);
    for p in POINTS {
        let light = Light::Triangle(TriangleLight::new(corners, Vec3::ONE, false));
        check_flat("triangle", light, &Shape::triangle(corners), p);
    }
}

#[test]
fn rectangles_and_parallelograms() {
    let corner = Vec3::new(-0.5, 0.0, -0.1);
    // Turned in its plane, so that the axes of the rectangle are not those of the world.
    let (long, short) = (Vec3::new(0.8, 0.0, -0.6), Vec3::new(0.3, 0.0, 0.4));
    let skew = Vec3::new(0.1, 0.0, 0.6);
    for p in POINTS {
        for (name, edge_u) in [("rectangle", short), ("parallelogram", skew)] {
            let light = Light::Quad(QuadLight::new(corner, edge_u, long, Vec3::ONE, false));
            check_flat(name, light, &Shape::quad(corner, edge_u, long), p);
        }
    }
}

#[test]
fn spheres_from_outside_and_inside() {
    let (center, radius) = (Vec3::new(0.1, -0.2, 0.05), 0.5);
    let shape = Shape::sphere(center, radius);
    let light = Light::Sphere(SphereLight::new(center, radius, Vec3::ONE, true));
    let up = Vec3::new(0.6, 0.8, 0.0);
    for distance in [1e3, 3.0, 0.501, 0.4, 0.1] {
        let p = center + distance * up;
        // The light fills about this angle.
        let scale = f64::from(radius / distance.max(radius));
        let bins = SphereBins::focused(32, 32, (-up).as_dvec3().to_array(), 0.3 * scale);
        let counts = bins.count(
            (0..SAMPLES).map(|i| light.sample_li(p, u(i)).map(|s| s.wi.as_dvec3().to_array())),
        );
        let expected = bins.expected(SAMPLES.into(), |d| {
            let Some((dist, ng)) = shape.hit(p.as_dvec3(), d.into()) else {
                return 0.0;
            };
            let wi = Vec3::new(d[0] as f32, d[1] as f32, d[2] as f32);
            light.pdf_li(p, wi, dist as f32, ng.as_vec3()).into()
        });
        judge("sphere", p, &counts, &expected);
    }
}

#[test]
fn environment() {
    let light = Light::Environment(ConstantEnvironment {
        radiance: Vec3::ONE,
    });
    let bins = SphereBins::uniform(16, 32);
    let counts = bins.count((0..SAMPLES).map(|i| {
        let s = light.sample_li(Vec3::ZERO, u(i))?;
        assert_eq!(s.pdf, light.pdf_li(Vec3::ZERO, s.wi, s.dist, s.ng));
        Some(s.wi.as_dvec3().to_array())
    }));
    let expected = bins.expected(SAMPLES.into(), |_| 0.25 / std::f64::consts::PI);
    judge("environment", Vec3::ZERO, &counts, &expected);
}
