//! What sampling a light returns.

use glam::Vec3;
use sr_math::Real;

/// Light that arrives at a reference point, if nothing is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction from the reference point to the light.
    pub wi: Vec3,
    /// Distance to the point on the light, infinite for infinite lights.
    pub dist: f32,
    /// What arrives along `−wi`: radiance; for a delta light irradiance perpendicular to `wi`
    /// (intensity over squared distance, or that of a directional light).
    pub radiance: Vec3,
    /// Density of `wi` per solid angle, positive and finite; 1 for delta lights.
    pub pdf: f32,
    /// The point on the light; unused for infinite lights.
    pub p: Vec3,
    /// Bounds, one for each component, of the distance of `p` from the true surface.
    pub p_err: Vec3,
    /// Geometric normal of the light at `p`; towards the reference point where there is no surface.
    pub ng: Vec3,
    /// No other way of sampling can find this light.
    pub is_delta: bool,
}

/// [`LightSample`] in the type that it was computed in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSampleOf<R> {
    /// See [`LightSample::wi`].
    pub wi: [R; 3],
    /// See [`LightSample::dist`].
    pub dist: R,
    /// See [`LightSample::radiance`].
    pub radiance: [R; 3],
    /// See [`LightSample::pdf`].
    pub pdf: R,
    /// See [`LightSample::p`].
    pub p: [R; 3],
    /// See [`LightSample::p_err`]: the bound of this type's rounding.
    pub p_err: [R; 3],
    /// See [`LightSample::ng`].
    pub ng: [R; 3],
    /// See [`LightSample::is_delta`].
    pub is_delta: bool,
}

impl<R: Real> LightSampleOf<R> {
    /// From infinitely far away.
    #[inline(always)]
    pub(crate) fn infinite(wi: [R; 3], radiance: [R; 3], pdf: R, is_delta: bool) -> Self {
        Self {
            wi,
            dist: R::INFINITY,
            radiance,
            pdf,
            p: [R::ZERO; 3],
            p_err: [R::ZERO; 3],
            ng: wi.map(|x| -x),
            is_delta,
        }
    }
}

impl From<LightSampleOf<f32>> for LightSample {
    #[inline(always)]
    fn from(s: LightSampleOf<f32>) -> Self {
        Self {
            wi: s.wi.into(),
            dist: s.dist,
            radiance: s.radiance.into(),
            pdf: s.pdf,
            p: s.p.into(),
            p_err: s.p_err.into(),
            ng: s.ng.into(),
            is_delta: s.is_delta,
        }
    }
}

/// A ray that leaves a light.
///
/// It carries `radiance · |ng · d| / (pdf_pos · pdf_dir)`: for every kind of light the mean of this
/// is the light's power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionSample {
    /// Origin.
    pub o: Vec3,
    /// Bounds, one for each component, of the distance of `o` from the true surface.
    pub o_err: Vec3,
    /// Geometric normal at the origin; the direction `d` itself where there is no surface.
    pub ng: Vec3,
    /// Unit direction of travel.
    pub d: Vec3,
    /// Radiance along the ray; intensity for point and spot lights, irradiance for directional ones.
    pub radiance: Vec3,
    /// Density of the origin per area; 1 for lights that are a point.
    pub pdf_pos: f32,
    /// Density of the direction per solid angle; 1 for directional lights.
    pub pdf_dir: f32,
    /// The light is a point: no path can hit it.
    pub is_delta_position: bool,
    /// The light has one direction: no path can find it.
    pub is_delta_direction: bool,
}
