//! Progress: a bar on a terminal, a line now and then elsewhere.

use crate::units;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sr_pipeline::film_kernel::ErrorEstimate;
use sr_pipeline::{Progress, StopReason};
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Time between two lines when there is no terminal.
const LINE_INTERVAL: Duration = Duration::from_secs(5);

/// Steps of the bar: finer than any terminal shows.
const STEPS: u64 = 1000;

/// Shows where the work is.
pub struct Reporter {
    place: Place,
    /// What is rendered, where there is more than one thing.
    name: String,
    samples: Option<u64>,
    /// The last estimate; it is not made after every pass.
    error: Option<ErrorEstimate>,
}

enum Place {
    /// A terminal; the bar while passes run.
    Terminal(Option<ProgressBar>),
    /// A file or pipe, and when the next line is due.
    Lines(Instant),
    Nowhere,
}

impl Reporter {
    /// For the standard error, or for nothing.
    pub fn new(quiet: bool) -> Self {
        let place = if quiet {
            Place::Nowhere
        } else if std::io::stderr().is_terminal() {
            Place::Terminal(None)
        } else {
            Place::Lines(Instant::now() + LINE_INTERVAL)
        };
        Self {
            place,
            name: String::new(),
            samples: None,
            error: None,
        }
    }

    /// The first pass of one of several renders is about to start.
    pub fn start_named(&mut self, name: &str, samples: Option<u64>) {
        self.name = format!("{name}: ");
        self.error = None;
        self.start(samples);
    }

    /// Shows that something of unknown length goes on.
    pub fn during<T>(&self, what: &'static str, work: impl FnOnce() -> T) -> T {
        if !matches!(self.place, Place::Terminal(_)) {
            return work();
        }
        let spinner = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        spinner.set_style(style("{spinner} {msg} {elapsed}"));
        spinner.set_message(what);
        spinner.enable_steady_tick(Duration::from_millis(100));
        let result = work();
        spinner.finish_and_clear();
        result
    }

    /// The first pass is about to start, of a render of so many samples a pixel, if that is known.
    pub fn start(&mut self, samples: Option<u64>) {
        self.samples = samples;
        if let Place::Terminal(place) = &mut self.place {
            let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
            bar.set_style(style("{bar:16} {percent:>3} %  {wide_msg}"));
            bar.set_message("first pass");
            bar.tick();
            *place = Some(bar);
        }
    }

    /// A pass is done.
    pub fn pass(&mut self, progress: &Progress) {
        self.error = progress.error.or(self.error);
        match &self.place {
            Place::Terminal(Some(bar)) => {
                bar.set_message(self.describe(progress));
                bar.set_position((progress.fraction * STEPS as f64) as u64);
            }
            Place::Lines(due) if Instant::now() >= *due => {
                let percent = (100.0 * progress.fraction) as u32;
                let text = format!("{percent:>3} %  {}", self.describe(progress));
                let _ = writeln!(std::io::stderr().lock(), "{text}");
                self.place = Place::Lines(Instant::now() + LINE_INTERVAL);
            }
            _ => {}
        }
    }

    /// The last pass is done; the bar goes.
    pub fn finish(&mut self) {
        if let Place::Terminal(place) = &mut self.place
            && let Some(bar) = place.take()
        {
            bar.finish_and_clear();
        }
    }

    fn describe(&self, progress: &Progress) -> String {
        let samples = match self.samples {
            Some(total) => format!("{}/{} samples", progress.samples, total),
            None => format!("{} samples", progress.samples),
        };
        // Pixels that are done no longer count.
        let samples = if progress.active < 1.0 {
            let mean = progress.mean_samples;
            let going_on = units::percent(progress.active);
            format!("{samples} ({mean:.1} on average, {going_on} of the pixels go on)")
        } else {
            samples
        };
        // What matters least comes last: a narrow terminal cuts it off.
        let mut parts = vec![samples];
        parts.extend(self.error.as_ref().map(units::error));
        parts.push(units::duration(progress.seconds));
        parts.extend(progress.target.as_ref().map(units::to_target));
        // An end by the error has been told.
        if progress.target.is_none() || progress.ends_by != Some(StopReason::TargetError) {
            let to_go = time_to_go(progress).map(|s| format!("{} to go", units::about(s)));
            parts.extend(to_go);
        }
        format!("{}{}", self.name, parts.join(", "))
    }
}

/// Seconds left, when the share that is done says anything about them.
fn time_to_go(progress: &Progress) -> Option<f64> {
    let done = progress.fraction;
    (done > 0.0 && done < 1.0).then(|| progress.seconds * (1.0 - done) / done)
}

fn style(template: &str) -> ProgressStyle {
    // The templates are constants; a wrong one would show as indicatif's default bar.
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_pipeline::TimeToError;

    fn progress(samples: u64, seconds: f64, fraction: f64) -> Progress {
        Progress {
            samples,
            mean_samples: samples as f64,
            active: 1.0,
            seconds,
            fraction,
            ends_by: None,
            error: None,
            target: None,
        }
    }

    #[test]
    fn a_line_holds_what_is_known() {
        let mut reporter = Reporter::new(true);
        reporter.start(Some(64));
        let text = reporter.describe(&progress(16, 1.0, 0.25));
        assert_eq!(text, "16/64 samples, 1.00 s, 3 s to go");
        reporter.start(None);
        let text = reporter.describe(&progress(16, 1.0, 0.0));
        assert_eq!(text, "16 samples, 1.00 s");
    }

    #[test]
    fn an_estimate_is_kept_until_the_next() {
        let mut reporter = Reporter::new(true);
        let error = ErrorEstimate {
            mse: 1.0,
            relmse: 0.25,
            relmse_std_error: Some(0.03),
            pixels: 1,
            unknown_pixels: 0,
        };
        reporter.pass(&Progress {
            error: Some(error),
            ..progress(8, 1.0, 0.0)
        });
        reporter.pass(&progress(9, 1.0, 0.0));
        let text = reporter.describe(&progress(9, 1.0, 0.0));
        assert_eq!(text, "9 samples, relMSE ≈ 0.25 ± 0.03, 1.00 s");
    }

    #[test]
    fn the_next_error_is_told_and_the_end_once() {
        let mut reporter = Reporter::new(true);
        let error = ErrorEstimate {
            mse: 1.0,
            relmse: 0.003_1,
            relmse_std_error: Some(0.000_2),
            pixels: 1,
            unknown_pixels: 0,
        };
        let now = Progress {
            error: Some(error),
            target: Some(TimeToError {
                relmse: 0.001,
                seconds: 39.5,
            }),
            ..progress(64, 12.4, 0.25)
        };
        reporter.pass(&now);
        let known = "64 samples, relMSE ≈ 0.0031 ± 0.0002, 12.4 s, ~40 s to 0.001";
        let by = |ends_by| Progress { ends_by, ..now };
        let text = reporter.describe(&by(Some(StopReason::Seconds)));
        assert_eq!(text, format!("{known}, 38 s to go"));
        // The error is the end.
        let text = reporter.describe(&by(Some(StopReason::TargetError)));
        assert_eq!(text, known);
    }
}
