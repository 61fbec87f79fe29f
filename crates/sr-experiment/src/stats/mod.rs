//! What several runs say together: means, slopes, efficiencies, speed-ups, each with its interval.
//!
//! Pure functions of numbers (and, in [`noise`], of pictures in memory). Runs differ in their seeds
//! only; what varies among them is all that is known about how certain a figure is. Intervals hold
//! what they are intervals of with probability [`CONFIDENCE`]: tested by simulation, as each
//! function says.

mod curve;
mod log_estimate;
mod mean;
mod noise;
mod slope;
mod time_to;

pub use curve::{CurveError, Run};
pub use log_estimate::{LogEstimate, efficiency};
pub use mean::{CONFIDENCE, Mean, mean};
pub use noise::{Noise, NoiseError, Split, mean_variance, noise, split};
pub use slope::{FLATTENING_LEVEL, Flattening, Slope, slope};
pub use time_to::time_to_error;
