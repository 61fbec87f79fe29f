//! A parallelogram of uniform radiance. Rectangles are sampled by solid angle.

use crate::area::{self, SurfacePoint, height_over_plane, pdf_from_area};
use crate::{EmissionSample, LightSampleOf};
use glam::{DVec3, Vec2, Vec3};
use sr_math::warp::SphericalRectangle;
use sr_math::{Bounds3, Real, gamma, gamma_of, vec3};

/// An emissive parallelogram.
#[derive(Clone, Copy, Debug)]
pub struct QuadLight {
    corner: Vec3,
    /// The longer edge first: the solid-angle sampling is then well conditioned farther out.
    edges: [Vec3; 2],
    /// That changed their order.
    turned: bool,
    measures: Measures<f32>,
    radiance: Vec3,
    two_sided: bool,
}

/// What follows from the edges.
#[derive(Clone, Copy, Debug)]
struct Measures<R> {
    /// Unit directions and lengths of the edges, when they are at right angles.
    rectangle: Option<[([R; 3], R); 2]>,
    ng: [R; 3],
    area: R,
}

impl Measures<f64> {
    fn of(edges: [Vec3; 2], turned: bool) -> Self {
        let [u, v] = edges.map(Vec3::as_dvec3);
        let cross = if turned { v.cross(u) } else { u.cross(v) };
        let along = |e: DVec3| (e.normalize_or_zero().to_array(), e.length());
        // Solid-angle sampling honours u to 2⁻¹⁴; a skew of 2⁻¹⁷ cannot be seen beside that, and
        // edges that went through a transform in f32 are well within it.
        let skew = u.dot(v).abs() / (u.length() * v.length());
        Self {
            rectangle: (skew < f64::from(gamma(128))).then(|| [u, v].map(along)),
            ng: cross.normalize_or_zero().to_array(),
            area: cross.length(),
        }
    }
}

impl<R: Copy> Measures<R> {
    #[inline(always)]
    fn map<S>(self, f: impl Fn(R) -> S) -> Measures<S> {
        Measures {
            rectangle: self
                .rectangle
                .map(|edges| edges.map(|(direction, length)| (direction.map(&f), f(length)))),
            ng: self.ng.map(&f),
            area: f(self.area),
        }
    }
}

/// How a reference point samples the light.
enum Strategy<R> {
    /// Uniformly by solid angle; the corner in the coordinates of the rectangle.
    SolidAngle(SphericalRectangle<R>, [R; 2]),
    /// Uniformly by area; the height of the reference point over the plane.
    Area(R),
}

impl<R: Real> Strategy<R> {
    #[inline]
    fn pdf(&self, dist: R, area: R) -> R {
        match self {
            Self::SolidAngle(seen, _) => R::ONE / seen.solid_angle(),
            Self::Area(height) => pdf_from_area(dist, *height / dist, area),
        }
    }
}

impl QuadLight {
    /// Emits `radiance` on the side of `edge_u × edge_v`, or on both.
    pub fn new(corner: Vec3, edge_u: Vec3, edge_v: Vec3, radiance: Vec3, two_sided: bool) -> Self {
        let length2 = |e: Vec3| e.as_dvec3().length_squared();
        let turned = length2(edge_u) < length2(edge_v);
        let edges = if turned {
            [edge_v, edge_u]
        } else {
            [edge_u, edge_v]
        };
        Self {
            corner,
            edges,
            turned,
            measures: Measures::of(edges, turned).map(|x| x as f32),
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

    /// Unit normal of the emitting side; zero when the quad has no area.
    pub fn ng(&self) -> Vec3 {
        self.measures.ng.into()
    }

    /// `corner + (s e0 + t e1)`: a product rounds once, their sum once, the last sum once: γ₃ of the
    /// absolute terms.
    #[inline]
    fn point<R: Real>(&self, s: R, t: R) -> SurfacePoint<R> {
        let corner = vec3::lift(self.corner);
        let [a, b] = self.edges.map(vec3::lift);
        let (a, b) = (vec3::scale(s, a), vec3::scale(t, b));
        let terms = vec3::add(vec3::add(vec3::abs(corner), vec3::abs(a)), vec3::abs(b));
        SurfacePoint {
            p: vec3::add(corner, vec3::add(a, b)),
            p_err: vec3::scale(gamma_of(3), terms),
            ng: self.measures().ng,
        }
    }

    #[inline(always)]
    fn measures<R: Real>(&self) -> Measures<R> {
        R::stored_or(
            || self.measures.map(R::from_f32),
            || Measures::of(self.edges, self.turned).map(R::lit),
        )
    }

    #[inline]
    fn strategy<R: Real>(&self, p: [R; 3], m: &Measures<R>) -> Option<Strategy<R>> {
        let corner = vec3::lift(self.corner);
        let height = height_over_plane(p, corner, m.ng)?;
        if !(self.two_sided || height > R::ZERO) {
            return None;
        }
        if let Some([(ex, lx), (ey, ly)]) = m.rectangle {
            let d = vec3::sub(corner, p);
            let (x, y) = (vec3::dot(d, ex), vec3::dot(d, ey));
            if let Some(seen) = SphericalRectangle::new([x, x + lx], [y, y + ly], height)
                && seen.is_well_conditioned()
            {
                return Some(Strategy::SolidAngle(seen, [x, y]));
            }
        }
        Some(Strategy::Area(height.abs()))
    }

    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, p: [R; 3], u: [R; 2]) -> Option<LightSampleOf<R>> {
        let m = self.measures();
        let strategy = self.strategy(p, &m)?;
        let [s, t] = match (&strategy, m.rectangle) {
            (Strategy::SolidAngle(seen, [x0, y0]), Some([(_, lx), (_, ly)])) => {
                let [x, y] = seen.sample(u);
                [(x - *x0) / lx, (y - *y0) / ly].map(|s| s.clamp_to(R::ZERO, R::ONE))
            }
            _ => u,
        };
        area::seen_from(p, self.point(s, t), self.radiance, |_, dist| {
            strategy.pdf(dist, m.area)
        })
    }

    /// See [`crate::Light::pdf_li_real`].
    #[inline]
    pub fn pdf_li<R: Real>(&self, p: [R; 3], dist: R) -> R {
        let m = self.measures();
        self.strategy(p, &m)
            .map_or(R::ZERO, |s| s.pdf(dist, m.area))
    }

    /// See [`crate::Light::le`].
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        area::emitted(self.radiance, self.two_sided, w, ng)
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_pos: Vec2, u_dir: Vec2) -> Option<EmissionSample> {
        let (point, radiance) = (self.point(u_pos.x, u_pos.y), self.radiance);
        area::emission(point, self.area(), radiance, self.two_sided, u_dir)
    }

    /// π · area · radiance for each emitting side.
    pub fn power(&self) -> Vec3 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * std::f32::consts::PI * self.area() * self.radiance
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds3 {
        let [a, b] = self.edges;
        Bounds3::from_points([Vec3::ZERO, a, b, a + b].map(|e| self.corner + e))
    }
}
