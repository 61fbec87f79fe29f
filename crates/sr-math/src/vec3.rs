//! Vectors as plain arrays, for formulas that are generic over [`Real`].
//!
//! Operations round in the order in which glam's do, so that a kernel gives the same bits in
//! either notation.

use crate::Real;
use glam::Vec3;

/// From the type that kernels run in; exact.
#[inline(always)]
pub fn lift<R: Real>(v: Vec3) -> [R; 3] {
    v.to_array().map(R::from_f32)
}

/// `a + b`.
#[inline(always)]
pub fn add<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a − b`.
#[inline(always)]
pub fn sub<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `s · v`.
#[inline(always)]
pub fn scale<R: Real>(s: R, v: [R; 3]) -> [R; 3] {
    v.map(|x| s * x)
}

/// `v / s`, each component divided.
#[inline(always)]
pub fn div<R: Real>(v: [R; 3], s: R) -> [R; 3] {
    v.map(|x| x / s)
}

/// The product of each component with its counterpart.
#[inline(always)]
pub fn mul<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// `−v`.
#[inline(always)]
pub fn neg<R: Real>(v: [R; 3]) -> [R; 3] {
    v.map(|x| -x)
}

/// The magnitude of each component.
#[inline(always)]
pub fn abs<R: Real>(v: [R; 3]) -> [R; 3] {
    v.map(R::abs)
}

/// `a · b`.
#[inline(always)]
pub fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// |v|².
#[inline(always)]
pub fn length_squared<R: Real>(v: [R; 3]) -> R {
    dot(v, v)
}

/// |v|.
#[inline(always)]
pub fn length<R: Real>(v: [R; 3]) -> R {
    dot(v, v).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit_f32};

    #[test]
    fn bits_are_those_of_glam() {
        for i in 0..10_000u32 {
            let h = |k| (2.0 * unit_f32(mix(i, k)) - 1.0) * 10f32.powi((i % 21) as i32 - 10);
            let (a, b, s) = (
                Vec3::new(h(0), h(1), h(2)),
                Vec3::new(h(3), h(4), h(5)),
                h(6),
            );
            let (x, y) = (lift::<f32>(a), lift(b));
            assert_eq!(Vec3::from(add(x, y)), a + b);
            assert_eq!(Vec3::from(sub(x, y)), a - b);
            assert_eq!(Vec3::from(mul(x, y)), a * b);
            assert_eq!(Vec3::from(scale(s, x)), s * a);
            assert_eq!(Vec3::from(div(x, s)), a / s);
            assert_eq!(Vec3::from(neg(x)), -a);
            assert_eq!(Vec3::from(abs(x)), a.abs());
            assert_eq!(dot(x, y), a.dot(b));
            assert_eq!(length(x), a.length());
            assert_eq!(length_squared(x), a.length_squared());
        }
    }
}
