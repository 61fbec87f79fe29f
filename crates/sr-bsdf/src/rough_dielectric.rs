//! A rough interface between two dielectrics.

use crate::dielectric::{choose, relative_ior};
use crate::fresnel::fresnel_dielectric;
use crate::interface_loss::InterfaceLoss;
use crate::local::{has_side, mirror};
use crate::microfacet::{FacetLobe, SMOOTH_ALPHA, Sampling, half_vector, reflect};
use crate::{BsdfSample, Dielectric, FresnelKind, LobeFlags, Microsurface, TransportMode, refract};
use glam::{Vec2, Vec3};
use sr_math::warp::cosine_hemisphere;
use std::sync::Arc;

/// What α·|1 − 1/η| must be at least for a refracted lobe to be more than a delta.
///
/// The half vector of a refraction is wo + η·wi, of length about |η − 1|: an `f32` direction errs by 6·10⁻⁸, so D
/// errs by some 10⁻⁷/(α·|η − 1|), which is 1 % here.
const NARROWEST: f32 = 1e-5;

/// Frosted glass: a rough surface that reflects and refracts (Walter, Marschner, Li and Torrance 2007). +Z is
/// outside.
///
/// Exact Fresnel at the facet; height-correlated Smith masking, also between the two sides. Which of the two a
/// facet does is chosen as in [`Dielectric`]. Where the surface is too smooth for `f32`, below
/// [`SMOOTH_ALPHA`](crate::microfacet::SMOOTH_ALPHA) or below 10⁻⁵/|1 − 1/η|, it is that lobe: an index of 1 is
/// always passed straight.
///
/// Light that meets a second facet is lost, unless the interface is [compensated](RoughDielectric::compensated).
#[derive(Clone, Debug, PartialEq)]
pub struct RoughDielectric {
    ior: f32,
    reflectance: Vec3,
    transmittance: Vec3,
    surface: Microsurface,
    compensation: Option<Arc<InterfaceLoss>>,
}

/// Value in importance mode, density and weight of one direction.
struct Terms {
    f: Vec3,
    pdf: f32,
    weight: Vec3,
}

impl RoughDielectric {
    /// `ior` inside over outside, positive; tints of each reflection and each passage, in [0, 1].
    pub fn new(ior: f32, reflectance: Vec3, transmittance: Vec3, surface: Microsurface) -> Self {
        // The same for η and 1/η.
        let contrast = (ior - 1.0).abs() / ior.max(1.0);
        let surface = surface.at_least(SMOOTH_ALPHA.max(NARROWEST / contrast));
        Self {
            ior,
            reflectance,
            transmittance,
            surface,
            compensation: None,
        }
    }

    /// The same interface with what single scattering loses given back: a clear one loses nothing, up to the
    /// accuracy of a table (some 10⁻³). Takes milliseconds.
    pub fn compensated(mut self) -> Self {
        if !self.surface.is_smooth() {
            let white = Self {
                reflectance: Vec3::ONE,
                transmittance: Vec3::ONE,
                surface: self.surface.sampled(Sampling::Visible),
                ..self
            };
            let loss = InterfaceLoss::new(self.surface.alpha(), self.ior, |wo, u, eta| {
                white.single_albedo(wo, u, eta)
            });
            self.compensation = Some(Arc::new(loss));
        }
        self
    }

    /// The facets.
    pub fn surface(&self) -> &Microsurface {
        &self.surface
    }

    /// Index inside over outside.
    pub fn ior(&self) -> f32 {
        self.ior
    }

    pub(crate) fn flags(&self) -> LobeFlags {
        if self.surface.is_smooth() {
            Dielectric::FLAGS
        } else {
            LobeFlags::REFLECTION | LobeFlags::TRANSMISSION | LobeFlags::GLOSSY
        }
    }

    fn smooth(&self) -> Dielectric {
        Dielectric {
            ior: self.ior,
            reflectance: self.reflectance,
            transmittance: self.transmittance,
            fresnel: FresnelKind::Exact,
        }
    }

    /// Probabilities of reflection and passage at a facet.
    fn chances(&self, fresnel: f32) -> (f32, f32) {
        if self.surface.sampling() == Sampling::Cosine {
            return (0.5, 0.5);
        }
        choose(
            (fresnel, self.reflectance),
            (1.0 - fresnel, self.transmittance),
        )
    }

    /// Single scattering for `wo` of the upper side; `None` when no facet leads from one to the other.
    fn single(&self, wo: Vec3, wi: Vec3, eta: f32) -> Option<Terms> {
        let sampling = self.surface.sampling();
        let (tint, share, lobe) = if wi.z > 0.0 {
            let (h, seen) = half_vector(wo.to_array(), wi.to_array());
            let fresnel = fresnel_dielectric(seen, eta);
            let lobe = FacetLobe::reflected(self.surface.facet(wo, wi, h), seen, sampling);
            let chance = self.chances(fresnel).0;
            (self.reflectance, (fresnel, chance), lobe)
        } else {
            let sum = wo + eta * wi;
            let length = sum.length();
            let h = sum * (1.0_f32.copysign(sum.z) / length);
            let seen = (wo.dot(h), -wi.dot(h));
            if !(seen.0 > 0.0 && seen.1 > 0.0) {
                return None;
            }
            let fresnel = fresnel_dielectric(seen.0, eta);
            let facet = self.surface.facet(wo, wi, h.to_array());
            let lobe = FacetLobe::refracted(facet, seen, eta, length, sampling);
            let chance = self.chances(fresnel).1;
            (self.transmittance, (1.0 - fresnel, chance), lobe)
        };
        let (energy, chance) = share;
        if chance == 0.0 {
            return None;
        }
        Some(Terms {
            f: tint * (energy * lobe.value),
            pdf: chance * lobe.pdf,
            weight: tint * (energy / chance * lobe.weight),
        })
    }

    /// What single scattering brings back of a sample `u`, reflection and passage together.
    fn single_albedo(&self, wo: Vec3, u: Vec2, eta: f32) -> f32 {
        let h = self.surface.sample_normal(wo, u);
        let seen = wo.dot(Vec3::from(h));
        let fresnel = fresnel_dielectric(seen, eta);
        let weight = |wi: Vec3| {
            let facet = self.surface.facet(wo, wi, h);
            // G₂/G₁ is the same for both.
            FacetLobe::reflected(facet, seen, Sampling::Visible).weight
        };
        let up = Vec3::from(reflect(wo.to_array(), h));
        let mut sum = 0.0;
        if up.z > 0.0 {
            sum += fresnel * weight(up);
        }
        if let Some(down) = refract(wo.to_array(), h, eta).map(Vec3::from)
            && down.z < 0.0
        {
            sum += (1.0 - fresnel) * weight(down);
        }
        sum
    }

    /// All scattering, importance transported, for `wo` of the upper side.
    fn terms(&self, wo: Vec3, wi: Vec3, eta: f32) -> Option<Terms> {
        let single = self.single(wo, wi, eta);
        let Some(c) = &self.compensation else {
            return single;
        };
        let (single_f, single_pdf) = single.map_or((Vec3::ZERO, 0.0), |s| (s.f, s.pdf));
        let tints = (self.reflectance, self.transmittance);
        let several = c.lobe(wo, wi, eta, tints);
        let pdf = if self.surface.sampling() == Sampling::Cosine {
            0.5 * wi.z.abs() * std::f32::consts::FRAC_1_PI
        } else {
            several.share * several.pdf + (1.0 - several.share) * single_pdf
        };
        let f = single_f + several.f;
        Some(Terms {
            f,
            pdf,
            weight: f * (wi.z.abs() / pdf),
        })
    }

    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Vec3, f32) {
        let dark = (Vec3::ZERO, 0.0);
        let Some(eta) = relative_ior(wo, self.ior) else {
            return dark;
        };
        if self.surface.is_smooth() || !has_side(wi) {
            return dark;
        }
        let below = wo.z < 0.0;
        let (up, wi) = (mirror(wo, below), mirror(wi, below));
        self.terms(up, wi, eta)
            .map_or(dark, |t| (t.f * transport(wi, eta, mode), t.pdf))
    }

    /// A direction for `wo` of the upper side.
    fn direction(&self, wo: Vec3, uc: f32, u: Vec2, eta: f32) -> Option<Vec3> {
        if self.surface.sampling() == Sampling::Cosine {
            let wi = Vec3::from(cosine_hemisphere(u.to_array()));
            return Some(mirror(wi, uc >= 0.5));
        }
        let mut uc = uc;
        if let Some(c) = &self.compensation {
            let tints = (self.reflectance, self.transmittance);
            let share = c.share(wo, eta, tints);
            if uc < share {
                return c.sample(uc / share, u, eta, tints);
            }
            uc = (uc - share) / (1.0 - share);
        }
        let h = self.surface.sample_normal(wo, u);
        let seen = wo.dot(Vec3::from(h));
        if seen <= 0.0 {
            return None;
        }
        let (reflection, _) = self.chances(fresnel_dielectric(seen, eta));
        if uc < reflection {
            let wi = Vec3::from(reflect(wo.to_array(), h));
            return (wi.z > 0.0).then_some(wi);
        }
        let wi = Vec3::from(refract(wo.to_array(), h, eta)?);
        (wi.z < 0.0).then_some(wi)
    }

    pub(crate) fn sample(
        &self,
        wo: Vec3,
        uc: f32,
        u: Vec2,
        mode: TransportMode,
    ) -> Option<BsdfSample> {
        if self.surface.is_smooth() {
            return self.smooth().sample(wo, uc, mode);
        }
        let eta = relative_ior(wo, self.ior)?;
        let below = wo.z < 0.0;
        let up = mirror(wo, below);
        let wi = self.direction(up, uc, u, eta).filter(|wi| has_side(*wi))?;
        let terms = self.terms(up, wi, eta)?;
        let (side, eta_crossed) = if wi.z > 0.0 {
            (LobeFlags::REFLECTION, 1.0)
        } else {
            (LobeFlags::TRANSMISSION, eta)
        };
        BsdfSample {
            wi: mirror(wi, below),
            weight: terms.weight * transport(wi, eta, mode),
            pdf: terms.pdf,
            lobe: side | LobeFlags::GLOSSY,
            eta: eta_crossed,
        }
        .checked()
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let single = self.smooth().albedo();
        match &self.compensation {
            None => single,
            Some(c) => {
                let tints = (self.reflectance, self.transmittance);
                let (lost, returned) = c.albedo(Vec3::Z, self.ior, tints);
                single * (1.0 - lost) + returned
            }
        }
    }
}

/// What radiance is scaled by on a passage, (η_i/η_t)².
#[inline(always)]
fn transport(wi: Vec3, eta: f32, mode: TransportMode) -> f32 {
    match mode {
        TransportMode::Radiance if wi.z < 0.0 => 1.0 / (eta * eta),
        _ => 1.0,
    }
}
