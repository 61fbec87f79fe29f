//! What is printed, and where to.

use std::fmt;
use std::io::Write;

/// Results go to the standard output, the rest to the standard error; `quiet` keeps errors only.
///
/// A reader that has gone away (`steradian list settings | head`) is no failure.
pub struct Console {
    /// Errors only.
    pub quiet: bool,
}

impl Console {
    /// A line of results.
    pub fn say(&self, text: impl fmt::Display) {
        if !self.quiet {
            let _ = writeln!(std::io::stdout().lock(), "{text}");
        }
    }

    /// A warning, a notice or progress.
    pub fn note(&self, text: impl fmt::Display) {
        if !self.quiet {
            self.error(text);
        }
    }

    /// An error.
    pub fn error(&self, text: impl fmt::Display) {
        let _ = writeln!(std::io::stderr().lock(), "{text}");
    }
}
