//! The point of a hit, and how far off it may be.
//!
//! `p_err` bounds two things together: the distance of `p` from the surface it stands for, and the
//! resolution of the test that a ray leaving `p` will make with that surface (see `node.rs`: the
//! test is exact for points moved by γ₁₀ of their distance from the ray's origin). The second part
//! is what keeps a ray from hitting the triangle that it left near a vertex at the origin of the
//! coordinates, where the first vanishes. Errors within the surface are not counted: they move the
//! point along it and harm nobody.
//!
//! # Shapes in an axis plane
//! A flat shape all of whose corners have one coordinate `c` on an axis k, a floor say, needs no
//! margin for the test, however large it is. `p` has that coordinate too, exactly, so the origin of
//! a leaving ray has it or lies on the side that the ray goes to: `c − o.k` and `d.k` are of
//! opposite signs, or zero. The test (`triangle.rs`) then finds no positive `t`:
//!
//! - A corner that is not ahead along `kz`, and always when k is `kz`: `t` has the sign of
//!   `(c − o.k) / d.k`, whose every step in f64 is exact in sign.
//! - All corners ahead: the sheared coordinates `(c − o.k) − s z` add terms of one sign, so they
//!   have that sign, rounded or not, and the shape lies to one side of the ray. Edge functions of
//!   three such points cannot all be positive, since rounding is monotone; they can be zero or
//!   positive, and not all zero, only where the points are in line with the ray up to 18 u of their
//!   distance, for a triangle 36 u of its length wide. [`SLENDER`] excludes those four times over.

use crate::accel::Accel;
use crate::geometry::{Prim, QuadShape, SphereShape};
use crate::ray::{Hit, Ray};
use glam::Vec3;
use sr_math::gamma;

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitPoint {
    /// Position.
    pub p: Vec3,
    /// Absolute error bound of `p`, per axis; for [`sr_math::offset_ray_origin`].
    pub p_err: Vec3,
    /// Unit geometric normal, on the side that the primitive's orientation says, whatever side the
    /// ray came from.
    pub ng: Vec3,
}

impl Accel {
    /// The surface point of a hit that this structure returned for this ray.
    ///
    /// # Panics
    /// May panic for [`Hit::MISS`] and for hits of another structure.
    #[inline]
    pub fn hit_point(&self, ray: &Ray, hit: &Hit) -> HitPoint {
        let geometry = self.geometry();
        match geometry.kind(hit.prim) {
            Prim::Triangle(i) => triangle_point(geometry.triangle_vertices(i), hit),
            Prim::Sphere(i) => sphere_point(&geometry.spheres[i as usize], ray, hit),
            Prim::Quad(i) => quad_point(&geometry.quads[i as usize], hit),
        }
    }
}

/// `e₁ × e₂` normalised, in f64: for a needle the f32 product has no correct digit.
#[inline]
fn unit_normal(e1: glam::DVec3, e2: glam::DVec3) -> Vec3 {
    e1.cross(e2).normalize().as_vec3()
}

/// Twice the area of a triangle over the square of its longest extent on an axis, below which it is
/// too slender for what is said of axis planes: 4 · 36 √2 u < 2⁻¹⁶.
const SLENDER: f64 = 1.0 / 65536.0;

/// How far, on each axis, a ray must start from a flat shape for the test not to see it: γ₁₀ of its
/// extent, but nothing off an axis plane. `edges` span the plane, the test sees `triangles`.
#[inline]
fn resolution<const N: usize>(edges: [Vec3; 2], triangles: [[Vec3; 3]; N], longest: f32) -> Vec3 {
    let all = Vec3::splat(gamma(10) * longest);
    // Not whether corners are equal: those of a quad may be so by rounding.
    let Some(k) = (0..3).find(|&k| edges.iter().all(|e| e[k] == 0.0)) else {
        return all;
    };
    let least = SLENDER * f64::from(longest) * f64::from(longest);
    let slender = triangles.iter().any(|t| {
        let [a, b, c] = t.map(Vec3::as_dvec3);
        (b - a).cross(c - a)[k].abs() < least
    });
    if slender {
        return all;
    }
    let mut out = all;
    out[k] = 0.0;
    out
}

/// `p₀ + (u e₁ + v e₂)`: an affine form whose weights sum to 1 whatever `u` and `v` are, so that
/// their own error stays in the plane.
///
/// Edges, products and their sum round three times, γ₃ (|u e₁| + |v e₂|); the last sum rounds once,
/// γ₁ |p|. The test's [`resolution`] comes on top.
#[inline]
fn triangle_point([p0, p1, p2]: [Vec3; 3], hit: &Hit) -> HitPoint {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let (a, b) = (hit.u * e1, hit.v * e2);
    let p = p0 + (a + b);
    let longest = e1.abs().max(e2.abs()).max((p2 - p1).abs()).max_element();
    let p_err = gamma(1) * p.abs() + gamma(3) * (a.abs() + b.abs());
    let q = p0.as_dvec3();
    HitPoint {
        p,
        p_err: p_err + resolution([e1, e2], [[p0, p1, p2]], longest),
        ng: unit_normal(p1.as_dvec3() - q, p2.as_dvec3() - q),
    }
}

/// As for a triangle, but the corners that the test sees are rounded themselves: the sums of the
/// corner and one or two edges, γ₂ of the terms.
#[inline]
fn quad_point(quad: &QuadShape, hit: &Hit) -> HitPoint {
    let (eu, ev) = (quad.edge_u, quad.edge_v);
    let (a, b) = (hit.u * eu, hit.v * ev);
    let p = quad.corner + (a + b);
    let terms = quad.corner.abs() + eu.abs() + ev.abs();
    let longest = (eu.abs() + ev.abs()).max_element();
    let [c0, c1, c2, c3] = quad.corners();
    let p_err = gamma(1) * p.abs() + gamma(2) * terms + gamma(3) * (a.abs() + b.abs());
    HitPoint {
        p,
        p_err: p_err + resolution([eu, ev], [[c0, c1, c2], [c0, c2, c3]], longest),
        ng: unit_normal(eu.as_dvec3(), ev.as_dvec3()),
    }
}

/// The point along the ray, moved onto the sphere around its centre: that takes away the error of
/// `t`, which grows with the distance of the ray's origin (Pharr, Jakob, Humphreys 2023, §6.8.5).
///
/// Scaling rounds: the squared length γ₃, its root half of that and 1, a quotient, a product: γ₅
/// of the offset. The resolution of the test is 5 u of the radius (the origin relative to the
/// centre, 1; the nearest point, 1; the sums of the two squares that are compared, 3): γ₅. Adding
/// the centre rounds once more.
#[inline]
fn sphere_point(sphere: &SphereShape, ray: &Ray, hit: &Hit) -> HitPoint {
    let along = (ray.o - sphere.center) + hit.t * ray.d;
    let length = along.length();
    // Only a sphere smaller than the error of `t` can have its centre there.
    let ng = if length > 0.0 {
        along / length
    } else {
        -ray.d.normalize()
    };
    let offset = sphere.radius * ng;
    let p = sphere.center + offset;
    HitPoint {
        p,
        p_err: gamma(1) * p.abs() + gamma(10) * offset.abs(),
        ng,
    }
}
