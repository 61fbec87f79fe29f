//! Method against method, on every scene of the repository.

use sr_tests::{
    Scene,
    agree::{Blocks, assert_same},
    repository_scenes,
};
use std::path::Path;

/// Scenes that are one lobe, light or camera more: compared at half the width and height, which
/// leaves the error of a block as it is and compares a quarter of the blocks.
const SMALLER: [&str; 7] = [
    "caustics",
    "cornell_knot",
    "festival",
    "focus_row",
    "gems",
    "unlit",
    "veach_mis",
];

/// A scene at thumbnail size.
fn thumbnail(path: &Path, integrator: &str) -> Scene {
    let folder = path.parent().and_then(Path::file_name);
    let smaller = folder.is_some_and(|f| SMALLER.iter().any(|s| f == *s));
    let [width, height] = if smaller { ["32", "24"] } else { ["64", "48"] };
    Scene::load(
        path,
        &[
            ("integrator", integrator),
            ("film.width", width),
            ("film.height", height),
            ("sampler.replicas", "1"),
        ],
    )
}

fn check(integrators: [&str; 2], samples: [u64; 2]) {
    for path in repository_scenes() {
        let render = |i: usize| {
            Blocks::render(
                &mut thumbnail(&path, integrators[i]),
                samples[i],
                i as u64 + 1,
            )
        };
        let name = path
            .file_name()
            .expect("a file")
            .to_string_lossy()
            .into_owned();
        let what = format!("{name}: {} and {}", integrators[0], integrators[1]);
        assert_same(&what, &render(0), &render(1));
    }
}

#[test]
fn path_and_path_bsdf_agree_on_every_scene() {
    check(["Path(max_depth: 6)", "PathBsdf(max_depth: 6)"], [64, 256]);
}

#[test]
fn direct_agrees_with_path_of_one_bounce_on_every_scene() {
    check(["Direct(strategy: Mis)", "Path(max_depth: 1)"], [32, 32]);
    check(["Direct(strategy: Light)", "Path(max_depth: 1)"], [64, 32]);
    check(["Direct(strategy: Bsdf)", "Path(max_depth: 1)"], [128, 32]);
    check(
        ["Direct(strategy: Hemisphere)", "PathBsdf(max_depth: 1)"],
        [128, 128],
    );
}

/// Roulette from the first bounce, through glass (where throughput is scaled by η²) as elsewhere.
#[test]
fn roulette_leaves_the_mean_unchanged_on_every_scene() {
    check(
        [
            "Path(max_depth: 8, roulette_from: Some(0))",
            "Path(max_depth: 8, roulette_from: None)",
        ],
        [128, 64],
    );
}
