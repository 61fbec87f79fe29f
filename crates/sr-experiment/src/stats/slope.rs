//! How fast an error falls: the slope of its curve in logarithms, and whether it flattens.

use super::curve::{CurveError, Run, all, check, fitted_slope, mean_curve};
use super::mean::CONFIDENCE;
use serde::Serialize;
use sr_stats::{bootstrap_std_error, student_cdf, student_quantile};

/// False-alarm rate of [`Flattening::found`].
pub const FLATTENING_LEVEL: f64 = 0.01;

/// Seed of the bootstraps: results are a function of the runs alone.
const SEED: u64 = 0x5107e;

/// Log points that [`Flattening`] takes.
const FLATTENING_POINTS: usize = 6;

/// A fitted slope d ln(error) / d ln(x).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Slope {
    /// By least squares on the mean curve of all runs: −1 for MSE against samples of independent
    /// sampling, steeper for better distributed samples.
    pub slope: f64,
    /// Ends of the interval; `None` for a single run.
    pub interval: Option<(f64, f64)>,
    /// Whether it flattens; `None` with fewer than three runs or six log points.
    pub flattening: Option<Flattening>,
}

/// Whether an error stops falling, as it does when it nears a bias or the noise of the reference.
///
/// The slope of the last third of the log points (at least three) is compared with half of the
/// slope of the first half. It flattens if the late slope is above that by Student's t over the
/// runs, one-sided at [`FLATTENING_LEVEL`]: the error falls less than half as steeply as it did,
/// and that is no chance. A curve whose slope has just halved is reported at that rate, a straight
/// one practically never; low-discrepancy sampling that goes over from −1.5 to −1 is not reported.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Flattening {
    /// Slope of the first half of the log points.
    pub early: f64,
    /// Slope of the last third.
    pub late: f64,
    /// Probability of a late slope so far above half of the early one, or farther, if it is not.
    pub p_value: f64,
    /// Whether that is below [`FLATTENING_LEVEL`] and the error did fall at first.
    pub found: bool,
}

/// The slope of an error against samples or time over several runs.
///
/// The interval is the slope ± Student's quantile × the bootstrap's standard error over the runs
/// ([`bootstrap_std_error`]). By simulation with runs of noise correlated along the curve it
/// covers 92.5–97.5 % from 4 runs on.
///
/// # Errors
/// Runs without three common log points, or what has no logarithm.
pub fn slope(runs: &[Run]) -> Result<Slope, CurveError> {
    check(runs, 3)?;
    let of = |chosen: &[usize]| Some(fitted_slope(&mean_curve(runs, chosen)));
    let slope = fitted_slope(&mean_curve(runs, &all(runs)));
    let interval = bootstrap_std_error(runs.len(), SEED, of).map(|e| {
        let half = student_quantile(0.5 + 0.5 * CONFIDENCE, runs.len() as f64 - 1.0) * e;
        (slope - half, slope + half)
    });
    Ok(Slope {
        slope,
        interval,
        flattening: flattening(runs),
    })
}

fn flattening(runs: &[Run]) -> Option<Flattening> {
    let points = runs[0].x.len();
    if runs.len() < 3 || points < FLATTENING_POINTS {
        return None;
    }
    let slopes = |chosen: &[usize]| {
        let curve = mean_curve(runs, chosen);
        let last = (points / 3).max(3);
        (
            fitted_slope(&curve[..points.div_ceil(2)]),
            fitted_slope(&curve[points - last..]),
        )
    };
    let above = |(early, late): (f64, f64)| late - 0.5 * early;
    let (early, late) = slopes(&all(runs));
    let error = bootstrap_std_error(runs.len(), SEED, |c| Some(above(slopes(c))))?;
    let t = above((early, late)) / error;
    // Runs without any spread decide by the sign alone.
    let p_value = if t.is_nan() {
        1.0
    } else {
        student_cdf(-t, runs.len() as f64 - 1.0)
    };
    Some(Flattening {
        early,
        late,
        p_value,
        found: early < 0.0 && p_value < FLATTENING_LEVEL,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_stats::SplitMix;

    /// A run of an error with expectation 1/n^power + floor at 1, 2, 4 … samples: like a picture's
    /// MSE its relative noise goes along the curve, since later points contain the earlier samples.
    fn run(power: f64, floor: f64, points: usize, random: &mut SplitMix) -> Run {
        let mut noise = 0.05 * random.normal();
        let (mut x, mut error) = (Vec::new(), Vec::new());
        for k in 0..points {
            let n = f64::from(1u32 << k);
            noise = 0.7 * noise + 0.05 * 0.51f64.sqrt() * random.normal();
            x.push(n);
            error.push(n.powf(-power) * (1.0 + noise) + floor);
        }
        Run { x, error }
    }

    fn runs(count: usize, power: f64, floor: f64, random: &mut SplitMix) -> Vec<Run> {
        (0..count).map(|_| run(power, floor, 11, random)).collect()
    }

    #[test]
    fn a_power_law_has_its_exponent() {
        let exact = Run {
            x: vec![1.0, 2.0, 4.0, 8.0],
            error: vec![1.0, 0.5, 0.25, 0.125],
        };
        let found = slope(&[exact]).unwrap();
        assert!((found.slope + 1.0).abs() < 1e-12);
        assert_eq!((found.interval, found.flattening), (None, None));
    }

    /// 1000 experiments a row: 95 % of the intervals should hold the exponent; σ is 0.7 %, and the
    /// band of 92.5–97.5 % is 3.6σ wide on either side. An interval by the normal quantile covers
    /// 85 % at 4 runs.
    #[test]
    fn intervals_cover_the_slope() {
        let mut random = SplitMix::new(1);
        for count in [4, 8] {
            let mut covered = 0;
            for _ in 0..1000 {
                let (low, high) = slope(&runs(count, 1.0, 0.0, &mut random))
                    .unwrap()
                    .interval
                    .unwrap();
                covered += u32::from(low <= -1.0 && -1.0 <= high);
            }
            assert!((925..=975).contains(&covered), "{count} runs: {covered}");
        }
    }

    /// A floor where the noise is 1/32 of the start is always found, with 5 runs of 11 points;
    /// straight curves of slope −1 and −1.5 and one that bends from −1.5 to −1 never in 500
    /// experiments each (rate below 1 %: the slopes are ten standard errors from half).
    #[test]
    fn flattening_is_found_and_bending_is_not() {
        let mut random = SplitMix::new(2);
        let mut found = |power: f64, floor: f64, bend: bool| {
            let mut count = 0;
            for _ in 0..500 {
                let mut runs = runs(5, power, floor, &mut random);
                if bend {
                    for r in &mut runs {
                        for (x, e) in r.x.iter().zip(&mut r.error) {
                            *e += 0.1 / x;
                        }
                    }
                }
                count += u32::from(slope(&runs).unwrap().flattening.unwrap().found);
            }
            count
        };
        assert_eq!(found(1.0, 1.0 / 32.0, false), 500);
        assert_eq!(found(1.0, 0.0, false), 0);
        assert_eq!(found(1.5, 0.0, true), 0);
    }

    /// At the border, a slope of −1 that becomes −1/2, the rate is the level: 2000 experiments of 6
    /// runs give 20 ± 4.5; the bound is 5σ.
    #[test]
    fn the_false_alarm_rate_at_the_border_is_the_level() {
        let mut random = SplitMix::new(3);
        let mut alarms = 0;
        for _ in 0..2000 {
            let mut runs = runs(6, 1.0, 0.0, &mut random);
            for r in &mut runs {
                // From the eighth point on: the first half of 11 ends with the sixth.
                for (x, e) in r.x.iter().zip(&mut r.error).skip(7) {
                    *e *= (x / 128.0).sqrt();
                }
            }
            alarms += u32::from(slope(&runs).unwrap().flattening.unwrap().found);
        }
        assert!(alarms <= 43, "{alarms}");
    }

    #[test]
    fn what_has_no_slope_says_why() {
        let good = Run {
            x: vec![1.0, 2.0, 4.0],
            error: vec![3.0, 2.0, 1.0],
        };
        let with = |change: &dyn Fn(&mut Run)| {
            let mut run = good.clone();
            change(&mut run);
            slope(&[good.clone(), run]).unwrap_err()
        };
        assert_eq!(slope(&[]), Err(CurveError::NoRuns));
        assert_eq!(with(&|r| r.error[1] = 0.0), CurveError::NotPositive);
        assert_eq!(with(&|r| r.x[1] = 1.0), CurveError::NotPositive);
        assert_eq!(with(&|r| r.error[2] = f64::NAN), CurveError::NotPositive);
        assert_eq!(with(&|r| r.x.truncate(2)), CurveError::LengthsDiffer);
        let short = Run {
            x: vec![1.0, 2.0],
            error: vec![2.0, 1.0],
        };
        assert_eq!(slope(&[short]), Err(CurveError::TooFewPoints { needed: 3 }));
    }
}
