//! The material of glTF 2.0, and thin transmission.

use crate::color::Color;
use crate::fresnel::{normal_reflectance, schlick};
use crate::local::{has_side, mirror, same_side, specular};
use crate::microfacet::{Alpha, Facet, FacetLobe, Sampling, half_vector, is_smooth, reflect};
use crate::{BsdfSampleOf, Lambert, LobeFlags, Mirror, Refraction, ggx};
use glam::Vec3;
use sr_math::Real;
use sr_math::vec3::neg;
use sr_math::warp::cosine_hemisphere;

/// The metallic-roughness material of the glTF 2.0 specification, appendix B, two-sided, with
/// `KHR_materials_ior` and `KHR_materials_transmission` (thin-walled: nothing bends).
///
/// With m = metallic, t = transmission, c = base colour, S the GGX reflection lobe of reflectance 1 and
/// S' the same lobe mirrored through the surface:
///
///   f = (1 − m)·(mix((1 − F_d)·c/π, (1 − F_d)·c·S', t) + F_d·S) + m·F_c·S
///
/// F is Schlick's at the half vector, R₀ = ((ior − 1)/(ior + 1))² for F_d and c for F_c. Where the
/// specification leaves a choice: shadowing is height-correlated. Where it is not physical it is
/// followed: the diffuse layer is weighted by 1 − F at the half vector, which is reciprocal but gives
/// more energy than it should at grazing: a white dielectric of roughness 0 returns 1.00 at normal incidence,
/// 1.55 at cosθ_o = 0.1 and 1.89 at 0.01; of roughness 0.5, 1.00, 1.11 and 1.15. The bound is
/// 1 + (1 − m)(1 − t)(1 − R₀)·max c. Metal and clear transmission gain nothing.
///
/// Sampling mixes the cosine, visible normals, and visible normals mirrored. The weights are
/// (1 − m)(1 − R₀)(1 − t)·max c for the first, max F for the second and (1 − m)(1 − F_d)·t·max c for the
/// third, F at cosθ_o·(1 + Λ_o), about the mean cosine to a visible normal; a rough lobe gets at
/// least 1/32 of the sum. Below [`SMOOTH_ALPHA`](crate::microfacet::SMOOTH_ALPHA) S and S' are delta
/// lobes, with F at cosθ_o, and `pdf` integrates to the probability of the diffuse lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// Albedo of the dielectric's diffuse layer, tint of its transmission, reflectance of the metal at
    /// normal incidence; by colour, in [0, 1].
    pub base_color: Vec3,
    /// 0 for a dielectric, 1 for a metal, a mixture between.
    pub metallic: f32,
    /// Perceptual roughness in [0, 1]; α is its square.
    pub roughness: f32,
    /// Index of refraction of the dielectric, positive; 1.5 (R₀ = 0.04) by default in glTF.
    pub ior: f32,
    /// Share of the diffuse layer that passes straight through, in [0, 1].
    pub transmission: f32,
}

/// What a rough lobe gets at least of the samples: the estimate of its share may be too low, by less
/// than this leaves weights unbounded.
const LEAST_SHARE: f32 = 1.0 / 32.0;

/// Probabilities of the three lobes; they sum to 1, or are all 0 for a black material.
#[derive(Clone, Copy)]
struct Shares<R> {
    diffuse: R,
    specular: R,
    transmitted: R,
}

impl MetallicRoughness {
    /// Decided in `f32`, in whatever arithmetic the lobe is computed.
    fn is_smooth(&self) -> bool {
        is_smooth(self.roughness * self.roughness)
    }

    fn facets<R: Real>(&self) -> Alpha<R> {
        Alpha::isotropic(R::from_f32(self.roughness).sqr())
    }

    /// Reflectance of the dielectric at normal incidence.
    fn r0<R: Real>(&self) -> R {
        normal_reflectance(R::from_f32(self.ior))
    }

    /// Reflectance of the dielectric, and of the whole specular lobe, at a cosine to the facet.
    fn fresnel<R: Real>(&self, cos: R) -> (R, Color<R>) {
        let (base, metallic) = (Color::lift(self.base_color), R::from_f32(self.metallic));
        let dielectric = schlick(cos, self.r0());
        let grazing = schlick(cos, R::ZERO);
        let metal = base + (Color::WHITE - base) * grazing;
        (
            dielectric,
            Color::splat((R::ONE - metallic) * dielectric) + metal * metallic,
        )
    }

    /// What the diffuse and the transmitting lobe have before their Fresnel factor.
    fn base<R: Real>(&self) -> (Color<R>, Color<R>) {
        let transmission = R::from_f32(self.transmission);
        let base = Color::lift(self.base_color) * (R::ONE - R::from_f32(self.metallic));
        (base * (R::ONE - transmission), base * transmission)
    }

    fn shares<R: Real>(&self, up: [R; 3]) -> Shares<R> {
        let smooth = self.is_smooth();
        let facing = up[2]
            + if smooth {
                R::ZERO
            } else {
                ggx::cos_lambda(up, self.facets())
            };
        let (dielectric, specular) = self.fresnel(facing);
        let (diffuse, transmitted) = self.base();
        let d = (R::ONE - self.r0()) * diffuse.strength();
        let mut s = specular.strength();
        let mut t = (R::ONE - dielectric) * transmitted.strength();
        let total = d + s + t;
        if !smooth {
            let least = R::from_f32(LEAST_SHARE) * total;
            s = s.max(least);
            if transmitted.strength() > R::ZERO {
                t = t.max(least);
            }
        }
        let sum = d + s + t;
        let scale = if sum > R::ZERO { R::ONE / sum } else { R::ZERO };
        Shares {
            diffuse: d * scale,
            specular: s * scale,
            transmitted: t * scale,
        }
    }

    /// The facets' lobe of reflectance 1, for directions of the upper side.
    fn lobe<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (FacetLobe<R>, R) {
        let (h, cos) = half_vector(wo, wi);
        let alpha = self.facets();
        let facet = Facet {
            d: ggx::d(h, alpha),
            cos_h: h[2],
            cos: [wo[2], wi[2]],
            cos_lambda: [wo, wi].map(|w| ggx::cos_lambda(w, alpha)),
        };
        (FacetLobe::reflected(facet, cos, Sampling::Visible), cos)
    }

    /// For `wo` and `wi` of the upper side.
    fn reflection<R: Real>(&self, wo: [R; 3], wi: [R; 3], shares: Shares<R>) -> (Color<R>, R) {
        let cos = half_vector(wo, wi).1;
        let (dielectric, specular) = self.fresnel(cos);
        let mut f = self.base().0 * ((R::ONE - dielectric) * R::INV_PI);
        let mut pdf = shares.diffuse * wi[2] * R::INV_PI;
        if !self.is_smooth() {
            let (lobe, _) = self.lobe(wo, wi);
            f = f + specular * lobe.value;
            pdf += shares.specular * lobe.pdf;
        }
        (f, pdf)
    }

    /// For `wo` of the upper side and `wi` mirrored there.
    fn transmission<R: Real>(&self, wo: [R; 3], wi: [R; 3], shares: Shares<R>) -> (Color<R>, R) {
        if self.is_smooth() || shares.transmitted == R::ZERO {
            return (Color::BLACK, R::ZERO);
        }
        let (lobe, cos) = self.lobe(wo, wi);
        let f = self.base().1 * ((R::ONE - self.fresnel(cos).0) * lobe.value);
        (f, shares.transmitted * lobe.pdf)
    }

    pub(crate) fn eval_pdf<R: Real>(&self, wo: [R; 3], wi: [R; 3]) -> (Color<R>, R) {
        if let Some((wo, wi)) = same_side(wo, wi) {
            self.reflection(wo, wi, self.shares(wo))
        } else if let Some((wo, wi)) = same_side(wo, mirror(wi, true)) {
            self.transmission(wo, wi, self.shares(wo))
        } else {
            (Color::BLACK, R::ZERO)
        }
    }

    pub(crate) fn sample<R: Real>(&self, wo: [R; 3], uc: R, u: [R; 2]) -> Option<BsdfSampleOf<R>> {
        if !has_side(wo) {
            return None;
        }
        let below = wo[2] < R::ZERO;
        let up = mirror(wo, below);
        let shares = self.shares(up);
        let through = uc >= shares.diffuse + shares.specular;
        if uc < shares.diffuse {
            let wi = cosine_hemisphere(u);
            return self.wide_sample(wo, mirror(wi, below), Lambert::FLAGS);
        }
        if self.is_smooth() {
            return self.delta_sample(wo, through, shares);
        }
        let h = ggx::sample_vndf(up, self.facets(), u);
        let wi = reflect(up, h);
        if wi[2] <= R::ZERO {
            return None;
        }
        let side = if through {
            LobeFlags::TRANSMISSION
        } else {
            LobeFlags::REFLECTION
        };
        self.wide_sample(wo, mirror(wi, below != through), side | LobeFlags::GLOSSY)
    }

    fn wide_sample<R: Real>(
        &self,
        wo: [R; 3],
        wi: [R; 3],
        lobe: LobeFlags,
    ) -> Option<BsdfSampleOf<R>> {
        let (f, pdf) = self.eval_pdf(wo, wi);
        BsdfSampleOf {
            wi,
            weight: (f * (wi[2].abs() / pdf)).0,
            pdf,
            lobe,
            eta: R::ONE,
        }
        .checked()
    }

    fn delta_sample<R: Real>(
        &self,
        wo: [R; 3],
        through: bool,
        shares: Shares<R>,
    ) -> Option<BsdfSampleOf<R>> {
        let (dielectric, specular_f) = self.fresnel(wo[2].abs());
        let (wi, f, pdf, lobe) = if through {
            let f = self.base().1 * (R::ONE - dielectric);
            (neg(wo), f, shares.transmitted, Refraction::FLAGS)
        } else {
            (specular(wo), specular_f, shares.specular, Mirror::FLAGS)
        };
        BsdfSampleOf {
            wi,
            weight: (f / pdf).0,
            pdf,
            lobe,
            eta: R::ONE,
        }
        .checked()
    }

    pub(crate) fn flags(&self) -> LobeFlags {
        let width = if self.is_smooth() {
            LobeFlags::DELTA
        } else {
            LobeFlags::GLOSSY
        };
        let mut flags = LobeFlags::REFLECTION | width;
        let (diffuse, transmitted) = self.base::<f32>();
        if diffuse.strength() > 0.0 {
            flags = flags | Lambert::FLAGS;
        }
        if transmitted.strength() > 0.0 {
            flags = flags | LobeFlags::TRANSMISSION;
        }
        flags
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let (dielectric, specular) = self.fresnel(1.0f32);
        let (diffuse, transmitted) = self.base();
        (specular + (diffuse + transmitted) * (1.0 - dielectric)).narrow()
    }
}
