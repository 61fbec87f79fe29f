//! What integrators rely on: stratification, independence, unbiasedness, convergence.

use glam::Vec2;
use sr_sampling::{BounceDim, Dim, Sampler, SamplerSpec};
use sr_stats::{chi2_test, sidak};

/// Some dimensions from the camera to a deep bounce.
const DIMS: [Dim; 8] = [
    Dim::FILTER,
    Dim::LENS,
    Dim::TIME,
    Dim::bounce(0, BounceDim::Bsdf),
    Dim::bounce(0, BounceDim::Light),
    Dim::bounce(1, BounceDim::Bsdf),
    Dim::bounce(37, BounceDim::User(10)),
    Dim::bounce(100_000, BounceDim::Roulette),
];

fn spec(seed: u64, replicas: u32) -> SamplerSpec {
    SamplerSpec {
        seed,
        replicas,
        ..SamplerSpec::default()
    }
}

/// One point in each box of area 1/n, for every shape of box.
fn is_net(points: &[Vec2]) -> bool {
    let m = points.len().trailing_zeros();
    (0..=m).all(|a| {
        let (nx, ny) = (1u32 << a, 1u32 << (m - a));
        let mut seen = vec![false; points.len()];
        points.iter().all(|p| {
            let (i, j) = ((p.x * nx as f32) as u32, (p.y * ny as f32) as u32);
            !std::mem::replace(&mut seen[(i * ny + j) as usize], true)
        })
    })
}

fn sobol_points(spec: &SamplerSpec, dim: Dim, samples: impl Iterator<Item = u64>) -> Vec<Vec2> {
    samples.map(|i| spec.sobol([17, 4], i).d2(dim)).collect()
}

#[test]
fn every_aligned_block_of_a_power_of_two_is_a_net() {
    for seed in 0..8 {
        let spec = spec(seed, 1);
        for dim in DIMS {
            for m in 0..=10 {
                let n = 1u64 << m;
                // The prefix, the next block, and blocks past 2¹⁶ and 2³² samples.
                for start in [0, n, 1 << 16, 3 << 20, 5 << 32] {
                    let points = sobol_points(&spec, dim, start..start + n);
                    assert!(is_net(&points), "seed {seed} {dim:?} {n} from {start}");
                }
            }
        }
    }
}

#[test]
fn each_replica_is_a_sequence_of_its_own() {
    let spec = spec(3, 4);
    let replica = |r: u64| sobol_points(&spec, Dim::FILTER, (0..256u64).map(|i| 4 * i + r));
    for r in 0..4 {
        assert!(is_net(&replica(r)));
        for other in 0..r {
            assert_ne!(replica(r), replica(other));
        }
    }
    // Past 2³² samples a new scramble, not the old one again.
    let late = sobol_points(&spec, Dim::FILTER, (0..256u64).map(|i| 4 * i + (1 << 34)));
    assert!(is_net(&late));
    assert_ne!(late, replica(0));
}

#[test]
fn numbers_are_below_one_and_d1_is_the_first_of_d2() {
    let mut largest = 0.0f32;
    for i in 0..1 << 20 {
        let (a, b) = (
            spec(1, 1).sobol([2, 3], i),
            spec(1, 1).independent([2, 3], i),
        );
        let dim = Dim::bounce(i as u32 % 7, BounceDim::Light);
        let (p, q) = (a.d2(dim), b.d2(dim));
        assert_eq!((p.x, q.x), (a.d1(dim), b.d1(dim)));
        for x in [p.x, p.y, q.x, q.y] {
            assert!((0.0..1.0).contains(&x));
            largest = largest.max(x);
        }
    }
    assert!(largest > 1.0 - 1e-5);
}

/// The correlation of pairs of uniform numbers, and its standard deviation if there is none.
fn correlation(pairs: impl Iterator<Item = (f32, f32)>) -> (f64, f64) {
    let (mut n, mut sum) = (0.0, 0.0);
    for (a, b) in pairs {
        n += 1.0;
        sum += (f64::from(a) - 0.5) * (f64::from(b) - 0.5);
    }
    // In units of the variance 1/12 of a uniform number.
    (12.0 * sum / n, 1.0 / f64::sqrt(n))
}

/// Over the samples of one pixel: 4096 of them, 28 pairs of dimensions, 4 pixels. 5.5σ: a false alarm
/// of 5·10⁻⁶ in all; a correlation of 0.1 is found.
#[test]
fn dimensions_of_a_pixel_are_uncorrelated() {
    for pixel in [[0, 0], [1, 0], [100, 7], [4_000_000, 9]] {
        for (i, &a) in DIMS.iter().enumerate() {
            for &b in &DIMS[..i] {
                let pairs = (0..4096).map(|k| {
                    let s = spec(11, 1).sobol(pixel, k);
                    (s.d2(a).x, s.d2(b).y)
                });
                let (r, sigma) = correlation(pairs);
                assert!(r.abs() < 5.5 * sigma, "{pixel:?} {a:?} {b:?}: {r}");
            }
        }
    }
}

/// What a sample is told apart by: seed, replicas, pixel, sample.
type Key = (u64, u32, u32, u64);

/// Two samples that are neighbours in some sense, one such pair for each number.
type Neighbours = fn(u32) -> [Key; 2];

/// Neighbouring pixels, seeds, replicas and blocks: 65,536 pairs each, 5.5σ, ten figures: a false
/// alarm of 4·10⁻⁷; a correlation of 0.03 is found.
#[test]
fn neighbours_are_uncorrelated() {
    let dim = Dim::bounce(2, BounceDim::Bsdf);
    let sobol = |(seed, replicas, k, i): Key| {
        let s = spec(seed, replicas);
        s.sobol([k % 256, k / 256], i).d1(dim)
    };
    let independent = |(seed, replicas, k, i): Key| {
        let s = spec(seed, replicas);
        s.independent([k % 256, k / 256], i).d1(dim)
    };
    let neighbours: [(&str, Neighbours); 5] = [
        ("x", |k| [(5, 1, k, 3), (5, 1, k + 1, 3)]),
        ("y", |k| [(5, 1, k, 3), (5, 1, k + 256, 3)]),
        ("seed", |k| [(5, 1, k, 3), (6, 1, k, 3)]),
        ("replica", |k| [(5, 2, k, 2), (5, 2, k, 3)]),
        ("block", |k| [(5, 1, k, 3), (5, 1, k, 3 + (1 << 32))]),
    ];
    for (name, pair) in neighbours {
        let pairs = (0..65_536).map(pair);
        let (r, sigma) = correlation(pairs.clone().map(|[a, b]| (sobol(a), sobol(b))));
        assert!(r.abs() < 5.5 * sigma, "sobol over {name}: {r}");
        let (r, _) = correlation(pairs.map(|[a, b]| (independent(a), independent(b))));
        assert!(r.abs() < 5.5 * sigma, "independent over {name}: {r}");
    }
}

/// Each single point is uniform over the pixels, which is what makes every estimate unbiased: 16×16
/// cells, 65,536 pixels, 12 tests, a false alarm of 10⁻⁴ in all; errors of 10 % a cell are found.
#[test]
fn each_point_is_uniform_over_the_pixels() {
    const N: u32 = 1 << 16;
    let expected = [f64::from(N) / 256.0; 256];
    for sample in [0, 1, 7, 65_537, (1 << 32) + 5, 1 << 40] {
        for dim in [Dim::FILTER, Dim::bounce(3, BounceDim::Light)] {
            let mut counts = [0; 256];
            for k in 0..N {
                let p = spec(8, 1).sobol([k % 512, k / 512], sample).d2(dim);
                counts[(p.x * 16.0) as usize * 16 + (p.y * 16.0) as usize] += 1;
            }
            let p = chi2_test(&counts, &expected, 5.0).p_value;
            assert!(p > sidak(1e-4, 12), "{sample} {dim:?}: {p}");
        }
    }
}

/// Mean and variance, over `seeds` pixels, of the mean of `n` samples of `f`.
fn moments(n: u64, seeds: u32, f: impl Fn(u32, u64) -> f64) -> (f64, f64) {
    let means: Vec<f64> = (0..seeds)
        .map(|k| (0..n).map(|i| f(k, i)).sum::<f64>() / n as f64)
        .collect();
    let mean = means.iter().sum::<f64>() / f64::from(seeds);
    let square = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>();
    (mean, square / f64::from(seeds - 1))
}

/// In one dimension n scrambled points are one uniform point in each n-th, so the mean of `u` has
/// variance 1/(12 n³), exactly. 4096 seeds know it to σ = 2.2 % (a sum of n uniform numbers is close
/// to normal): a false alarm at 5σ is 6·10⁻⁷ a figure.
#[test]
fn one_dimension_has_the_variance_of_owen_scrambling() {
    for n in [4, 16, 64] {
        let spec = spec(21, 1);
        let (_, variance) = moments(n, 4096, |k, i| {
            f64::from(spec.sobol([k, 0], i).d1(Dim::LENS))
        });
        let ratio = variance * 12.0 * (n as f64).powi(3);
        assert!((ratio - 1.0).abs() < 5.0 * 0.0221, "{n}: {ratio}");
    }
}

/// A smooth function of the plane: its mean is right (5σ), and its variance falls with n⁻³ log n
/// where independent samples have n⁻¹. Measured: 2600 times less at n = 256 than at 16 (independent
/// ones 16 times), and 22,600 times less than independent ones. Half and a tenth are asked; the ratios
/// are known to 6 %.
#[test]
fn smooth_integrands_converge_faster_than_one_over_n() {
    let (sobol, independent) = (spec(33, 1), spec(34, 1));
    let f = |p: Vec2| f64::from((1.3 * p.x + 0.7 * p.y).exp());
    let exact = (1.3f64.exp_m1() / 1.3) * (0.7f64.exp_m1() / 0.7);
    let run = |n| {
        let (mean, v) = moments(n, 1024, |k, i| f(sobol.sobol([k, 1], i).d2(Dim::FILTER)));
        assert!(
            (mean - exact).abs() < 5.0 * (v / 1024.0).sqrt(),
            "{n}: {mean}"
        );
        let (mean, w) = moments(n, 1024, |k, i| {
            f(independent.independent([k, 1], i).d2(Dim::FILTER))
        });
        assert!(
            (mean - exact).abs() < 5.0 * (w / 1024.0).sqrt(),
            "{n}: {mean}"
        );
        (v, w)
    };
    let ((v16, w16), (v256, w256)) = (run(16), run(256));
    let (fall, independent_fall) = (v16 / v256, w16 / w256);
    assert!(
        (independent_fall / 16.0 - 1.0).abs() < 0.5,
        "{independent_fall}"
    );
    assert!(fall > 1300.0, "{fall}");
    assert!(w256 / v256 > 2260.0, "{}", w256 / v256);
}

/// The spread of the replicas' means estimates the variance of their mean: over 512 pixels the mean
/// estimate and the observed variance agree within 5σ (6.3 % for the one, 2.4 % for the other).
#[test]
fn replicas_estimate_their_own_variance() {
    const R: u64 = 8;
    const N: u64 = 16;
    let spec = spec(55, R as u32);
    let f = |k: u32, i: u64| f64::from(spec.sobol([k, 2], i).d2(Dim::FILTER).element_product());
    let (_, observed) = moments(R * N, 512, f);
    let mut estimate = 0.0;
    for k in 0..512 {
        let mean = |r: u64| (0..N).map(|i| f(k, R * i + r)).sum::<f64>() / N as f64;
        let means = [0, 1, 2, 3, 4, 5, 6, 7].map(mean);
        let mid = means.iter().sum::<f64>() / R as f64;
        let square: f64 = means.iter().map(|m| (m - mid).powi(2)).sum();
        estimate += square / ((R - 1) * R) as f64 / 512.0;
    }
    let ratio = observed / estimate;
    assert!((ratio - 1.0).abs() < 5.0 * 0.067, "{ratio}");
}
