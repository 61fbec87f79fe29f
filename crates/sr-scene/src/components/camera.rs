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

/// A lens of finite aperture, beside a camera: what is not in focus is blurred.
///
/// Give `focus_distance` or `focus`; an aperture of radius 0 is a pinhole and needs neither.
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct ThinLens {
    /// Radius of the aperture in metres, from 0; of a polygon, of the circle through its corners.
    pub aperture_radius: f64,
    /// Distance of the plane of focus along the view axis in metres, above 0; may be infinite.
    pub focus_distance: Option<f64>,
    /// What lies in the plane of focus.
    pub focus: Option<Focus>,
    /// Corners of a polygonal aperture, at least 3; 0 for a round one.
    pub blades: u32,
    /// Turns the polygon, in degrees counter-clockwise as the picture shows it; at 0 a corner is at
    /// the top.
    pub rotation_deg: f64,
}

/// What lies in the plane of focus of a [`ThinLens`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Focus {
    /// The centre of an entity's world bounds, its children included; without any shape its origin.
    Entity(Entity),
    /// What is seen first through the centre of a pixel, counted from the top left.
    At([u32; 2]),
}

impl Default for Focus {
    fn default() -> Self {
        Self::At([0; 2])
    }
}

/// Marks the camera that renders. A scene has at most one.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default)]
pub struct ActiveCamera;
