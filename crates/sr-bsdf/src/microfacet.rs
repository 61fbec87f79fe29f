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

/// The reflecting lobe of reflectance 1.
#[derive(Clone, Copy, Debug)]
pub struct Reflected<R> {
    /// D·G₂/(4 cosθ_o cosθ_i), G₂ = 1/(1 + Λ_o + Λ_i) with height-correlated masking and shadowing.
    pub value: R,
    /// Density per solid angle of reflecting `wo` at a visible normal: D/(4 cosθ_o (1 + Λ_o)).
    pub pdf: R,
    /// value·cosθ_i/pdf = G₂/G₁, from which D has cancelled.
    pub weight: R,
}

impl<R: Real> Reflected<R> {
    /// From D at the half vector, the cosines, and cosθ·Λ of `wo` and `wi`.
    #[inline]
    pub fn new(d: R, cos: [R; 2], cos_lambda: [R; 2]) -> Self {
        let four = R::lit(4.0);
        let visible = cos[0] + cos_lambda[0];
        let joint = visible * cos[1] + cos[0] * cos_lambda[1];
        Self {
            value: d / (four * joint),
            pdf: d / (four * visible),
            weight: visible * cos[1] / joint,
        }
    }
}

/// The normal that a slope belongs to: (−x, −y, 1), normalised.
#[inline]
pub(crate) fn normal_of_slope<R: Real>(x: R, y: R) -> [R; 3] {
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
