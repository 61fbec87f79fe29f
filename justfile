# Everyday commands; `just` lists them.

default:
    @just --list

# What a change must pass.
ci:
    bash .ci/run

# All tests.
test:
    cargo test --workspace

# Formatting and lints, without building.
check:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# Every picture of configs/quick, into out/.
figures:
    for c in $(ls configs/quick/*.ron | grep -v '.exp.ron$'); do cargo run --release -- render "$c"; done

# Every experiment that comes with Steradian, into out/: half an hour.
experiments:
    for c in configs/*/*.exp.ron; do cargo run --release -- experiment "$c"; done

# Benchmarks; they print ratios.
bench:
    cargo bench --workspace
