//! Directions in bins over the sphere, and densities integrated over the same bins.
//!
//! Bins are products of an interval of polar angle θ (from +Z) and one of azimuth φ. The horizon
//! θ = π/2 is always an edge, so that a density that ends there is smooth within every bin.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Nodes and weights of the five-point Gauss–Legendre rule on [−1, 1], exact to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Accuracy at which a cell is not divided further, as a share of its bin's mass and as a mass. Both halve
/// with every division, as the number of cells along an edge of the density doubles. A bias of 10⁻⁴ is below
/// what 10⁷ samples can see in a χ²; and a density that is noisy with `f32` rounding is not divided for ever.
const RELATIVE: f64 = 1e-4;
const ABSOLUTE: f64 = 1e-7;

/// Divisions in each direction, at most: an edge of the density inside a bin is found to 1/512 of it.
const MAX_DEPTH: u32 = 9;

/// What a density's integral may exceed 1 by: the quadrature's share of it is below 10⁻⁴.
const EXCESS: f64 = 1e-3;

/// A grid of bins over the sphere.
#[derive(Clone, Debug)]
pub struct SphereBins {
    /// Edges of θ, ascending from 0 to π.
    theta: Vec<f64>,
    /// Edges of φ − `phi_0`, ascending from −π to π.
    phi: Vec<f64>,
    phi_0: f64,
}

impl SphereBins {
    /// `theta × phi` bins, evenly spaced in both angles. `theta` is rounded up to an even number.
    pub fn uniform(theta: usize, phi: usize) -> Self {
        let theta = theta.max(2).next_multiple_of(2);
        let phi = phi.max(1);
        Self {
            theta: (0..=theta).map(|i| PI * i as f64 / theta as f64).collect(),
            phi: (0..=phi)
                .map(|i| TAU * i as f64 / phi as f64 - PI)
                .collect(),
            phi_0: 0.0,
        }
    }

    /// About `theta × phi` bins that shrink towards `direction`, where they are a fraction of `scale`
    /// (radian) wide: for densities with a peak of that width. The spacing is a hyperbolic sine.
    pub fn focused(theta: usize, phi: usize, direction: [f64; 3], scale: f64) -> Self {
        let (t, p) = angles(direction);
        let (theta, phi) = (theta.max(2), phi.max(2));
        let mut edges = sinh_spaced(theta, scale, -t, PI - t);
        for e in &mut edges {
            *e += t;
        }
        edges[0] = 0.0;
        edges[theta] = PI;
        let at = edges.partition_point(|&e| e < FRAC_PI_2);
        if edges[at] > FRAC_PI_2 {
            edges.insert(at, FRAC_PI_2);
        }
        // An azimuth of scale/sin θ is as wide as `scale`; round the pole all azimuths are.
        let around = scale / t.sin().max(scale);
        Self {
            theta: edges,
            phi: sinh_spaced(phi, around, -PI, PI),
            phi_0: p,
        }
    }

    /// Number of bins.
    pub fn len(&self) -> usize {
        (self.theta.len() - 1) * (self.phi.len() - 1)
    }

    /// Never: there are at least two bins.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The bin of a direction, which need not be of unit length.
    pub fn index(&self, direction: [f64; 3]) -> usize {
        let (theta, phi) = angles(direction);
        let phi = (phi - self.phi_0 + PI).rem_euclid(TAU) - PI;
        interval(&self.theta, theta) * (self.phi.len() - 1) + interval(&self.phi, phi)
    }

    /// How many directions fall into each bin; the entry after the last bin counts the `None`s, the
    /// samples that failed.
    pub fn count(&self, directions: impl IntoIterator<Item = Option<[f64; 3]>>) -> Vec<u64> {
        let mut counts = vec![0; self.len() + 1];
        for d in directions {
            counts[d.map_or(self.len(), |d| self.index(d))] += 1;
        }
        counts
    }

    /// The integral over each bin of a density per solid angle.
    ///
    /// Gauss–Legendre, subdivided until five points a side agree with ten. A feature smaller than
    /// about a tenth of a bin is missed: focus the bins on it.
    pub fn integrate(&self, density: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
        let f = |theta: f64, phi: f64| {
            let (st, ct) = theta.sin_cos();
            let (sp, cp) = (phi + self.phi_0).sin_cos();
            st * density([st * cp, st * sp, ct])
        };
        let mut masses = Vec::with_capacity(self.len());
        for t in self.theta.windows(2) {
            for p in self.phi.windows(2) {
                let cell = Cell {
                    theta: (t[0], t[1]),
                    phi: (p[0], p[1]),
                };
                masses.push(cell.integral(&f));
            }
        }
        masses
    }

    /// What `samples` draws from `density` should make of [`SphereBins::count`]. What the density
    /// lacks to 1 is expected among the failed samples, and at least a millionth of all is, since
    /// draws at the very edge of the unit square may fail. No bin expects less than the quadrature's
    /// absolute error, so a sample in the sliver of a bin that all nodes missed is rare, not impossible.
    ///
    /// # Panics
    /// When the density integrates to more than 1, beyond the error of the quadrature.
    pub fn expected(&self, samples: u64, density: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
        let mut expected = self.integrate(density);
        let total: f64 = expected.iter().sum();
        assert!(total < 1.0 + EXCESS, "the density integrates to {total}");
        expected.push((1.0 - total).max(1e-6));
        for e in &mut expected {
            *e = e.max(ABSOLUTE) * samples as f64;
        }
        expected
    }
}

/// θ and φ; atan2 keeps full accuracy at the poles.
fn angles(d: [f64; 3]) -> (f64, f64) {
    (d[0].hypot(d[1]).atan2(d[2]), d[1].atan2(d[0]))
}

/// `n + 1` edges from `lo < 0` to `hi > 0`, dense around 0 on the scale given.
fn sinh_spaced(n: usize, scale: f64, lo: f64, hi: f64) -> Vec<f64> {
    let (a, b) = ((lo / scale).asinh(), (hi / scale).asinh());
    let at = |i: usize| scale * (a + (b - a) * i as f64 / n as f64).sinh();
    let mut edges: Vec<f64> = (0..=n).map(at).collect();
    edges[0] = lo;
    edges[n] = hi;
    edges
}

fn interval(edges: &[f64], x: f64) -> usize {
    (edges.partition_point(|&e| e <= x).max(1) - 1).min(edges.len() - 2)
}

#[derive(Clone, Copy)]
struct Cell {
    theta: (f64, f64),
    phi: (f64, f64),
}

impl Cell {
    fn gauss(&self, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let half = |(a, b): (f64, f64)| (0.5 * (a + b), 0.5 * (b - a));
        let ((tm, th), (pm, ph)) = (half(self.theta), half(self.phi));
        let mut sum = 0.0;
        for (x, wx) in GAUSS {
            for (y, wy) in GAUSS {
                sum += wx * wy * f(tm + th * x, pm + ph * y);
            }
        }
        sum * th * ph
    }

    fn quarters(&self) -> [Self; 4] {
        let (tm, pm) = (
            0.5 * (self.theta.0 + self.theta.1),
            0.5 * (self.phi.0 + self.phi.1),
        );
        let (t, p) = (
            [(self.theta.0, tm), (tm, self.theta.1)],
            [(self.phi.0, pm), (pm, self.phi.1)],
        );
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| Self {
            theta: t[i],
            phi: p[j],
        })
    }

    fn integral(&self, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let coarse = self.gauss(f);
        let mass: f64 = self.quarters().iter().map(|q| q.gauss(f)).sum();
        self.refine(f, coarse, ABSOLUTE + RELATIVE * mass.abs(), MAX_DEPTH)
    }

    fn refine(&self, f: &impl Fn(f64, f64) -> f64, coarse: f64, accuracy: f64, depth: u32) -> f64 {
        let quarters = self.quarters();
        let parts = quarters.map(|q| q.gauss(f));
        let fine: f64 = parts.iter().sum();
        if depth == 0 || (fine - coarse).abs() <= accuracy {
            return fine;
        }
        let finer = quarters.iter().zip(parts);
        finer
            .map(|(q, part)| q.refine(f, part, 0.5 * accuracy, depth - 1))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grids() -> [SphereBins; 3] {
        [
            SphereBins::uniform(16, 32),
            SphereBins::focused(32, 24, [0.6, -0.3, 0.2], 0.01),
            SphereBins::focused(32, 24, [0.0, 0.0, 1.0], 0.1),
        ]
    }

    #[test]
    fn the_bins_cover_the_sphere_once() {
        for bins in grids() {
            let sum: f64 = bins.integrate(|_| 0.25 / PI).iter().sum();
            assert!((sum - 1.0).abs() < 1e-9, "{sum}");
            assert!(bins.theta.contains(&FRAC_PI_2));
            assert!(bins.theta.is_sorted() && bins.phi.is_sorted());
        }
    }

    /// The mass that `integrate` gives a bin is the mass of the directions that `index` puts there:
    /// an indicator of the bin's own index integrates to its area alone.
    #[test]
    fn index_and_integrate_mean_the_same_bins() {
        for bins in grids() {
            for target in [0, 17, bins.len() / 2, bins.len() - 1] {
                let masses = bins.integrate(|d| f64::from(u8::from(bins.index(d) == target)));
                let area = bins.integrate(|_| 1.0)[target];
                assert!((masses[target] - area).abs() < 1e-12);
                assert_eq!(masses.iter().filter(|&&m| m > 0.0).count(), 1);
            }
        }
    }

    /// A von Mises–Fisher lobe of width 0.01 integrates to 1 on bins focused on it.
    #[test]
    fn a_narrow_lobe_is_integrated() {
        let (axis, kappa) = ([0.48, 0.64, 0.6], 1e4);
        let bins = SphereBins::focused(40, 40, axis, 0.01);
        let lobe = |d: [f64; 3]| {
            let cos = (0..3).map(|i| d[i] * axis[i]).sum::<f64>();
            kappa / (2.0 * PI) * (kappa * (cos - 1.0)).exp()
        };
        let sum: f64 = bins.integrate(lobe).iter().sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
    }

    /// A uniform cap whose rim runs through the bins: 1/512 of a bin's width is resolved.
    #[test]
    fn an_edge_inside_the_bins_is_integrated() {
        let cos_max = 0.8;
        let density = |d: [f64; 3]| {
            let cos = 0.6 * d[0] + 0.8 * d[2];
            if cos > cos_max {
                1.0 / (2.0 * PI * (1.0 - cos_max))
            } else {
                0.0
            }
        };
        let sum: f64 = SphereBins::uniform(16, 16).integrate(density).iter().sum();
        assert!((sum - 1.0).abs() < 1e-3, "{sum}");
    }

    #[test]
    fn failed_samples_have_a_place_of_their_own() {
        let bins = SphereBins::uniform(4, 4);
        let counts = bins.count([None, Some([0.0, 0.0, 1.0]), None]);
        assert_eq!((counts.len(), counts[bins.len()]), (bins.len() + 1, 2));
        let expected = bins.expected(1000, |_| 0.1 / PI);
        assert!((expected[bins.len()] - 600.0).abs() < 1e-6);
        assert!((expected.iter().sum::<f64>() - 1000.0).abs() < 1e-6);
    }

    #[test]
    #[should_panic(expected = "integrates to 2")]
    fn a_density_above_one_is_refused() {
        SphereBins::uniform(4, 4).expected(10, |_| 0.5 / PI);
    }
}
