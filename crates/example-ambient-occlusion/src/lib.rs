//! How to write an integrator that answers one camera ray at a time.
//!
//! Ambient occlusion: how much of the hemisphere above a surface is open. A settings type, the
//! [`Integrator`] trait for what it is, the [`RayIntegrator`] trait for what it does, and one call
//! to register it; its name then works in RON: `integrator: AmbientOcclusion(distance: 0.5)`.

use sr_pipeline::accel::Ray;
use sr_pipeline::math::warp;
use sr_pipeline::prelude::*;

/// The open share of the hemisphere, weighted by the cosine.
pub struct AmbientOcclusion {
    distance: f32,
}

/// Settings, as written in RON between the parentheses.
#[derive(Clone, Debug, PartialEq, Reflect)]
#[reflect(Default)]
pub struct AmbientOcclusionSettings {
    /// What is farther away than this does not occlude, metres.
    pub distance: f32,
}

impl Default for AmbientOcclusionSettings {
    fn default() -> Self {
        Self {
            distance: f32::INFINITY,
        }
    }
}

impl Integrator for AmbientOcclusion {
    const NAME: &'static str = "AmbientOcclusion";
    const SUMMARY: &'static str = "the open share of the hemisphere above each surface";
    const USES: SceneFeatures = SceneFeatures::TRIANGLES
        .union(SceneFeatures::SPHERES)
        .union(SceneFeatures::QUADS)
        .union(SceneFeatures::SMOOTH_NORMALS);
    type Settings = AmbientOcclusionSettings;

    fn check(settings: &AmbientOcclusionSettings) -> Result<(), String> {
        if settings.distance.is_nan() || settings.distance <= 0.0 {
            return Err("`distance` must be above 0".into());
        }
        Ok(())
    }
}

impl RayIntegrator for AmbientOcclusion {
    fn prepare(settings: &AmbientOcclusionSettings, _: &RenderScene) -> Result<Self, String> {
        Ok(Self {
            distance: settings.distance,
        })
    }

    fn li<C: RayContext>(&self, ray: &Ray, context: &mut C) -> Vec3 {
        let Some(point) = context.closest(ray) else {
            return Vec3::ONE;
        };
        context.at(1, &point);
        let u = context.sampler().d2(Dim::bounce(0, BounceDim::Bsdf));
        // On the side of the surface that the camera sees.
        let side = point.to_local(point.wo).z.signum();
        let wi = Vec3::from(warp::cosine_hemisphere(u.to_array())) * Vec3::new(1.0, 1.0, side);
        let mut way = point.spawn_ray(point.to_world(wi));
        way.t_max = self.distance;
        // The cosine and 1/π of the estimate cancel against the density.
        if context.occluded(&way) {
            Vec3::ZERO
        } else {
            Vec3::ONE
        }
    }
}

/// The plug-in.
pub fn ambient_occlusion(pipeline: &mut Pipeline) {
    pipeline.add_ray_integrator::<AmbientOcclusion>();
}
