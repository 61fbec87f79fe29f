//! A parallelogram of uniform radiance. Rectangles are sampled by solid angle.

use crate::area::{self, SurfacePoint, height_over_plane, pdf_from_area};
use crate::{EmissionSample, LightSample};
use glam::{Vec2, Vec3};
use sr_math::warp::SphericalRectangle;
use sr_math::{Bounds3, gamma};

/// An emissive parallelogram.
#[derive(Clone, Copy, Debug)]
pub struct QuadLight {
    corner: Vec3,
    /// The longer edge first: the solid-angle sampling is then well conditioned farther out.
    edges: [Vec3; 2],
    /// Unit directions and lengths of the edges, when they are at right angles.
    rectangle: Option<[(Vec3, f32); 2]>,
    ng: Vec3,
    area: f32,
    radiance: Vec3,
    two_sided: bool,
}

/// How a reference point samples the light.
enum Strategy {
    /// Uniformly by solid angle; the corner in the coordinates of the rectangle.
    SolidAngle(SphericalRectangle<f32>, [f32; 2]),
    /// Uniformly by area; the height of the reference point over the plane.
    Area(f32),
}

impl QuadLight {
    /// Emits `radiance` on the side of `edge_u × edge_v`, or on both.
    pub fn new(corner: Vec3, edge_u: Vec3, edge_v: Vec3, radiance: Vec3, two_sided: bool) -> Self {
        let (u, v) = (edge_u.as_dvec3(), edge_v.as_dvec3());
        let cross = u.cross(v);
        let longer_first = u.length_squared() >= v.length_squared();
        let edges = if longer_first {
            [edge_u, edge_v]
        } else {
            [edge_v, edge_u]
        };
        let along = |e: Vec3| {
            let e = e.as_dvec3();
            (e.normalize_or_zero().as_vec3(), e.length() as f32)
        };
        // Solid-angle sampling honours u to 2⁻¹⁴; a skew of 2⁻¹⁷ cannot be seen beside that, and
        // edges that went through a transform in f32 are well within it.
        let skew = u.dot(v).abs() / (u.length() * v.length());
        Self {
            corner,
            edges,
            rectangle: (skew < f64::from(gamma(128))).then(|| edges.map(along)),
            ng: cross.normalize_or_zero().as_vec3(),
            area: cross.length() as f32,
            radiance,
            two_sided,
        }
    }

    /// Radiance on the emitting side.
    pub fn radiance(&self) -> Vec3 {
        self.radiance
    }

    /// Emits on the other side too.
    pub(crate) fn is_two_sided(&self) -> bool {
        self.two_sided
    }

    /// Area in m².
    pub fn area(&self) -> f32 {
        self.area
    }

    /// Unit normal of the emitting side; zero when the quad has no area.
    pub fn ng(&self) -> Vec3 {
        self.ng
    }

    /// `corner + (s e0 + t e1)`: a product rounds once, their sum once, the last sum once: γ₃ of the
    /// absolute terms.
    #[inline]
    fn point(&self, s: f32, t: f32) -> SurfacePoint {
        let (a, b) = (s * self.edges[0], t * self.edges[1]);
        SurfacePoint {
            p: self.corner + (a + b),
            p_err: gamma(3) * (self.corner.abs() + a.abs() + b.abs()),
            ng: self.ng,
        }
    }

    #[inline]
    fn strategy(&self, p: Vec3) -> Option<Strategy> {
        let height = height_over_plane(p, self.corner, self.ng)?;
        if !(self.two_sided || height > 0.0) {
            return None;
        }
        if let Some([(ex, lx), (ey, ly)]) = self.rectangle {
            let d = self.corner - p;
            let (x, y) = (d.dot(ex), d.dot(ey));
            if let Some(seen) = SphericalRectangle::new([x, x + lx], [y, y + ly], height)
                && seen.is_well_conditioned()
            {
                return Some(Strategy::SolidAngle(seen, [x, y]));
            }
        }
        Some(Strategy::Area(height.abs()))
    }

    /// See [`crate::Light::sample_li`].
    #[inline]
    pub fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let strategy = self.strategy(p)?;
        let [s, t] = match (&strategy, self.rectangle) {
            (Strategy::SolidAngle(seen, [x0, y0]), Some([(_, lx), (_, ly)])) => {
                let [x, y] = seen.sample(u.to_array());
                [(x - x0) / lx, (y - y0) / ly].map(|s| s.clamp(0.0, 1.0))
            }
            _ => u.to_array(),
        };
        area::seen_from(p, self.point(s, t), self.radiance, |_, dist| {
            self.pdf(&strategy, dist)
        })
    }

    #[inline]
    fn pdf(&self, strategy: &Strategy, dist: f32) -> f32 {
        match strategy {
            Strategy::SolidAngle(seen, _) => seen.solid_angle().recip(),
            Strategy::Area(height) => pdf_from_area(dist, height / dist, self.area),
        }
    }

    /// See [`crate::Light::pdf_li`].
    #[inline]
    pub fn pdf_li(&self, p: Vec3, dist: f32) -> f32 {
        self.strategy(p).map_or(0.0, |s| self.pdf(&s, dist))
    }

    /// See [`crate::Light::le`].
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        area::emitted(self.radiance, self.two_sided, w, ng)
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_pos: Vec2, u_dir: Vec2) -> Option<EmissionSample> {
        let (point, radiance) = (self.point(u_pos.x, u_pos.y), self.radiance);
        area::emission(point, self.area, radiance, self.two_sided, u_dir)
    }

    /// π · area · radiance for each emitting side.
    pub fn power(&self) -> Vec3 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * std::f32::consts::PI * self.area * self.radiance
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds3 {
        let [a, b] = self.edges;
        Bounds3::from_points([Vec3::ZERO, a, b, a + b].map(|e| self.corner + e))
    }
}
