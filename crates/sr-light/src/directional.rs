//! Parallel light from infinitely far away.

use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Frame, Real, vec3, warp};
use std::f32::consts::PI;

/// A directional light.
#[derive(Clone, Copy, Debug)]
pub struct DirectionalLight {
    /// Unit vector towards the light.
    pub wi: Vec3,
    /// What a surface that faces the light receives, in W/m².
    pub irradiance: Vec3,
}

/// An origin, uniform on the disk that the scene's bounding sphere shows to the direction `towards`,
/// outside that sphere; and the density of the origin. `None` for a scene of no extent.
pub(crate) fn disk_before_scene(
    towards: Vec3,
    u: Vec2,
    scene_center: Vec3,
    scene_radius: f32,
) -> Option<(Vec3, f32)> {
    let frame = Frame::from_normal(towards);
    let [x, y] = warp::concentric_disk(u.to_array());
    let o = scene_center + scene_radius * (frame.n + x * frame.s + y * frame.t);
    let pdf = 1.0 / (PI * scene_radius * scene_radius);
    (pdf > 0.0 && pdf.is_finite()).then_some((o, pdf))
}

impl DirectionalLight {
    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self) -> Option<LightSampleOf<R>> {
        let (wi, irradiance) = (vec3::lift(self.wi), vec3::lift(self.irradiance));
        (self.irradiance != Vec3::ZERO)
            .then(|| LightSampleOf::infinite(wi, irradiance, R::ONE, true))
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(
        &self,
        u_pos: Vec2,
        scene_center: Vec3,
        scene_radius: f32,
    ) -> Option<EmissionSample> {
        let (o, pdf_pos) = disk_before_scene(self.wi, u_pos, scene_center, scene_radius)?;
        let d = -self.wi;
        Some(EmissionSample {
            o,
            o_err: Vec3::ZERO,
            ng: d,
            d,
            radiance: self.irradiance,
            pdf_pos,
            pdf_dir: 1.0,
            is_delta_position: false,
            is_delta_direction: true,
        })
    }

    /// What passes through the cross section of the scene's bounding sphere.
    pub fn power(&self, scene_radius: f32) -> Vec3 {
        PI * scene_radius * scene_radius * self.irradiance
    }
}
