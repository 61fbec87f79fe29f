//! What a rough surface loses because its facets scatter once, tabulated.
//!
//! E(w), the share of the light from `w` that comes back in a white furnace, has no closed form. It is
//! integrated when a material is made, some milliseconds for each table, and read by linear
//! interpolation: in x = (1 + √t − √(1 − t))/2 of t = cosθ·(1 + α)/(cosθ + α), since what is lost changes where cosθ is of
//! the order of α, α seen along `w`, begins as steeply as cosθ log cosθ, and of very rough glass bends most near the
//! axis; and in sin²φ when there are two roughnesses.

use crate::color::Color;
use crate::microfacet::Alpha;
use sr_math::Real;
use sr_math::distribution::Distribution1D;
use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_4, TAU};
use std::fmt;

/// Intervals of x.
const ELEVATIONS: usize = 48;
/// Intervals of sin²φ of an anisotropic surface.
const AZIMUTHS: usize = 8;
/// Points of the quadrature at each node.
const POINTS: u32 = 2048;
/// Points of the quadrature across each bin that directions are drawn from, in cos²θ and in φ.
const BIN_POINTS: (usize, usize) = (8, 16);

/// m(w) = 1 − E(w), and a density in proportion to m·cosθ.
#[derive(Clone, PartialEq)]
pub(crate) struct MissingEnergy {
    alpha: Alpha<f32>,
    /// m at the nodes, elevation by elevation.
    nodes: Vec<f32>,
    azimuths: usize,
    /// M = ∫ m·cosθ/π dω, from the interpolated table.
    average: f32,
    /// cos²θ at the edges of the bins.
    edges: Vec<f32>,
    /// Density of each bin per projected solid angle.
    density: Vec<f32>,
    choice: Option<Distribution1D>,
}

impl fmt::Debug for MissingEnergy {
    /// Without the table.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "MissingEnergy({:?}, {})", self.alpha, self.average)
    }
}

impl MissingEnergy {
    /// `weight(wo, u)` is the mean of what a sample `u` brings back from `wo` of the upper side.
    pub fn new(alpha: Alpha<f32>, weight: impl Fn([f32; 3], [f32; 2]) -> f32) -> Self {
        let azimuths = if alpha.ratio == 1.0 { 0 } else { AZIMUTHS };
        let mut table = Self {
            alpha,
            nodes: Vec::new(),
            azimuths,
            average: 0.0,
            edges: Vec::new(),
            density: Vec::new(),
            choice: None,
        };
        for i in 0..=ELEVATIONS {
            for s in 0..=azimuths {
                let wo = table.node(i, s);
                let sum: f64 = (0..POINTS)
                    .map(|p| f64::from(weight(wo, hammersley(p))))
                    .sum();
                let missing = 1.0 - sum / f64::from(POINTS);
                table.nodes.push((missing as f32).max(0.0));
            }
        }
        table.bin();
        table
    }

    /// The direction of a node.
    fn node(&self, elevation: usize, azimuth: usize) -> [f32; 3] {
        let sin2_phi = azimuth as f32 / self.azimuths.max(1) as f32;
        let cos = elevation_cos(
            elevation as f32 / ELEVATIONS as f32,
            self.alpha_along(sin2_phi),
        );
        let sin = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
        [
            sin * (1.0 - sin2_phi).max(0.0).sqrt(),
            sin * sin2_phi.sqrt(),
            cos,
        ]
    }

    fn alpha_along<R: Real>(&self, sin2_phi: R) -> R {
        let alpha = Alpha::<R>::lift(self.alpha);
        let (x, y) = (alpha.x, alpha.y());
        (x * x * (R::ONE - sin2_phi) + y * y * sin2_phi).sqrt()
    }

    /// m(w) = 1 − E(w).
    #[inline]
    pub fn missing<R: Real>(&self, w: [R; 3]) -> R {
        let (sin2_phi, alpha) = if self.azimuths == 0 {
            (R::ZERO, R::from_f32(self.alpha.x))
        } else {
            let sin2 = w[0] * w[0] + w[1] * w[1];
            let sin2_phi = if sin2 > R::ZERO {
                w[1] * w[1] / sin2
            } else {
                R::ZERO
            };
            (sin2_phi, self.alpha_along(sin2_phi))
        };
        let cos = w[2].abs().min(R::ONE);
        let (i, t) = interval(elevation(cos, alpha), ELEVATIONS);
        let node = |i: usize| R::from_f32(self.nodes[i]);
        let row = |i: usize| {
            let first = i * (self.azimuths + 1);
            if self.azimuths == 0 {
                return node(first);
            }
            let (s, f) = interval(sin2_phi, self.azimuths);
            mix(node(first + s), node(first + s + 1), f)
        };
        mix(row(i), row(i + 1), t)
    }

    /// M, the mean of m over a diffuse light.
    pub fn average<R: Real>(&self) -> R {
        R::from_f32(self.average)
    }

    /// Fills the bins from which directions are drawn.
    fn bin(&mut self) {
        let scale = self.scale::<f32>();
        let edge = |k: usize| elevation_cos(k as f32 / ELEVATIONS as f32, scale).powi(2);
        self.edges = (0..=ELEVATIONS).map(edge).collect();
        let masses: Vec<f64> = self
            .edges
            .windows(2)
            .map(|e| self.mean(e[0], e[1]) * f64::from(e[1] - e[0]))
            .collect();
        let total: f64 = masses.iter().sum();
        self.average = total as f32;
        self.choice = Distribution1D::new(masses.iter().copied());
        let width = |k: usize| f64::from(self.edges[k + 1] - self.edges[k]);
        self.density = (0..ELEVATIONS)
            .map(|k| (masses[k] / (total.max(f64::MIN_POSITIVE) * width(k))) as f32)
            .collect();
    }

    /// Mean of m between two values of cos²θ.
    fn mean(&self, from: f32, to: f32) -> f64 {
        let (rings, spokes) = BIN_POINTS;
        let spokes = if self.azimuths == 0 { 1 } else { spokes };
        let mut sum = 0.0;
        for r in 0..rings {
            let cos2 = from + (to - from) * (r as f32 + 0.5) / rings as f32;
            let sin = (1.0 - cos2).max(0.0).sqrt();
            for p in 0..spokes {
                let phi = 0.25 * TAU * (p as f32 + 0.5) / spokes as f32;
                let w = [sin * phi.cos(), sin * phi.sin(), cos2.sqrt()];
                sum += f64::from(self.missing(w));
            }
        }
        sum / (rings * spokes) as f64
    }

    /// One roughness for all azimuths, by which bins are spaced.
    fn scale<R: Real>(&self) -> R {
        let alpha = Alpha::<R>::lift(self.alpha);
        alpha.x * alpha.ratio.sqrt()
    }

    /// A direction of the upper side, about in proportion to m·cosθ.
    pub fn sample<R: Real>(&self, u: [R; 2]) -> Option<[R; 3]> {
        let (bin, _, rest) = self.choice.as_ref()?.sample(u[0]);
        let [from, to] = [bin, bin + 1].map(|k| R::from_f32(self.edges[k]));
        let cos2 = from + (to - from) * rest;
        let sin = (R::ONE - cos2).safe_sqrt();
        let phi = R::lit(2.0) * R::PI * u[1];
        Some([sin * phi.cos(), sin * phi.sin(), cos2.sqrt()])
    }

    /// Density of [`MissingEnergy::sample`] per solid angle, either side.
    #[inline]
    pub fn pdf<R: Real>(&self, w: [R; 3]) -> R {
        let (cos, scale) = (w[2].abs().min(R::ONE), self.scale::<R>());
        let (bin, _) = interval(elevation(cos, scale), ELEVATIONS);
        R::from_f32(self.density[bin]) * cos * R::INV_PI
    }
}

/// The x of a cosine; 1 − t is written without a difference.
#[inline(always)]
fn elevation<R: Real>(cos: R, alpha: R) -> R {
    let sum = cos + alpha;
    let (t, rest) = (cos * (R::ONE + alpha) / sum, alpha * (R::ONE - cos) / sum);
    R::lit(0.5) * (R::ONE + t.sqrt() - rest.sqrt())
}

/// The cosine that x stands for: with t = sin²ψ, 2x − 1 is sin ψ − cos ψ = √2 sin(ψ − π/4).
fn elevation_cos(x: f32, alpha: f32) -> f32 {
    let psi = FRAC_PI_4 + ((2.0 * x - 1.0) * FRAC_1_SQRT_2).asin();
    let t = psi.sin().powi(2);
    (alpha * t / (1.0 + alpha - t)).min(1.0)
}

/// Which of `n` intervals of `[0, 1]` x lies in, and where in it.
#[inline(always)]
fn interval<R: Real>(x: R, n: usize) -> (usize, R) {
    let scaled = x * R::lit(n as f64);
    let i = (scaled.to_f64() as usize).min(n - 1);
    (i, (scaled - R::lit(i as f64)).min(R::ONE))
}

#[inline(always)]
fn mix<R: Real>(a: R, b: R, t: R) -> R {
    a + (b - a) * t
}

/// Hammersley's point set (Hammersley 1960), in the middle of its strata.
fn hammersley(i: u32) -> [f32; 2] {
    let x = (f64::from(i) + 0.5) / f64::from(POINTS);
    let y = (f64::from(i.reverse_bits()) + 0.5) / 4_294_967_296.0;
    [x as f32, (y as f32).min(1.0 - f32::EPSILON / 2.0)]
}

/// 2 ∫ F(μ)·μ dμ: the mean of a Fresnel term over a diffuse light.
pub(crate) fn diffuse_mean(fresnel: impl Fn(f32) -> Color<f32>) -> Color<f32> {
    const POINTS: u32 = 128;
    let at = |i: u32| fresnel(((i as f32 + 0.5) / POINTS as f32).sqrt());
    (0..POINTS).map(at).fold(Color::BLACK, |sum, f| sum + f) / POINTS as f32
}
