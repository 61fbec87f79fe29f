//! The float type that a formula is written over.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// `f32` or `f64`: kernels run in the first, their oracle in the second.
///
/// Constants that appear in a formula go through [`Real::lit`], so that the `f64` instance gets
/// them unrounded.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + Send
    + Sync
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// π.
    const PI: Self;
    /// 1/π.
    const INV_PI: Self;
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// The largest number below 1.
    const ONE_MINUS_ULP: Self;
    /// The largest finite number.
    const MAX: Self;
    /// The smallest positive normal number.
    const MIN_POSITIVE: Self;
    /// Positive infinity.
    const INFINITY: Self;

    /// A literal of a formula.
    fn lit(x: f64) -> Self;
    /// From the type that kernels run in; exact.
    fn from_f32(x: f32) -> Self;
    /// To `f64`; exact.
    fn to_f64(self) -> f64;
    /// A parameter that follows from others: kernels take it as it was stored, rounded; the oracle
    /// derives it again, so that it knows nothing of that rounding.
    fn stored_or<T>(stored: impl FnOnce() -> T, derive: impl FnOnce() -> T) -> T;
    /// Square root.
    fn sqrt(self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The smaller of two numbers; the other one when one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers; the other one when one is NaN.
    fn max(self, other: Self) -> Self;
    /// The largest whole number that is not above `self`.
    fn floor(self) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Tangent.
    fn tan(self) -> Self;
    /// Arc cosine.
    fn acos(self) -> Self;
    /// Arc tangent of `self / x` in the quadrant of `(x, self)`.
    fn atan2(self, x: Self) -> Self;
    /// eˣ.
    fn exp(self) -> Self;
    /// eˣ − 1, accurate near 0.
    fn exp_m1(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// ln(1 + x), accurate near 0.
    fn ln_1p(self) -> Self;
    /// xʸ.
    fn powf(self, y: Self) -> Self;
    /// Magnitude of `self`, sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// `self · a + b`, rounded once.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// x².
    #[inline(always)]
    fn sqr(self) -> Self {
        self * self
    }

    /// √max(x, 0): for differences of squares that rounding may take below zero.
    #[inline(always)]
    fn safe_sqrt(self) -> Self {
        self.max(Self::ZERO).sqrt()
    }

    /// `self` in `[lo, hi]`.
    #[inline(always)]
    fn clamp_to(self, lo: Self, hi: Self) -> Self {
        self.max(lo).min(hi)
    }
}

macro_rules! impl_real {
    ($t:ident, $stored:ident) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const PI: Self = std::f64::consts::PI as $t;
            const INV_PI: Self = std::f64::consts::FRAC_1_PI as $t;
            const EPSILON: Self = $t::EPSILON;
            const ONE_MINUS_ULP: Self = 1.0 - $t::EPSILON / 2.0;
            const MAX: Self = $t::MAX;
            const MIN_POSITIVE: Self = $t::MIN_POSITIVE;
            const INFINITY: Self = $t::INFINITY;
            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn from_f32(x: f32) -> Self {
                x as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn stored_or<T>(stored: impl FnOnce() -> T, derive: impl FnOnce() -> T) -> T {
                impl_real!(@$stored stored derive)
            }
            impl_real!(@unary $t sqrt abs floor sin cos tan acos exp exp_m1 ln ln_1p);
            impl_real!(@binary $t min max atan2 powf copysign);
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                $t::mul_add(self, a, b)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $t::is_finite(self)
            }
        }
    };
    (@stored $stored:ident $derive:ident) => {{
        let _ = $derive;
        $stored()
    }};
    (@derived $stored:ident $derive:ident) => {{
        let _ = $stored;
        $derive()
    }};
    (@unary $t:ident $($f:ident)*) => {
        $(#[inline(always)] fn $f(self) -> Self { $t::$f(self) })*
    };
    (@binary $t:ident $($f:ident)*) => {
        $(#[inline(always)] fn $f(self, other: Self) -> Self { $t::$f(self, other) })*
    };
}

impl_real!(f32, stored);
impl_real!(f64, derived);
