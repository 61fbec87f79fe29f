//! A point that shines into a cone, as the glTF extension KHR_lights_punctual defines it.

use crate::point::sample_point;
use crate::{EmissionSample, LightSampleOf};
use glam::{Vec2, Vec3};
use sr_math::{Bounds3, Frame, Real, vec3};
use std::f32::consts::PI;

/// A spot light: full intensity within the inner cone, none outside the outer one.
///
/// Between them it falls with the square of `(cos θ − cos_outer) / max(0.001, cos_inner − cos_outer)`,
/// the falloff of the extension's text (section "Inner and Outer Cone Angles"). The floor of 0.001 is
/// part of that text: a spot whose two cones coincide keeps a narrow ramp inside.
#[derive(Clone, Copy, Debug)]
pub struct SpotLight {
    /// Where it is.
    pub p: Vec3,
    /// Unit vector from the light into the cone.
    pub axis: Vec3,
    /// Radiant intensity within the inner cone in W/sr.
    pub intensity: Vec3,
    /// Cosine of the half angle of the inner cone, at least `cos_outer`.
    pub cos_inner: f32,
    /// Cosine of the half angle of the outer cone.
    pub cos_outer: f32,
}

/// `∫ falloff dω / 2π`, the part on the ramp and the part above it.
struct Shares {
    /// Height of the ramp, in its own units, where the pole cuts it off; 1 if it does not.
    top: f32,
    ramp: f32,
    plateau: f32,
}

impl SpotLight {
    /// Width of the falloff in cos θ.
    #[inline]
    fn ramp<R: Real>(&self) -> R {
        (R::from_f32(self.cos_inner) - R::from_f32(self.cos_outer)).max(R::lit(0.001))
    }

    /// Share of the full intensity at an angle from the axis.
    #[inline]
    pub fn falloff<R: Real>(&self, cos_theta: R) -> R {
        let t = (cos_theta - R::from_f32(self.cos_outer)) / self.ramp();
        t.clamp_to(R::ZERO, R::ONE).sqr()
    }

    /// With t the height on the ramp, `∫ t² dcosθ = ramp · top³/3`; above it the falloff is 1.
    fn shares(&self) -> Shares {
        let room = 1.0 - self.cos_outer;
        let ramp: f32 = self.ramp();
        let top = (room / ramp).min(1.0);
        Shares {
            top,
            ramp: ramp * top.powi(3) / 3.0,
            plateau: (room - ramp).max(0.0),
        }
    }

    /// See [`crate::Light::sample_li_real`].
    #[inline]
    pub fn sample_li<R: Real>(&self, p: [R; 3]) -> Option<LightSampleOf<R>> {
        sample_point(self.p, p, |wi| {
            let share = self.falloff(-vec3::dot(wi, vec3::lift(self.axis)));
            vec3::scale(share, vec3::lift(self.intensity))
        })
    }

    /// See [`crate::Light::sample_le`]. Directions follow the falloff, so every ray carries the same.
    pub fn sample_le(&self, u_dir: Vec2) -> Option<EmissionSample> {
        let s = self.shares();
        let total = s.ramp + s.plateau;
        // 1 − cos θ, from the axis outward.
        let at = u_dir.x * total;
        let one_minus_cos = if at < s.plateau {
            at
        } else {
            let left = ((total - at) / s.ramp).clamp(0.0, 1.0);
            (1.0 - self.cos_outer) - self.ramp::<f32>() * s.top * left.cbrt()
        };
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
        let (sin_phi, cos_phi) = (2.0 * PI * u_dir.y).sin_cos();
        let falloff = self.falloff(1.0 - one_minus_cos);
        let local = Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - one_minus_cos);
        let d = Frame::from_normal(self.axis).to_world(local);
        let pdf_dir = falloff / (2.0 * PI * total);
        (pdf_dir > 0.0 && pdf_dir.is_finite()).then_some(EmissionSample {
            o: self.p,
            o_err: Vec3::ZERO,
            ng: d,
            d,
            radiance: self.intensity * falloff,
            pdf_pos: 1.0,
            pdf_dir,
            is_delta_position: true,
            is_delta_direction: false,
        })
    }

    /// `∫ intensity dω`, exactly.
    pub fn power(&self) -> Vec3 {
        let s = self.shares();
        2.0 * PI * (s.ramp + s.plateau) * self.intensity
    }

    /// The point itself.
    pub fn bounds(&self) -> Bounds3 {
        Bounds3::from_points([self.p])
    }
}
