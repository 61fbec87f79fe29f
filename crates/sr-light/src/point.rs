//! A point that shines evenly in all directions.

use crate::{EmissionSample, LightSample};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, warp};
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
pub(crate) fn sample_point(
    light: Vec3,
    p: Vec3,
    intensity: impl FnOnce(Vec3) -> Vec3,
) -> Option<LightSample> {
    let d = light - p;
    let dist = d.length();
    let wi = d / dist;
    // Divided twice: the square of a short distance underflows before this does.
    let radiance = intensity(wi) / dist / dist;
    (dist > 0.0 && radiance != Vec3::ZERO).then_some(LightSample {
        wi,
        dist,
        radiance,
        pdf: 1.0,
        p: light,
        p_err: Vec3::ZERO,
        ng: -wi,
        is_delta: true,
    })
}

impl PointLight {
    /// See [`crate::Light::sample_li`].
    #[inline]
    pub fn sample_li(&self, p: Vec3) -> Option<LightSample> {
        sample_point(self.p, p, |_| self.intensity)
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
