//! Which samples come next, and when to stop.

use crate::adapt::DecisionPoints;
use crate::log_points::{LogPoints, Marks};
use crate::pace::Pace;
use crate::pass::{PassSpec, StopReason, TimeToError, most_samples};
use sr_render::film::ErrorEstimate;
use sr_scene::settings::{AdaptiveSettings, Budget};

/// Passes are sized to take about this long, so that progress shows and time budgets are met.
const PASS_SECONDS: f64 = 0.5;

/// Most samples a pixel in one pass: between two passes a render can be stopped.
const MAX_PASS_SAMPLES: u64 = 64;

/// An estimate from fewer samples a pixel is not trusted to end a render.
const FEWEST_SAMPLES: u64 = 8;

/// The error is looked at after this part of the samples so far, at the earliest: each look is one
/// more chance to stop by luck.
const LOOKS_PER_SAMPLES: u64 = 16;

/// The state of the pass loop.
pub(crate) struct PassPlanner {
    budget: Budget,
    decisions: Option<DecisionPoints>,
    doublings: bool,
    marks: Marks,
    samples: u64,
    /// Share of the pixels that the next pass samples.
    active: f64,
    /// Samples a pixel on average.
    mean_samples: f64,
    seconds: f64,
    pace: Pace,
    /// The last pass ended at a log point.
    at_log_point: bool,
    /// The last estimate of relMSE that is above 0, and the samples a pixel that it had.
    error: Option<(f64, f64)>,
}

impl PassPlanner {
    pub fn new(budget: &Budget, adaptive: &AdaptiveSettings, log: &LogPoints) -> Self {
        Self {
            budget: Budget {
                samples: most_samples(budget, adaptive),
                ..budget.clone()
            },
            decisions: DecisionPoints::new(adaptive),
            doublings: log.doublings,
            marks: Marks::new(log),
            samples: 0,
            active: 1.0,
            mean_samples: 0.0,
            seconds: 0.0,
            pace: Pace::default(),
            at_log_point: false,
            error: None,
        }
    }

    /// The next pass, or why there is none.
    pub fn next(&self) -> Result<PassSpec, StopReason> {
        let mut samples = self.wanted();
        // Whatever the clock says: two renders of the same have these log points at the same counts.
        if self.doublings {
            samples = samples.min((self.samples + 1).next_power_of_two().max(2) - self.samples);
        }
        if let Some(total) = self.budget.samples {
            let left = total.saturating_sub(self.samples);
            if left == 0 {
                return Err(StopReason::Samples);
            }
            samples = samples.min(left);
        }
        if let (Some(limit), Some(s)) = (self.budget.seconds, self.sample_seconds()) {
            let fits = ((limit - self.seconds) / s) as u64;
            if fits == 0 {
                return Err(StopReason::Seconds);
            }
            samples = samples.min(fits);
        }
        if let (Some(mark), Some(s)) = (self.marks.next(), self.sample_seconds()) {
            let reaches = ((mark - self.seconds) / s).ceil() as u64;
            samples = samples.min(reaches.max(1));
        }
        if let Some(look) = self.samples_to_look() {
            samples = samples.min(look);
        }
        if let Some(decisions) = &self.decisions {
            samples = samples.min(decisions.after(self.samples) - self.samples);
        }
        Ok(PassSpec {
            first_sample: self.samples,
            samples: samples.min(u64::from(u32::MAX)) as u32,
        })
    }

    /// Samples of a pass that nothing cuts.
    fn wanted(&self) -> u64 {
        let samples = match self.sample_seconds() {
            // The first pass tells how long a sample takes. Only a plain number of samples needs
            // no such knowledge.
            None if self.budget.pass_samples.is_none() || self.is_open_ended() => 2,
            None => MAX_PASS_SAMPLES,
            Some(s) => {
                let fits = (PASS_SECONDS / s) as u64;
                let grown = self.max_pass().min(2 * self.samples.max(1));
                fits.clamp(1, grown)
            }
        };
        let Some(limit) = self.budget.pass_samples else {
            return samples;
        };
        let limit = u64::from(limit.max(1)).min(MAX_PASS_SAMPLES);
        if self.is_open_ended() {
            samples.min(limit)
        } else {
            limit
        }
    }

    /// Few pixels take more samples each: a pass is as long, and its waves are as full.
    fn max_pass(&self) -> u64 {
        const MOST: f64 = 4096.0;
        (MAX_PASS_SAMPLES as f64 / self.active).min(MOST) as u64
    }

    /// Time or error may end the render between any two passes, or a time mark cuts them.
    fn is_open_ended(&self) -> bool {
        self.budget.seconds.is_some()
            || self.budget.target_error.is_some()
            || self.marks.next().is_some()
    }

    /// Seconds that the next sample will take, of the pixels that go on.
    fn sample_seconds(&self) -> Option<f64> {
        let pace = self.pace.seconds_a_sample()?;
        Some((pace * self.active).max(f64::MIN_POSITIVE))
    }

    /// Samples until the error is worth a look, when it decides: half of what is missing by error ∝
    /// 1/samples, since it may fall faster.
    fn samples_to_look(&self) -> Option<u64> {
        self.budget.target_error?;
        let missing = self.missing_samples(self.budget.target_error?)?;
        let half = (0.5 * missing / self.active).ceil() as u64;
        let untrusted = FEWEST_SAMPLES.saturating_sub(self.samples);
        Some(
            half.max(self.samples / LOOKS_PER_SAMPLES)
                .max(untrusted)
                .max(1),
        )
    }

    /// Samples a pixel on average that an error is away, by error ∝ 1/samples.
    fn missing_samples(&self, relmse: f64) -> Option<f64> {
        let (error, samples) = self.error?;
        Some((samples * error / relmse - self.mean_samples).max(0.0))
    }

    /// A pass is done, after which a share of `active` of the pixels goes on.
    pub fn done(&mut self, pass: PassSpec, seconds: f64, active: f64) {
        let before = self.samples;
        let work = f64::from(pass.samples) * self.active;
        self.samples += u64::from(pass.samples);
        self.mean_samples += work;
        self.seconds += seconds;
        self.pace.add(work, seconds);
        self.active = active;
        let doubled = before.max(1).ilog2() < self.samples.max(1).ilog2();
        let at_mark = self.marks.pass(self.seconds);
        self.at_log_point = at_mark || (self.doublings && doubled);
    }

    /// The film has been looked at.
    pub fn estimated(&mut self, estimate: &ErrorEstimate) {
        if estimate.relmse > 0.0 && estimate.relmse.is_finite() {
            self.error = Some((estimate.relmse, self.mean_samples));
        }
    }

    /// No pixel wants more samples.
    pub fn is_converged(&self) -> bool {
        self.active == 0.0
    }

    /// Share of the pixels that go on.
    pub fn active(&self) -> f64 {
        self.active
    }

    /// Samples a pixel so far.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Samples a pixel so far, on average.
    pub fn mean_samples(&self) -> f64 {
        self.mean_samples
    }

    /// The last pass ended at a doubling of the samples or at a time mark.
    pub fn at_log_point(&self) -> bool {
        self.at_log_point
    }

    /// The film is worth a look: at log points, and after every pass when the error decides.
    pub fn wants_estimate(&self) -> bool {
        self.at_log_point || self.budget.target_error.is_some()
    }

    /// The error is good enough.
    pub fn reached(&self, estimate: &ErrorEstimate) -> bool {
        let target = self.budget.target_error;
        self.samples >= FEWEST_SAMPLES && target.is_some_and(|t| estimate.relmse <= t)
    }

    /// The next error to wait for: the budget's, or a power of ten.
    pub fn target(&self) -> Option<TimeToError> {
        let (error, samples) = self.error?;
        let now = error * samples / self.mean_samples;
        let relmse = match self.budget.target_error {
            Some(target) => target,
            None => power_of_ten_below(now),
        };
        let seconds = self.pace.seconds_a_sample()? * self.missing_samples(relmse)?;
        // An error too small for a float has no target below it.
        (relmse > 0.0 && seconds.is_finite()).then_some(TimeToError { relmse, seconds })
    }

    /// Share of the budget used up, by whichever part of it ends first, and which.
    pub fn fraction(&self, error: Option<&ErrorEstimate>) -> (f64, Option<StopReason>) {
        let samples = self
            .budget
            .samples
            .map(|n| 1.0 - self.active * (1.0 - self.samples as f64 / n.max(1) as f64));
        let seconds = self.budget.seconds.map(|s| self.seconds / s);
        // Error falls as 1/samples, so its share of the way is target over error.
        let error = self
            .budget
            .target_error
            .zip(error)
            .map(|(t, e)| t / e.relmse.max(f64::MIN_POSITIVE));
        let parts = [
            (samples, StopReason::Samples),
            (seconds, StopReason::Seconds),
            (error, StopReason::TargetError),
        ];
        let known = parts
            .into_iter()
            .filter_map(|(f, reason)| Some((f?, reason)));
        let most = known.max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or((0.0, None), |(f, reason)| (f.clamp(0.0, 1.0), Some(reason)))
    }

    /// Seconds of integration beyond the budget's, of a render that `reason` ended: below 0 when the
    /// next pass would not have fitted. Unset where time neither ended it nor was overrun.
    pub fn over_budget(&self, reason: StopReason) -> Option<f64> {
        let over = self.seconds - self.budget.seconds?;
        (reason == StopReason::Seconds || over > 0.0).then_some(over)
    }
}

/// The largest power of ten below `x`.
fn power_of_ten_below(x: f64) -> f64 {
    let power = 10f64.powi(x.log10().ceil() as i32 - 1);
    // Where the logarithm was rounded up to a whole number.
    if power < x { power } else { power / 10.0 }
}

#[cfg(test)]
mod tests;
