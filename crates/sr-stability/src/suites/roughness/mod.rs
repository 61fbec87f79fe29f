//! Roughness: lobes from wide to needle, and what they become below α = 10⁻⁴.

mod distribution;
mod fit;
mod furnace;
mod gold;
mod limit;
mod lobe;

use super::lobes;
use crate::{Effort, Kernels, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let mut all = distribution::sweeps::<K>();
    all.extend(lobe::sweeps::<K>());
    all.extend(fit::sweeps::<K>(effort));
    all.extend(furnace::sweeps::<K>());
    all.push(limit::delta_limit::<K>());
    all.push(gold::small_light::<K>(effort));
    all
}

/// On both sides of the limit of smoothness.
const ALPHAS: [f32; 17] = [
    1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 3e-3, 1e-3, 3e-4, 1.01e-4, 0.99e-4, 3e-5, 1e-5, 1e-6,
    1e-7, 1e-8,
];

/// Where lobes are rough.
fn rough_alphas() -> impl Iterator<Item = f32> {
    ALPHAS.into_iter().filter(|a| *a > 1e-4)
}

/// From where lobes are rough: the range of what only rough lobes have.
const ROUGH: [f64; 2] = [1e-4, 1.0];
/// The range of what holds for smooth lobes too.
const ALL: [f64; 2] = [0.9e-8, 1.0];
