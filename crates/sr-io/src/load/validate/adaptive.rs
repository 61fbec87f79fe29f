//! Adaptive sampling, and the replicas that it needs.

use super::super::session::Session;
use super::complaint;
use sr_scene::diagnostics::Diagnostic;
use sr_scene::settings::{AdaptiveRule, AdaptiveSettings, Budget, SamplerName, SamplerSettings};

/// Replicas of an adaptive render whose author says nothing of them: each decides by the seven others.
/// With four the interval of three would be very wide; sixteen leave a low-discrepancy sequence few
/// points each.
const FOLDS: u32 = 8;

/// The longest way between two decisions: more is taken for a slip.
const MAX_BATCH: u32 = 65_536;

impl Session<'_> {
    pub(super) fn check_adaptive(&mut self) {
        let adaptive = self.world.resource::<AdaptiveSettings>().clone();
        self.check_adaptive_numbers(&adaptive);
        if adaptive.rule == AdaptiveRule::Folds {
            self.check_folds();
        }
        let samples = self.world.resource::<Budget>().samples;
        let fewest = match adaptive.rule {
            AdaptiveRule::Off => 0,
            AdaptiveRule::Folds => u64::from(adaptive.min_samples.max(adaptive.batch)),
            AdaptiveRule::Course => u64::from(adaptive.batch),
        };
        if let Some(samples) = samples.filter(|n| *n <= fewest) {
            let message = format!(
                "nothing can be adaptive: the first decision falls at {fewest} samples, and \
                 `budget.samples` is {samples}"
            );
            let field = "adaptive.rule";
            let place = self.places.find(field).cloned();
            let diagnostic = Diagnostic::warning(message).at(place).field(field);
            let hint = "raise `budget.samples` (`--spp`), which is the most that a pixel gets";
            self.diagnostics.push(diagnostic.hint(hint));
        }
    }

    fn check_adaptive_numbers(&mut self, adaptive: &AdaptiveSettings) {
        let AdaptiveSettings {
            tolerance,
            confidence,
            batch,
            block,
            floor,
            ..
        } = *adaptive;
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            let message = format!("{tolerance} must be finite and above 0");
            self.invalid_setting("adaptive.tolerance", complaint(message));
        }
        if !(0.5..=0.9999).contains(&confidence) {
            let message = format!("{confidence} must be between 0.5 and 0.9999");
            self.invalid_setting("adaptive.confidence", complaint(message));
        }
        if !(1..=MAX_BATCH).contains(&batch) {
            let message = format!("{batch} must be between 1 and {MAX_BATCH}");
            self.invalid_setting("adaptive.batch", complaint(message));
        }
        if !block.is_power_of_two() || block > 16 {
            let message = format!("{block} must be one of 1, 2, 4, 8 and 16");
            self.invalid_setting("adaptive.block", complaint(message));
        }
        if !(floor >= 0.0 && floor.is_finite()) {
            let message = format!("{floor} must be finite and not below 0");
            self.invalid_setting("adaptive.floor", complaint(message));
        }
    }

    /// Folds are replicas. Who says nothing of them gets enough, who says too few is told.
    fn check_folds(&mut self) {
        let sampler = self.world.resource::<SamplerSettings>().clone();
        let field = "sampler.replicas";
        if !self.places.is_set(field) {
            self.world.resource_mut::<SamplerSettings>().replicas = FOLDS;
            return;
        }
        // The variance of the means of all replicas but one takes three; that of samples takes one.
        let fewest = match sampler.kind {
            SamplerName::Sobol => 4,
            SamplerName::Independent => 2,
        };
        if sampler.replicas < fewest {
            let message = format!(
                "{} is too few for adaptive sampling with `{:?}`: it takes {fewest}",
                sampler.replicas, sampler.kind
            );
            let hint = Some("leave it out, which means 8, or write 4, 8 or 16");
            self.invalid_setting(field, (message, hint));
        }
    }
}
