//! The same radiance from everywhere.

use crate::directional::disk_before_scene;
use crate::{EmissionSample, LightSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Real, vec3, warp};
use std::f32::consts::PI;

/// A constant environment.
///
/// Sampled uniformly over the sphere: half of the samples fall behind a surface, but the choice needs
/// no normal, and holds for media and glass too.
#[derive(Clone, Copy, Debug)]
pub struct ConstantEnvironment {
    /// Radiance from every direction.
    pub radiance: Vec3,
}

impl ConstantEnvironment {
    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, u: [R; 2]) -> Option<LightSampleOf<R>> {
        let (wi, radiance) = (warp::uniform_sphere(u), vec3::lift(self.radiance));
        Some(LightSampleOf::infinite(wi, radiance, self.pdf_li(), false))
    }

    /// See [`crate::Light::pdf_li_real`].
    #[inline]
    pub fn pdf_li<R: Real>(&self) -> R {
        R::lit(0.25) / R::PI
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(
        &self,
        u_pos: Vec2,
        u_dir: Vec2,
        scene_center: Vec3,
        scene_radius: f32,
    ) -> Option<EmissionSample> {
        leave(
            &self.sample_li(u_dir.to_array())?.into(),
            u_pos,
            scene_center,
            scene_radius,
        )
    }

    /// What enters the scene's bounding sphere: 4π directions times its cross section.
    pub fn power(&self, scene_radius: f32) -> Vec3 {
        4.0 * PI * PI * scene_radius * scene_radius * self.radiance
    }
}

/// The ray that a sample of an environment sends back to the scene, from outside it.
pub(crate) fn leave(
    sample: &LightSample,
    u_pos: Vec2,
    scene_center: Vec3,
    scene_radius: f32,
) -> Option<EmissionSample> {
    let (o, pdf_pos) = disk_before_scene(sample.wi, u_pos, scene_center, scene_radius)?;
    let d = -sample.wi;
    Some(EmissionSample {
        o,
        o_err: Vec3::ZERO,
        ng: d,
        d,
        radiance: sample.radiance,
        pdf_pos,
        pdf_dir: sample.pdf,
        is_delta_position: false,
        is_delta_direction: false,
    })
}
