//! How long until the error is as small as wanted.

use super::curve::{CurveError, Point, Run, all, check, fitted_slope, mean_curve};
use super::log_estimate::LogEstimate;

/// Time (or samples) until the mean error of the runs is `target`, by interpolation between log
/// points in logarithms. Where the curve passes it more than once, the last time counts: from then
/// on it stays below.
///
/// The interval comes from a bootstrap over the runs on the logarithm of the time; resamples that
/// miss the target go on along their fitted line. It covers 92.5–97.5 % in simulations of 8 runs.
/// The speed-up of a method over a baseline is
/// `time_to_error(baseline).ratio(&time_to_error(method))`.
///
/// # Errors
/// Runs without three common log points or logarithms; a target that is not reached, or reached
/// already at the first log point: nothing is extrapolated.
pub fn time_to_error(runs: &[Run], target: f64) -> Result<LogEstimate, CurveError> {
    check(runs, 3)?;
    if !(target.is_finite() && target > 0.0) {
        return Err(CurveError::NotPositive);
    }
    let target = target.ln();
    let curve = mean_curve(runs, &all(runs));
    let (first, last) = (curve[0].1, curve[curve.len() - 1].1);
    if last > target {
        return Err(CurveError::NotReached { last: last.exp() });
    }
    if curve.iter().all(|p| p.1 <= target) {
        return Err(CurveError::AlreadyBelow { first: first.exp() });
    }
    let of = |chosen: &[usize]| crossing(&mean_curve(runs, chosen), target);
    let value = crossing(&curve, target)
        .unwrap_or(curve[curve.len() - 1].0)
        .exp();
    Ok(LogEstimate::bootstrap(value, runs.len(), of))
}

/// ln x of the last crossing; beyond the ends along the fitted line, if that falls.
fn crossing(curve: &[Point], target: f64) -> Option<f64> {
    let above = curve.iter().rposition(|p| p.1 > target);
    let from = match above {
        Some(k) if k + 1 < curve.len() => {
            let (a, b) = (curve[k], curve[k + 1]);
            return Some(a.0 + (b.0 - a.0) * (a.1 - target) / (a.1 - b.1));
        }
        Some(k) => curve[k],
        None => *curve.first()?,
    };
    let slope = fitted_slope(curve);
    (slope < 0.0).then(|| from.0 + (target - from.1) / slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_stats::SplitMix;

    fn exact() -> Run {
        Run {
            x: vec![1.0, 2.0, 4.0, 8.0],
            error: vec![1.0, 0.5, 0.25, 0.125],
        }
    }

    #[test]
    fn times_are_interpolated_in_logarithms() {
        let at = |target| time_to_error(&[exact()], target);
        assert!((at(0.3).unwrap().value - 1.0 / 0.3).abs() < 1e-12);
        assert!((at(0.125).unwrap().value - 8.0).abs() < 1e-12);
        let Err(CurveError::NotReached { last }) = at(0.1) else {
            panic!("it is not reached");
        };
        assert!((last - 0.125).abs() < 1e-15);
        assert_eq!(at(1.0), Err(CurveError::AlreadyBelow { first: 1.0 }));
        assert_eq!(at(0.0), Err(CurveError::NotPositive));
        // Below, above and below again: the last crossing.
        let back = Run {
            x: vec![1.0, 2.0, 4.0, 8.0],
            error: vec![1.0, 0.25, 0.5, 0.125],
        };
        let t = time_to_error(&[back], 0.3).unwrap().value;
        assert!(t > 4.0 && t < 8.0, "{t}");
    }

    /// 1000 experiments of 8 runs of two methods, of which one is 3 times as fast: intervals of the
    /// time and of the speed-up cover the truth in 95 %; σ is 0.7 %, the band 3.6σ.
    #[test]
    fn intervals_cover_the_time_and_the_speed_up() {
        let mut random = SplitMix::new(9);
        let mut method = |seconds: f64| -> Vec<Run> {
            let mut run = || {
                let (noise, clock) = (0.08 * random.normal(), 1.0 + 0.02 * random.normal());
                let mut run = Run::default();
                for k in 0..8 {
                    let n = f64::from(1u32 << k);
                    run.x.push(seconds * n * clock);
                    run.error.push((1.0 + noise + 0.05 * random.normal()) / n);
                }
                run
            };
            (0..8).map(|_| run()).collect()
        };
        let (mut time, mut ratio) = (0, 0);
        for _ in 0..1000 {
            let (slow, fast) = (method(0.3), method(0.1));
            let [slow, fast] = [slow, fast].map(|m| time_to_error(&m, 0.04).unwrap());
            let holds = |e: &LogEstimate, truth: f64| {
                let (low, high) = e.interval().unwrap();
                u32::from(low <= truth && truth <= high)
            };
            time += holds(&fast, 2.5);
            ratio += holds(&slow.ratio(&fast), 3.0);
        }
        assert!((925..=975).contains(&time), "{time}");
        assert!((925..=975).contains(&ratio), "{ratio}");
    }
}
