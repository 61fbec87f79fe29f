//! Is the picture right? Against closed forms, and method against method.

#![allow(
    clippy::print_stderr,
    reason = "a comparison's figures are worth reading when it passes, too"
)]

mod adaptive;
mod agreement;
mod clamp;
mod convergence;
mod edges;
mod environment;
mod estimate;
mod facets;
mod furnace;
mod lens;
mod light_sampling;
mod references;
mod strangers;
