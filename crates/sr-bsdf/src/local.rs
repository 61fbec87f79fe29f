//! The local frame: sides, tangent directions, mirroring.

use glam::Vec3;

/// The direction has a side: its squared cosine is a normal number. False for NaN.
#[inline(always)]
pub(crate) fn has_side(w: Vec3) -> bool {
    w.z * w.z >= f32::MIN_POSITIVE
}

/// Mirrors at the tangent plane if `below`.
#[inline(always)]
pub(crate) fn mirror(w: Vec3, below: bool) -> Vec3 {
    Vec3::new(w.x, w.y, if below { -w.z } else { w.z })
}

/// The specular direction of `wo`; exact.
#[inline(always)]
pub(crate) fn specular(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// `wo` and `wi` mirrored to the upper side, if they are on the same one.
#[inline(always)]
pub(crate) fn same_side(wo: Vec3, wi: Vec3) -> Option<(Vec3, Vec3)> {
    let below = wo.z < 0.0;
    let (wo, wi) = (mirror(wo, below), mirror(wi, below));
    (has_side(wo) && has_side(wi) && wi.z > 0.0).then_some((wo, wi))
}

/// The largest component of a colour: what lobes are chosen by, since it keeps every component of
/// the weight at or below 1.
#[inline(always)]
pub(crate) fn strength(color: Vec3) -> f32 {
    color.max_element().max(0.0)
}
