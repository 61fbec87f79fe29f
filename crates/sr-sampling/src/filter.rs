//! Pixel filters, sampled.
//!
//! A camera sample is placed with the density of the filter and then counts fully towards its own
//! pixel: filter importance sampling (Ernst, Stamminger, Greiner 2006). No sample is shared between
//! pixels. All filters are products of the same even function of x and of y, positive inside
//! `±radius`.

mod table;

use glam::Vec2;
use table::Table;

/// A separable pixel filter; lengths in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// Constant.
    Box {
        /// Half width.
        radius: f32,
    },
    /// Falls linearly to zero.
    Tent {
        /// Half width.
        radius: f32,
    },
    /// A Gaussian less its value at the edge, so that it ends continuously.
    Gaussian {
        /// Half width.
        radius: f32,
        /// Standard deviation before it is cut.
        sigma: f32,
    },
    /// The four-term window of Harris 1978, "On the Use of Windows for Harmonic Analysis".
    BlackmanHarris {
        /// Half width.
        radius: f32,
    },
}

impl Default for Filter {
    /// One pixel's own square.
    fn default() -> Self {
        Self::Box { radius: 0.5 }
    }
}

impl Filter {
    /// Half width.
    pub const fn radius(&self) -> f32 {
        match *self {
            Self::Box { radius }
            | Self::Tent { radius }
            | Self::Gaussian { radius, .. }
            | Self::BlackmanHarris { radius } => radius,
        }
    }

    /// One factor of the filter at `x` from the pixel's centre, not normalised; 0 beyond `radius`.
    pub fn evaluate(&self, x: f64) -> f64 {
        let radius = f64::from(self.radius());
        if x.abs() > radius {
            return 0.0;
        }
        let t = x / radius;
        match *self {
            Self::Box { .. } => 1.0,
            Self::Tent { .. } => 1.0 - t.abs(),
            Self::Gaussian { sigma, .. } => {
                // The difference of two exponentials, without cancellation near the edge.
                let k = -0.5 / f64::from(sigma).powi(2);
                -(k * x * x).exp() * (k * (radius * radius - x * x)).exp_m1()
            }
            Self::BlackmanHarris { .. } => {
                let phase = std::f64::consts::PI * t;
                0.35875
                    + 0.48829 * phase.cos()
                    + 0.14128 * (2.0 * phase).cos()
                    + 0.01168 * (3.0 * phase).cos()
            }
        }
    }
}

/// A [`Filter`] made ready to be sampled.
#[derive(Clone, Debug)]
pub struct FilterSampler {
    radius: f32,
    inverse: Inverse,
}

/// How the distribution function of one factor is inverted.
#[derive(Clone, Debug)]
enum Inverse {
    Linear,
    Root,
    Table(Box<Table>),
}

impl FilterSampler {
    /// `None` unless radius and sigma are positive and finite.
    pub fn new(filter: Filter) -> Option<Self> {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        let mut radius = filter.radius();
        if !positive(radius) {
            return None;
        }
        if let Filter::Gaussian { sigma, .. } = filter {
            if !positive(sigma) {
                return None;
            }
            // Beyond 8σ lie 10⁻¹⁵ of all samples; the table's resolution is better spent.
            radius = radius.min(8.0 * sigma);
        }
        let inverse = match filter {
            Filter::Box { .. } => Inverse::Linear,
            Filter::Tent { .. } => Inverse::Root,
            Filter::Gaussian { .. } | Filter::BlackmanHarris { .. } => {
                let f = |t: f64| filter.evaluate(t * f64::from(radius));
                Inverse::Table(Box::new(Table::new(f)))
            }
        };
        Some(Self { radius, inverse })
    }

    /// The offset from the pixel's centre for `u` in `[0, 1)²`; the sample has weight 1.
    ///
    /// Monotone in both components, so that it keeps the stratification of `u`. A box of radius 0.5
    /// covers exactly `[−0.5, 0.5)`.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Vec2 {
        // Exact for u on the grid of 2⁻²⁴.
        let v = 2.0 * u - Vec2::ONE;
        self.radius * Vec2::new(self.unit(v.x), self.unit(v.y))
    }

    /// The odd inverse from `[−1, 1)` to the filter of radius 1.
    #[inline]
    fn unit(&self, v: f32) -> f32 {
        match &self.inverse {
            Inverse::Linear => v,
            // 1 − √(1 − |v|), without cancellation.
            Inverse::Root => v / (1.0 + (1.0 - v.abs()).sqrt()),
            Inverse::Table(table) => table.invert(v.abs()).copysign(v),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dim, Sampler, SamplerSpec};
    use sr_stats::{chi2_test, sidak};

    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

    const FILTERS: [Filter; 7] = [
        Filter::Box { radius: 0.5 },
        Filter::Box { radius: 1.5 },
        Filter::Tent { radius: 1.0 },
        Filter::Gaussian {
            radius: 1.5,
            sigma: 0.5,
        },
        Filter::Gaussian {
            radius: 0.1,
            sigma: 3.0,
        },
        Filter::Gaussian {
            radius: 50.0,
            sigma: 0.5,
        },
        Filter::BlackmanHarris { radius: 2.0 },
    ];

    fn prepared(filter: Filter) -> FilterSampler {
        FilterSampler::new(filter).expect("valid")
    }

    #[test]
    fn the_default_box_covers_exactly_one_pixel() {
        let f = prepared(Filter::default());
        assert_eq!(f.sample(Vec2::ZERO), Vec2::splat(-0.5));
        assert_eq!(f.sample(Vec2::splat(0.5)), Vec2::ZERO);
        assert_eq!(
            f.sample(Vec2::splat(BELOW_ONE)),
            Vec2::splat(0.5 - f32::EPSILON / 2.0)
        );
    }

    #[test]
    fn offsets_are_odd_monotone_and_inside() {
        for filter in FILTERS {
            let f = prepared(filter);
            let mut last = f32::NEG_INFINITY;
            for i in 0..=4096u32 {
                let u = (i as f32 / 4096.0).min(BELOW_ONE);
                let x = f.sample(Vec2::new(u, 0.25));
                assert!(
                    x.x >= last && x.x.abs() <= filter.radius(),
                    "{filter:?} {u}"
                );
                last = x.x;
                if i > 0 && i < 4096 {
                    assert_eq!(x.x, -f.sample(Vec2::new(1.0 - u, 0.0)).x, "{filter:?} {u}");
                }
            }
        }
    }

    /// A million samples in 64 bins a side; the bins tile ±radius (±8σ if less). False alarm 10⁻⁴
    /// for the family; a relative error of 3 % of every bin is found.
    #[test]
    fn histograms_match_the_filter() {
        const N: u64 = 1 << 20;
        let spec = SamplerSpec::default();
        for (k, filter) in FILTERS.into_iter().enumerate() {
            let f = prepared(filter);
            let radius = f64::from(f.radius);
            let bin = |x: f32| (((f64::from(x) / radius + 1.0) * 32.0) as usize).min(63);
            let mut observed = [vec![0; 64], vec![0; 64]];
            for i in 0..N {
                let x = f.sample(spec.independent([k as u32, 0], i).d2(Dim::FILTER));
                observed[0][bin(x.x)] += 1;
                observed[1][bin(x.y)] += 1;
            }
            // Simpson on 32 panels a bin.
            let masses: Vec<f64> = (0..64)
                .map(|b| {
                    let at =
                        |i: usize| filter.evaluate(radius * ((b * 64 + i) as f64 / 2048.0 - 1.0));
                    (0..32)
                        .map(|i| at(2 * i) + 4.0 * at(2 * i + 1) + at(2 * i + 2))
                        .sum()
                })
                .collect();
            let total: f64 = masses.iter().sum();
            let expected: Vec<f64> = masses.iter().map(|m| m / total * N as f64).collect();
            for axis in observed {
                let p = chi2_test(&axis, &expected, 5.0).p_value;
                assert!(p > sidak(1e-4, 2 * FILTERS.len()), "{filter:?}: {p}");
            }
        }
    }

    /// The table inverts the distribution of the true filter: an even grid of u has its mean square,
    /// found here by quadrature, to the sum of the table's bound (see [`Table`]) and the grid's.
    #[test]
    fn variances_match_the_filter() {
        for filter in FILTERS {
            let f = prepared(filter);
            let n = 1 << 16;
            let sampled: f64 = (0..n)
                .map(|i| f64::from(f.sample(Vec2::splat((i as f32 + 0.5) / n as f32)).x).powi(2))
                .sum::<f64>()
                / f64::from(n);
            let (mut mass, mut moment) = (0.0, 0.0);
            for i in 0..n {
                let x = f64::from(filter.radius()) * (f64::from(i) + 0.5) / f64::from(n);
                let w = filter.evaluate(x);
                mass += w;
                moment += w * x * x;
            }
            let error = sampled / (moment / mass) - 1.0;
            assert!(error.abs() < 4e-4, "{filter:?}: {error}");
        }
    }

    #[test]
    fn meaningless_parameters_are_refused() {
        for x in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(FilterSampler::new(Filter::Box { radius: x }).is_none());
            assert!(FilterSampler::new(Filter::BlackmanHarris { radius: x }).is_none());
            assert!(
                FilterSampler::new(Filter::Gaussian {
                    radius: 1.0,
                    sigma: x
                })
                .is_none()
            );
        }
    }
}
