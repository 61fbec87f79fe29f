//! Decisions that one sample takes several times: together they are as well spread as samples.

use glam::Vec2;
use sr_sampling::{BounceDim, Dim, Sampler, SamplerSpec};

const DIM: Dim = Dim::bounce(0, BounceDim::Light);

fn sobol(sample: u64) -> sr_sampling::SobolSampler {
    SamplerSpec::default().sobol([7, 9], sample)
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

#[test]
fn one_sub_sample_is_the_sample_and_the_first_fork_too() {
    for sample in [0, 1, 77, (1 << 32) + 3] {
        let s = sobol(sample);
        assert_eq!(s.split(0, 1).d2(DIM), s.d2(DIM));
        assert_eq!(s.fork(0).d2(DIM), s.d2(DIM));
        let s = SamplerSpec::default().independent([7, 9], sample);
        assert_eq!(s.split(0, 1).d2(DIM), s.d2(DIM));
        assert_eq!(s.fork(0).d2(DIM), s.d2(DIM));
    }
}

/// Four samples with sixteen sub-samples each are the sixty-four points of one sequence; and so are
/// those of every fork, which is another sequence.
#[test]
fn sub_samples_are_stratified_within_a_sample_and_over_samples() {
    let of = |samples: std::ops::Range<u64>, fork: u32| -> Vec<Vec2> {
        let split = |i| (0..16).map(move |j| sobol(i).fork(fork).split(j, 16).d2(DIM));
        samples.flat_map(split).collect()
    };
    let plain: Vec<Vec2> = (0..64).map(|i| sobol(i).d2(DIM)).collect();
    assert_eq!(of(0..4, 0), plain);
    for fork in [0, 1, 2, 1000] {
        for start in [0, 4, 1 << 20] {
            assert!(is_net(&of(start..start + 1, fork)));
            assert!(is_net(&of(start..start + 4, fork)), "{fork} from {start}");
        }
        assert!(fork == 0 || of(0..4, fork) != plain);
    }
}

/// Where a sequence of 2³² points ends another begins: no sub-sample meets those of another sample.
#[test]
fn sub_samples_past_the_end_of_a_sequence_are_new_ones() {
    let early: Vec<Vec2> = (0..64).map(|j| sobol(0).split(j, 64).d2(DIM)).collect();
    // 2²⁶ · 64 = 2³².
    let late: Vec<Vec2> = (0..64)
        .map(|j| sobol(1 << 26).split(j, 64).d2(DIM))
        .collect();
    assert!(is_net(&late));
    assert_ne!(early, late);
}

/// 65,536 pairs: σ = 1/256. 12 figures beyond 5σ are a false alarm of 10⁻⁵; a correlation of 0.02
/// is found.
#[test]
fn forks_are_uncorrelated_and_so_are_independent_sub_samples() {
    let far = |what: &str, pair: &dyn Fn(u64) -> (f32, f32)| {
        let n = 1 << 16;
        let sum: f64 = (0..n)
            .map(pair)
            .map(|(a, b)| (f64::from(a) - 0.5) * (f64::from(b) - 0.5))
            .sum();
        let r = 12.0 * sum / n as f64;
        assert!(r.abs() < 5.0 / 256.0, "{what}: {r}");
    };
    for (a, b) in [(0, 1), (1, 2), (0, 2), (3, 12)] {
        let name = format!("{a} and {b}");
        far(&name, &|i| {
            // One point of each pixel, so that stratification plays no part.
            let s = SamplerSpec::default().sobol([i as u32, 1], 5);
            (s.fork(a).d1(DIM), s.fork(b).d1(DIM))
        });
        far(&name, &|i| {
            let s = SamplerSpec::default().independent([2, 3], i);
            (s.fork(a).d1(DIM), s.fork(b).d1(DIM))
        });
        far(&name, &|i| {
            let s = SamplerSpec::default().independent([2, 3], i);
            (s.split(a, 16).d1(DIM), s.split(b, 16).d1(DIM))
        });
    }
}
