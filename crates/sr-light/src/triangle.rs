//! A triangle of uniform radiance, sampled by area.

use crate::area::{self, SurfacePoint, height_over_plane, pdf_from_area};
use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, Real, gamma_of, vec3, warp};

/// An emissive triangle.
#[derive(Clone, Copy, Debug)]
pub struct TriangleLight {
    p: [Vec3; 3],
    measures: Measures<f32>,
    radiance: Vec3,
    two_sided: bool,
}

/// What follows from the corners.
#[derive(Clone, Copy, Debug)]
struct Measures<R> {
    ng: [R; 3],
    area: R,
}

impl Measures<f64> {
    fn of(p: [Vec3; 3]) -> Self {
        let [a, b, c] = p.map(Vec3::as_dvec3);
        let cross = (b - a).cross(c - a);
        Self {
            ng: cross.normalize_or_zero().to_array(),
            area: 0.5 * cross.length(),
        }
    }
}

impl<R> Measures<R> {
    #[inline(always)]
    fn map<S>(self, f: impl Fn(R) -> S) -> Measures<S> {
        Measures {
            ng: self.ng.map(&f),
            area: f(self.area),
        }
    }
}

impl TriangleLight {
    /// Emits `radiance` on the side from which the corners run anticlockwise, or on both.
    pub fn new(p: [Vec3; 3], radiance: Vec3, two_sided: bool) -> Self {
        Self {
            p,
            measures: Measures::of(p).map(|x| x as f32),
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
        self.measures.area
    }

    /// Unit normal of the emitting side; zero when the triangle has no area.
    pub fn ng(&self) -> Vec3 {
        self.measures.ng.into()
    }

    /// `c + b0 (a − c) + b1 (b − c)`. An edge is rounded once, a product once, their sum once: γ₃ of
    /// the absolute terms. The last sum rounds once more, all terms included: γ₄ of all.
    #[inline]
    fn point<R: Real>(&self, u: [R; 2]) -> SurfacePoint<R> {
        let [b0, b1] = warp::uniform_triangle(u);
        let [a, b, c] = self.p.map(vec3::lift);
        let (s, t) = (
            vec3::scale(b0, vec3::sub(a, c)),
            vec3::scale(b1, vec3::sub(b, c)),
        );
        let terms = vec3::add(vec3::add(vec3::abs(c), vec3::abs(s)), vec3::abs(t));
        SurfacePoint {
            p: vec3::add(c, vec3::add(s, t)),
            p_err: vec3::scale(gamma_of(4), terms),
            ng: self.measures().ng,
        }
    }

    #[inline(always)]
    fn measures<R: Real>(&self) -> Measures<R> {
        R::stored_or(
            || self.measures.map(R::from_f32),
            || Measures::of(self.p).map(R::lit),
        )
    }

    /// Height of `p` over the light's plane where the light can be seen from there.
    #[inline]
    fn visible_height<R: Real>(&self, p: [R; 3]) -> Option<R> {
        let height = height_over_plane(p, vec3::lift(self.p[2]), self.measures().ng)?;
        (self.two_sided || height > R::ZERO).then_some(height.abs())
    }

    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, p: [R; 3], u: [R; 2]) -> Option<LightSampleOf<R>> {
        let height = self.visible_height(p)?;
        area::seen_from(p, self.point(u), self.radiance, |_, dist| {
            pdf_from_area(dist, height / dist, self.measures().area)
        })
    }

    /// See [`crate::Light::pdf_li_real`].
    #[inline]
    pub fn pdf_li<R: Real>(&self, p: [R; 3], dist: R) -> R {
        self.visible_height(p).map_or(R::ZERO, |height| {
            pdf_from_area(dist, height / dist, self.measures().area)
        })
    }

    /// See [`crate::Light::le`].
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        area::emitted(self.radiance, self.two_sided, w, ng)
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_pos: Vec2, u_dir: Vec2) -> Option<EmissionSample> {
        let (point, radiance) = (self.point(u_pos.to_array()), self.radiance);
        area::emission(point, self.area(), radiance, self.two_sided, u_dir)
    }

    /// π · area · radiance for each emitting side.
    pub fn power(&self) -> Vec3 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * std::f32::consts::PI * self.area() * self.radiance
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds3 {
        Bounds3::from_points(self.p)
    }
}
