//! Angles as pairs of cosine and sine: their differences need no inverse function.

/// An angle from 0 to π.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Angle {
    pub cos: f32,
    pub sin: f32,
}

impl Angle {
    pub const ZERO: Self = Self { cos: 1.0, sin: 0.0 };
    pub const STRAIGHT: Self = Self {
        cos: -1.0,
        sin: 0.0,
    };

    /// Rounded from radians.
    pub fn from_radians(angle: f64) -> Self {
        if angle >= std::f64::consts::PI {
            return Self::STRAIGHT;
        }
        Self {
            cos: angle.cos() as f32,
            sin: angle.sin() as f32,
        }
    }

    /// `self − other`, or 0 where `other` is larger.
    ///
    /// The sign of the sine decides: near 0 the cosine cannot tell angles apart that differ by less
    /// than 3·10⁻⁴. A sine below 0 may belong to a difference near −π, which is 0 here, or by rounding
    /// to one near π; the cosines tell these.
    #[inline]
    pub fn minus(self, other: Self) -> Self {
        let cos = self.cos * other.cos + self.sin * other.sin;
        let sin = self.sin * other.cos - self.cos * other.sin;
        if sin > 0.0 {
            Self { cos, sin }
        } else if cos > 0.0 || self.cos > other.cos {
            Self::ZERO
        } else {
            Self::STRAIGHT
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To 8 roundings of 2⁻²⁴: the error of the inputs, of two products and of a sum.
    #[test]
    fn differences_are_those_of_radians() {
        let angles: Vec<f64> = (0..=400)
            .map(|k| f64::from(k) * std::f64::consts::PI / 400.0)
            .chain((0..20).map(|k| 10f64.powi(-k)))
            .collect();
        for &a in &angles {
            for &b in &angles {
                let got = Angle::from_radians(a).minus(Angle::from_radians(b));
                let want = (a - b).max(0.0);
                let error = (f64::from(got.cos) - want.cos())
                    .abs()
                    .max((f64::from(got.sin) - want.sin()).abs());
                assert!(error <= 4.0 * f64::from(f32::EPSILON), "{a} {b}: {got:?}");
            }
        }
    }
}
