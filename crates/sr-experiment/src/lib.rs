//! Measuring: how far a picture is from a reference.
//!
//! [`compare`] gives every metric of two pictures of the same size at once, ready for text
//! ([`Comparison::describe`]) and JSON (it is `serde::Serialize`); the metrics are there one by one
//! as well, each with its definition.

mod metrics;

pub use metrics::{CompareError, Comparison, RELATIVE_OFFSET, compare, mape, mse, relmse, smape};
pub use sr_film::RELMSE_OFFSET;
