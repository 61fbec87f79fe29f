//! Random numbers: at the ends of their range, past the ends of sequences, and against one another.

mod catalogue;
mod choices;
mod ends;
mod points;
mod relations;

use crate::{Effort, Kernels, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    vec![
        ends::warps::<K>(),
        ends::rectangles::<K>(),
        ends::shapes::<K>(),
        ends::lobes::<K>(),
        ends::lights::<K>(),
        ends::camera(),
        choices::choices::<K>(),
        points::nets::<K>(effort),
        points::strata::<K>(effort),
        points::long_sequences::<K>(effort),
        points::end_of_range::<K>(),
        relations::bounces::<K>(effort),
        relations::pixels::<K>(effort),
        relations::seeds::<K>(effort),
        relations::replicas::<K>(effort),
    ]
}
