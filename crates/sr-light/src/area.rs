//! What lights with a surface share.

use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Frame, Real, gamma_of, vec3, warp};

/// Height of `p` over the plane through `on_plane` with unit normal `ng`, negative below it.
///
/// `None` in the plane, which here means nearer than the height's error. The sum itself errs by γ₅
/// of its absolute terms: one rounding in the difference, one in the product, two in the sum, one in
/// the normal. The point is where a ray has hit a surface, and off it by up to γ₁₆ of its
/// coordinates and the surface's extent. A point of the light itself is thus always in its plane;
/// seen edge on, the light gives nothing that sampling could find and a ray could not.
///
/// It does not depend on the point sampled, so that sampling and its density take the cosine at the
/// light, height over distance, from one and the same number.
#[inline]
pub fn height_over_plane<R: Real>(p: [R; 3], on_plane: [R; 3], ng: [R; 3]) -> Option<R> {
    let d = vec3::sub(p, on_plane);
    let height = vec3::dot(ng, d);
    let blur: [R; 3] = std::array::from_fn(|k| {
        let place = p[k].abs() + on_plane[k].abs() + d[k].abs();
        gamma_of::<R>(5) * d[k].abs() + gamma_of::<R>(16) * place
    });
    let error = vec3::dot(vec3::abs(ng), blur);
    (height.abs() > error).then_some(height)
}

/// Density per solid angle of a point chosen uniformly by area: `dist² / (cos θ · area)`.
///
/// 0 where that is not a number to divide by.
#[inline]
pub fn pdf_from_area<R: Real>(dist: R, cos_light: R, area: R) -> R {
    let pdf = dist * dist / (cos_light * area);
    if pdf.is_finite() { pdf } else { R::ZERO }
}

/// The sample for a point of a surface, given its density.
#[inline]
pub fn seen_from<R: Real>(
    reference: [R; 3],
    point: SurfacePoint<R>,
    radiance: Vec3,
    pdf: impl FnOnce([R; 3], R) -> R,
) -> Option<LightSampleOf<R>> {
    let d = vec3::sub(point.p, reference);
    let dist = vec3::length(d);
    let wi = vec3::div(d, dist);
    let pdf = pdf(wi, dist);
    // A distance of 0, or one whose square is no normal number, has no direction.
    (pdf > R::ZERO && dist * dist >= R::MIN_POSITIVE).then_some(LightSampleOf {
        wi,
        dist,
        radiance: vec3::lift(radiance),
        pdf,
        p: point.p,
        p_err: point.p_err,
        ng: point.ng,
        is_delta: false,
    })
}

/// A point on a light with the bound of its error.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<R> {
    pub p: [R; 3],
    pub p_err: [R; 3],
    pub ng: [R; 3],
}

/// What a surface of uniform radiance emits in a direction `w`, of any length.
#[inline]
pub fn emitted(radiance: Vec3, two_sided: bool, w: Vec3, ng: Vec3) -> Vec3 {
    if two_sided || w.dot(ng) > 0.0 {
        radiance
    } else {
        Vec3::ZERO
    }
}

/// A ray from a point chosen uniformly by area, cosine distributed around its normal; for two-sided
/// lights the first half of `u.x` takes the front.
#[inline]
pub fn emission(
    point: SurfacePoint<f32>,
    area: f32,
    radiance: Vec3,
    two_sided: bool,
    mut u: Vec2,
) -> Option<EmissionSample> {
    let mut side = 1.0;
    if two_sided {
        u.x *= 2.0;
        if u.x >= 1.0 {
            u.x -= 1.0;
            side = -1.0;
        }
    }
    let local = Vec3::from(warp::cosine_hemisphere(u.to_array()));
    let pdf = warp::cosine_hemisphere_pdf(local.z) * if two_sided { 0.5 } else { 1.0 };
    let pdf_pos = area.recip();
    let ng = Vec3::from(point.ng);
    (pdf > 0.0 && pdf_pos.is_finite()).then(|| EmissionSample {
        o: point.p.into(),
        o_err: point.p_err.into(),
        ng,
        d: Frame::from_normal(side * ng).to_world(local),
        radiance,
        pdf_pos,
        pdf_dir: pdf,
        is_delta_position: false,
        is_delta_direction: false,
    })
}
