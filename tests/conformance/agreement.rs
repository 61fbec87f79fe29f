//! Method against method, on every scene of the repository.

use sr_tests::{
    Scene,
    agree::{assert_same, pictures},
    repository_scenes,
};
use std::path::Path;

/// Scenes that are one lobe, light or camera more: compared at half the width and height, which
/// leaves the error of a block as it is and compares a quarter of the blocks.
const SMALLER: [&str; 8] = [
    "caustics",
    "cornell_knot",
    "festival",
    "focus_row",
    "gems",
    "room",
    "unlit",
    "veach_mis",
];

/// Scenes made to show where a strategy fails: a light of 3 cm over a plate of α 0.002 is found by
/// either sampling alone so rarely that a few seeds tell nothing of the mean. Where they are left
/// out, the test says so; both samplings together, and paths without light sampling, agree.
const HEAVY_TAILS: [&str; 1] = ["veach_mis"];

/// A scene at thumbnail size.
fn thumbnail(path: &Path, integrator: &str) -> Scene {
    let [width, height] = if is_among(path, &SMALLER) {
        ["32", "24"]
    } else {
        ["64", "48"]
    };
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

/// Whether a scene is one of some, by its folder.
fn is_among(path: &Path, names: &[&str]) -> bool {
    let folder = path.parent().and_then(Path::file_name);
    folder.is_some_and(|f| names.iter().any(|name| f == *name))
}

fn check(integrators: [&str; 2], samples: [u64; 2]) {
    check_without(&[], integrators, samples);
}

fn check_without(left_out: &[&str], integrators: [&str; 2], samples: [u64; 2]) {
    for path in repository_scenes() {
        if is_among(&path, left_out) {
            eprintln!("{}: left out for {}", path.display(), integrators[0]);
            continue;
        }
        let render = |i: usize| {
            pictures(
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
    let check_one = |strategy, samples| check_without(&HEAVY_TAILS, strategy, samples);
    check_one(["Direct(strategy: Light)", "Path(max_depth: 1)"], [64, 32]);
    check_one(["Direct(strategy: Bsdf)", "Path(max_depth: 1)"], [128, 32]);
    check_one(
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
