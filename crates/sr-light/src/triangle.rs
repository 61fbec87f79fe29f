//! A triangle of uniform radiance, sampled by area.

use crate::area::{self, SurfacePoint, height_over_plane, pdf_from_area};
use crate::{EmissionSample, LightSample};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, gamma, warp};

/// An emissive triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleLight {
    p: [Vec3; 3],
    ng: Vec3,
    area: f32,
    radiance: Vec3,
    two_sided: bool,
}

impl TriangleLight {
    /// Emits `radiance` on the side from which the corners run anticlockwise, or on both.
    pub fn new(p: [Vec3; 3], radiance: Vec3, two_sided: bool) -> Self {
        let [a, b, c] = p.map(Vec3::as_dvec3);
        let cross = (b - a).cross(c - a);
        Self {
            p,
            ng: cross.normalize_or_zero().as_vec3(),
            area: (0.5 * cross.length()) as f32,
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

    /// Unit normal of the emitting side; zero when the triangle has no area.
    pub fn ng(&self) -> Vec3 {
        self.ng
    }

    /// `c + b0 (a − c) + b1 (b − c)`. An edge is rounded once, a product once, their sum once: γ₃ of
    /// the absolute terms. The last sum rounds once more, all terms included: γ₄ of all.
    #[inline]
    fn point(&self, u: Vec2) -> SurfacePoint {
        let [b0, b1] = warp::uniform_triangle(u.to_array());
        let [a, b, c] = self.p;
        let (s, t) = (b0 * (a - c), b1 * (b - c));
        SurfacePoint {
            p: c + (s + t),
            p_err: gamma(4) * (c.abs() + s.abs() + t.abs()),
            ng: self.ng,
        }
    }

    /// Height of `p` over the light's plane where the light can be seen from there.
    #[inline]
    fn visible_height(&self, p: Vec3) -> Option<f32> {
        let height = height_over_plane(p, self.p[2], self.ng)?;
        (self.two_sided || height > 0.0).then_some(height.abs())
    }

    /// See [`crate::Light::sample_li`].
    #[inline]
    pub fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let height = self.visible_height(p)?;
        area::seen_from(p, self.point(u), self.radiance, |_, dist| {
            pdf_from_area(dist, height / dist, self.area)
        })
    }

    /// See [`crate::Light::pdf_li`].
    #[inline]
    pub fn pdf_li(&self, p: Vec3, dist: f32) -> f32 {
        self.visible_height(p)
            .map_or(0.0, |height| pdf_from_area(dist, height / dist, self.area))
    }

    /// See [`crate::Light::le`].
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        area::emitted(self.radiance, self.two_sided, w, ng)
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_pos: Vec2, u_dir: Vec2) -> Option<EmissionSample> {
        let (point, radiance) = (self.point(u_pos), self.radiance);
        area::emission(point, self.area, radiance, self.two_sided, u_dir)
    }

    /// π · area · radiance for each emitting side.
    pub fn power(&self) -> Vec3 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * std::f32::consts::PI * self.area * self.radiance
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds3 {
        Bounds3::from_points(self.p)
    }
}
