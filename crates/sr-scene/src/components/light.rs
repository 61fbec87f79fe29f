//! Lights without a surface. A surface that glows has [`Emission`](super::Emission) on its
//! material instead.

use super::Rgb;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::light::EnvironmentMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A point that shines in every direction.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct PointLight {
    /// Radiant intensity, W/sr.
    pub intensity: Rgb,
}

impl Default for PointLight {
    fn default() -> Self {
        Self {
            intensity: Rgb::splat(1.0),
        }
    }
}

/// A point that shines in a cone around local −Z.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct SpotLight {
    /// Radiant intensity on the axis, W/sr.
    pub intensity: Rgb,
    /// Half angle of the cone of full intensity, degrees.
    pub inner_deg: f32,
    /// Half angle of the cone outside of which there is no light, degrees, at most 90.
    pub outer_deg: f32,
}

impl Default for SpotLight {
    fn default() -> Self {
        Self {
            intensity: Rgb::splat(1.0),
            inner_deg: 0.0,
            outer_deg: 45.0,
        }
    }
}

/// Parallel light from infinitely far away, along local −Z.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct DirectionalLight {
    /// Irradiance on a surface that faces it, W/m².
    pub irradiance: Rgb,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self {
            irradiance: Rgb::splat(1.0),
        }
    }
}

/// How directions towards an environment with a map are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum EnvironmentSampling {
    /// In proportion to the luminance of the map.
    #[default]
    Importance,
    /// Uniformly over the sphere.
    Uniform,
}

/// Light from all directions, infinitely far away: `radiance · scale`, times the map if there is one.
///
/// The entity's transform turns the map, after `rotation_deg`; only its rotation counts (and whether it
/// mirrors).
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Environment {
    /// Radiance, W/(m² sr); with a map the factor of its texels.
    pub radiance: Rgb,
    /// Latitude-longitude image with the radiance by direction: OpenEXR or Radiance HDR (or PNG), relative
    /// to the file that names it. The top is +Y, the middle −Z, the right half +X.
    pub map: Option<PathBuf>,
    /// Mirror the map left to right.
    pub flip_u: bool,
    /// Turn the map about +Y, degrees, right-handed: 90 takes what was at −Z to −X.
    pub rotation_deg: f64,
    /// Factor of the radiance.
    pub scale: f32,
    /// How directions are chosen where there is a map.
    pub sampling: EnvironmentSampling,
}

impl Default for Environment {
    fn default() -> Self {
        Self {
            radiance: Rgb::splat(1.0),
            map: None,
            flip_u: false,
            rotation_deg: 0.0,
            scale: 1.0,
            sampling: EnvironmentSampling::default(),
        }
    }
}

/// The map of an [`Environment`], as it was read: what its `map` names, or one that a program made.
/// Entities whose map is the same share it.
#[derive(Component, Clone, Debug)]
pub struct EnvironmentImage(pub Arc<EnvironmentMap>);
