//! Running suites.

use crate::built_in::Unpacked;
use crate::rendered::rendered;
use crate::{Effort, Suite, Sweep, Verdict};
use serde::Serialize;
use sr_experiment::{Host, PlanError};
use std::path::Path;
use std::time::Instant;

/// What a suite came to.
#[derive(Clone, Debug, Serialize)]
pub struct Checked {
    /// The suite, or the file.
    pub suite: String,
    /// What it is about.
    pub about: String,
    /// Its sweeps, in order.
    pub sweeps: Vec<Sweep>,
    /// How long it took.
    pub seconds: f64,
}

impl Checked {
    /// The worst of its sweeps.
    pub fn verdict(&self) -> Verdict {
        let all = self.sweeps.iter().map(Sweep::verdict);
        all.max().unwrap_or(Verdict::Broken)
    }
}

/// Why a check came to nothing. What is wrong with an input has been told to the host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CheckError {
    /// The input has errors.
    Input {
        /// How many.
        errors: usize,
    },
    /// The input is right, and no check.
    NoCheck(String),
    /// The work failed.
    Work(String),
    /// Somebody asked for an end.
    Interrupted,
}

/// Runs a suite: what is measured in code, and its experiments.
///
/// # Errors
/// As [`CheckError`] says; a broken bound is none.
pub fn check(suite: &Suite, effort: &Effort, host: &dyn Host) -> Result<Checked, CheckError> {
    let begun = Instant::now();
    let mut sweeps = (suite.run)(effort);
    let unpacked = Unpacked::new().map_err(CheckError::Work)?;
    for path in unpacked.experiments(suite.name) {
        if host.stopped() {
            return Err(CheckError::Interrupted);
        }
        sweeps.extend(of_file(&path, effort, host)?.1);
    }
    Ok(Checked {
        suite: suite.name.into(),
        about: suite.about.into(),
        sweeps,
        seconds: begun.elapsed().as_secs_f64(),
    })
}

/// Runs an experiment with `stability`; one that is long whatever the effort, since somebody asked for it.
///
/// # Errors
/// As [`check`], and an experiment without `stability`.
pub fn check_file(path: &Path, host: &dyn Host) -> Result<Checked, CheckError> {
    let begun = Instant::now();
    let (title, sweeps) = of_file(path, &Effort { long: true }, host)?;
    Ok(Checked {
        suite: path.display().to_string(),
        about: title,
        sweeps,
        seconds: begun.elapsed().as_secs_f64(),
    })
}

/// Title and sweeps of an experiment; no sweeps where it is longer than the effort.
fn of_file(
    path: &Path,
    effort: &Effort,
    host: &dyn Host,
) -> Result<(String, Vec<Sweep>), CheckError> {
    let experiment = sr_experiment::read(path).map_err(|problems| {
        problems.iter().for_each(|p| host.diagnose(p));
        CheckError::Input {
            errors: problems.len(),
        }
    })?;
    let Some(stability) = &experiment.stability else {
        return Err(CheckError::NoCheck(format!(
            "`{}` has no `stability`, which says what its pictures should be (see docs/stability.md)",
            path.display()
        )));
    };
    let title = experiment.title.clone();
    if stability.long && !effort.long {
        return Ok((title, Vec::new()));
    }
    let plan = sr_experiment::plan(experiment, host).map_err(|error| match error {
        PlanError::Input { errors } => CheckError::Input { errors },
        PlanError::Pipeline(error) => CheckError::Work(host.explain(error)),
    })?;
    match rendered(&plan, host).map_err(CheckError::Work)? {
        Some(sweeps) => Ok((title, sweeps)),
        None => Err(CheckError::Interrupted),
    }
}
