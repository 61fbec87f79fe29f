//! Scale and place: rooms of any size, anywhere, and shapes that are hard to hit. That a room of known radiance keeps it
//! is in the experiments of `configs/stability/scale`.

mod degenerate;
mod place;
mod room;
mod shapes;
mod walk;

use crate::{Effort, Kernels, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let mut all = walk::sweeps::<K>(effort);
    all.extend(place::sweeps::<K>());
    all.extend(shapes::sweeps::<K>());
    all.push(degenerate::sweep::<K>());
    all
}

/// Powers of ten.
fn decades(from: i32, to: i32) -> impl Iterator<Item = f64> {
    (from..=to).map(|k| 10f64.powi(k))
}
