//! Colours in the arithmetic of a formula.

use glam::Vec3;
use sr_math::Real;
use std::array::from_fn;
use std::ops::{Add, Div, Mul, Sub};

/// Three numbers by colour: what `Vec3` is to `f32`, in the same order of operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Color<R>(pub [R; 3]);

impl<R: Real> Color<R> {
    /// 0.
    pub const BLACK: Self = Self([R::ZERO; 3]);
    /// 1.
    pub const WHITE: Self = Self([R::ONE; 3]);

    /// A parameter, exact.
    #[inline(always)]
    pub fn lift(color: Vec3) -> Self {
        Self(color.to_array().map(R::from_f32))
    }

    /// The same number for every colour.
    #[inline(always)]
    pub fn splat(x: R) -> Self {
        Self([x; 3])
    }

    /// The largest component, and not below 0: what lobes are chosen by, since it keeps every component of
    /// the weight at or below 1.
    #[inline(always)]
    pub fn strength(self) -> R {
        let larger = |a: R, b: R| if a > b { a } else { b };
        let [r, g, b] = self.0;
        larger(larger(r, g), b).max(R::ZERO)
    }
}

impl Color<f32> {
    /// As the vector that the rest of the renderer has.
    #[inline(always)]
    pub fn narrow(self) -> Vec3 {
        Vec3::from(self.0)
    }
}

impl<R: Real> Add for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(from_fn(|c| self.0[c] + other.0[c]))
    }
}

impl<R: Real> Sub for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|c| self.0[c] - other.0[c]))
    }
}

impl<R: Real> Mul for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(from_fn(|c| self.0[c] * other.0[c]))
    }
}

impl<R: Real> Mul<R> for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, scale: R) -> Self {
        Self(self.0.map(|x| x * scale))
    }
}

impl<R: Real> Div for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(from_fn(|c| self.0[c] / other.0[c]))
    }
}

impl<R: Real> Div<R> for Color<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, scale: R) -> Self {
        Self(self.0.map(|x| x / scale))
    }
}
