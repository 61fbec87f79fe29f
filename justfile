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
    for c in configs/quick/*.ron; do cargo run --release -- render "$c"; done

# Benchmarks; they print ratios.
bench:
    cargo bench --workspace
