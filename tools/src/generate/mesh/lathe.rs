//! Surfaces of revolution about the axis y.

use super::Mesh;
use super::grid::{Ends, resolution, sweep};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Turns a curve, given as distance from the axis and height with its normal in that plane.
fn turn(triangles: u64, ratio: f64, ends: Ends, profile: impl Fn(f64) -> (DVec2, DVec2)) -> Mesh {
    sweep(resolution(triangles, ratio), ends, |s, t| {
        let (p, n) = profile(s);
        let (sin, cos) = (TAU * t).sin_cos();
        let around = |v: DVec2| DVec3::new(v.x * cos, v.y, v.x * sin);
        (around(p), around(n))
    })
}

/// A band with rounded edges: its section is the superellipse `x⁴ + y⁴ = 1` (Lamé 1818).
pub(super) fn ring(triangles: u64) -> Mesh {
    let (middle, half) = (DVec2::new(0.94, 0.2), DVec2::new(0.06, 0.2));
    turn(triangles, 0.25, Ends::Meet, |s| {
        // Downwards on the inside first, so that the front is outside.
        let (sin, cos) = (TAU * s).sin_cos();
        let p = DVec2::new(-cos, -sin) / (cos.powi(4) + sin.powi(4)).powf(0.25);
        (middle + half * p, (p * p * p / half).normalize())
    })
    .standing(None)
}

/// Heights and radii of the pawn below its head.
const PAWN: [[f64; 2]; 16] = [
    [0.0, 0.0],
    [0.16, 0.0],
    [0.28, 0.0],
    [0.31, 0.03],
    [0.31, 0.08],
    [0.27, 0.12],
    [0.22, 0.145],
    [0.17, 0.21],
    [0.13, 0.33],
    [0.11, 0.46],
    [0.115, 0.56],
    [0.19, 0.60],
    [0.205, 0.625],
    [0.175, 0.647],
    [0.13, 0.661],
    [0.122, 0.678],
];
/// Middle and radius of its head.
const HEAD: (f64, f64) = (0.81, 0.19);

/// A spline through the points of the foot and arcs of the head.
pub(super) fn pawn(triangles: u64) -> Mesh {
    let mut points: Vec<DVec2> = PAWN.map(DVec2::from_array).to_vec();
    // From where the foot ends, at 0.6 radian below the horizon, to the top.
    for k in 0..=8 {
        let angle = -0.6 + (FRAC_PI_2 + 0.6) * f64::from(k) / 8.0;
        points.push(DVec2::new(
            HEAD.1 * angle.cos(),
            HEAD.0 + HEAD.1 * angle.sin(),
        ));
    }
    // Exactly on the axis.
    if let Some(top) = points.last_mut() {
        top.x = 0.0;
    }
    let last = points.len() - 1;
    turn(triangles, 1.2, Ends::Poles, |s| {
        let along = s * last as f64;
        let piece = (along as usize).min(last - 1);
        let get = |k: isize| points[(piece as isize + k).clamp(0, last as isize) as usize];
        let (mut p, tangent) = catmull_rom([get(-1), get(0), get(1), get(2)], along - piece as f64);
        p.x = p.x.max(0.0);
        let normal = DVec2::new(tangent.y, -tangent.x).normalize();
        // Beyond rounding the ends are flat.
        let pole = if s == 0.0 { -DVec2::Y } else { DVec2::Y };
        (p, if s == 0.0 || s == 1.0 { pole } else { normal })
    })
    .standing(Some(1.0))
}

/// Position and tangent at `t` between the two middle points (Catmull, Rom 1974).
fn catmull_rom([a, b, c, d]: [DVec2; 4], t: f64) -> (DVec2, DVec2) {
    let (m0, m1) = (0.5 * (c - a), 0.5 * (d - b));
    let (c2, c3) = (3.0 * (c - b) - 2.0 * m0 - m1, 2.0 * (b - c) + m0 + m1);
    let p = b + t * (m0 + t * (c2 + t * c3));
    (p, m0 + t * (2.0 * c2 + t * 3.0 * c3))
}
