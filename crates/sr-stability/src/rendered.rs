//! Sweeps from experiment files: pictures whose mean is known.

use crate::{Point, Sweep};
use sr_experiment::document::{Stability, Truth};
use sr_experiment::{Host, PictureMean, Plan, picture_mean};

/// Four standard errors: a mean of pixels is normal enough that 1 of 16 000 strays further.
const SIGMAS: f64 = 4.0;

/// Makes every run of an experiment with `stability` and holds its means against the truth: a sweep, or one
/// each method. `None` when it was interrupted.
///
/// # Errors
/// An experiment that is no check, or a run that failed.
pub fn rendered(plan: &Plan, host: &dyn Host) -> Result<Option<Vec<Sweep>>, String> {
    let Some(stability) = &plan.experiment.stability else {
        return Err("the experiment has no `stability`, which says what is to be true".into());
    };
    let mut means: Vec<Vec<PictureMean>> = vec![Vec::new(); plan.points.len()];
    for (number, run) in plan.runs.iter().enumerate() {
        match picture_mean(plan, number, host)? {
            Some(mean) => means[run.point].push(mean),
            None => return Ok(None),
        }
    }
    let means: Vec<PictureMean> = means.iter().map(|m| pooled(m)).collect();
    let methods = plan.experiment.methods.len().max(1);
    let sweeps = (0..methods).map(|m| {
        let truth = |value: usize| match &stability.truth {
            Truth::Mean(means) => (means[value], 0.0),
            // With methods the first of the same value, otherwise the first value.
            Truth::First => {
                let first = &means[if methods > 1 { value * methods } else { 0 }];
                (first.mean, first.std_error)
            }
        };
        let points = stability
            .at
            .iter()
            .enumerate()
            .map(|(value, at)| point(*at, &means[value * methods + m], truth(value)));
        sweep(plan, stability, m, points.collect())
    });
    // A method is no check of itself.
    let itself = usize::from(methods > 1 && stability.truth == Truth::First);
    Ok(Some(sweeps.skip(itself).collect()))
}

/// The mean over seeds.
fn pooled(of_seeds: &[PictureMean]) -> PictureMean {
    let n = of_seeds.len() as f64;
    let sum = |of: fn(&PictureMean) -> f64| of_seeds.iter().map(of).sum::<f64>();
    PictureMean {
        mean: sum(|m| m.mean) / n,
        std_error: sum(|m| m.std_error * m.std_error).sqrt() / n,
        rejected: of_seeds.iter().map(|m| m.rejected).sum(),
    }
}

fn point(at: f64, found: &PictureMean, (truth, truth_error): (f64, f64)) -> Point {
    let error = match found.rejected {
        0 => ((found.mean - truth) / truth).abs(),
        _ => f64::INFINITY,
    };
    let half_width = SIGMAS * found.std_error.hypot(truth_error) / truth;
    let worst = match found.rejected {
        0 => format!("mean {:.6}, should be {truth:.6}", found.mean),
        n => format!("{n} samples were refused"),
    };
    Point::new(at, error, worst).with_half_width(half_width)
}

fn sweep(plan: &Plan, stability: &Stability, method: usize, points: Vec<Point>) -> Sweep {
    let experiment = &plan.experiment;
    let stem = experiment.stem();
    let name = match experiment.methods.get(method) {
        Some(method) => format!("{stem}_{}", method.label.replace(' ', "_")),
        None => stem,
    };
    Sweep {
        name,
        about: experiment.title.clone(),
        parameter: stability.parameter.clone(),
        error: "relative error of the picture's mean".into(),
        bound: stability.bound,
        holds: stability.holds,
        points,
    }
}
