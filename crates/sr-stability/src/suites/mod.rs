//! The built-in suites.

mod camera;
mod grazing;
mod lights;
mod lobes;
mod paths;
mod random_numbers;
mod roughness;
mod scale;
mod sums;

use crate::{Effort, Kernels, Sweep};

/// Sweeps of one theme.
#[derive(Clone, Copy, Debug)]
pub struct Suite {
    /// As it is named on the command line.
    pub name: &'static str,
    /// What it is about, in a sentence.
    pub about: &'static str,
    /// Measures its sweeps, but for those that are experiments in `configs/stability`.
    pub run: fn(&Effort) -> Vec<Sweep>,
}

/// All suites, over the kernels of `K`.
pub fn suites<K: Kernels>() -> Vec<Suite> {
    vec![
        Suite {
            name: "roughness",
            about: "Rough lobes from α = 1 to 10⁻⁸, and how they become mirrors and clear glass.",
            run: roughness::run::<K>,
        },
        Suite {
            name: "grazing",
            about: "Every lobe from cos θ = 1 to 10⁻⁷, Fresnel's equations, the critical angle, and normals that face away.",
            run: grazing::run::<K>,
        },
        Suite {
            name: "scale",
            about: "Rooms from 10⁻⁶ to 10⁷ m, far from the origin, mirrored and flat; needles, thin walls, coincident and broken faces.",
            run: scale::run::<K>,
        },
        Suite {
            name: "lights",
            about: "Lights from a solid angle of 2π to 10⁻¹⁴, at distances from 0 to 10⁸, of radiance 10⁻³⁰ to 10³⁰; maps; lights that are none.",
            run: lights::run::<K>,
        },
        Suite {
            name: "paths",
            about: "Long paths in white rooms and in glass, depth, roulette, and the weights of techniques.",
            run: paths::run::<K>,
        },
        Suite {
            name: "sums",
            about: "Means of up to 10⁸ samples, and what becomes of them in files of half precision.",
            run: sums::run::<K>,
        },
        Suite {
            name: "random_numbers",
            about: "Numbers at 0 and next to 1 through every map, lobe and light; nets, long sequences, and independence.",
            run: random_numbers::run::<K>,
        },
        Suite {
            name: "camera",
            about: "Angles of view from 10⁻³° to 179.9°, lenses from 0 to huge, focus from next to the lens to infinity, rows and crops.",
            run: |_| camera::run::<K>(),
        },
    ]
}
