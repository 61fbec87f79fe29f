//! Pearson's χ² goodness of fit, and Šidák's correction for many tests.

use crate::gamma_upper_regularized;

/// The outcome of a [`chi2_test`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chi2 {
    /// Σ (observed − expected)²/expected over the cells.
    pub statistic: f64,
    /// Cells after pooling, less one.
    pub dof: usize,
    /// Probability of a statistic at least this large if the expectation is right.
    pub p_value: f64,
}

/// Tests counts against their expectations.
///
/// Bins that expect fewer than `min_expected` (5 by custom) are pooled, the smallest first, into
/// cells that expect as many; what is left joins the smallest cell. A count in a bin that expects
/// exactly 0 is impossible: the p-value is then 0. One degree of freedom is taken for the total, so
/// `expected` has to sum to the number of samples: give samples that found no bin a bin of their
/// own (as [`SphereBins::expected`](crate::SphereBins::expected) does).
///
/// With N samples a relative error δ of every probability is found when N·δ² is several times
/// √(2·dof).
///
/// # Panics
/// When the lengths differ or an expectation is negative or not finite.
pub fn chi2_test(observed: &[u64], expected: &[f64], min_expected: f64) -> Chi2 {
    assert_eq!(observed.len(), expected.len(), "one expectation a bin");
    for e in expected {
        assert!(e.is_finite() && *e >= 0.0, "an expected count of {e}");
    }
    let impossible = observed
        .iter()
        .zip(expected)
        .any(|(&o, &e)| o > 0 && e == 0.0);
    let cells = pool(observed, expected, min_expected);
    let statistic = if impossible {
        f64::INFINITY
    } else {
        cells.iter().map(|&(o, e)| (o - e) * (o - e) / e).sum()
    };
    let dof = cells.len().saturating_sub(1);
    let p_value = match (impossible, dof) {
        (true, _) => 0.0,
        (false, 0) => 1.0,
        (false, dof) => gamma_upper_regularized(dof as f64 / 2.0, statistic / 2.0),
    };
    Chi2 {
        statistic,
        dof,
        p_value,
    }
}

/// Cells of (observed, expected), every one expecting at least `min_expected` unless all bins
/// together expect less.
fn pool(observed: &[u64], expected: &[f64], min_expected: f64) -> Vec<(f64, f64)> {
    let mut order: Vec<usize> = (0..expected.len()).filter(|&i| expected[i] > 0.0).collect();
    // Stable, so ties keep the order of the bins and the result is reproducible.
    order.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    let mut cells = Vec::new();
    let (mut o, mut e) = (0.0, 0.0);
    for i in order {
        o += observed[i] as f64;
        e += expected[i];
        if e >= min_expected {
            cells.push((o, e));
            (o, e) = (0.0, 0.0);
        }
    }
    if e > 0.0 {
        match cells.iter_mut().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some(cell) => {
                cell.0 += o;
                cell.1 += e;
            }
            None => cells.push((o, e)),
        }
    }
    cells
}

/// The level of each of `tests` independent tests that gives all of them together the false-alarm
/// rate `alpha`: 1 − (1 − α)^(1/n).
pub fn sidak(alpha: f64, tests: usize) -> f64 {
    -((-alpha).ln_1p() / tests.max(1) as f64).exp_m1()
}

/// The probability that the smallest p-value of `tests` independent tests is `smallest` or less if
/// all hypotheses are true: 1 − (1 − p)ⁿ. It is below α just when p is below [`sidak`]'s level.
pub fn family_p_value(smallest: f64, tests: usize) -> f64 {
    -(tests as f64 * (-smallest).ln_1p()).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SplitMix;

    fn throw(samples: u64, bins: usize, bias: f64, random: &mut SplitMix) -> Vec<u64> {
        let mut counts = vec![0; bins];
        for _ in 0..samples {
            let u = random.uniform();
            // Density 1 + bias·(2u − 1), by rejection.
            let u = if random.uniform() < 0.5 + 0.5 * bias * (2.0 * u - 1.0) {
                u
            } else {
                1.0 - u
            };
            counts[(u * bins as f64) as usize] += 1;
        }
        counts
    }

    /// Under the null hypothesis p is uniform. 2000 tests at level 5 % give 100 ± 10 alarms, and
    /// the mean of p is 0.5 ± 0.0065; both bounds stand at 5σ (10⁻⁶). A wrong dof by one of 19
    /// would move the mean by about 0.06.
    #[test]
    fn p_values_are_uniform_when_the_hypothesis_holds() {
        let mut state = SplitMix::new(1);
        let (mut alarms, mut sum) = (0, 0.0);
        for _ in 0..2000 {
            let counts = throw(1000, 20, 0.0, &mut state);
            let p = chi2_test(&counts, &[50.0; 20], 5.0).p_value;
            alarms += u32::from(p < 0.05);
            sum += p;
        }
        assert!((50..=150).contains(&alarms), "{alarms}");
        assert!((sum / 2000.0 - 0.5).abs() < 0.033, "{}", sum / 2000.0);
    }

    /// A slope of 5 %: N·δ²/3 = 83 against √(2·19) = 6.
    #[test]
    fn a_small_bias_is_found() {
        let counts = throw(100_000, 20, 0.05, &mut SplitMix::new(7));
        assert!(chi2_test(&counts, &[5000.0; 20], 5.0).p_value < 1e-6);
    }

    #[test]
    fn rare_bins_are_pooled_and_nothing_is_lost() {
        let observed = [90, 3, 2, 3, 1, 1];
        let expected = [90.0, 2.0, 2.0, 2.0, 2.0, 2.0];
        let cells = pool(&observed, &expected, 5.0);
        assert_eq!(cells.len(), 2);
        let total = cells.iter().fold((0.0, 0.0), |t, c| (t.0 + c.0, t.1 + c.1));
        assert_eq!(total, (100.0, 100.0));
        assert_eq!(chi2_test(&observed, &expected, 5.0).dof, 1);
    }

    #[test]
    fn an_impossible_count_fails_the_test() {
        assert_eq!(chi2_test(&[99, 1], &[100.0, 0.0], 5.0).p_value, 0.0);
        assert_eq!(chi2_test(&[100, 0], &[100.0, 0.0], 5.0).p_value, 1.0);
    }

    /// The textbook die: 5, 8, 9, 8, 10, 20 in 60 throws give 13.4, p = 0.0199.
    #[test]
    fn known_statistic_and_p_value() {
        let r = chi2_test(&[5, 8, 9, 8, 10, 20], &[10.0; 6], 5.0);
        assert!((r.statistic - 13.4).abs() < 1e-12 && r.dof == 5);
        assert!((r.p_value - 0.019_905).abs() < 1e-6, "{}", r.p_value);
    }

    #[test]
    fn sidak_shares_the_level() {
        // Rounding of 1 − x and of 50 multiplications: at most 51 ulp of 1.
        assert!((1.0 - (1.0 - sidak(0.01, 50)).powi(50) - 0.01).abs() < 51.0 * f64::EPSILON);
        assert!((sidak(1e-12, 10) - 1e-13).abs() < 1e-24);
        assert!((sidak(0.25, 1) - 0.25).abs() < f64::EPSILON);
        assert!((family_p_value(sidak(0.01, 300), 300) - 0.01).abs() < 1e-15);
        assert_eq!((family_p_value(0.0, 7), family_p_value(1.0, 7)), (0.0, 1.0));
    }
}
