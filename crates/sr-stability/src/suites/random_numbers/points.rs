//! Points of one pixel: nets, long sequences, and the range of the numbers themselves.

use crate::{Effort, Kernels, Point, Sweep};
use sr_pipeline::glam::Vec2;
use sr_pipeline::sampling::{BounceDim, Dim, SamplerSpec};

/// From the camera to a deep bounce.
const DIMS: [Dim; 6] = [
    Dim::FILTER,
    Dim::LENS,
    Dim::bounce(0, BounceDim::Bsdf),
    Dim::bounce(0, BounceDim::Light),
    Dim::bounce(37, BounceDim::User(10)),
    Dim::bounce(100_000, BounceDim::Bsdf),
];

const PIXEL: [u32; 2] = [17, 4];

fn spec(seed: u64) -> SamplerSpec {
    SamplerSpec {
        seed,
        ..SamplerSpec::default()
    }
}

fn points<K: Kernels>(seed: u64, dim: Dim, start: u64, count: u64) -> Vec<Vec2> {
    let samples = (0..count).map(|i| start.wrapping_add(i));
    samples
        .map(|i| K::random_numbers(&spec(seed), PIXEL, i, dim))
        .collect()
}

/// The share of the elementary intervals of area 1/n, of all shapes, that have not exactly one of n points
/// (Niederreiter 1992, "Random Number Generation and Quasi-Monte Carlo Methods", definition 4.1, t = 0).
fn missed_intervals(points: &[Vec2]) -> f64 {
    let m = points.len().trailing_zeros();
    let mut missed = 0usize;
    let mut seen = vec![false; points.len()];
    for a in 0..=m {
        let (nx, ny) = (1u64 << a, 1u64 << (m - a));
        seen.fill(false);
        for p in points {
            let cell = |x: f32, n: u64| (f64::from(x) * n as f64) as u64;
            let at = cell(p.x, nx) * ny + cell(p.y, ny);
            // A number of 1 or above is in no interval.
            if let Some(seen) = seen.get_mut(at as usize) {
                *seen = true;
            }
        }
        missed += seen.iter().filter(|s| !**s).count();
    }
    missed as f64 / (points.len() * (m as usize + 1)) as f64
}

/// The worst of several cases, by its error.
fn worst(at: f64, cases: impl Iterator<Item = (f64, String)>) -> Point {
    let worst = cases.max_by(|a, b| a.0.total_cmp(&b.0));
    let (error, what) = worst.unwrap_or((f64::INFINITY, "nothing was measured".into()));
    Point::new(at, error, what)
}

/// Aligned blocks of 2ᵐ samples, scrambled as they are used.
pub(super) fn nets<K: Kernels>(effort: &Effort) -> Sweep {
    let most = effort.choose(12, 18);
    let measured = (0..=most).map(|m| {
        let n = 1u64 << m;
        let starts = [0, n, 3 << 20, (1 << 32) - n, 5 << 32, 1 << 63];
        let cases = DIMS
            .into_iter()
            .flat_map(|dim| starts.map(|start| (dim, start)));
        worst(
            n as f64,
            cases.map(|(dim, start)| {
                let missed = missed_intervals(&points::<K>(1 + start, dim, start, n));
                (
                    missed,
                    format!("{dim:?}, samples from {start}, seed {}", 1 + start),
                )
            }),
        )
    });
    Sweep {
        name: "nets".into(),
        about: "Every aligned block of 2ᵐ samples has one point in each elementary interval of area 2⁻ᵐ, of every shape \
                ((0, m, 2)-net), after the scramble and past 2³² samples."
            .into(),
        parameter: "samples".into(),
        error: "share of the intervals without their point".into(),
        bound: 0.0,
        holds: [1.0, 2f64.powi(18)],
        points: measured.collect(),
    }
}

/// Decisions that take one number.
const SINGLES: [Dim; 4] = [
    Dim::TIME,
    Dim::bounce(0, BounceDim::Lobe),
    Dim::bounce(3, BounceDim::Roulette),
    Dim::bounce(100_000, BounceDim::LightSelect),
];

/// As [`nets`], of the decisions that take one number.
pub(super) fn strata<K: Kernels>(effort: &Effort) -> Sweep {
    let most = effort.choose(12, 18);
    let measured = (0..=most).map(|m| {
        let n = 1u64 << m;
        let starts = [0, n, 3 << 20, (1 << 32) - n, 5 << 32, 1 << 63];
        let cases = SINGLES
            .into_iter()
            .flat_map(|dim| starts.map(|start| (dim, start)));
        let cases = cases.map(|(dim, start)| {
            let spec = spec(1 + start);
            let number = |i| K::random_number(&spec, PIXEL, start.wrapping_add(i), dim);
            let mut seen = vec![false; n as usize];
            for u in (0..n).map(number) {
                if let Some(seen) = seen.get_mut((f64::from(u) * n as f64) as usize) {
                    *seen = true;
                }
            }
            let missed = seen.iter().filter(|s| !**s).count() as f64 / n as f64;
            let what = format!("{dim:?}, samples from {start}, seed {}", 1 + start);
            (missed, what)
        });
        worst(n as f64, cases)
    });
    Sweep {
        name: "strata".into(),
        about: "Every aligned block of 2ᵐ samples has one number in each interval of length 2⁻ᵐ, of decisions that take one."
            .into(),
        parameter: "samples".into(),
        error: "share of the intervals without their number".into(),
        bound: 0.0,
        holds: [1.0, 2f64.powi(18)],
        points: measured.collect(),
    }
}

/// 4096 samples from far on in a pixel. As they are 24 bits a number, two of them are alike with probability
/// 4096²·2⁻⁴⁸ = 6·10⁻⁸.
pub(super) fn long_sequences<K: Kernels>(effort: &Effort) -> Sweep {
    const N: u64 = 4096;
    let ends = [12u32, 16, 24, 31, 32, 33, 36, 40, 48, 56, 63];
    let every = effort.choose(1, DIMS.len());
    let measured = ends.into_iter().map(|k| {
        let start = 1u64 << k;
        let cases = DIMS.into_iter().take(every);
        worst(
            start as f64,
            cases.map(|dim| {
                let mut early = points::<K>(2, dim, 0, N);
                let late = points::<K>(2, dim, start, N);
                let missed = missed_intervals(&late);
                early.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
                let is_early = |p: &&Vec2| {
                    let order = |q: &Vec2| q.x.total_cmp(&p.x).then(q.y.total_cmp(&p.y));
                    early.binary_search_by(order).is_ok()
                };
                let repeated = late.iter().filter(is_early).count() as f64 / N as f64;
                let what =
                    format!("{dim:?}: {repeated} repeated, {missed} of the intervals missed");
                (repeated + missed, what)
            }),
        )
    });
    Sweep {
        name: "long_sequences".into(),
        about: "Samples from any number on are new ones, and a net again: after 2³² of them a new scramble begins.".into(),
        parameter: "number of the sample".into(),
        error: "repeated points and missed intervals, as shares".into(),
        bound: 0.0,
        holds: [4096.0, 2f64.powi(63)],
        points: measured.collect(),
    }
}

/// Bits to a number: all ends of the 32 bits, and every place where a rounding could carry.
pub(super) fn end_of_range<K: Kernels>() -> Sweep {
    let bits = (0..=32).map(|k| u32::MAX.checked_shr(k).unwrap_or(0));
    let measured = bits.map(|bits| {
        let u = f64::from(K::unit_f32(bits));
        let truth = f64::from(bits) / 4_294_967_296.0;
        // Below 1, not above the truth, and less than one step of the grid below it.
        let error = match u < 1.0 && u <= truth {
            true => truth - u,
            false => f64::INFINITY,
        };
        Point::new(truth, error, format!("{bits:#x} becomes {u:e}"))
    });
    Sweep {
        name: "end_of_range".into(),
        about: "32 random bits become a number below 1, whatever they are.".into(),
        parameter: "bits/2³²".into(),
        error: "distance from the number that the bits say".into(),
        // The last eight bits are cut off.
        bound: 255.0 / 4_294_967_296.0,
        holds: [0.0, 1.0],
        points: measured.collect(),
    }
}
