//! The closed set of lights.

use crate::{
    ConstantEnvironment, DirectionalLight, EmissionSample, ImageEnvironment, LightSample,
    LightSampleOf, PointLight, QuadLight, SphereLight, SpotLight, TriangleLight,
};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, Real, vec3};

/// Any light.
#[derive(Clone, Debug)]
pub enum Light {
    /// An emissive triangle.
    Triangle(TriangleLight),
    /// An emissive parallelogram.
    Quad(QuadLight),
    /// An emissive sphere.
    Sphere(SphereLight),
    /// A point.
    Point(PointLight),
    /// A point behind a cone.
    Spot(SpotLight),
    /// Parallel light.
    Directional(DirectionalLight),
    /// All directions alike.
    Environment(ConstantEnvironment),
    /// All directions as in an image, which clones share.
    ImageEnvironment(ImageEnvironment),
}

impl Light {
    /// A direction from which light may arrive at `p`, `u` in `[0, 1)²`. Visibility is not tested.
    ///
    /// `None` where no light arrives, or where `u` fell on a point of density zero.
    #[inline]
    pub fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.sample_li_real(p.to_array(), u.to_array())
            .map(LightSample::from)
    }

    /// [`Light::sample_li`] in either type.
    #[inline]
    pub fn sample_li_real<R: Real>(&self, p: [R; 3], u: [R; 2]) -> Option<LightSampleOf<R>> {
        match self {
            Self::Triangle(l) => l.sample_li(p, u),
            Self::Quad(l) => l.sample_li(p, u),
            Self::Sphere(l) => l.sample_li(p, u),
            Self::Point(l) => l.sample_li(p),
            Self::Spot(l) => l.sample_li(p),
            Self::Directional(l) => l.sample_li(),
            Self::Environment(l) => l.sample_li(u),
            Self::ImageEnvironment(l) => l.sample_li(u),
        }
    }

    /// The density per solid angle with which [`Light::sample_li`] chooses `wi` at `p`, given that the
    /// ray from `p` along `wi` meets the light at `dist` with geometric normal `ng_light` (infinite
    /// lights: neither is read). 0 for delta lights.
    #[inline]
    pub fn pdf_li(&self, p: Vec3, wi: Vec3, dist: f32, ng_light: Vec3) -> f32 {
        self.pdf_li_real(p.to_array(), wi.to_array(), dist, ng_light.to_array())
    }

    /// [`Light::pdf_li`] in either type.
    #[inline]
    pub fn pdf_li_real<R: Real>(&self, p: [R; 3], wi: [R; 3], dist: R, ng_light: [R; 3]) -> R {
        match self {
            Self::Triangle(l) => l.pdf_li(p, dist),
            Self::Quad(l) => l.pdf_li(p, dist),
            Self::Sphere(l) => l.pdf_li(p, wi, dist, ng_light),
            Self::Environment(l) => l.pdf_li(),
            Self::ImageEnvironment(l) => l.pdf_li(wi),
            Self::Point(_) | Self::Spot(_) | Self::Directional(_) => R::ZERO,
        }
    }

    /// Radiance that leaves the surface in direction `w`, where its normal is `ng`; 0 for lights
    /// without a surface.
    #[inline]
    pub fn le(&self, w: Vec3, ng: Vec3) -> Vec3 {
        match self {
            Self::Triangle(l) => l.le(w, ng),
            Self::Quad(l) => l.le(w, ng),
            Self::Sphere(l) => l.le(w, ng),
            _ => Vec3::ZERO,
        }
    }

    /// Radiance that a ray in direction `d` finds when it leaves the scene; 0 for all but
    /// environments.
    #[inline]
    pub fn le_environment(&self, d: Vec3) -> Vec3 {
        match self {
            Self::Environment(l) => l.radiance,
            Self::ImageEnvironment(l) => l.radiance(d.to_array()).into(),
            _ => Vec3::ZERO,
        }
    }

    /// [`Light::le_environment`] in either type.
    #[inline]
    pub fn le_environment_real<R: Real>(&self, d: [R; 3]) -> [R; 3] {
        match self {
            Self::Environment(l) => vec3::lift(l.radiance),
            Self::ImageEnvironment(l) => l.radiance(d),
            _ => [R::ZERO; 3],
        }
    }

    /// Emitted power in W. That of an infinite light is what reaches the scene's bounding sphere.
    ///
    /// No light needs the centre yet; one that varies with the place would.
    pub fn power(&self, _scene_center: Vec3, scene_radius: f32) -> Vec3 {
        match self {
            Self::Triangle(l) => l.power(),
            Self::Quad(l) => l.power(),
            Self::Sphere(l) => l.power(),
            Self::Point(l) => l.power(),
            Self::Spot(l) => l.power(),
            Self::Directional(l) => l.power(scene_radius),
            Self::Environment(l) => l.power(scene_radius),
            Self::ImageEnvironment(l) => l.power(scene_radius),
        }
    }

    /// Only [`Light::sample_li`] finds it.
    pub fn is_delta(&self) -> bool {
        matches!(self, Self::Point(_) | Self::Spot(_) | Self::Directional(_))
    }

    /// Has no place: every ray that leaves the scene along its direction meets it.
    pub fn is_infinite(&self) -> bool {
        matches!(
            self,
            Self::Directional(_) | Self::Environment(_) | Self::ImageEnvironment(_)
        )
    }

    /// The box around it; `None` for infinite lights.
    pub fn bounds(&self) -> Option<Bounds3> {
        match self {
            Self::Triangle(l) => Some(l.bounds()),
            Self::Quad(l) => Some(l.bounds()),
            Self::Sphere(l) => Some(l.bounds()),
            Self::Point(l) => Some(l.bounds()),
            Self::Spot(l) => Some(l.bounds()),
            Self::Directional(_) | Self::Environment(_) | Self::ImageEnvironment(_) => None,
        }
    }

    /// A ray that leaves the light, for tracing from the lights. Infinite lights send it from a disk
    /// that covers the scene's bounding sphere, just outside it.
    pub fn sample_le(
        &self,
        u_pos: Vec2,
        u_dir: Vec2,
        scene_center: Vec3,
        scene_radius: f32,
    ) -> Option<EmissionSample> {
        match self {
            Self::Triangle(l) => l.sample_le(u_pos, u_dir),
            Self::Quad(l) => l.sample_le(u_pos, u_dir),
            Self::Sphere(l) => l.sample_le(u_pos, u_dir),
            Self::Point(l) => l.sample_le(u_dir),
            Self::Spot(l) => l.sample_le(u_dir),
            Self::Directional(l) => l.sample_le(u_pos, scene_center, scene_radius),
            Self::Environment(l) => l.sample_le(u_pos, u_dir, scene_center, scene_radius),
            Self::ImageEnvironment(l) => l.sample_le(u_pos, u_dir, scene_center, scene_radius),
        }
    }
}
