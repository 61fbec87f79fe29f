//! Irradiance by sampling a light, against closed forms and quadrature in f64: from a solid angle of 2π to 10⁻¹⁴.

use crate::suites::lobes::even;
use crate::worst::{Worst, relative};
use crate::{Effort, Kernels, Sweep};
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::light::{Light, QuadLight, SphereLight, TriangleLight};
use std::f64::consts::{PI, TAU};

/// Who is lit: no coordinate is a round number.
const P: Vec3 = Vec3::new(0.3, -0.2, 0.1);

/// A light of radiance 1, the normal of who is lit, and the irradiance.
struct Case {
    light: Light,
    n: Vec3,
    irradiance: f64,
}

pub(super) fn sweeps<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let n = effort.choose(4096, 65536);
    let sweep = |name: &str, about: &str, bound: f64, holds: [f64; 2], cases: Vec<(f64, Case)>| {
        let point = |(at, case): &(f64, Case)| {
            let mut worst = Worst::default();
            let found = narrow::<K>(case, n);
            let error = relative(found, case.irradiance);
            worst.see(error, || format!("{found:e}, truth {:e}", case.irradiance));
            worst.see_oracle(relative(wide(case, n), case.irradiance));
            worst.at(*at)
        };
        Sweep {
            name: name.into(),
            about: format!("{about}; samples that fill the square evenly."),
            parameter: "solid angle, steradian".into(),
            error: "relative error of irradiance".into(),
            bound,
            holds,
            points: cases.iter().map(point).collect(),
        }
    };
    let all = [0.9e-14, TAU];
    let rectangle = |side: f32, middle: DVec3| rectangle(side, middle);
    vec![
        sweep(
            "sphere_above",
            "A sphere around the normal, against π sin²θ",
            // Even in u, in which the integrand is a line.
            3e-4,
            all,
            spheres(Vec3::Z).collect(),
        ),
        sweep(
            "sphere_at_horizon",
            "A sphere half below the horizon, against α − sin α cos α",
            2e-3,
            all,
            spheres(Vec3::X).collect(),
        ),
        sweep(
            "rectangle",
            "A rectangle above, against quadrature",
            1e-3,
            all,
            sides().map(|s| rectangle(s, DVec3::Z)).collect(),
        ),
        sweep(
            "rectangle_aside",
            "A rectangle 58° from the normal",
            1e-3,
            all,
            sides()
                .map(|s| rectangle(s, DVec3::new(1.4, 0.8, 1.0)))
                .collect(),
        ),
        sweep(
            "triangle",
            "A triangle above, sampled by area",
            // No more than a seventh of the sphere: near a large light samples by area are no longer even.
            1e-3,
            [0.9e-14, 0.6],
            sides().filter(|s| *s <= 1.0).map(triangle).collect(),
        ),
        rectangle_edge_on::<K>(n),
    ]
}

fn narrow<K: Kernels>(case: &Case, n: u32) -> f64 {
    let sample = |i| {
        let s = K::sample_li(&case.light, P, even(i, n).1)?;
        let cos = s.wi.dot(case.n).max(0.0);
        Some(f64::from(s.radiance.x * cos / s.pdf))
    };
    (0..n).filter_map(sample).sum::<f64>() / f64::from(n)
}

/// The same of the kernels in f64.
fn wide(case: &Case, n: u32) -> f64 {
    let (p, normal) = (P.as_dvec3().to_array(), case.n.as_dvec3());
    let sample = |i| {
        let u = even(i, n).1.as_dvec2().to_array();
        let s = case.light.sample_li_real(p, u)?;
        let cos = DVec3::from(s.wi).dot(normal).max(0.0);
        Some(s.radiance[0] * cos / s.pdf)
    };
    (0..n).filter_map(sample).sum::<f64>() / f64::from(n)
}

/// Radii of a sphere at distance 1; from the last but one the surface is as near as 10⁻⁵.
const RADII: [f32; 14] = [
    5.6e-9, 5.6e-8, 5.6e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.7, 0.9, 0.99, 0.999, 0.999_99,
];

fn spheres(axis: Vec3) -> impl Iterator<Item = (f64, Case)> {
    RADII.into_iter().map(move |radius| {
        let center = P + axis;
        let distance = (center.as_dvec3() - P.as_dvec3()).length();
        let sin = f64::from(radius) / distance;
        let cos = ((1.0 - sin) * (1.0 + sin)).sqrt();
        let irradiance = if axis == Vec3::Z {
            PI * sin * sin
        } else {
            below_horizon(sin.asin())
        };
        // 1 − cos θ without the difference.
        let solid_angle = TAU * sin * sin / (1.0 + cos);
        let case = Case {
            light: Light::Sphere(SphereLight::new(center, radius, Vec3::ONE, false)),
            n: Vec3::Z,
            irradiance,
        };
        (solid_angle, case)
    })
}

/// α − sin α cos α, by its series where it is small.
fn below_horizon(alpha: f64) -> f64 {
    let a2 = alpha * alpha;
    if alpha < 0.01 {
        alpha * a2 * (2.0 / 3.0 - a2 * (2.0 / 15.0 - a2 * (4.0 / 315.0)))
    } else {
        alpha - alpha.sin() * alpha.cos()
    }
}

/// Sides of a flat light at a height of 1.
fn sides() -> impl Iterator<Item = f32> {
    [
        1e-8f32, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 3000.0,
    ]
    .into_iter()
}

/// Irradiance, and solid angle, of the points of a flat light at `corner + s u + t v`, as seen from the origin by a
/// receiver with normal `n`: midpoints of a grid that is as fine near the foot of the perpendicular as far off.
fn quadrature(corner: DVec3, [u, v]: [DVec3; 2], n: DVec3, triangle: bool) -> (f64, f64) {
    const GRID: u32 = 600;
    let normal = u.cross(v);
    let places: Vec<(f64, f64)> = (0..GRID)
        .map(|i| graded((f64::from(i) + 0.5) / f64::from(GRID)))
        .collect();
    let (mut irradiance, mut solid_angle) = (0.0, 0.0);
    for (s, ds) in &places {
        for (t, dt) in &places {
            let (t, jacobian) = if triangle {
                (t * (1.0 - s), 1.0 - s)
            } else {
                (*t, 1.0)
            };
            let d = corner + *s * u + t * v;
            let d2 = d.length_squared();
            let omega = normal.dot(d).abs() / (d2 * d2.sqrt()) * ds * dt * jacobian;
            solid_angle += omega;
            irradiance += omega * d.dot(n).max(0.0) / d2.sqrt();
        }
    }
    let cells = f64::from(GRID * GRID);
    (irradiance / cells, solid_angle / cells)
}

/// A map of [0, 1] to itself that is slow around the middle, and its derivative: 600 steps across 3000 are as short as 0.01 there.
fn graded(x: f64) -> (f64, f64) {
    const RANGE: f64 = 8.0;
    let y = RANGE * (2.0 * x - 1.0);
    let all = 2.0 * RANGE.sinh();
    (0.5 + y.sinh() / all, 2.0 * RANGE * y.cosh() / all)
}

fn rectangle(side: f32, middle: DVec3) -> (f64, Case) {
    let (u, v) = (Vec3::X * side, Vec3::Y * side);
    let corner = (P.as_dvec3() + middle - 0.5 * (u + v).as_dvec3()).as_vec3();
    let light = Light::Quad(QuadLight::new(corner, v, u, Vec3::ONE, false));
    flat(light, corner, [u, v], false)
}

fn triangle(side: f32) -> (f64, Case) {
    let (u, v) = (
        Vec3::new(1.0, 0.2, 0.1) * side,
        Vec3::new(-0.3, 0.9, -0.2) * side,
    );
    let corner = P + Vec3::new(0.05, -0.04, 1.0);
    let corners = [corner, corner + v, corner + u];
    let light = Light::Triangle(TriangleLight::new(corners, Vec3::ONE, false));
    flat(
        light,
        corner,
        [corners[2] - corner, corners[1] - corner],
        true,
    )
}

/// Its truth is of corners as they are rounded.
fn flat(light: Light, corner: Vec3, edges: [Vec3; 2], triangle: bool) -> (f64, Case) {
    let from = corner.as_dvec3() - P.as_dvec3();
    let (irradiance, solid_angle) = quadrature(from, edges.map(Vec3::as_dvec3), DVec3::Z, triangle);
    let case = Case {
        light,
        n: Vec3::Z,
        irradiance,
    };
    (solid_angle, case)
}

/// A wall that begins ever nearer to the plane of a square light.
fn rectangle_edge_on<K: Kernels>(n: u32) -> Sweep {
    let heights = [1.0f32, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
    let points = heights.map(|height| {
        let corner = P + Vec3::new(1.0, -0.5, height);
        let (u, v) = (Vec3::X, Vec3::Y);
        let from = corner.as_dvec3() - P.as_dvec3();
        let truth = quadrature(from, [u, v].map(Vec3::as_dvec3), DVec3::X, false).0;
        let case = Case {
            light: Light::Quad(QuadLight::new(corner, v, u, Vec3::ONE, false)),
            n: Vec3::X,
            irradiance: truth,
        };
        let mut worst = Worst::default();
        let found = narrow::<K>(&case, n);
        worst.see(relative(found, truth), || {
            format!("{found:e}, truth {truth:e}")
        });
        worst.see_oracle(relative(wide(&case, n), truth));
        worst.at(height.into())
    });
    Sweep {
        name: "rectangle_edge_on".into(),
        about: "A square light of side 1, seen from a distance of 1 at a small height over its plane. Nearer than the error of a \
                hit point it gives nothing."
            .into(),
        parameter: "height over the light's plane".into(),
        error: "relative error of irradiance".into(),
        // The height is a difference of coordinates of 1: good to 6·10⁻⁸.
        bound: 2e-3,
        holds: [0.9e-4, 1.0],
        points: points.into(),
    }
}
