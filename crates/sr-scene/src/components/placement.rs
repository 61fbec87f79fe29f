//! Where things are.

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::ReflectComponent;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use glam::{DMat4, DQuat, DVec3, EulerRot};

/// Placement relative to the parent (`ChildOf`), or to the world without one.
///
/// The local matrix is `T · R · S · matrix`: the optional matrix acts first.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct LocalTransform {
    /// Translation in metres.
    pub translate: [f64; 3],
    /// Rotation about the fixed axes x, then y, then z, in degrees: `Rz · Ry · Rx`.
    pub rotate_deg: [f64; 3],
    /// Scale along the axes; may be negative. In RON a single number scales all three.
    pub scale: [f64; 3],
    /// A 4×4 matrix, column by column, as model files write it.
    pub matrix: Option<[f64; 16]>,
}

impl Default for LocalTransform {
    fn default() -> Self {
        Self {
            translate: [0.0; 3],
            rotate_deg: [0.0; 3],
            scale: [1.0; 3],
            matrix: None,
        }
    }
}

impl LocalTransform {
    /// A pure translation.
    pub fn from_translation(translate: [f64; 3]) -> Self {
        Self {
            translate,
            ..Self::default()
        }
    }

    /// From a matrix that a model file brought.
    pub fn from_matrix(matrix: [f64; 16]) -> Self {
        Self {
            matrix: Some(matrix),
            ..Self::default()
        }
    }

    /// Local to parent.
    pub fn to_matrix(&self) -> DMat4 {
        let [x, y, z] = self.rotate_deg.map(f64::to_radians);
        let trs = DMat4::from_scale_rotation_translation(
            DVec3::from_array(self.scale),
            DQuat::from_euler(EulerRot::ZYX, z, y, x),
            DVec3::from_array(self.translate),
        );
        match &self.matrix {
            Some(m) => trs * DMat4::from_cols_array(m),
            None => trs,
        }
    }
}

/// Placement of a camera by where it looks, instead of a [`LocalTransform`]; not both.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default)]
pub struct LookAt {
    /// Position, in the parent's frame.
    pub from: [f64; 3],
    /// A point on the optical axis.
    pub to: [f64; 3],
    /// Roughly upwards; must not be parallel to the axis.
    pub up: [f64; 3],
}

impl Default for LookAt {
    fn default() -> Self {
        Self {
            from: [0.0; 3],
            to: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
        }
    }
}

impl LookAt {
    /// Local to parent for a thing that looks along its −Z with +Y up, or `None` when `from`,
    /// `to` and `up` do not span a frame.
    pub fn to_matrix(&self) -> Option<DMat4> {
        let from = DVec3::from_array(self.from);
        let back = (from - DVec3::from_array(self.to)).try_normalize()?;
        let right = DVec3::from_array(self.up).cross(back).try_normalize()?;
        let up = back.cross(right);
        Some(DMat4::from_cols(
            right.extend(0.0),
            up.extend(0.0),
            back.extend(0.0),
            from.extend(1.0),
        ))
    }
}

/// Local to world, derived by `Compile` in f64.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct WorldTransform(pub DMat4);
