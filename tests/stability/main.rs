//! Numerical stability: every suite of `steradian check` holds its bounds, and finds a broken kernel.

mod health;
mod mutations;
mod oracle;
mod random_numbers;

use sr_stability::{Bench, Effort, Kernels, Renderer, Suite, Sweep, Verdict, check, suites};

/// The sweeps of a suite by its name, over the kernels of `K`.
fn sweeps<K: Kernels>(suite: &str) -> Vec<Sweep> {
    let all = suites::<K>();
    let found = all.iter().find(|s| s.name == suite).expect("a suite");
    (found.run)(&Effort::default())
}

/// What a suite says that does not hold.
fn complaints(suite: &Suite) -> Vec<String> {
    let bench = Bench::new(0);
    let checked = check(suite, &Effort::default(), &bench);
    let sweeps = checked.unwrap_or_else(|e| panic!("{e:?}: {:?}", bench.told()));
    let bad = sweeps
        .sweeps
        .iter()
        .filter(|s| s.verdict() != Verdict::Holds);
    let line = |s: &Sweep| {
        format!(
            "{} {}: {:?}, bound {:e}, worst {:?}",
            suite.name,
            s.name,
            s.verdict(),
            s.bound,
            s.worst()
        )
    };
    bad.map(line).collect()
}

#[test]
fn every_suite_holds_its_bounds() {
    let all: Vec<String> = suites::<Renderer>().iter().flat_map(complaints).collect();
    assert!(all.is_empty(), "{}", all.join("\n"));
}
