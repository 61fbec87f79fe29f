//! Orthonormal frames around a direction.

use crate::Real;
use glam::Vec3;

/// Two unit vectors `(s, t)` that make a right-handed orthonormal basis with the unit vector `n`.
///
/// Branchless and continuous except across `n.z = 0`: Duff, Burgess, Christensen, Hery, Kensler,
/// Liani, Villemin 2017, "Building an Orthonormal Basis, Revisited", listing 3.
#[inline]
pub fn orthonormal_basis<R: Real>(n: [R; 3]) -> ([R; 3], [R; 3]) {
    let [x, y, z] = n;
    let sign = R::ONE.copysign(z);
    let a = -R::ONE / (sign + z);
    let b = x * y * a;
    (
        [R::ONE + sign * x * x * a, sign * b, -sign * x],
        [b, sign + y * y * a, -y],
    )
}

/// A vector of the frame that [`orthonormal_basis`] puts around the unit vector `n`, in world
/// coordinates: [`Frame::to_world`] for either type.
#[inline]
pub fn to_world<R: Real>(n: [R; 3], [x, y, z]: [R; 3]) -> [R; 3] {
    let (s, t) = orthonormal_basis(n);
    std::array::from_fn(|k| s[k] * x + t[k] * y + n[k] * z)
}

/// A right-handed orthonormal frame; local +Z is `n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// World direction of local +X.
    pub s: Vec3,
    /// World direction of local +Y.
    pub t: Vec3,
    /// World direction of local +Z.
    pub n: Vec3,
}

impl Frame {
    /// The frame around a unit normal, its tangent wherever it falls.
    #[inline]
    pub fn from_normal(n: Vec3) -> Self {
        let (s, t) = orthonormal_basis(n.to_array());
        Self {
            s: s.into(),
            t: t.into(),
            n,
        }
    }

    /// World to local.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// Local to world.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basis_is_orthonormal_and_right_handed() {
        // 3 roundings a component: a few ulp of 1.
        let bound = 4.0 * f64::from(f32::EPSILON);
        for i in 0..20_000u32 {
            let u = crate::hash::unit_f32(crate::hash::mix(i, 1));
            let v = crate::hash::unit_f32(crate::hash::mix(i, 2));
            let z = 1.0 - 2.0 * u;
            let r = (1.0 - z * z).max(0.0).sqrt();
            let phi = 2.0 * std::f32::consts::PI * v;
            let f = Frame::from_normal(Vec3::new(r * phi.cos(), r * phi.sin(), z).normalize());
            let (s, t, n) = (f.s.as_dvec3(), f.t.as_dvec3(), f.n.as_dvec3());
            for e in [
                s.dot(t),
                s.dot(n),
                t.dot(n),
                s.length() - 1.0,
                t.length() - 1.0,
            ] {
                assert!(e.abs() < bound, "{n:?}: {e}");
            }
            assert!((s.cross(t) - n).length() < 2.0 * bound);
            let v = Vec3::new(0.3 - u, v, z * z);
            let world = to_world(f.n.to_array(), v.to_array());
            assert_eq!(Vec3::from(world), f.to_world(v));
        }
    }

    #[test]
    fn poles_are_no_exception() {
        for z in [1.0, -1.0] {
            let f = Frame::from_normal(Vec3::new(0.0, 0.0, z));
            assert!(f.s.is_finite() && f.t.is_finite());
            assert_eq!(f.s.cross(f.t), f.n);
        }
    }
}
