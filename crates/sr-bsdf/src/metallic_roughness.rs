//! The material of glTF 2.0, and thin transmission.

use crate::fresnel::{normal_reflectance, schlick};
use crate::local::{has_side, mirror, same_side, specular, strength};
use crate::microfacet::{Alpha, Facet, FacetLobe, Sampling, half_vector, is_smooth, reflect};
use crate::{BsdfSample, Lambert, LobeFlags, Mirror, Refraction, ggx};
use glam::{Vec2, Vec3};
use sr_math::warp::cosine_hemisphere;
use std::f32::consts::FRAC_1_PI;

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
struct Shares {
    diffuse: f32,
    specular: f32,
    transmitted: f32,
}

impl MetallicRoughness {
    fn alpha(&self) -> f32 {
        self.roughness * self.roughness
    }

    fn facets(&self) -> Alpha<f32> {
        Alpha::isotropic(self.alpha())
    }

    /// Reflectance of the dielectric, and of the whole specular lobe, at a cosine to the facet.
    fn fresnel(&self, cos: f32) -> (f32, Vec3) {
        let dielectric = schlick(cos, normal_reflectance(self.ior));
        let grazing = schlick(cos, 0.0);
        let metal = self.base_color + (Vec3::ONE - self.base_color) * grazing;
        (
            dielectric,
            Vec3::splat((1.0 - self.metallic) * dielectric) + self.metallic * metal,
        )
    }

    /// What the diffuse and the transmitting lobe have before their Fresnel factor.
    fn base(&self) -> (Vec3, Vec3) {
        let base = (1.0 - self.metallic) * self.base_color;
        ((1.0 - self.transmission) * base, self.transmission * base)
    }

    fn shares(&self, up: Vec3) -> Shares {
        let smooth = is_smooth(self.alpha());
        let facing = up.z
            + if smooth {
                0.0
            } else {
                ggx::cos_lambda(up.to_array(), self.facets())
            };
        let (dielectric, specular) = self.fresnel(facing);
        let (diffuse, transmitted) = self.base();
        let d = (1.0 - normal_reflectance(self.ior)) * strength(diffuse);
        let mut s = strength(specular);
        let mut t = (1.0 - dielectric) * strength(transmitted);
        let total = d + s + t;
        if !smooth {
            s = s.max(LEAST_SHARE * total);
            if strength(transmitted) > 0.0 {
                t = t.max(LEAST_SHARE * total);
            }
        }
        let sum = d + s + t;
        let scale = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        Shares {
            diffuse: d * scale,
            specular: s * scale,
            transmitted: t * scale,
        }
    }

    /// The facets' lobe of reflectance 1, for directions of the upper side.
    fn lobe(&self, wo: Vec3, wi: Vec3) -> (FacetLobe<f32>, f32) {
        let (h, cos) = half_vector(wo.to_array(), wi.to_array());
        let alpha = self.facets();
        let facet = Facet {
            d: ggx::d(h, alpha),
            cos_h: h[2],
            cos: [wo.z, wi.z],
            cos_lambda: [wo, wi].map(|w| ggx::cos_lambda(w.to_array(), alpha)),
        };
        (FacetLobe::reflected(facet, cos, Sampling::Visible), cos)
    }

    /// For `wo` and `wi` of the upper side.
    fn reflection(&self, wo: Vec3, wi: Vec3, shares: Shares) -> (Vec3, f32) {
        let cos = half_vector(wo.to_array(), wi.to_array()).1;
        let (dielectric, specular) = self.fresnel(cos);
        let mut f = self.base().0 * ((1.0 - dielectric) * FRAC_1_PI);
        let mut pdf = shares.diffuse * wi.z * FRAC_1_PI;
        if !is_smooth(self.alpha()) {
            let (lobe, _) = self.lobe(wo, wi);
            f += specular * lobe.value;
            pdf += shares.specular * lobe.pdf;
        }
        (f, pdf)
    }

    /// For `wo` of the upper side and `wi` mirrored there.
    fn transmission(&self, wo: Vec3, wi: Vec3, shares: Shares) -> (Vec3, f32) {
        if is_smooth(self.alpha()) || shares.transmitted == 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let (lobe, cos) = self.lobe(wo, wi);
        let f = self.base().1 * ((1.0 - self.fresnel(cos).0) * lobe.value);
        (f, shares.transmitted * lobe.pdf)
    }

    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Vec3, f32) {
        if let Some((wo, wi)) = same_side(wo, wi) {
            self.reflection(wo, wi, self.shares(wo))
        } else if let Some((wo, wi)) = same_side(wo, mirror(wi, true)) {
            self.transmission(wo, wi, self.shares(wo))
        } else {
            (Vec3::ZERO, 0.0)
        }
    }

    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        if !has_side(wo) {
            return None;
        }
        let below = wo.z < 0.0;
        let up = mirror(wo, below);
        let shares = self.shares(up);
        let through = uc >= shares.diffuse + shares.specular;
        if uc < shares.diffuse {
            let wi = Vec3::from(cosine_hemisphere(u.to_array()));
            return self.wide_sample(wo, mirror(wi, below), Lambert::FLAGS);
        }
        if is_smooth(self.alpha()) {
            return self.delta_sample(wo, through, shares);
        }
        let h = ggx::sample_vndf(up.to_array(), self.facets(), u.to_array());
        let wi = Vec3::from(reflect(up.to_array(), h));
        if wi.z <= 0.0 {
            return None;
        }
        let side = if through {
            LobeFlags::TRANSMISSION
        } else {
            LobeFlags::REFLECTION
        };
        self.wide_sample(wo, mirror(wi, below != through), side | LobeFlags::GLOSSY)
    }

    fn wide_sample(&self, wo: Vec3, wi: Vec3, lobe: LobeFlags) -> Option<BsdfSample> {
        let (f, pdf) = self.eval_pdf(wo, wi);
        BsdfSample {
            wi,
            weight: f * (wi.z.abs() / pdf),
            pdf,
            lobe,
            eta: 1.0,
        }
        .checked()
    }

    fn delta_sample(&self, wo: Vec3, through: bool, shares: Shares) -> Option<BsdfSample> {
        let (dielectric, specular_f) = self.fresnel(wo.z.abs());
        let (wi, f, pdf, lobe) = if through {
            let f = self.base().1 * (1.0 - dielectric);
            (-wo, f, shares.transmitted, Refraction::FLAGS)
        } else {
            (specular(wo), specular_f, shares.specular, Mirror::FLAGS)
        };
        BsdfSample {
            wi,
            weight: f / pdf,
            pdf,
            lobe,
            eta: 1.0,
        }
        .checked()
    }

    pub(crate) fn flags(&self) -> LobeFlags {
        let width = if is_smooth(self.alpha()) {
            LobeFlags::DELTA
        } else {
            LobeFlags::GLOSSY
        };
        let mut flags = LobeFlags::REFLECTION | width;
        let (diffuse, transmitted) = self.base();
        if strength(diffuse) > 0.0 {
            flags = flags | Lambert::FLAGS;
        }
        if strength(transmitted) > 0.0 {
            flags = flags | LobeFlags::TRANSMISSION;
        }
        flags
    }

    pub(crate) fn albedo(&self) -> Vec3 {
        let (dielectric, specular) = self.fresnel(1.0);
        let (diffuse, transmitted) = self.base();
        specular + (1.0 - dielectric) * (diffuse + transmitted)
    }
}
