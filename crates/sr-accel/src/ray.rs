//! Rays and what they hit.

use glam::Vec3;

/// The primitive id of a [`Hit`] that hit nothing.
pub const PRIM_NONE: u32 = u32::MAX;

/// A half line: the points `o + t d` with `0 < t <= t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// The largest `t` that counts, in units of `d`; may be infinite.
    pub t_max: f32,
    /// Direction; need not be of unit length.
    pub d: Vec3,
}

/// Where a ray met a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Hit {
    /// The ray's parameter, in units of its direction.
    pub t: f32,
    /// Triangle: the weight of vertex 1. Quad: the fraction of `edge_u`. Sphere: 0.
    pub u: f32,
    /// Triangle: the weight of vertex 2. Quad: the fraction of `edge_v`. Sphere: 0.
    pub v: f32,
    /// The primitive's id, or [`PRIM_NONE`].
    pub prim: u32,
}

impl Default for Hit {
    fn default() -> Self {
        Self::MISS
    }
}

impl Hit {
    /// No hit.
    pub const MISS: Self = Self {
        t: f32::INFINITY,
        u: 0.0,
        v: 0.0,
        prim: PRIM_NONE,
    };

    /// Whether anything was hit.
    #[inline]
    pub fn is_hit(&self) -> bool {
        self.prim != PRIM_NONE
    }
}
