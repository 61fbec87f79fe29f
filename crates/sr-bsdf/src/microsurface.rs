//! The rough surface that conductors and dielectrics share: a distribution, its roughness, and how it is
//! sampled.

use crate::microfacet::{Alpha, Facet, SMOOTH_ALPHA, Sampling, is_smooth};
use crate::{beckmann, ggx};
use sr_math::Real;

/// The distribution of a rough surface's normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ndf {
    /// Gaussian slopes, [`beckmann`].
    #[default]
    Beckmann,
    /// Trowbridge and Reitz's, with longer tails, [`ggx`].
    Ggx,
}

/// A rough surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microsurface {
    ndf: Ndf,
    alpha: Alpha<f32>,
    sampling: Sampling,
    rotation: f32,
}

impl Microsurface {
    /// Roughness α along local X and local Y; not negative.
    ///
    /// With both below [`SMOOTH_ALPHA`] the surface is smooth. With one below it that one counts as
    /// [`SMOOTH_ALPHA`].
    pub fn new(ndf: Ndf, alpha: [f32; 2]) -> Self {
        let alpha = if alpha.iter().all(|&a| is_smooth(a)) {
            Alpha::isotropic(0.0)
        } else {
            let [x, y] = alpha.map(|a| a.max(SMOOTH_ALPHA));
            Alpha::new(x, y)
        };
        Self {
            ndf,
            alpha,
            sampling: Sampling::Visible,
            rotation: 0.0,
        }
    }

    /// The same roughness along both tangents.
    pub fn isotropic(ndf: Ndf, alpha: f32) -> Self {
        Self::new(ndf, [alpha; 2])
    }

    /// No smoother than `floor` along either tangent, or smooth when it is so along both.
    pub(crate) fn at_least(self, floor: f32) -> Self {
        let (x, y) = (self.alpha.x, self.alpha.y());
        let alpha = if x < floor && y < floor {
            Alpha::isotropic(0.0)
        } else if x < floor || y < floor {
            Alpha::new(x.max(floor), y.max(floor))
        } else {
            self.alpha
        };
        Self { alpha, ..self }
    }

    /// Sampled in another way.
    pub fn sampled(self, sampling: Sampling) -> Self {
        Self { sampling, ..self }
    }

    /// Turned about the normal by an angle in radian, counter-clockwise seen from outside.
    ///
    /// The lobe itself does not turn: whoever makes the local frame does, see
    /// [`Bsdf::brush`](crate::Bsdf::brush).
    pub fn rotated(self, rotation: f32) -> Self {
        Self { rotation, ..self }
    }

    /// Roughness along both tangents; 0 for a smooth surface.
    pub fn alpha(&self) -> Alpha<f32> {
        self.alpha
    }

    /// How it is sampled.
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// By how much it is turned, when that matters.
    pub(crate) fn brush(&self) -> Option<f32> {
        (self.alpha.ratio != 1.0).then_some(self.rotation)
    }

    /// The surface is replaced by its delta limit.
    #[inline(always)]
    pub fn is_smooth(&self) -> bool {
        is_smooth(self.alpha.x)
    }

    #[inline(always)]
    fn d<R: Real>(&self, h: [R; 3]) -> R {
        match self.ndf {
            Ndf::Beckmann => beckmann::d(h, Alpha::lift(self.alpha)),
            Ndf::Ggx => ggx::d(h, Alpha::lift(self.alpha)),
        }
    }

    #[inline(always)]
    fn cos_lambda<R: Real>(&self, w: [R; 3]) -> R {
        match self.ndf {
            Ndf::Beckmann => beckmann::cos_lambda(w, Alpha::lift(self.alpha)),
            Ndf::Ggx => ggx::cos_lambda(w, Alpha::lift(self.alpha)),
        }
    }

    /// A normal, visible to `wo` of the upper side where that is asked for.
    #[inline]
    pub(crate) fn sample_normal<R: Real>(&self, wo: [R; 3], u: [R; 2]) -> [R; 3] {
        let alpha = Alpha::lift(self.alpha);
        match (self.ndf, self.sampling) {
            (Ndf::Beckmann, Sampling::Ndf) => beckmann::sample_ndf(alpha, u),
            (Ndf::Beckmann, _) => beckmann::sample_vndf(wo, alpha, u),
            (Ndf::Ggx, Sampling::Ndf) => ggx::sample_ndf(alpha, u),
            (Ndf::Ggx, _) => ggx::sample_vndf(wo, alpha, u),
        }
    }

    /// The facet of normal `h`, for `wo` of the upper side and `wi` of either.
    #[inline(always)]
    pub(crate) fn facet<R: Real>(&self, wo: [R; 3], wi: [R; 3], h: [R; 3]) -> Facet<R> {
        Facet {
            d: self.d(h),
            cos_h: h[2],
            cos: [wo[2], wi[2].abs()],
            cos_lambda: [self.cos_lambda(wo), self.cos_lambda(wi)],
        }
    }
}
