//! The health of one scene: what its samples look like, whoever made them.
//!
//! Every sample is traced as `render --replay` would trace it, under a record, and what matters of it is
//! counted: whether the film takes it, how bright it is, how its path ended. So the render itself need not be
//! slowed by any of this. Of integrators that cannot trace a single sample, passes of one sample are looked at.

mod examine;
mod findings;
mod found;
mod grid;
mod moments;
mod passes;
mod report;
mod route;
mod survey;
mod tally;
mod top;
mod words;

pub use examine::{Examination, examine};
pub use found::{
    BounceLight, BrightSample, Brightest, Condition, Ended, Finding, FirstDefect, Health, Kurtosis,
    Paths, Rejected, RejectedKind, UnevenPixel,
};
pub use report::SceneReport;
pub use route::Kind;

/// Somebody asked for an end.
struct Stopped;
