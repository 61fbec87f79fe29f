//! Lights without a surface. A surface that glows has [`Emission`](super::Emission) on its
//! material instead.

use super::Rgb;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;

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

/// Light from all directions, infinitely far away.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Environment {
    /// Radiance, W/(m² sr).
    pub radiance: Rgb,
}

impl Default for Environment {
    fn default() -> Self {
        Self {
            radiance: Rgb::splat(1.0),
        }
    }
}
