//! Radiance from every direction as an image has it.

use crate::environment::leave;
use crate::{EmissionSample, EnvironmentMap, LightSample};
use glam::{Mat3, Vec2, Vec3};
use sr_math::warp;
use std::f32::consts::PI;
use std::sync::Arc;

/// How directions are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EnvironmentSampling {
    /// In proportion to the map's luminance.
    #[default]
    Importance,
    /// Uniformly over the sphere.
    Uniform,
}

/// An environment map in its place.
#[derive(Clone, Debug)]
pub struct ImageEnvironment {
    /// The map.
    pub map: Arc<EnvironmentMap>,
    /// Takes directions of render space to those of the map. Orthogonal: a rotation, mirrored or not.
    pub to_map: Mat3,
    /// Factor of the map's radiance. Times [`EnvironmentMap::brightest`] it must stay below
    /// [`EnvironmentMap::BRIGHTEST`].
    pub scale: Vec3,
    /// How directions are chosen.
    pub sampling: EnvironmentSampling,
}

impl ImageEnvironment {
    /// Radiance from direction `d`.
    #[inline]
    pub fn radiance(&self, d: Vec3) -> Vec3 {
        self.scale * self.map.radiance(self.to_map * d)
    }

    /// See [`crate::Light::sample_li`].
    ///
    /// Radiance and density are those of the direction as it is rounded, so that no gradient between
    /// texels comes between a sample and its density.
    #[inline]
    pub fn sample_li(&self, u: Vec2) -> Option<LightSample> {
        let wi = self.sample_direction(u)?;
        let (radiance, pdf) = self.radiance_and_pdf(wi);
        (pdf > 0.0).then_some(LightSample {
            wi,
            dist: f32::INFINITY,
            radiance,
            pdf,
            p: Vec3::ZERO,
            p_err: Vec3::ZERO,
            ng: -wi,
            is_delta: false,
        })
    }

    /// See [`crate::Light::pdf_li`].
    #[inline]
    pub fn pdf_li(&self, wi: Vec3) -> f32 {
        match self.sampling {
            EnvironmentSampling::Uniform => 0.25 / PI,
            EnvironmentSampling::Importance => self.map.pdf(self.to_map * wi),
        }
    }

    fn sample_direction(&self, u: Vec2) -> Option<Vec3> {
        match self.sampling {
            EnvironmentSampling::Uniform => Some(warp::uniform_sphere(u.to_array()).into()),
            // The inverse of an orthogonal matrix is its transpose.
            EnvironmentSampling::Importance => {
                Some(self.to_map.transpose() * self.map.sample(u.to_array())?)
            }
        }
    }

    fn radiance_and_pdf(&self, wi: Vec3) -> (Vec3, f32) {
        let (radiance, pdf) = self.map.radiance_and_pdf(self.to_map * wi);
        let pdf = match self.sampling {
            EnvironmentSampling::Uniform => 0.25 / PI,
            EnvironmentSampling::Importance => pdf,
        };
        (self.scale * radiance, pdf)
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

    /// What enters the scene's bounding sphere: the mean of 4π directions times its cross section.
    pub fn power(&self, scene_radius: f32) -> Vec3 {
        4.0 * PI * PI * scene_radius * scene_radius * (self.scale * self.map.average())
    }
}
