//! Decisions, pixels, seeds and replicas know nothing of one another.
//!
//! The correlation of n pairs of independent uniform numbers has a standard deviation of 1/√n (the mean of the products,
//! in units of the variance). Of the largest of k figures most lie below √(2 ln k) of those, at most 3.8 here; with four more for
//! the error that is less than the bound, and a correlation of twice the bound is found for certain.

use crate::{Effort, Kernels, Point, Sweep};
use sr_pipeline::glam::Vec2;
use sr_pipeline::sampling::{BounceDim, Dim, SamplerSpec};

/// Pairs for each figure: σ = 1/256.
const PAIRS: u32 = 1 << 16;

/// Eight standard deviations.
const BOUND: f64 = 8.0 / 256.0;

/// Decisions of a bounce that sit in different places of a picture.
const DECISIONS: [BounceDim; 4] = [
    BounceDim::Lobe,
    BounceDim::Bsdf,
    BounceDim::Light,
    BounceDim::User(10),
];

/// What a number is told apart by.
#[derive(Clone, Copy, Debug)]
struct Key {
    seed: u64,
    replicas: u32,
    pixel: [u32; 2],
    sample: u64,
    dim: Dim,
}

/// Number `k` of the pairs: another pixel each time, sample 0 to 7.
fn key(k: u32, dim: Dim) -> Key {
    Key {
        seed: 5,
        replicas: 1,
        pixel: [k % 512, k / 512],
        sample: u64::from(k % 8),
        dim,
    }
}

fn numbers<K: Kernels>(key: Key) -> Vec2 {
    let spec = SamplerSpec {
        seed: key.seed,
        replicas: key.replicas,
        ..SamplerSpec::default()
    };
    K::random_numbers(&spec, key.pixel, key.sample, key.dim)
}

/// The largest correlation, by magnitude, between a component of the one and of the other.
fn correlation<K: Kernels>(count: u32, pair: impl Fn(u32) -> [Key; 2]) -> f64 {
    // In units of the variance of a uniform number, 1/12.
    let mut sums = [0.0f64; 4];
    for k in 0..count {
        let [a, b] = pair(k).map(|key| numbers::<K>(key).as_dvec2() - 0.5);
        for (sum, product) in sums
            .iter_mut()
            .zip([a.x * b.x, a.x * b.y, a.y * b.x, a.y * b.y])
        {
            *sum += 12.0 * product;
        }
    }
    sums.into_iter()
        .map(|s| (s / f64::from(count)).abs())
        .fold(0.0, f64::max)
}

/// One point of a sweep from cases with a name each.
fn point<K: Kernels>(
    at: f64,
    effort: &Effort,
    cases: impl Iterator<Item = (String, Box<dyn Fn(u32) -> [Key; 2]>)>,
) -> Point {
    let count = effort.choose(PAIRS, 16 * PAIRS);
    let figures = cases.map(|(name, pair)| (correlation::<K>(count, pair), name));
    let worst = figures.max_by(|a, b| a.0.total_cmp(&b.0));
    let (error, name) = worst.unwrap_or((f64::INFINITY, "nothing was measured".into()));
    Point::new(at, error, name).with_half_width(4.0 / f64::from(count).sqrt())
}

fn sweep(name: &str, about: &str, parameter: &str, holds: [f64; 2], points: Vec<Point>) -> Sweep {
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: parameter.into(),
        error: "largest correlation".into(),
        bound: BOUND,
        holds,
        points,
    }
}

type Case = (String, Box<dyn Fn(u32) -> [Key; 2]>);

/// Decisions of a bounce against those of the camera, of the bounce before and of the first one. The last point lies
/// where the numbers of dimensions end.
pub(super) fn bounces<K: Kernels>(effort: &Effort) -> Sweep {
    const LAST: u32 = (1 << 28) - 2;
    let depths = [
        1,
        2,
        7,
        15,
        63,
        255,
        1000,
        4095,
        65_535,
        1_000_000,
        LAST,
        LAST + 1,
    ];
    let points = depths.into_iter().map(|depth| {
        let others = [
            Dim::FILTER,
            Dim::LENS,
            Dim::TIME,
            Dim::user(12),
            Dim::bounce(0, BounceDim::Bsdf),
            Dim::bounce(depth / 2, BounceDim::Light),
            Dim::bounce(depth - 1, BounceDim::Bsdf),
            Dim::bounce(depth - 1, BounceDim::Light),
        ];
        let cases = DECISIONS.into_iter().flat_map(|what| {
            let dim = Dim::bounce(depth, what);
            others
                .into_iter()
                .filter(move |o| *o != dim || depth > LAST)
                .map(move |other| -> Case {
                    let name = format!("{what:?} against {other:?}");
                    (name, Box::new(move |k| [key(k, dim), key(k, other)]))
                })
        });
        point::<K>(f64::from(depth), effort, cases)
    });
    let about = "Decisions of a bounce are independent of those of the camera and of other bounces, however deep: each has a \
                 dimension of its own up to bounce 2²⁸ − 2, then they begin again.";
    sweep(
        "bounces",
        about,
        "bounce",
        [1.0, f64::from(LAST)],
        points.collect(),
    )
}

/// Neighbours and pixels far apart, in x, in y and across.
pub(super) fn pixels<K: Kernels>(effort: &Effort) -> Sweep {
    let steps = [0u32, 1, 2, 4, 8, 16, 24, 31];
    let points = steps.into_iter().map(|k| {
        let distance = 1u32 << k;
        let shifts = [
            ("x", [distance, 0]),
            ("y", [0, distance]),
            ("x and y", [distance, distance]),
        ];
        let cases = shifts.into_iter().flat_map(|(name, [x, y])| {
            [Dim::FILTER, Dim::bounce(2, BounceDim::Bsdf)].map(|dim| -> Case {
                let pair = move |k| {
                    let one = key(k, dim);
                    let [px, py] = one.pixel;
                    let pixel = [px.wrapping_add(x), py.wrapping_add(y)];
                    [one, Key { pixel, ..one }]
                };
                (format!("{dim:?}, in {name}"), Box::new(pair))
            })
        });
        point::<K>(f64::from(distance), effort, cases)
    });
    let about = "The numbers of two pixels are independent, be they neighbours or 2³¹ apart.";
    let holds = [1.0, 2f64.powi(31)];
    sweep(
        "pixels",
        about,
        "distance in pixels",
        holds,
        points.collect(),
    )
}

/// Seeds that differ in one bit.
pub(super) fn seeds<K: Kernels>(effort: &Effort) -> Sweep {
    let points = [0u32, 1, 8, 31, 32, 47, 63].into_iter().map(|bit| {
        let cases = [Dim::FILTER, Dim::bounce(2, BounceDim::Bsdf)].map(|dim| -> Case {
            let pair = move |k| {
                let one = key(k, dim);
                [
                    one,
                    Key {
                        seed: one.seed ^ 1 << bit,
                        ..one
                    },
                ]
            };
            (format!("{dim:?}"), Box::new(pair))
        });
        point::<K>(2f64.powi(bit as i32), effort, cases.into_iter())
    });
    let about = "Two seeds give two independent pictures, whichever bit they differ in.";
    sweep(
        "seeds",
        about,
        "difference of the seeds",
        [1.0, 2f64.powi(63)],
        points.collect(),
    )
}

/// The sequences that a pixel's samples are dealt to, which must be independent for the error estimate.
pub(super) fn replicas<K: Kernels>(effort: &Effort) -> Sweep {
    let points = [2u32, 4, 8, 16].into_iter().map(|replicas| {
        let others = [1, replicas / 2, replicas - 1];
        let cases = others.into_iter().map(|other| -> Case {
            let pair = move |k| {
                let one = key(k, Dim::bounce(0, BounceDim::Light));
                // The same point of two sequences.
                let sample = one.sample * u64::from(replicas);
                let one = Key {
                    replicas,
                    sample,
                    ..one
                };
                let sample = sample + u64::from(other);
                [one, Key { sample, ..one }]
            };
            (format!("replicas 0 and {other}"), Box::new(pair))
        });
        point::<K>(f64::from(replicas), effort, cases)
    });
    let about = "The replicas of a pixel are independent of one another.";
    sweep("replicas", about, "replicas", [2.0, 16.0], points.collect())
}
