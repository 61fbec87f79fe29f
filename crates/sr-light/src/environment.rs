//! The same radiance from everywhere.

use crate::directional::disk_before_scene;
use crate::{EmissionSample, LightSample};
use glam::{Vec2, Vec3};
use sr_math::warp;
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
    /// See [`crate::Light::sample_li`].
    #[inline]
    pub fn sample_li(&self, u: Vec2) -> Option<LightSample> {
        let wi = Vec3::from(warp::uniform_sphere(u.to_array()));
        Some(LightSample {
            wi,
            dist: f32::INFINITY,
            radiance: self.radiance,
            pdf: self.pdf_li(),
            p: Vec3::ZERO,
            p_err: Vec3::ZERO,
            ng: -wi,
            is_delta: false,
        })
    }

    /// See [`crate::Light::pdf_li`].
    #[inline]
    pub fn pdf_li(&self) -> f32 {
        0.25 / PI
    }

    /// See [`crate::Light::sample_le`].
    pub fn sample_le(
        &self,
        u_pos: Vec2,
        u_dir: Vec2,
        scene_center: Vec3,
        scene_radius: f32,
    ) -> Option<EmissionSample> {
        leave(&self.sample_li(u_dir)?, u_pos, scene_center, scene_radius)
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
