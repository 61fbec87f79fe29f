//! What sampling a lobe gives, and what kinds of lobe there are.

use glam::Vec3;
use sr_math::Real;
use std::ops::BitOr;

/// What travels along the path from `wo`.
///
/// Refraction makes the difference: radiance is compressed by (η_i/η_t)² on its way into the less
/// dense side, importance is not (Veach 1997, section 5.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TransportMode {
    /// A path from the camera: `wi` brings radiance.
    Radiance,
    /// A path from a light: `wi` brings importance.
    Importance,
}

/// A set of kinds of scattering: a side, a width, or several of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LobeFlags(u8);

impl LobeFlags {
    /// To the side that `wo` is on.
    pub const REFLECTION: Self = Self(1);
    /// To the other side.
    pub const TRANSMISSION: Self = Self(2);
    /// Over the whole hemisphere, without a peak.
    pub const DIFFUSE: Self = Self(4);
    /// Around a peak of some width.
    pub const GLOSSY: Self = Self(8);
    /// Into one direction: `eval` and `pdf` do not see it.
    pub const DELTA: Self = Self(16);

    /// No kind at all.
    pub const fn empty() -> Self {
        Self(0)
    }

    /// The kinds of both; `|` in constants.
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// All kinds of `other` are in this set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Some kind is in both sets.
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Nothing but delta lobes: `eval` is 0 everywhere and light sampling is in vain. A set of a
    /// delta and a wider lobe is not delta.
    pub const fn is_delta(self) -> bool {
        self.contains(Self::DELTA) && !self.intersects(Self(Self::DIFFUSE.0 | Self::GLOSSY.0))
    }
}

impl BitOr for LobeFlags {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        self.with(other)
    }
}

/// A direction drawn from a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// The sampled direction: unit length, away from the surface, local frame.
    pub wi: Vec3,
    /// f·|cosθ|/pdf, which a path's throughput is multiplied with.
    pub weight: Vec3,
    /// Density per solid angle of all non-delta lobes together; for a delta lobe the probability
    /// with which it was chosen.
    pub pdf: f32,
    /// The lobe that was chosen: one side and one width.
    pub lobe: LobeFlags,
    /// η_t/η_i seen from `wo` if the sample crossed into another medium, else 1.
    pub eta: f32,
}

/// [`BsdfSample`] in the arithmetic of `R`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSampleOf<R> {
    /// The sampled direction.
    pub wi: [R; 3],
    /// f·|cosθ|/pdf.
    pub weight: [R; 3],
    /// Density, or probability of a delta lobe.
    pub pdf: R,
    /// The lobe that was chosen.
    pub lobe: LobeFlags,
    /// η_t/η_i seen from `wo` if the sample crossed into another medium, else 1.
    pub eta: R,
}

impl<R: Real> BsdfSampleOf<R> {
    /// The sample, unless its density is 0 or something in it is not finite.
    #[inline]
    pub(crate) fn checked(self) -> Option<Self> {
        let finite = |v: [R; 3]| v.iter().all(|x| x.is_finite());
        let finite = finite(self.weight) && finite(self.wi) && self.pdf.is_finite();
        (finite && self.pdf > R::ZERO).then_some(self)
    }
}

impl From<BsdfSampleOf<f32>> for BsdfSample {
    #[inline]
    fn from(s: BsdfSampleOf<f32>) -> Self {
        Self {
            wi: s.wi.into(),
            weight: s.weight.into(),
            pdf: s.pdf,
            lobe: s.lobe,
            eta: s.eta,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_pure_delta_set_is_delta() {
        let mirror = LobeFlags::REFLECTION | LobeFlags::DELTA;
        assert!(mirror.is_delta() && mirror.contains(LobeFlags::REFLECTION));
        assert!(!(mirror | LobeFlags::DIFFUSE).is_delta());
        assert!(!(mirror | LobeFlags::GLOSSY).is_delta());
        assert!(!LobeFlags::empty().is_delta() && !LobeFlags::REFLECTION.is_delta());
        assert!(!mirror.contains(LobeFlags::TRANSMISSION | LobeFlags::DELTA));
        assert!(mirror.intersects(LobeFlags::TRANSMISSION | LobeFlags::DELTA));
    }
}
