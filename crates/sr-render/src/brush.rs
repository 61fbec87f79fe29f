//! Tangents of anisotropic surfaces.

use glam::{DVec3, Vec3};
use sr_math::Frame;

/// Marks around an axis, as a lathe or a brush leaves them: the tangent that every normal of a shape gets.
///
/// Local X is axis × n, or the fallback where the normal is the axis; turned about the normal by an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    axis: DVec3,
    fallback: DVec3,
    sin_cos: (f32, f32),
}

impl Brush {
    /// `axis` and `fallback` are directions in render space, not parallel and of any length; `rotation` in radian,
    /// counter-clockwise seen from the tip of the normal.
    pub fn new(axis: DVec3, fallback: DVec3, rotation: f32) -> Self {
        Self {
            // In f32, as normals are: then a normal along the axis is parallel to it exactly.
            axis: axis.normalize().as_vec3().as_dvec3(),
            fallback: fallback.normalize(),
            sin_cos: rotation.sin_cos(),
        }
    }

    /// The frame around a unit normal.
    ///
    /// Products of f32 are exact in f64, so each component of the cross product rounds once: next to the axis,
    /// where it is small, it still has all its digits.
    #[inline]
    pub fn frame(&self, n: Vec3) -> Frame {
        let (s, t) = self.tangents(n.as_dvec3());
        let (s, t) = (s.as_vec3(), t.as_vec3());
        let (sin, cos) = self.sin_cos;
        Frame {
            s: s * cos + t * sin,
            t: t * cos - s * sin,
            n,
        }
    }

    /// Tangent, bitangent and normal of the frame around a unit normal in f64, for checks.
    pub fn wide_frame(&self, n: DVec3) -> [DVec3; 3] {
        let (s, t) = self.tangents(n);
        let (sin, cos) = (f64::from(self.sin_cos.0), f64::from(self.sin_cos.1));
        [s * cos + t * sin, t * cos - s * sin, n]
    }

    /// Across the axis, and across that, before the turn.
    #[inline(always)]
    fn tangents(&self, n: DVec3) -> (DVec3, DVec3) {
        let across = match self.axis.cross(n).try_normalize() {
            Some(across) => across,
            // What of the fallback is along the normal is taken off.
            None => (self.fallback - n * n.dot(self.fallback)).normalize(),
        };
        (across, n.cross(across))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash::{mix, unit_f32};

    fn is_frame(f: &Frame) -> bool {
        let ulps = 8.0 * f32::EPSILON;
        let pairs = [f.s.dot(f.t), f.s.dot(f.n), f.t.dot(f.n)];
        pairs.iter().all(|x| x.abs() < ulps)
            && (f.s.length() - 1.0).abs() < ulps
            && (f.s.cross(f.t) - f.n).length() < 2.0 * ulps
    }

    /// Everywhere on the sphere, and down to an ulp from the axis.
    #[test]
    fn the_frame_is_orthonormal_next_to_the_axis_too() {
        let axis = DVec3::new(0.3, 0.8, -0.2);
        for rotation in [0.0, 0.7, -3.0] {
            let brush = Brush::new(axis, DVec3::X, rotation);
            let pole = axis.normalize().as_vec3();
            assert!(is_frame(&brush.frame(pole)) && is_frame(&brush.frame(-pole)));
            for i in 0..5000u32 {
                let r = |k| 2.0 * unit_f32(mix(i, k)) - 1.0;
                let v = Vec3::new(r(0), r(1), r(2));
                let near = pole + v * 10f32.powf(4.0 * (r(3) - 1.0));
                for n in [v.normalize(), near.normalize()] {
                    assert!(is_frame(&brush.frame(n)), "{n} {:?}", brush.frame(n));
                }
            }
        }
    }

    /// On a rectangle the tangent is local +X, and the angle turns it towards local +Y.
    #[test]
    fn on_a_rectangle_the_tangent_is_its_x_axis() {
        let frame =
            |degrees: f32| Brush::new(DVec3::Y, DVec3::X, degrees.to_radians()).frame(Vec3::Z);
        assert_eq!(frame(0.0).s, Vec3::X);
        assert!((frame(90.0).s - Vec3::Y).length() < 1e-6);
        assert_eq!(
            Brush::new(DVec3::Y, DVec3::X, 0.0).frame(Vec3::Y).s,
            Vec3::X
        );
    }
}
