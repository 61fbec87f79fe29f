//! Camera and film: angles of view from nothing to half the world, lenses of any size and focus, pictures of any shape.

mod lens;
mod pictures;
mod view;

use crate::{Kernels, Sweep};

pub(super) fn run<K: Kernels>() -> Vec<Sweep> {
    let mut all = view::sweeps::<K>();
    all.extend(lens::sweeps::<K>());
    all.extend(pictures::sweeps::<K>());
    all
}
