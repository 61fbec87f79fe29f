//! Cameras look along their local −Z, with +Y up.

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;

/// A pinhole camera. Give one of the two angles; the other follows from the picture's shape.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct PerspectiveCamera {
    /// Full horizontal angle of view in degrees, between 0.000014 and 179.99998.
    pub hfov_deg: Option<f64>,
    /// Full vertical angle of view in degrees, between 0.000014 and 179.99998.
    pub vfov_deg: Option<f64>,
}

/// A camera with parallel rays. Give one extent; the other follows from the picture's shape.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct Orthographic {
    /// Full width of what is seen, in metres.
    pub width: Option<f64>,
    /// Full height of what is seen, in metres.
    pub height: Option<f64>,
}

/// Marks the camera that renders. A scene has at most one.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default)]
pub struct ActiveCamera;
