//! The local frame: sides, tangent directions, mirroring.

use sr_math::Real;

/// The direction has a side: its squared cosine is a normal number. False for NaN.
#[inline(always)]
pub(crate) fn has_side<R: Real>(w: [R; 3]) -> bool {
    w[2] * w[2] >= R::MIN_POSITIVE
}

/// Mirrors at the tangent plane if `below`.
#[inline(always)]
pub(crate) fn mirror<R: Real>(w: [R; 3], below: bool) -> [R; 3] {
    [w[0], w[1], if below { -w[2] } else { w[2] }]
}

/// The specular direction of `wo`; exact.
#[inline(always)]
pub(crate) fn specular<R: Real>(wo: [R; 3]) -> [R; 3] {
    [-wo[0], -wo[1], wo[2]]
}

/// The normal, as a direction.
#[inline(always)]
pub(crate) fn up<R: Real>() -> [R; 3] {
    [R::ZERO, R::ZERO, R::ONE]
}

/// `wo` and `wi` mirrored to the upper side, if they are on the same one.
#[inline(always)]
pub(crate) fn same_side<R: Real>(wo: [R; 3], wi: [R; 3]) -> Option<([R; 3], [R; 3])> {
    let below = wo[2] < R::ZERO;
    let (wo, wi) = (mirror(wo, below), mirror(wi, below));
    (has_side(wo) && has_side(wi) && wi[2] > R::ZERO).then_some((wo, wi))
}
