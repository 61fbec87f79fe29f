//! A sphere of uniform radiance, sampled by the cone it fills.
//!
//! Everything is written from `sin²θmax = r²/d²` and the fraction `u` of the cone, so that no size of
//! the cone makes a difference of nearly equal numbers.

use crate::area::{self, SurfacePoint, pdf_from_area};
use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, Real, gamma_of, to_world, vec3, warp};
use std::f32::consts::PI;

/// An emissive sphere.
#[derive(Clone, Copy, Debug)]
pub struct SphereLight {
    center: Vec3,
    radius: f32,
    radiance: Vec3,
    two_sided: bool,
}

/// A sample of the cone that a sphere fills, +Z towards its centre.
#[derive(Clone, Copy, Debug)]
struct ConeSample<R> {
    /// Unit direction from the reference point.
    wi: [R; 3],
    /// Unit normal of the sphere where that direction first meets it.
    ng: [R; 3],
    /// Distance from there to the middle of the chord, in radii.
    half_chord: R,
}

/// Uniform in the cone of `sin²θmax`.
///
/// With h = 1 − cos θmax and θ the sampled angle, 1 − cos θ = u h; the sine of the angle of incidence
/// is s = sin θ / sin θmax (law of sines), and
///
/// ```text
/// s² = u (2 − u h)/(2 − h),   1 − s² = (1 − u)(2 − h (1 + u))/(2 − h)
/// ```
///
/// without a difference of rounded numbers. The normal is inclined to −Z by asin s − θ.
#[inline]
fn sample_cone<R: Real>(u: [R; 2], sin2_theta_max: R) -> ConeSample<R> {
    let two = R::lit(2.0);
    let h = warp::one_minus_cos(sin2_theta_max);
    let wi = warp::uniform_cone(u, sin2_theta_max);
    let incidence_sin = (u[0] * (two - u[0] * h) / (two - h)).sqrt();
    let incidence_cos = ((R::ONE - u[0]) * (two - h * (R::ONE + u[0])) / (two - h)).safe_sqrt();
    let (sin_theta, cos_theta) = (sin2_theta_max.sqrt() * incidence_sin, wi[2]);
    // cos and sin of asin s − θ; the azimuth is that of wi.
    let normal_cos = incidence_cos * cos_theta + incidence_sin * sin_theta;
    let normal_sin = incidence_sin * cos_theta - incidence_cos * sin_theta;
    let phi = two * R::PI * u[1];
    ConeSample {
        wi,
        ng: [normal_sin * phi.cos(), normal_sin * phi.sin(), -normal_cos],
        half_chord: incidence_cos,
    }
}

impl SphereLight {
    /// Emits `radiance` outward, or on both sides.
    pub fn new(center: Vec3, radius: f32, radiance: Vec3, two_sided: bool) -> Self {
        Self {
            center,
            radius: radius.abs(),
            radiance,
            two_sided,
        }
    }

    /// Radiance on the emitting side.
    pub fn radiance(&self) -> Vec3 {
        self.radiance
    }

    /// Area in m².
    pub fn area(&self) -> f32 {
        self.area_in()
    }

    #[inline(always)]
    fn area_in<R: Real>(&self) -> R {
        let radius = R::from_f32(self.radius);
        R::lit(4.0) * R::PI * radius * radius
    }

    /// `sin²θmax` of the cone that the sphere fills; `None` from inside, and from so near the
    /// surface that rounding cannot tell the sides apart.
    ///
    /// A point of the sphere itself is off it by γ₆ · (|center| + radius) an axis (see `point`), the
    /// difference to the centre rounds once more, and three axes add up to √3 times that: 2 γ₈ in
    /// all. Such a point may be a surface seen from inside, whose light is the far wall and not the
    /// cone; sampling by area is right on both sides.
    #[inline]
    fn sin2_theta_max<R: Real>(&self, p: [R; 3]) -> Option<R> {
        let (center, radius) = (vec3::lift(self.center), R::from_f32(self.radius));
        let d2 = vec3::length_squared(vec3::sub(center, p));
        let r2 = radius * radius;
        let blur = R::lit(2.0) * gamma_of::<R>(8) * (vec3::length(center) + radius);
        let reach = radius + blur;
        (d2 > reach * reach).then_some(r2 / d2)
    }

    /// `center + radius · ng` for a normal that is renormalised here: its square's sum takes 3
    /// roundings, halved by the root, root and quotient 2 more, the product with the radius 1, so
    /// the point is off the sphere by γ₅ · radius along the normal. The last sum rounds by half an
    /// ulp of at most |center| + radius · |ng|: γ₆ of that bounds both.
    #[inline]
    fn point<R: Real>(&self, ng: [R; 3]) -> SurfacePoint<R> {
        let center = vec3::lift(self.center);
        let ng = vec3::div(ng, vec3::length(ng));
        let arm = vec3::scale(R::from_f32(self.radius), ng);
        let terms = vec3::add(vec3::abs(center), vec3::abs(arm));
        SurfacePoint {
            p: vec3::add(center, arm),
            p_err: vec3::scale(gamma_of(6), terms),
            ng,
        }
    }

    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, p: [R; 3], u: [R; 2]) -> Option<LightSampleOf<R>> {
        match self.sin2_theta_max(p) {
            Some(sin2) => self.sample_outside(p, u, sin2),
            None => {
                let point = self.point(warp::uniform_sphere(u));
                area::seen_from(p, point, self.radiance, |wi, dist| {
                    self.pdf_by_area(wi, dist, point.ng)
                })
            }
        }
    }

    /// Density per solid angle of sampling by area; 0 for a side that does not emit, which from
    /// inside a one-sided sphere is all there is to see.
    #[inline]
    fn pdf_by_area<R: Real>(&self, wi: [R; 3], dist: R, ng: [R; 3]) -> R {
        let cos_light = -vec3::dot(wi, ng);
        if self.two_sided || cos_light > R::ZERO {
            pdf_from_area(dist, cos_light.abs(), self.area_in())
        } else {
            R::ZERO
        }
    }

    #[inline]
    fn sample_outside<R: Real>(
        &self,
        p: [R; 3],
        u: [R; 2],
        sin2_theta_max: R,
    ) -> Option<LightSampleOf<R>> {
        let pdf = warp::uniform_cone_pdf(sin2_theta_max);
        if !pdf.is_finite() {
            return None;
        }
        let d = vec3::sub(vec3::lift(self.center), p);
        let distance = vec3::length(d);
        let axis = vec3::div(d, distance);
        let local = sample_cone(u, sin2_theta_max);
        let point = self.point(to_world(axis, local.ng));
        let chord = R::from_f32(self.radius) * local.half_chord;
        Some(LightSampleOf {
            wi: to_world(axis, local.wi),
            dist: (distance * local.wi[2] - chord).max(R::ZERO),
            radiance: vec3::lift(self.radiance),
            pdf,
            p: point.p,
            p_err: point.p_err,
            ng: point.ng,
            is_delta: false,
        })
    }

    /// See [`crate::Light::pdf_li_real`].
    #[inline]
    pub fn pdf_li<R: Real>(&self, p: [R; 3], wi: [R; 3], dist: R, ng_light: [R; 3]) -> R {
        match self.sin2_theta_max(p) {
            Some(sin2) => {
                let pdf = warp::uniform_cone_pdf(sin2);
                if pdf.is_finite() { pdf } else { R::ZERO }
            }
            None => self.pdf_by_area(wi, dist, ng_light),
        }
    }

    /// See [`crate::Light::le`].
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        area::emitted(self.radiance, self.two_sided, w, ng)
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_pos: Vec2, u_dir: Vec2) -> Option<EmissionSample> {
        let point = self.point(warp::uniform_sphere(u_pos.to_array()));
        area::emission(point, self.area(), self.radiance, self.two_sided, u_dir)
    }

    /// π · area · radiance for each emitting side.
    pub fn power(&self) -> Vec3 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * PI * self.area() * self.radiance
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds3 {
        let r = Vec3::splat(self.radius);
        Bounds3::from_points([self.center - r, self.center + r])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash;

    /// Down to 1e-14 steradian and below: sine and normal keep their relative accuracy.
    #[test]
    fn cone_samples_agree_with_f64_at_every_size() {
        for i in 0..40_000u32 {
            let h = |k| hash::unit_f32(hash::mix(i, k));
            let sin2 = 10f32.powf(-16.0 * h(0));
            let u = [h(1), h(2)];
            let narrow = sample_cone(u, sin2);
            let wide = sample_cone(u.map(f64::from), sin2.into());
            // Twelve roundings, and φ up to 2π rounded once.
            let bound = (12.0 + 2.0 * std::f64::consts::PI) * f64::from(f32::EPSILON);
            for k in 0..3 {
                let size = if k < 2 { f64::from(sin2).sqrt() } else { 1.0 };
                let error = (f64::from(narrow.wi[k]) - wide.wi[k]).abs();
                assert!(error <= bound * size, "{sin2} {u:?}: {error}");
                let error = (f64::from(narrow.ng[k]) - wide.ng[k]).abs();
                assert!(error <= bound, "{sin2} {u:?}: {error}");
            }
        }
    }

    /// The oracle itself: the direction meets the sphere where the normal says, on the near side.
    #[test]
    fn the_normal_belongs_to_the_direction() {
        for i in 0..10_000u32 {
            let h = |k| f64::from(hash::unit_f32(hash::mix(i, k)));
            let sin2 = 10f64.powf(-6.0 * h(0));
            let s = sample_cone([h(1), h(2)], sin2);
            let distance = sin2.sqrt().recip();
            let t = distance * s.wi[2] - s.half_chord;
            for k in 0..3 {
                let center = if k == 2 { distance } else { 0.0 };
                let error = (t * s.wi[k] - (center + s.ng[k])).abs();
                assert!(error < 1e-14 * distance, "{sin2}: {error}");
            }
            let facing: f64 = (0..3).map(|k| s.wi[k] * s.ng[k]).sum();
            assert!(facing <= 1e-12, "{facing}");
        }
    }
}
