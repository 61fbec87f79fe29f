//! Choices among several by one number, at the ends of its range.

use super::catalogue;
use super::ends::{Failures, NUMBERS, sweep};
use crate::{Kernels, Sweep};
use sr_pipeline::glam::Vec3;
use sr_pipeline::light::{Light, LightSampler, LightSelection, Receiver};
use sr_pipeline::math::distribution::Distribution1D;
use sr_pipeline::math::gamma;

/// Weights with nothing at either end, with extremes side by side, and alone.
fn weights() -> [Vec<f64>; 5] {
    [
        vec![0.0, 0.0, 3.0, 0.0, 1.0, 0.0],
        vec![1e-300, 1.0, 1e-300],
        vec![1e300, 1e-300, 1e300],
        vec![5e-324],
        vec![1.0; 1000],
    ]
}

/// What is chosen has a probability above 0, and what is left of the number is a number again.
fn is_choice(pmf: f32, rest: f32) -> bool {
    pmf > 0.0 && pmf <= 1.0 && (0.0..1.0).contains(&rest)
}

/// The probability of a choice, and as it is asked for afterwards: the same product, but in another order. Each level of
/// the tree gives a factor of less than eight roundings, as does the choice between it and lights at infinity.
fn is_same(sampler: &LightSampler, a: f32, b: f32) -> bool {
    (a - b).abs() <= gamma(8 * (sampler.tree_levels() + 1)) * b
}

/// Tables of all kinds, and the choice of a light by each rule.
pub(super) fn choices<K: Kernels>() -> Sweep {
    let lights: Vec<Light> = catalogue::lights().into_iter().map(|(_, l)| l).collect();
    let rules = [
        LightSelection::Uniform,
        LightSelection::Power,
        LightSelection::Spatial,
    ];
    let samplers = rules.map(|rule| LightSampler::new(&lights, rule, Vec3::ZERO, 10.0));
    let points = NUMBERS.map(|u| {
        let mut failures = Failures::default();
        for weights in weights() {
            let table = Distribution1D::new(weights.iter().copied());
            let chosen = table.map(|t| K::choose(&t, u));
            let is_right = chosen.is_some_and(|(i, pmf, rest)| {
                let weight = weights.get(i).copied().unwrap_or(0.0);
                weight > 0.0 && is_choice(pmf, rest)
            });
            let few = &weights[..weights.len().min(6)];
            failures.add(is_right, || format!("{few:?} by {u:e}: {chosen:?}"));
        }
        for (sampler, p) in samplers
            .iter()
            .flat_map(|s| catalogue::receivers().into_iter().map(move |p| (s, p)))
        {
            let receiver = Receiver::anywhere(p);
            let chosen = sampler.select(&receiver, u);
            let is_right = chosen.is_some_and(|(i, pmf, rest)| {
                is_choice(pmf, rest) && is_same(sampler, pmf, sampler.pmf(&receiver, i))
            });
            let rule = sampler.selection();
            failures.add(is_right, || format!("{rule:?} at {p} by {u:e}: {chosen:?}"));
        }
        failures.point(u)
    });
    let about = "Choices by tables, and of a light by each rule, take one that has a probability above 0, and leave a number in \
                 [0, 1), at the ends of its range too.";
    sweep(
        "choices",
        about,
        "choices that are not so",
        0.0,
        points.into(),
    )
}
