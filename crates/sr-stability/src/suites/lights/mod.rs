//! Lights: as large as half the world and too small to see, near and far, bright and dark.

mod irradiance;
mod maps;
mod pictures;
mod samples;

use crate::{Effort, Kernels, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let mut all = irradiance::sweeps::<K>(effort);
    all.extend(samples::sweeps::<K>());
    all.extend(maps::sweeps::<K>(effort));
    all.extend(pictures::sweeps());
    all
}
