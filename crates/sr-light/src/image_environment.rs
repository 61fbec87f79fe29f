//! Radiance from every direction as an image has it.

use crate::environment::leave;
use crate::{EmissionSample, EnvironmentMap, LightSampleOf};
use glam::{Mat3, Vec2, Vec3};
use sr_math::{Real, vec3, warp};
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
    pub fn radiance<R: Real>(&self, d: [R; 3]) -> [R; 3] {
        let (radiance, _) = self.map.radiance_and_pdf_real(self.to_map(d));
        vec3::mul(vec3::lift(self.scale), radiance)
    }

    /// See [`crate::Light::sample_li_real`].
    ///
    /// Radiance and density are those of the direction as it is rounded, so that no gradient between
    /// texels comes between a sample and its density.
    #[inline]
    pub fn sample_li<R: Real>(&self, u: [R; 2]) -> Option<LightSampleOf<R>> {
        let wi = self.sample_direction(u)?;
        let (radiance, pdf) = self.radiance_and_pdf(wi);
        (pdf > R::ZERO).then(|| LightSampleOf::infinite(wi, radiance, pdf, false))
    }

    /// See [`crate::Light::pdf_li_real`].
    #[inline]
    pub fn pdf_li<R: Real>(&self, wi: [R; 3]) -> R {
        match self.sampling {
            EnvironmentSampling::Uniform => R::lit(0.25) / R::PI,
            EnvironmentSampling::Importance => self.map.radiance_and_pdf_real(self.to_map(wi)).1,
        }
    }

    fn sample_direction<R: Real>(&self, u: [R; 2]) -> Option<[R; 3]> {
        match self.sampling {
            EnvironmentSampling::Uniform => Some(warp::uniform_sphere(u)),
            EnvironmentSampling::Importance => Some(self.world_direction(self.map.sample_real(u)?)),
        }
    }

    fn radiance_and_pdf<R: Real>(&self, wi: [R; 3]) -> ([R; 3], R) {
        let (radiance, pdf) = self.map.radiance_and_pdf_real(self.to_map(wi));
        let pdf = match self.sampling {
            EnvironmentSampling::Uniform => R::lit(0.25) / R::PI,
            EnvironmentSampling::Importance => pdf,
        };
        (vec3::mul(vec3::lift(self.scale), radiance), pdf)
    }

    #[inline]
    fn to_map<R: Real>(&self, d: [R; 3]) -> [R; 3] {
        let [x, y, z] = self.axes::<R>();
        std::array::from_fn(|k| x[k] * d[0] + y[k] * d[1] + z[k] * d[2])
    }

    /// The inverse of an orthogonal matrix is its transpose.
    #[inline]
    fn world_direction<R: Real>(&self, d: [R; 3]) -> [R; 3] {
        self.axes().map(|axis| vec3::dot(axis, d))
    }

    /// Columns of `to_map`.
    #[inline]
    fn axes<R: Real>(&self) -> [[R; 3]; 3] {
        let m = &self.to_map;
        [m.x_axis, m.y_axis, m.z_axis].map(vec3::lift)
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

    /// What enters the scene's bounding sphere: the mean of 4π directions times its cross section.
    pub fn power(&self, scene_radius: f32) -> Vec3 {
        4.0 * PI * PI * scene_radius * scene_radius * (self.scale * self.map.average())
    }
}
