//! What the first hit looks like, as a picture: to see what a scene is before it is lit.

use sr_pipeline::accel::Ray;
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::math::hash;
use sr_pipeline::prelude::*;

/// Shows a quantity instead of light. The film's layers give the same quantities as numbers,
/// beside the light of any integrator.
pub struct Aov {
    settings: AovSettings,
}

/// What [`Aov`] shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Quantity {
    /// Shading normal, `(n + 1) / 2`.
    #[default]
    Normal,
    /// Distance along the view axis, in units of the scene's radius.
    Depth,
    /// Albedo.
    Albedo,
    /// A colour for each shape.
    Shape,
    /// A colour for each material.
    Material,
    /// Bounces of a path that follows the lobes until it leaves, over `max_depth`.
    Bounces,
}

/// Settings of [`Aov`].
#[derive(Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct AovSettings {
    /// What is shown.
    pub show: Quantity,
    /// Where counting bounces ends.
    pub max_depth: u32,
}

impl Default for AovSettings {
    fn default() -> Self {
        Self {
            show: Quantity::Normal,
            max_depth: 16,
        }
    }
}

impl Integrator for Aov {
    const NAME: &'static str = "Aov";
    const SUMMARY: &'static str = "normals, depth, albedo, ids or bounce counts as a picture";
    const USES: SceneFeatures = SceneFeatures::ALL
        .without(SceneFeatures::AREA_LIGHTS)
        .without(SceneFeatures::DELTA_LIGHTS)
        .without(SceneFeatures::ENVIRONMENT)
        .without(SceneFeatures::MANY_LIGHTS);
    type Settings = AovSettings;

    fn check(settings: &AovSettings) -> Result<(), String> {
        if settings.max_depth == 0 {
            return Err("`max_depth` must be at least 1".into());
        }
        Ok(())
    }
}

impl RayIntegrator for Aov {
    fn prepare(settings: &AovSettings, _scene: &RenderScene) -> Result<Self, String> {
        Ok(Self {
            settings: settings.clone(),
        })
    }

    fn li<C: RayContext>(&self, ray: &Ray, context: &mut C) -> Vec3 {
        let Some(point) = context.closest(ray) else {
            return Vec3::ZERO;
        };
        context.at(0, &point);
        match self.settings.show {
            Quantity::Normal => point.frame.n * 0.5 + 0.5,
            Quantity::Depth => {
                let scene = context.scene();
                let depth = scene.camera().depth(point.p);
                Vec3::splat(depth / scene.radius().max(f32::MIN_POSITIVE))
            }
            Quantity::Albedo => context.scene().bsdf(&point).albedo(),
            Quantity::Shape => colour_of(point.shape.0),
            Quantity::Material => colour_of(point.material.0),
            Quantity::Bounces => {
                let bounces = self.count_bounces(point, context);
                Vec3::splat(bounces as f32 / self.settings.max_depth as f32)
            }
        }
    }
}

impl Aov {
    fn count_bounces<C: RayContext>(&self, mut point: SurfacePoint, context: &mut C) -> u32 {
        for depth in 0..self.settings.max_depth {
            let uc = context.sampler().d1(Dim::bounce(depth, BounceDim::Lobe));
            let u = context.sampler().d2(Dim::bounce(depth, BounceDim::Bsdf));
            let wo = point.to_local(point.wo);
            let sample = context
                .scene()
                .bsdf(&point)
                .sample(wo, uc, u, TransportMode::Radiance);
            let Some(sample) = sample else {
                return depth;
            };
            let ray = point.spawn_ray(point.to_world(sample.wi));
            match context.closest(&ray) {
                Some(next) => point = next,
                None => return depth + 1,
            }
        }
        self.settings.max_depth
    }
}

/// A bright colour that differs between neighbouring ids.
fn colour_of(id: u32) -> Vec3 {
    let channel = |k| 0.2 + 0.8 * hash::unit_f32(hash::mix(id, k));
    Vec3::new(channel(0), channel(1), channel(2))
}
