//! What measuring costs on the clock of integration: `cargo bench -p sr-tests --bench measuring`.
//!
//! The estimate of the error and the log are made between passes, off the clock; what is left is what
//! they do to caches and to the processor's clock. One process renders the same picture with a look
//! after each of its 32 passes, five times as many as doublings are, and without any, in turns whose order
//! changes. The median ratio of the seconds of integration comes with a 95 % interval from order
//! statistics (of n independent ratios, the binomial distribution of those below the median).

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use sr_pipeline::settings::Budget;
use sr_pipeline::{LogPoints, StageSeconds};
use sr_tests::{Scene, repository};

const PAIRS: usize = 60;
const SAMPLES: u64 = 64;

/// Seconds of integration and of measuring.
fn seconds(scene: &mut Scene, measuring: bool) -> [f64; 2] {
    let world = scene.world();
    world.insert_resource(LogPoints::none());
    world.insert_resource(Budget {
        // Never met, so that every pass is looked at; and passes are alike either way.
        target_error: measuring.then_some(1e-300),
        seconds: Some(1e9),
        pass_samples: Some(2),
        ..Default::default()
    });
    let rendered = scene.render(SAMPLES, 1);
    assert_eq!(u64::from(rendered.report.passes), SAMPLES / 2);
    let seconds = *scene.world().resource::<StageSeconds>();
    [seconds.integrate, seconds.measure]
}

/// Ranks from 0 that hold the median between them with probability of at least 95 %.
fn ranks(n: usize) -> (usize, usize) {
    let (mut below, mut term, mut k) = (0.0, 0.5f64.powi(n as i32), 0);
    while below + term <= 0.025 {
        below += term;
        term *= (n - k) as f64 / (k + 1) as f64;
        k += 1;
    }
    let low = k.saturating_sub(1);
    (low, n - 1 - low)
}

fn main() {
    let path = repository().join("configs/quick/cornell_spheres.ron");
    let size = [("film.width", "160"), ("film.height", "120")];
    let mut scene = Scene::load(&path, &size);
    seconds(&mut scene, true);
    let (mut ratios, mut integrating, mut measuring) = (Vec::new(), 0.0, 0.0);
    for pair in 0..PAIRS {
        let first = pair % 2 == 0;
        let (a, b) = (seconds(&mut scene, first), seconds(&mut scene, !first));
        let ([with, look], [without, _]) = if first { (a, b) } else { (b, a) };
        ratios.push(with / without);
        integrating += with;
        measuring += look;
    }
    ratios.sort_by(f64::total_cmp);
    let (low, high) = ranks(PAIRS);
    let median = 0.5 * (ratios[(PAIRS - 1) / 2] + ratios[PAIRS / 2]);
    let per_cent = |ratio: f64| 100.0 * (ratio - 1.0);
    println!(
        "measuring after each of {} passes: {:+.2} % on the clock, 95 % interval {:+.2} to {:+.2} %, \
         {PAIRS} pairs; off the clock it took {:.1} % of the time",
        SAMPLES / 2,
        per_cent(median),
        per_cent(ratios[low]),
        per_cent(ratios[high]),
        100.0 * measuring / (integrating + measuring)
    );
}
