//! Why a command ends without having done its work, and the exit status that says so.

use crate::panics;
use sr_pipeline::PipelineError;
use std::fmt;
use std::process::ExitCode;

/// A failed command.
#[derive(Debug)]
pub enum Failure {
    /// Bad usage or bad input.
    Input(String),
    /// The work itself failed.
    Work(String),
}

impl Failure {
    /// A panic that no stage caught.
    pub fn bug() -> Self {
        let what = panics::take().unwrap_or_else(|| "unknown cause".into());
        Self::Work(format!("a bug in the program: {what}"))
    }

    /// The contract with scripts: 1 for work, 2 for input.
    pub fn status(&self) -> ExitCode {
        match self {
            Self::Work(_) => ExitCode::from(1),
            Self::Input(_) => ExitCode::from(2),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(message) | Self::Work(message) => f.write_str(message),
        }
    }
}

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        match error {
            PipelineError::Input { .. } => Self::Input(error.to_string()),
            // A stage that panicked says only that it did; the hook heard why.
            PipelineError::Stage(_) | PipelineError::Threads(_) => {
                Self::Work(match panics::take() {
                    Some(panic) if error.to_string().contains("panicked") => {
                        format!("{error}: {panic}")
                    }
                    _ => error.to_string(),
                })
            }
        }
    }
}
