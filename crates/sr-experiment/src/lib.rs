//! Experiments: many runs from one file, measured, as rows of data and a contact sheet.
//!
//! [`read`] reads the file, [`plan`](plan()) looks at every run before any is made, [`estimate`] says
//! what they will cost, and [`run`](run()) makes them in turns and writes what they came to. The
//! program around it is a [`Host`], so that integrators of strangers run here as anywhere.
//!
//! Measuring is there by itself too: [`compare`] gives every pointwise metric of two pictures of the
//! same size at once, ready for text ([`Comparison::describe`]) and JSON (it is `serde::Serialize`);
//! the metrics are there one by one as well, each with its definition, and so are ꟻLIP ([`ldr_flip`],
//! [`hdr_flip`]) and errors without the reference's noise ([`debiased`]). [`same`] asks whether two
//! methods have the same expected picture; [`stats`] has means, slopes, efficiencies and speed-ups
//! with their intervals.

pub mod analysis;
pub mod document;
mod estimate;
pub mod expand;
mod folder;
mod grid;
mod host;
mod machine;
mod mean;
mod measure;
mod metric;
mod metrics;
mod pictures;
mod plan;
mod reference;
pub mod report;
mod results;
mod resume;
mod run;
pub mod same;
mod seen;
mod session;
mod sheet;
pub mod stats;
pub mod units;
mod words;

pub use document::{EXTENSION, Experiment, read};
pub use estimate::{Cost, Costs, estimate};
pub use folder::{
    CSV, FIGURE, Folder, JSON, PAGE, PLOTS, REFERENCES, RUNS, SHEET, TEX, check_folder,
};
pub use host::Host;
pub use machine::Machine;
pub use mean::{PictureMean, picture_mean};
pub use measure::{ErrorSource, LogPoint};
pub use metric::Metric;
pub use metrics::{
    CompareError, Comparison, Debiased, ErrorMap, HdrFlip, NOISE_LIMIT, PIXELS_PER_DEGREE,
    PPD_RANGE, PixelError, RELATIVE_OFFSET, Scale, TRIMMED_PART, compare, debiased, error_map,
    hdr_flip, ldr_flip, mape, mean_error, mse, relmse, relmse_trimmed, smape,
};
pub use plan::{Facts, Plan, PlanError, RenderedReference, plan};
pub use reference::{Attempt, Reference, ReferenceFacts};
pub use results::VERSION;
pub use resume::resume;
pub use run::{Done, Failed, Outcome, run, write_text};
pub use sr_film::RELMSE_OFFSET;
pub use words::run as name_of_run;
