//! Rough or polished metal.

use crate::color::Color;
use crate::fresnel::{fresnel_conductor, fresnel_conductor_approximate};
use crate::local::{has_side, mirror, same_side, specular, up};
use crate::microfacet::{FacetLobe, Sampling, half_vector, reflect};
use crate::missing_energy::{MissingEnergy, diffuse_mean};
use crate::{BsdfSampleOf, LobeFlags, Microsurface, Mirror};
use glam::Vec3;
use sr_math::Real;
use sr_math::warp::cosine_hemisphere;
use std::array::from_fn;
use std::sync::Arc;

/// Which reflectance a [`Conductor`] has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ConductorFresnel {
    /// Fresnel's equations with a complex index, for unpolarised light.
    #[default]
    Exact,
    /// The classic assignment's approximation for air against a metal of |η + ik|² ≫ 1.
    Approximate,
}

/// A metal of complex index η + ik with a rough surface (Cook and Torrance 1982; Walter et al. 2007):
/// height-correlated Smith shadowing, Fresnel at the half vector. Two-sided.
///
/// Light that hits a second facet is lost, as in every single-scattering model, unless the metal is
/// [compensated](Conductor::compensated). Below
/// [`SMOOTH_ALPHA`](crate::microfacet::SMOOTH_ALPHA) the lobe is a mirror with the Fresnel term.
#[derive(Clone, Debug, PartialEq)]
pub struct Conductor {
    eta: Vec3,
    k: Vec3,
    fresnel: ConductorFresnel,
    surface: Microsurface,
    compensation: Option<Arc<Compensation>>,
}

/// The lobe of light that has met several facets (Kulla and Conty 2017, "Revisiting Physically Based Shading
/// at Imageworks"): f = S·m(wo)·m(wi)/(π·M), which is reciprocal and returns S·m(wo).
#[derive(Debug, PartialEq)]
struct Compensation {
    /// m(w), what single scattering loses of white light.
    table: MissingEnergy,
    /// S: what is left after all further reflections, F²·Ē/(1 − F·(1 − Ē)), F the mean Fresnel term and Ē = 1 − M.
    survives: Vec3,
    /// F, which single scattering is weighted with in the choice between the two lobes.
    reflectance: f32,
}

/// Value, density and weight of one direction.
struct Terms<R> {
    f: Color<R>,
    pdf: R,
    weight: Color<R>,
}

impl Conductor {
    /// A metal that scatters once; the index `eta` + i`k` by colour, relative to the outside, not negative.
    pub fn new(eta: Vec3, k: Vec3, fresnel: ConductorFresnel, surface: Microsurface) -> Self {
        Self {
            eta,
            k,
            fresnel,
            surface,
            compensation: None,
        }
    }

    /// The same metal with what single scattering loses given back: a white one loses nothing, up to the
    /// accuracy of a table (some 10⁻³). Takes milliseconds.
    pub fn compensated(mut self) -> Self {
        if self.surface.is_smooth() {
            return self;
        }
        let surface = self.surface.sampled(Sampling::Visible);
        let table = MissingEnergy::new(surface.alpha(), |wo, u| {
            let wi = reflect(wo, surface.sample_normal(wo, u));
            if wi[2] <= 0.0 {
                return 0.0;
            }
            let (h, cos) = half_vector(wo, wi);
            FacetLobe::reflected(surface.facet(wo, wi, h), cos, Sampling::Visible).weight
        });
        let mean = diffuse_mean(|cos| self.fresnel_at(cos));
        let lost = table.average::<f32>();
        let survives = mean * mean * (1.0 - lost) / (Color::WHITE - mean * lost);
        self.compensation = Some(Arc::new(Compensation {
            survives: survives.narrow(),
            reflectance: mean.strength(),
            table,
        }));
        self
    }

    /// The facets.
    pub fn surface(&self) -> &Microsurface {
        &self.surface
    }

    pub(crate) fn flags(&self) -> LobeFlags {
        if self.surface.is_smooth() {
            Mirror::FLAGS
        } else {
            LobeFlags::REFLECTION | LobeFlags::GLOSSY
        }
    }

    fn fresnel_at<R: Real>(&self, cos: R) -> Color<R> {
        let [eta, k] = [self.eta, self.k].map(|v| Color::lift(v).0);
        Color(from_fn(|c| match self.fresnel {
            ConductorFresnel::Exact => fresnel_conductor(cos, eta[c], k[c]),
            ConductorFresnel::Approximate => fresnel_conductor_approximate(cos, eta[c], k[c]),
        }))
    }

    /// For directions of the upper side.
    fn terms<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> Terms<R> {
        let sampling = self.surface.sampling();
        let (h, cos) = half_vector(wo, wi);
        let lobe = FacetLobe::reflected(self.surface.facet(wo, wi, h), cos, sampling);
        let fresnel = self.fresnel_at(cos);
        let single = fresnel * lobe.value;
        let Some(c) = &self.compensation else {
            return Terms {
                f: single,
                pdf: lobe.pdf,
                weight: fresnel * lobe.weight,
            };
        };
        let f = single + c.value(wo, wi);
        let pdf = if sampling == Sampling::Cosine {
            lobe.pdf
        } else {
            let share = c.share(wo);
            share * c.table.pdf(wi) + (R::ONE - share) * lobe.pdf
        };
        Terms {
            f,
            pdf,
            weight: f * (wi[2] / pdf),
        }
    }

    pub(crate) fn eval_pdf<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (Color<R>, R) {
        match same_side(wo, wi) {
            Some((wo, wi)) if !self.surface.is_smooth() => {
                let terms = self.terms(wo, wi);
                (terms.f, terms.pdf)
            }
            _ => (Color::BLACK, R::ZERO),
        }
    }

    /// A direction for `wo` of the upper side, possibly below the horizon.
    fn direction<R: Real>(&self, wo: [R; 3], uc: R, u: [R; 2]) -> Option<[R; 3]> {
        if self.surface.sampling() == Sampling::Cosine {
            return Some(cosine_hemisphere(u));
        }
        match &self.compensation {
            Some(c) if uc < c.share(wo) => c.table.sample(u),
            _ => Some(reflect(wo, self.surface.sample_normal(wo, u))),
        }
    }

    pub(crate) fn sample<R: Real>(&self, wo: [R; 3], uc: R, u: [R; 2]) -> Option<BsdfSampleOf<R>> {
        if !has_side(wo) {
            return None;
        }
        let below = wo[2] < R::ZERO;
        let up = mirror(wo, below);
        let (wi, weight, pdf) = if self.surface.is_smooth() {
            (specular(up), self.fresnel_at(up[2]), R::ONE)
        } else {
            let (up, wi) = same_side(up, self.direction(up, uc, u)?)?;
            let terms = self.terms(up, wi);
            (wi, terms.weight, terms.pdf)
        };
        BsdfSampleOf {
            wi: mirror(wi, below),
            weight: weight.0,
            pdf,
            lobe: self.flags(),
            eta: R::ONE,
        }
        .checked()
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let single = self.fresnel_at(1.0).narrow();
        match &self.compensation {
            None => single,
            Some(c) => {
                let lost = c.table.missing::<f32>(up());
                single * (1.0 - lost) + c.survives * lost
            }
        }
    }
}

impl Compensation {
    fn value<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> Color<R> {
        // The table may be all zeros, and then so is M.
        let average = self.table.average::<R>().max(R::MIN_POSITIVE);
        let joint = self.table.missing(wo) * (self.table.missing(wi) / average);
        Color::lift(self.survives) * (joint * R::INV_PI)
    }

    /// Probability of the lobe, by its share of the energy.
    fn share<R: Real>(&self, wo: [R; 3]) -> R {
        let lost = self.table.missing(wo);
        let several = lost * Color::lift(self.survives).strength();
        let single = (R::ONE - lost) * R::from_f32(self.reflectance);
        several / (several + single).max(R::MIN_POSITIVE)
    }
}
