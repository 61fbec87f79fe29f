//! The same questions answered in f64, for tests and checks.
//!
//! Slow, simple and independent of the kernels: textbook formulas whose rounding is 2²⁹ times finer than
//! that of the inputs, for one primitive at a time, or by brute force for all of them.

use crate::geometry::{Geometry, Prim};
use crate::ray::{PRIM_NONE, Ray};
use glam::DVec3;

/// A hit found in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OracleHit {
    /// The ray's parameter.
    pub t: f64,
    /// As [`crate::Hit::u`].
    pub u: f64,
    /// As [`crate::Hit::v`].
    pub v: f64,
    /// The primitive's id, or [`PRIM_NONE`].
    pub prim: u32,
}

/// A ray in f64: the points `o + t d` with `0 < t <= t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Origin.
    pub o: DVec3,
    /// Direction; need not be of unit length.
    pub d: DVec3,
    /// The largest `t` that counts.
    pub t_max: f64,
}

impl From<&Ray> for Line {
    fn from(ray: &Ray) -> Self {
        Self {
            o: ray.o.as_dvec3(),
            d: ray.d.as_dvec3(),
            t_max: f64::from(ray.t_max),
        }
    }
}

impl OracleHit {
    /// No hit.
    pub const MISS: Self = Self {
        t: f64::INFINITY,
        u: 0.0,
        v: 0.0,
        prim: PRIM_NONE,
    };
}

/// The first hit of a ray; of several at the same `t`, that of the smallest id.
pub fn brute_force_closest(geometry: &Geometry, ray: &Ray) -> OracleHit {
    let mut best = OracleHit::MISS;
    for prim in 0..geometry.prim_count() as u32 {
        if let Some(hit) = brute_force_one(geometry, prim, ray)
            && hit.t < best.t
        {
            best = hit;
        }
    }
    best
}

/// Whether a ray hits anything.
pub fn brute_force_occluded(geometry: &Geometry, ray: &Ray) -> bool {
    (0..geometry.prim_count() as u32).any(|prim| brute_force_one(geometry, prim, ray).is_some())
}

/// The first hit of a ray with one primitive.
pub fn brute_force_one(geometry: &Geometry, prim: u32, ray: &Ray) -> Option<OracleHit> {
    intersect(geometry, prim, &Line::from(ray))
}

/// [`brute_force_one`] of a ray in f64.
pub fn intersect(geometry: &Geometry, prim: u32, line: &Line) -> Option<OracleHit> {
    let Line { o, d, t_max } = *line;
    let sound = o.is_finite() && d.is_finite();
    if !sound || geometry.checked_bounds(prim).is_err() {
        return None;
    }
    let (t, u, v) = match geometry.kind(prim) {
        Prim::Triangle(i) => {
            let [p0, p1, p2] = geometry.triangle_vertices(i).map(|p| p.as_dvec3());
            let (t, u, v) = plane_coordinates(o, d, p0, p1 - p0, p2 - p0);
            (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some((t, u, v))?
        }
        Prim::Quad(i) => {
            let q = &geometry.quads[i as usize];
            let (corner, eu, ev) = (
                q.corner.as_dvec3(),
                q.edge_u.as_dvec3(),
                q.edge_v.as_dvec3(),
            );
            let (t, u, v) = plane_coordinates(o, d, corner, eu, ev);
            let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
            inside.then_some((t, u, v))?
        }
        Prim::Sphere(i) => {
            let s = &geometry.spheres[i as usize];
            let (near, far) = sphere_roots(o - s.center.as_dvec3(), d, f64::from(s.radius))?;
            (if near > 0.0 { near } else { far }, 0.0, 0.0)
        }
    };
    (t > 0.0 && t <= t_max).then_some(OracleHit { t, u, v, prim })
}

/// The lower and the upper corner of a box around a primitive; `None` for one that cannot be hit.
pub fn bounds(geometry: &Geometry, prim: u32) -> Option<[DVec3; 2]> {
    let outer = geometry.checked_bounds(prim).ok()?;
    let Prim::Quad(i) = geometry.kind(prim) else {
        return Some([outer.min.as_dvec3(), outer.max.as_dvec3()]);
    };
    // Its corners in f32 are rounded.
    let q = &geometry.quads[i as usize];
    let (c, u, v) = (
        q.corner.as_dvec3(),
        q.edge_u.as_dvec3(),
        q.edge_v.as_dvec3(),
    );
    let corners = [c, c + u, c + v, c + u + v];
    let low = corners.into_iter().fold(DVec3::INFINITY, DVec3::min);
    let high = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
    Some([low, high])
}

/// The solution of `o + t d = corner + u e₁ + v e₂` by Cramer's rule; not finite when there is
/// none.
fn plane_coordinates(o: DVec3, d: DVec3, corner: DVec3, e1: DVec3, e2: DVec3) -> (f64, f64, f64) {
    let to_corner = corner - o;
    let n = e1.cross(e2);
    let det = n.dot(d);
    let r = d.cross(to_corner);
    (n.dot(to_corner) / det, -r.dot(e2) / det, r.dot(e1) / det)
}

/// Both roots of the quadratic, the smaller first.
fn sphere_roots(f: DVec3, d: DVec3, radius: f64) -> Option<(f64, f64)> {
    let a = d.length_squared();
    let half_b = f.dot(d);
    // The area of the parallelogram of f and d, over |d|, is the line's distance: the form that
    // does not cancel.
    let discriminant = radius * radius - f.cross(d).length_squared() / a;
    let root = (discriminant >= 0.0).then(|| (discriminant / a).sqrt())?;
    let middle = -half_b / a;
    Some((middle - root, middle + root))
}
