//! Piecewise constant distributions on a line, tabulated.

use crate::Real;

/// Chooses an index with probability in proportion to its weight, and gives back what of `u` the
/// choice did not use.
///
/// The cumulative table is `f64`. An `f32` from a sampler has 24 bits: an index of probability p is
/// then chosen by p·2²⁴ ± 1 of its values, so probabilities far below 10⁻⁵ are honoured on average
/// over indices, not each by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution1D {
    /// `cdf[i]..cdf[i + 1]` belongs to index i; from exactly 0 to exactly 1.
    cdf: Vec<f64>,
}

impl Distribution1D {
    /// From weights in any unit.
    ///
    /// `None` when there is nothing to choose: no weight above zero, or a weight (or their sum)
    /// that is negative or not finite.
    ///
    /// A weight whose share of the sum is below the smallest normal `f32`, 10⁻³⁸, counts as zero: a number at the very
    /// end of its range would fall on it, and kernels would divide by a probability of 0.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Option<Self> {
        let weights: Vec<f64> = weights.into_iter().collect();
        if weights.iter().any(|w| w.is_nan() || *w < 0.0) {
            return None;
        }
        let total: f64 = weights.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let least = total * f64::from(f32::MIN_POSITIVE);
        let mut sum = 0.0;
        let mut cdf = vec![0.0];
        for w in weights {
            sum += if w < least { 0.0 } else { w };
            cdf.push(sum);
        }
        // x/x is 1, and whatever follows the last weight above zero has the same sum.
        for c in &mut cdf {
            *c /= sum;
        }
        Some(Self { cdf })
    }

    /// Number of indices, those of weight zero included.
    #[inline]
    pub fn len(&self) -> usize {
        self.cdf.len() - 1
    }

    /// Never: the constructor refuses an empty table.
    #[inline]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Probability of an index; 0 beyond the end.
    #[inline]
    pub fn pmf(&self, index: usize) -> f64 {
        match self.cdf.get(index..index + 2) {
            Some(&[a, b]) => b - a,
            _ => 0.0,
        }
    }

    /// The index that `u` in `[0, 1)` falls on, its probability, and the place of `u` within its
    /// interval, again uniform in `[0, 1)`. Never an index of weight zero.
    #[inline]
    pub fn sample<R: Real>(&self, u: R) -> (usize, R, R) {
        let u = u.to_f64();
        // The last edge at or below u starts the interval; one of no width has its successor there.
        let index = self.cdf.partition_point(|&c| c <= u).clamp(1, self.len()) - 1;
        let pmf = self.pmf(index);
        let rest = R::lit((u - self.cdf[index]) / pmf).clamp_to(R::ZERO, R::ONE_MINUS_ULP);
        (index, R::lit(pmf), rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash;

    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

    #[test]
    fn what_is_chosen_has_a_probability_in_f32() {
        let d = Distribution1D::new([1e-300, 1.0, 1e-39, 1e-37]).expect("weights");
        for u in [0.0f32, f32::from_bits(1), 0.5, BELOW_ONE] {
            let (i, pmf, rest) = d.sample(u);
            assert_eq!((i, pmf), (1, 1.0), "{u}");
            assert!((0.0..1.0).contains(&rest));
        }
        assert_eq!([0, 2].map(|i| d.pmf(i)), [0.0; 2]);
    }

    #[test]
    fn zeros_are_never_chosen_at_either_end_or_inside() {
        let d = Distribution1D::new([0.0, 0.0, 3.0, 0.0, 1.0, 0.0]).expect("two weights");
        assert_eq!(d.len(), 6);
        for u in [0.0, 1.0 / 16_777_216.0, 0.5, 0.75 - 1e-7, 0.75, BELOW_ONE] {
            let (i, pmf, rest) = d.sample(u);
            let expected = if u < 0.75 { (2, 0.75) } else { (4, 0.25) };
            assert_eq!((i, pmf), expected, "{u}");
            assert!((0.0..1.0).contains(&rest));
        }
        assert_eq!(
            [0, 1, 2, 3, 4, 5, 6, 7].map(|i| d.pmf(i)),
            [0., 0., 0.75, 0., 0.25, 0., 0., 0.]
        );
        assert_eq!(d.sample(0.75f32).2, 0.0);
        assert_eq!(d.sample(0.875f32).2, 0.5);
    }

    #[test]
    fn nothing_to_choose_is_refused() {
        for weights in [
            vec![],
            vec![0.0, 0.0],
            vec![1.0, -1.0],
            vec![f64::NAN],
            vec![f64::INFINITY],
            vec![f64::MAX; 2],
        ] {
            assert!(
                Distribution1D::new(weights.iter().copied()).is_none(),
                "{weights:?}"
            );
        }
    }

    /// Over a grid of n values of u an index gets p·n ± 1 of them, and the parts of u that are left
    /// have the mean 1/2 to within the spacing that is left, 1/(2pn).
    #[test]
    fn the_grid_of_u_is_shared_out_in_proportion() {
        let weights: Vec<f64> = (0..100u32)
            .map(|i| {
                if i % 7 == 0 {
                    0.0
                } else {
                    f64::from(hash::unit_f32(hash::mix(i, 9)))
                }
            })
            .collect();
        let total: f64 = weights.iter().sum();
        let d = Distribution1D::new(weights.iter().copied()).expect("weights");
        let n = 1 << 20;
        let (mut count, mut rest) = (vec![0u32; 100], vec![0.0; 100]);
        for k in 0..n {
            let (i, pmf, r) = d.sample(k as f32 / n as f32);
            assert!((f64::from(pmf) - weights[i] / total).abs() < 1e-7);
            count[i] += 1;
            rest[i] += f64::from(r);
        }
        for i in 0..100 {
            let expected = weights[i] / total * f64::from(n);
            assert!((f64::from(count[i]) - expected).abs() <= 1.0, "{i}");
            if count[i] > 0 {
                let mean = rest[i] / f64::from(count[i]);
                assert!((mean - 0.5).abs() <= 0.51 / expected + 1e-6, "{i}: {mean}");
            }
        }
    }
}
