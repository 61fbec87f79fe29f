//! Random numbers for the kernels, and pixel filters.
//!
//! A number is a pure function of (seed, pixel, sample, dimension). Nothing advances a counter, so a
//! kernel that skips a decision leaves all other decisions as they were, and a picture cannot depend
//! on the order of the work.

mod dim;
mod filter;
mod independent;
mod sampler;
mod sobol;

pub use dim::{BounceDim, Dim};
pub use filter::{Filter, FilterSampler};
pub use independent::IndependentSampler;
pub use sampler::{Sampler, SamplerKind, SamplerSpec};
pub use sobol::SobolSampler;
