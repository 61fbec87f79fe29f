//! Moments of a pixel's samples.

/// Mean and central moments up to the fourth, sample by sample (Pébay 2008, Formulas for robust, one-pass
/// parallel computation of covariances and arbitrary-order statistical moments, §2).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    n: f64,
    mean: f64,
    /// Sums of powers of the deviations from the mean.
    m2: f64,
    m3: f64,
    m4: f64,
}

impl Moments {
    /// One more.
    pub fn add(&mut self, x: f64) {
        self.n += 1.0;
        let n = self.n;
        let delta = x - self.mean;
        let part = delta / n;
        let term = delta * part * (n - 1.0);
        self.mean += part;
        self.m4 += term * part * part * (n * n - 3.0 * n + 3.0) + 6.0 * part * part * self.m2
            - 4.0 * part * self.m3;
        self.m3 += term * part * (n - 2.0) - 3.0 * part * self.m2;
        self.m2 += term;
    }

    /// How many there were.
    pub fn count(&self) -> f64 {
        self.n
    }

    /// Their sum.
    pub fn sum(&self) -> f64 {
        self.n * self.mean
    }

    /// Fourth central moment over the square of the second: 3 for normal noise, nearly `n` where one sample is
    /// unlike all others. `None` where the samples are equal up to the rounding of `f32`.
    pub fn kurtosis(&self) -> Option<f64> {
        let deviation = (self.m2 / self.n).sqrt();
        let noisy = deviation > f64::from(f32::EPSILON) * self.mean.abs();
        noisy.then(|| self.n * self.m4 / (self.m2 * self.m2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[f64]) -> Moments {
        let mut moments = Moments::default();
        values.iter().for_each(|x| moments.add(*x));
        moments
    }

    #[test]
    fn moments_are_those_of_the_definition() {
        let values = [3.0, -1.0, 4.0, 1.0, 5.0, 9.0, 2.5, 6.0];
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let power = |k| values.iter().map(|x| (x - mean).powi(k)).sum::<f64>();
        let wanted = n * power(4) / (power(2) * power(2));
        let found = of(&values);
        assert!((found.kurtosis().unwrap() - wanted).abs() < 1e-12);
        assert!((found.sum() - 29.5).abs() < 1e-12);
    }

    #[test]
    fn one_odd_sample_has_the_largest_kurtosis_and_equal_ones_have_none() {
        let mut values = [1.0; 64];
        assert_eq!(of(&values).kurtosis(), None);
        values[40] = 1.0 + 1e-8;
        assert_eq!(of(&values).kurtosis(), None, "rounding is no noise");
        values[40] = 1e30;
        // n − 2 + 1/(n − 1).
        let found = of(&values).kurtosis().unwrap();
        assert!((found - 62.0159).abs() < 1e-3, "{found}");
    }
}
