//! Whether p-values are as small as chance allows.
//!
//! Many p-values of true hypotheses are uniform in [0, 1]. Too many small ones tell of differences
//! that none of the tests sees by itself; too many large ones only of tests that are too careful.
//! So the one-sided statistic of Kolmogorov and Smirnov is asked.

/// The outcome of [`small_p_values`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallPValues {
    /// The largest excess of the share of values up to p over p itself.
    pub excess: f64,
    /// Where it is.
    pub at: f64,
    /// Probability of such an excess, or a larger one, if the values are uniform and independent:
    /// e^(−2 n D²), which is an upper bound for any n (Massart 1990) and its limit (Smirnov 1944).
    pub p_value: f64,
}

/// Tests values in [0, 1] for an excess of small ones; sorts them. No values, no excess.
pub fn small_p_values(values: &mut [f64]) -> SmallPValues {
    values.sort_unstable_by(f64::total_cmp);
    let n = values.len() as f64;
    let mut found = SmallPValues {
        excess: 0.0,
        at: 0.0,
        p_value: 1.0,
    };
    for (i, &p) in values.iter().enumerate() {
        let excess = (i + 1) as f64 / n - p;
        if excess > found.excess {
            (found.excess, found.at) = (excess, p);
        }
    }
    // One value has an excess in itself: Massart's bound holds from e^(−2 n D²) ≤ 1/2 on.
    found.p_value = (-2.0 * n * found.excess * found.excess).exp();
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SplitMix;

    /// 4000 tests of 200 values at 5 %: at most 200 alarms are expected, and 150 at least, since
    /// the bound is close to its limit by then; 14 is σ, the bounds stand 5σ beyond.
    #[test]
    fn uniform_values_pass_and_the_level_is_held() {
        let mut random = SplitMix::new(11);
        let mut alarms = 0;
        for _ in 0..4000 {
            let mut values: Vec<f64> = (0..200).map(|_| random.uniform()).collect();
            alarms += u32::from(small_p_values(&mut values).p_value < 0.05);
        }
        assert!((80..=270).contains(&alarms), "{alarms}");
    }

    /// Density 1.2 below 0.5: an excess of 0.1, and e^(−2·1000·0.01) = 2·10⁻⁹. The other way there
    /// is none.
    #[test]
    fn only_small_values_are_found() {
        let mut random = SplitMix::new(5);
        let mut lean = |share: f64| -> Vec<f64> {
            let one = |r: &mut SplitMix| {
                let u = 0.5 * r.uniform();
                if r.uniform() < share { u } else { u + 0.5 }
            };
            (0..1000).map(|_| one(&mut random)).collect()
        };
        assert!(small_p_values(&mut lean(0.6)).p_value < 1e-4);
        assert!(small_p_values(&mut lean(0.4)).p_value > 0.05);
        assert_eq!(small_p_values(&mut []).p_value, 1.0);
    }
}
