//! What the microfacet lobes share: half vectors, the reflected value and density, the smooth limit.
//!
//! Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs". The terms
//! are combined as cosθ·Λ rather than Λ, which is infinite at grazing where the product is finite.

use sr_math::Real;

/// Roughness below which a lobe is replaced by its delta limit.
///
/// An `f32` direction is known to about 6·10⁻⁸, a lobe is α·cosθ wide (in its narrower direction), so D errs
/// by some 6·10⁻⁸/(α·cosθ): 10⁻³ here when not grazing, and growing below. (Weights do not: D cancels.) The error of the replacement is of the order of α itself, in angle
/// and in albedo: 10⁻⁴ radian is a tenth of a millimetre at one metre. In terms of glTF's
/// roughness = √α the threshold is 0.01.
pub const SMOOTH_ALPHA: f32 = 1e-4;

/// Roughness of a surface along its two tangents.
///
/// Kept as one roughness and a ratio: times 1 and by 1 is exact, so that an isotropic surface has the same
/// bits as formulas of one α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alpha<R> {
    /// α along local X: root mean square slope times √2 for Beckmann; positive.
    pub x: R,
    /// α_y/α_x.
    pub ratio: R,
}

impl<R: Real> Alpha<R> {
    /// The same in every direction.
    #[inline(always)]
    pub fn isotropic(alpha: R) -> Self {
        Self {
            x: alpha,
            ratio: R::ONE,
        }
    }

    /// α along local X and along local Y.
    #[inline]
    pub fn new(x: R, y: R) -> Self {
        let ratio = if x == y { R::ONE } else { y / x };
        Self { x, ratio }
    }

    /// A parameter in the arithmetic of `R`, exact.
    #[inline(always)]
    pub(crate) fn lift(alpha: Alpha<f32>) -> Self {
        Self {
            x: R::from_f32(alpha.x),
            ratio: R::from_f32(alpha.ratio),
        }
    }

    /// α along local Y.
    #[inline]
    pub fn y(self) -> R {
        self.x * self.ratio
    }

    /// (α_x·x, α_y·y): slopes of the surface of unit roughness become those of this one.
    #[inline(always)]
    pub(crate) fn stretch(self, [x, y]: [R; 2]) -> [R; 2] {
        [self.x * x, self.x * (self.ratio * y)]
    }

    /// √((α_x·x)² + (α_y·y)²): α seen along `w`, times its sine.
    #[inline(always)]
    pub(crate) fn spread(self, w: [R; 3]) -> R {
        self.x * (w[0].sqr() + (self.ratio * w[1]).sqr()).sqrt()
    }
}

/// The lobe of this roughness counts as smooth; so does NaN.
#[inline(always)]
pub fn is_smooth(alpha: f32) -> bool {
    alpha < SMOOTH_ALPHA || alpha.is_nan()
}

/// The half vector of two directions of the upper side, and the cosine between it and either.
///
/// The cosine is |wo + wi|/2, which keeps its relative accuracy when both graze in opposite directions.
#[inline]
pub fn half_vector<R: Real>(wo: [R; 3], wi: [R; 3]) -> ([R; 3], R) {
    let sum = [wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]];
    let length = (sum[0].sqr() + sum[1].sqr() + sum[2].sqr()).sqrt();
    let h = sum.map(|x| x / length);
    (h, (R::lit(0.5) * length).min(R::ONE))
}

/// `wo` reflected at the facet of normal `h`.
#[inline]
pub fn reflect<R: Real>(wo: [R; 3], h: [R; 3]) -> [R; 3] {
    let twice = R::lit(2.0) * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]);
    [
        twice * h[0] - wo[0],
        twice * h[1] - wo[1],
        twice * h[2] - wo[2],
    ]
}

/// Which normals the directions of a rough lobe are sampled by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sampling {
    /// Those that `wo` sees (Heitz and d'Eon 2014): weights are G₂/G₁, at most 1.
    #[default]
    Visible,
    /// All, by their density D·cosθ (Walter et al. 2007), as in the classic assignment. Some samples
    /// fall below the horizon, and at grazing weights are large.
    Ndf,
    /// None: by the cosine of `wi`, as for a diffuse surface. What the others are measured against.
    Cosine,
}

/// Where a lobe stands: what its value, density and weight are made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet<R> {
    /// D at the half vector.
    pub d: R,
    /// cosθ of the half vector.
    pub cos_h: R,
    /// |cosθ| of `wo` and of `wi`.
    pub cos: [R; 2],
    /// cosθ·Λ of `wo` and of `wi`.
    pub cos_lambda: [R; 2],
}

impl<R: Real> Facet<R> {
    /// cosθ_o·(1 + Λ_o): the area of facets that `wo` sees.
    #[inline(always)]
    fn visible(&self) -> R {
        self.cos[0] + self.cos_lambda[0]
    }

    /// cosθ_o·cosθ_i/G₂, G₂ = 1/(1 + Λ_o + Λ_i): height-correlated.
    #[inline(always)]
    fn joint(&self) -> R {
        self.visible() * self.cos[1] + self.cos[0] * self.cos_lambda[1]
    }

    /// Density of `wi` by its cosine.
    #[inline(always)]
    fn cosine_pdf(&self) -> R {
        self.cos[1] * R::INV_PI
    }
}

/// A lobe of facets that scatter all that they get one way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacetLobe<R> {
    /// f(wo, wi).
    pub value: R,
    /// Density per solid angle of `wi` under the sampling.
    pub pdf: R,
    /// value·cosθ_i/pdf, from which D has cancelled where normals are sampled.
    pub weight: R,
}

impl<R: Real> FacetLobe<R> {
    /// Reflection: D·G₂/(4 cosθ_o cosθ_i) (Walter et al. 2007, eq. 20), at a facet that `wo` meets with the
    /// cosine `seen`. The density of visible normals is D/(4 cosθ_o (1 + Λ_o)) in `wi`.
    #[inline(always)]
    pub fn reflected(facet: Facet<R>, seen: R, sampling: Sampling) -> Self {
        let four = R::lit(4.0);
        let (visible, joint) = (facet.visible(), facet.joint());
        let value = facet.d / (four * joint);
        let (pdf, weight) = match sampling {
            Sampling::Visible => (facet.d / (four * visible), visible * facet.cos[1] / joint),
            Sampling::Ndf => (
                facet.d * facet.cos_h / (four * seen),
                seen / facet.cos_h * (facet.cos[1] / joint),
            ),
            Sampling::Cosine => (facet.cosine_pdf(), value * R::PI),
        };
        Self { value, pdf, weight }
    }

    /// Transmission, importance transported (Walter et al. 2007, eq. 21 and 17): the facet meets `wo` with
    /// the cosine `seen.0` and `wi` with −`seen.1`, and `length` is |wo + η wi|.
    ///
    /// Masking is taken as height-correlated on both sides of the surface, G₂ = 1/(1 + Λ_o + Λ_i).
    #[inline(always)]
    pub fn refracted(facet: Facet<R>, seen: (R, R), eta: R, length: R, sampling: Sampling) -> Self {
        // dω_h/dω_i.
        let jacobian = (eta / length).sqr() * seen.1;
        let (visible, joint) = (facet.visible(), facet.joint());
        let value = facet.d * seen.0 * jacobian / joint;
        let (pdf, weight) = match sampling {
            Sampling::Visible => (
                facet.d * seen.0 * jacobian / visible,
                visible * facet.cos[1] / joint,
            ),
            Sampling::Ndf => (
                facet.d * facet.cos_h * jacobian,
                seen.0 / facet.cos_h * (facet.cos[1] / joint),
            ),
            Sampling::Cosine => (facet.cosine_pdf(), value * R::PI),
        };
        Self { value, pdf, weight }
    }
}

/// The normal that a slope belongs to: (−x, −y, 1), normalised.
#[inline]
pub(crate) fn normal_of_slope<R: Real>([x, y]: [R; 2]) -> [R; 3] {
    let z = R::ONE / (R::ONE + x * x + y * y).sqrt();
    [-x * z, -y * z, z]
}

/// A uniform number away from the ends of the interval by half of what the type resolves there: an end
/// stands for the interval that was rounded to it, and has no finite slope of its own.
#[inline]
pub(crate) fn open<R: Real>(u: R) -> R {
    // ε/4 is half the 2⁻²⁴ between the numbers that samplers give in f32.
    u.clamp_to(R::lit(0.25) * R::EPSILON, R::ONE_MINUS_ULP)
}
