//! The closed enum of all lobes.

use crate::color::Color;
use crate::{
    BsdfSample, BsdfSampleOf, Conductor, Dielectric, Lambert, LobeFlags, MetallicRoughness, Mirror,
    OrenNayar, Refraction, RoughDielectric, ThinDielectric, TransportMode,
};
use glam::{Vec2, Vec3};
use sr_math::Real;

/// How a surface scatters light.
///
/// `wo` and `wi` are unit vectors of the local frame, away from the surface; `wo` belongs to the path
/// that is being extended. No parameter in the documented range, no direction and no random number makes
/// a result that is not finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Bsdf {
    /// Ideal diffuse reflection.
    Lambert(Lambert),
    /// Ideal mirror.
    Mirror(Mirror),
    /// Ideal refraction, nothing reflected.
    Refraction(Refraction),
    /// Smooth interface of two dielectrics.
    Dielectric(Dielectric),
    /// Thin plate of glass.
    ThinDielectric(ThinDielectric),
    /// Metal, rough or polished.
    Conductor(Conductor),
    /// Rough interface of two dielectrics.
    RoughDielectric(RoughDielectric),
    /// Rough diffuse reflection.
    OrenNayar(OrenNayar),
    /// The material of glTF.
    MetallicRoughness(MetallicRoughness),
}

impl Bsdf {
    /// f(wo, wi) without the cosine, in 1/sr; delta lobes do not count.
    ///
    /// The two modes differ where light is refracted: with η = η_t/η_i seen from `wo`, radiance has 1/η² of
    /// what importance has, and f(wo, wi) of either mode is f(wi, wo) of the other.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> Vec3 {
        self.eval_pdf(wo, wi, mode).0
    }

    /// Density per solid angle with which [`Bsdf::sample`] gives `wi` from a non-delta lobe. Its
    /// integral falls short of 1 by the probability of the delta lobes and of failed samples.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.eval_pdf(wo, wi, TransportMode::Radiance).1
    }

    /// [`Bsdf::eval`] and [`Bsdf::pdf`] at once; the same bits.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Vec3, f32) {
        let (f, pdf) = self.eval_pdf_real(wo.to_array(), wi.to_array(), mode);
        (f.into(), pdf)
    }

    /// [`Bsdf::eval_pdf`] in the arithmetic of `R`: the one source of both. In `f64` it is the oracle of `f32`, at the
    /// parameters as they are, and with the tables of compensation as they are.
    #[inline]
    pub fn eval_pdf_real<R: Real>(
        &self,
        wo: [R; 3],
        wi: [R; 3],
        mode: TransportMode,
    ) -> ([R; 3], R) {
        let (f, pdf) = match self {
            Self::Lambert(b) => b.eval_pdf(wo, wi),
            Self::Conductor(b) => b.eval_pdf(wo, wi),
            Self::RoughDielectric(b) => b.eval_pdf(wo, wi, mode),
            Self::OrenNayar(b) => b.eval_pdf(wo, wi),
            Self::MetallicRoughness(b) => b.eval_pdf(wo, wi),
            Self::Mirror(_)
            | Self::Refraction(_)
            | Self::Dielectric(_)
            | Self::ThinDielectric(_) => (Color::BLACK, R::ZERO),
        };
        (f.0, pdf)
    }

    /// Draws `wi`; `uc` chooses the lobe and `u` the direction within it, all in `[0, 1)`.
    ///
    /// `None` when the lobe absorbs the sample: it fell below the horizon, its density is 0, or `wo` is
    /// tangent. That is part of the estimate, not a failure.
    #[inline]
    pub fn sample(&self, wo: Vec3, uc: f32, u: Vec2, mode: TransportMode) -> Option<BsdfSample> {
        self.sample_real(wo.to_array(), uc, u.to_array(), mode)
            .map(BsdfSample::from)
    }

    /// [`Bsdf::sample`] in the arithmetic of `R`. With the same numbers in a wider type it is the same sample,
    /// unless it falls on an edge between two lobes, or on the horizon.
    #[inline]
    pub fn sample_real<R: Real>(
        &self,
        wo: [R; 3],
        uc: R,
        u: [R; 2],
        mode: TransportMode,
    ) -> Option<BsdfSampleOf<R>> {
        match self {
            Self::Lambert(b) => b.sample(wo, u),
            Self::Mirror(b) => b.sample(wo),
            Self::Refraction(b) => b.sample(wo, mode),
            Self::Dielectric(b) => b.sample(wo, uc, mode),
            Self::ThinDielectric(b) => b.sample(wo, uc),
            Self::Conductor(b) => b.sample(wo, uc, u),
            Self::RoughDielectric(b) => b.sample(wo, uc, u, mode),
            Self::OrenNayar(b) => b.sample(wo, uc, u),
            Self::MetallicRoughness(b) => b.sample(wo, uc, u),
        }
    }

    /// The angle in radian by which an anisotropic lobe wants its frame turned about the normal; `None` when
    /// any frame will do.
    pub fn brush(&self) -> Option<f32> {
        match self {
            Self::Conductor(b) => b.surface().brush(),
            Self::RoughDielectric(b) => b.surface().brush(),
            _ => None,
        }
    }

    /// Every kind of lobe that the parameters leave.
    pub fn flags(&self) -> LobeFlags {
        match self {
            Self::Lambert(_) => Lambert::FLAGS,
            Self::Mirror(_) => Mirror::FLAGS,
            Self::Refraction(_) => Refraction::FLAGS,
            Self::Dielectric(_) => Dielectric::FLAGS,
            Self::ThinDielectric(_) => ThinDielectric::FLAGS,
            Self::Conductor(b) => b.flags(),
            Self::RoughDielectric(b) => b.flags(),
            Self::OrenNayar(_) => OrenNayar::FLAGS,
            Self::MetallicRoughness(b) => b.flags(),
        }
    }

    /// Directional-hemispherical albedo at normal incidence, reflection and transmission together, for
    /// the albedo channel of a picture.
    ///
    /// Exact for smooth lobes (counted as energy, without radiance's (η_i/η_t)²) and for diffuse ones; for glossy
    /// ones the Fresnel factors are taken at normal incidence and what shadowing loses is left in, so it is
    /// too large: by less than 0.03 up to α = 0.2, by up to 0.4 at 0.7, and more beyond.
    pub fn albedo(&self) -> Vec3 {
        match self {
            Self::Lambert(b) => b.reflectance,
            Self::Mirror(b) => b.reflectance,
            Self::Refraction(b) => b.transmittance,
            Self::Dielectric(b) => b.albedo(),
            Self::ThinDielectric(b) => b.albedo(),
            Self::Conductor(b) => b.albedo(),
            Self::RoughDielectric(b) => b.albedo(),
            Self::OrenNayar(b) => b.albedo(),
            Self::MetallicRoughness(b) => b.albedo(),
        }
    }
}
