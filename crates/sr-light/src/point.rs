//! A point that shines evenly in all directions.

use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, Real, vec3, warp};
use std::f32::consts::PI;

/// An isotropic point light.
#[derive(Clone, Copy, Debug)]
pub struct PointLight {
    /// Where it is.
    pub p: Vec3,
    /// Radiant intensity in W/sr.
    pub intensity: Vec3,
}

/// The one sample of a light that is a point, given the intensity in the direction `−wi`.
#[inline]
pub(crate) fn sample_point<R: Real>(
    light: Vec3,
    p: [R; 3],
    intensity: impl FnOnce([R; 3]) -> [R; 3],
) -> Option<LightSampleOf<R>> {
    let light = vec3::lift(light);
    let d = vec3::sub(light, p);
    let dist = vec3::length(d);
    let wi = vec3::div(d, dist);
    // Divided twice: the square of a short distance underflows before this does.
    let radiance = intensity(wi).map(|i| i / dist / dist);
    // A distance whose square is no normal number has no direction.
    (dist * dist >= R::MIN_POSITIVE && radiance != [R::ZERO; 3]).then_some(LightSampleOf {
        wi,
        dist,
        radiance,
        pdf: R::ONE,
        p: light,
        p_err: [R::ZERO; 3],
        ng: vec3::neg(wi),
        is_delta: true,
    })
}

impl PointLight {
    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, p: [R; 3]) -> Option<LightSampleOf<R>> {
        sample_point(self.p, p, |_| vec3::lift(self.intensity))
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(&self, u_dir: Vec2) -> Option<EmissionSample> {
        let d = Vec3::from(warp::uniform_sphere(u_dir.to_array()));
        Some(EmissionSample {
            o: self.p,
            o_err: Vec3::ZERO,
            ng: d,
            d,
            radiance: self.intensity,
            pdf_pos: 1.0,
            pdf_dir: 0.25 / PI,
            is_delta_position: true,
            is_delta_direction: false,
        })
    }

    /// 4π · intensity.
    pub fn power(&self) -> Vec3 {
        4.0 * PI * self.intensity
    }

    /// The point itself.
    pub fn bounds(&self) -> Bounds3 {
        Bounds3::from_points([self.p])
    }
}
