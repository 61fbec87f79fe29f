//! Grazing: directions that nearly touch the surface, the critical angle, and normals that face away.

mod critical;
mod energy;
mod fresnel;
mod lobe;
mod normals;

use super::lobes;
use crate::{Effort, Kernels, Sweep};

pub(super) fn run<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let mut all = lobe::sweeps::<K>();
    all.push(energy::furnace::<K>());
    all.extend(fresnel::sweeps::<K>());
    all.extend(critical::sweeps::<K>());
    all.extend(normals::sweeps(effort));
    all
}

/// From the axis to what counts as tangent: below 10⁻¹⁹ a squared cosine is no normal number, and a direction has no
/// side.
const COSINES: [f32; 15] = [
    1.0, 0.5, 0.2, 0.05, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-15, 1e-18, 1e-30,
];

/// All of them.
const EVERYWHERE: [f64; 2] = [0.9e-30, 1.0];
/// Down to where f32 directions are told apart: next to 1, a step is 6·10⁻⁸.
const DIRECTIONS: [f64; 2] = [0.9e-7, 1.0];

const ULP: f64 = f32::EPSILON as f64;
