//! A rough interface between two dielectrics.

use crate::color::Color;
use crate::dielectric::{choose, relative_ior};
use crate::fresnel::fresnel_dielectric;
use crate::interface_loss::InterfaceLoss;
use crate::local::{has_side, mirror, up};
use crate::microfacet::{FacetLobe, SMOOTH_ALPHA, Sampling, half_vector, reflect};
use crate::refract::radiance_scale;
use crate::{
    BsdfSampleOf, Dielectric, FresnelKind, LobeFlags, Microsurface, TransportMode, refract,
};
use glam::Vec3;
use sr_math::Real;
use sr_math::vec3::{add, dot, length, scale};
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
struct Terms<R> {
    f: Color<R>,
    pdf: R,
    weight: Color<R>,
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

    /// Of reflection and of passage.
    fn tints<R: Real>(&self) -> [Color<R>; 2] {
        [self.reflectance, self.transmittance].map(Color::lift)
    }

    /// Probabilities of reflection and passage at a facet.
    fn chances<R: Real>(&self, fresnel: R) -> (R, R) {
        if self.surface.sampling() == Sampling::Cosine {
            return (R::lit(0.5), R::lit(0.5));
        }
        let [reflectance, transmittance] = self.tints();
        choose((fresnel, reflectance), (R::ONE - fresnel, transmittance))
    }

    /// Single scattering for `wo` of the upper side; `None` when no facet leads from one to the other.
    fn single<R: Real>(&self, wo: [R; 3], wi: [R; 3], eta: R) -> Option<Terms<R>> {
        let sampling = self.surface.sampling();
        let [reflectance, transmittance] = self.tints();
        let (tint, share, lobe) = if wi[2] > R::ZERO {
            let (h, seen) = half_vector(wo, wi);
            let fresnel = fresnel_dielectric(seen, eta);
            let lobe = FacetLobe::reflected(self.surface.facet(wo, wi, h), seen, sampling);
            let chance = self.chances(fresnel).0;
            (reflectance, (fresnel, chance), lobe)
        } else {
            let sum = add(wo, scale(eta, wi));
            let length = length(sum);
            let h = scale(R::ONE.copysign(sum[2]) / length, sum);
            let seen = (dot(wo, h), -dot(wi, h));
            if !(seen.0 > R::ZERO && seen.1 > R::ZERO) {
                return None;
            }
            let fresnel = fresnel_dielectric(seen.0, eta);
            let facet = self.surface.facet(wo, wi, h);
            let lobe = FacetLobe::refracted(facet, seen, eta, length, sampling);
            let chance = self.chances(fresnel).1;
            (transmittance, (R::ONE - fresnel, chance), lobe)
        };
        let (energy, chance) = share;
        if chance == R::ZERO {
            return None;
        }
        Some(Terms {
            f: tint * (energy * lobe.value),
            pdf: chance * lobe.pdf,
            weight: tint * (energy / chance * lobe.weight),
        })
    }

    /// What single scattering brings back of a sample `u`, reflection and passage together.
    fn single_albedo(&self, wo: [f32; 3], u: [f32; 2], eta: f32) -> f32 {
        let h = self.surface.sample_normal(wo, u);
        let seen = dot(wo, h);
        let fresnel = fresnel_dielectric(seen, eta);
        let weight = |wi: [f32; 3]| {
            let facet = self.surface.facet(wo, wi, h);
            // G₂/G₁ is the same for both.
            FacetLobe::reflected(facet, seen, Sampling::Visible).weight
        };
        let up = reflect(wo, h);
        let mut sum = 0.0;
        if up[2] > 0.0 {
            sum += fresnel * weight(up);
        }
        if let Some(down) = refract(wo, h, eta)
            && down[2] < 0.0
        {
            sum += (1.0 - fresnel) * weight(down);
        }
        sum
    }

    /// All scattering, importance transported, for `wo` of the upper side.
    fn terms<R: Real>(&self, wo: [R; 3], wi: [R; 3], eta: R) -> Option<Terms<R>> {
        let single = self.single(wo, wi, eta);
        let Some(c) = &self.compensation else {
            return single;
        };
        let (single_f, single_pdf) = single.map_or((Color::BLACK, R::ZERO), |s| (s.f, s.pdf));
        let several = c.lobe(wo, wi, eta, self.tints());
        let pdf = if self.surface.sampling() == Sampling::Cosine {
            R::lit(0.5) * wi[2].abs() * R::INV_PI
        } else {
            several.share * several.pdf + (R::ONE - several.share) * single_pdf
        };
        let f = single_f + several.f;
        Some(Terms {
            f,
            pdf,
            weight: f * (wi[2].abs() / pdf),
        })
    }

    pub(crate) fn eval_pdf<R: Real>(
        &self,
        wo: [R; 3],
        wi: [R; 3],
        mode: TransportMode,
    ) -> (Color<R>, R) {
        let dark = (Color::BLACK, R::ZERO);
        let Some(eta) = relative_ior(wo, self.ior) else {
            return dark;
        };
        if self.surface.is_smooth() || !has_side(wi) {
            return dark;
        }
        let below = wo[2] < R::ZERO;
        let (up, wi) = (mirror(wo, below), mirror(wi, below));
        self.terms(up, wi, eta)
            .map_or(dark, |t| (t.f * transport(wi, eta, mode), t.pdf))
    }

    /// A direction for `wo` of the upper side.
    fn direction<R: Real>(&self, wo: [R; 3], uc: R, u: [R; 2], eta: R) -> Option<[R; 3]> {
        if self.surface.sampling() == Sampling::Cosine {
            return Some(mirror(cosine_hemisphere(u), uc >= R::lit(0.5)));
        }
        let mut uc = uc;
        if let Some(c) = &self.compensation {
            let tints = self.tints();
            let share = c.share(wo, eta, tints);
            if uc < share {
                return c.sample(uc / share, u, eta, tints);
            }
            uc = (uc - share) / (R::ONE - share);
        }
        let h = self.surface.sample_normal(wo, u);
        let seen = dot(wo, h);
        if seen <= R::ZERO {
            return None;
        }
        let (reflection, _) = self.chances(fresnel_dielectric(seen, eta));
        if uc < reflection {
            let wi = reflect(wo, h);
            return (wi[2] > R::ZERO).then_some(wi);
        }
        let wi = refract(wo, h, eta)?;
        (wi[2] < R::ZERO).then_some(wi)
    }

    pub(crate) fn sample<R: Real>(
        &self,
        wo: [R; 3],
        uc: R,
        u: [R; 2],
        mode: TransportMode,
    ) -> Option<BsdfSampleOf<R>> {
        if self.surface.is_smooth() {
            return self.smooth().sample(wo, uc, mode);
        }
        let eta = relative_ior(wo, self.ior)?;
        let below = wo[2] < R::ZERO;
        let up = mirror(wo, below);
        let wi = self.direction(up, uc, u, eta).filter(|wi| has_side(*wi))?;
        let terms = self.terms(up, wi, eta)?;
        let (side, eta_crossed) = if wi[2] > R::ZERO {
            (LobeFlags::REFLECTION, R::ONE)
        } else {
            (LobeFlags::TRANSMISSION, eta)
        };
        BsdfSampleOf {
            wi: mirror(wi, below),
            weight: (terms.weight * transport(wi, eta, mode)).0,
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
                let (lost, returned) = c.albedo::<f32>(up(), self.ior, self.tints());
                single * (1.0 - lost) + returned.narrow()
            }
        }
    }
}

/// What radiance is scaled by on a passage, (η_i/η_t)².
#[inline(always)]
fn transport<R: Real>(wi: [R; 3], eta: R, mode: TransportMode) -> R {
    match mode {
        TransportMode::Radiance if wi[2] < R::ZERO => radiance_scale(eta),
        _ => R::ONE,
    }
}
