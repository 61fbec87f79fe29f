//! Broken kernels, each found by a suite that is named beforehand.

use super::sweeps;
use glam::Vec3;
use sr_pipeline::film_kernel::FilmSpec;
use sr_stability::{Kernels, Verdict, film_mean};

/// The names of the sweeps of a suite that are broken with the kernels of `K`.
fn broken<K: Kernels>(suite: &str) -> Vec<String> {
    let bad = sweeps::<K>(suite).into_iter();
    let bad = bad.filter(|s| s.verdict() == Verdict::Broken);
    bad.map(|s| s.name).collect()
}

/// A film that adds in `f32`, as many renderers do.
struct SumInF32;

impl Kernels for SumInF32 {
    fn film_mean(samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
        (0..samples).map(sample).sum::<Vec3>() / samples as f32
    }
}

/// A clamp that nobody asked for.
struct Clamp;

impl Kernels for Clamp {
    fn film_mean(samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
        let spec = FilmSpec {
            clamp: Some(10.0),
            ..FilmSpec::of_size(1, 1)
        };
        film_mean(spec, samples, sample)
    }
}

#[test]
fn a_film_sum_in_f32_is_found() {
    assert_eq!(broken::<SumInF32>("sums"), ["equal_samples"]);
}

#[test]
fn a_clamp_is_found() {
    assert_eq!(broken::<Clamp>("sums"), ["outlier"]);
}
