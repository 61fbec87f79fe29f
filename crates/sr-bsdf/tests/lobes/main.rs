//! What every lobe has to hold, tested through the public enum.

mod catalogue;
mod chi2;
mod consistency;
mod continuity;
mod energy;
mod extremes;
mod furnace_tables;
mod precision;
