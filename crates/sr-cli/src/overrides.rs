//! Options as values by path, the one way in which anything is changed.
//!
//! Options of their own come first, `--set` after them in its order, so that
//! `--integrator direct --set integrator.strategy=Light` works in whatever order it is typed.

use crate::args::SceneArgs;
use sr_io::Override;
use sr_pipeline::catalog::IntegratorCatalog;

/// All changes of a command line, in the order in which they apply.
pub fn overrides(args: &SceneArgs, integrators: &IntegratorCatalog) -> Vec<Override> {
    let mut list = Vec::new();
    let mut push = |path: &str, value: String, origin: &str| {
        list.push(Override {
            path: path.into(),
            value,
            origin: origin.into(),
        });
    };
    if let Some(name) = &args.integrator {
        push("integrator", full_name(name, integrators), "--integrator");
    }
    let budget = [
        ("budget.samples", args.spp.map(|n| n.to_string()), "--spp"),
        ("budget.seconds", args.time.map(number), "--time"),
        (
            "budget.target_error",
            args.target_error.map(number),
            "--target-error",
        ),
    ];
    // One of them replaces the whole budget: `--spp 16` means 16, whatever the file said of time.
    if let Some((_, _, given)) = budget.iter().find(|(_, value, _)| value.is_some()) {
        for (path, value, option) in &budget {
            let origin = if value.is_some() { option } else { given };
            push(path, value.clone().unwrap_or("None".into()), origin);
        }
    }
    if let Some(tolerance) = args.adaptive {
        push("adaptive.rule", "Folds".into(), "--adaptive");
        push("adaptive.tolerance", number(tolerance), "--adaptive");
    }
    let others = [
        (
            "integrator.max_depth",
            args.max_depth.map(|n| n.to_string()),
            "--max-depth",
        ),
        ("film.width", args.width.map(|n| n.to_string()), "--width"),
        (
            "film.height",
            args.height.map(|n| n.to_string()),
            "--height",
        ),
        (
            "film.crop",
            args.crop
                .map(|[x0, y0, x1, y1]| format!("({x0}, {y0}, {x1}, {y1})")),
            "--crop",
        ),
        ("sampler.seed", args.seed.map(|n| n.to_string()), "--seed"),
    ];
    for (path, value, origin) in others {
        if let Some(value) = value {
            push(path, value, origin);
        }
    }
    for (path, value) in &args.set {
        push(path, value.clone(), "--set");
    }
    list
}

/// `path_bsdf`, `PATHBSDF` and `path-bsdf` are `PathBsdf`; settings in parentheses stay. A name
/// that is none is handed on as typed, for the reader to complain about.
fn full_name(typed: &str, integrators: &IntegratorCatalog) -> String {
    let plain = |name: &str| name.replace(['_', '-'], "").to_lowercase();
    let (name, settings) = typed.split_at(typed.find('(').unwrap_or(typed.len()));
    let known = integrators
        .0
        .keys()
        .find(|known| plain(known) == plain(name.trim()));
    match known {
        Some(known) => format!("{known}{settings}"),
        None => typed.to_owned(),
    }
}

/// A float that reads as one in RON.
fn number(x: f64) -> String {
    format!("{x:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;
    use sr_pipeline::Pipeline;

    fn list(options: &[&str]) -> Vec<(String, String, String)> {
        let mut pipeline = Pipeline::new(1).unwrap();
        pipeline.add_plugin(sr_integrators::integrators);
        let line = ["steradian", "plan", "a.ron"].iter().chain(options);
        let Command::Plan(args) = Cli::try_parse_from(line).unwrap().command else {
            panic!("it was `plan`");
        };
        overrides(&args, pipeline.world.resource::<IntegratorCatalog>())
            .into_iter()
            .map(|o| (o.path, o.value, o.origin))
            .collect()
    }

    fn one(path: &str, value: &str, origin: &str) -> (String, String, String) {
        (path.into(), value.into(), origin.into())
    }

    #[test]
    fn no_option_changes_nothing() {
        assert!(list(&[]).is_empty());
    }

    #[test]
    fn one_part_of_a_budget_replaces_the_other_parts() {
        assert_eq!(
            list(&["--time", "2m"]),
            [
                one("budget.samples", "None", "--time"),
                one("budget.seconds", "120.0", "--time"),
                one("budget.target_error", "None", "--time"),
            ]
        );
        assert_eq!(
            list(&["--spp", "8", "--target-error", "1e-3"]),
            [
                one("budget.samples", "8", "--spp"),
                one("budget.seconds", "None", "--spp"),
                one("budget.target_error", "0.001", "--target-error"),
            ]
        );
    }

    #[test]
    fn integrators_are_found_however_they_are_spelt() {
        for name in ["PathBsdf", "path_bsdf", "path-bsdf", "PATHBSDF"] {
            let expected = [one("integrator", "PathBsdf", "--integrator")];
            assert_eq!(list(&["--integrator", name]), expected);
        }
        assert_eq!(
            list(&["--integrator", "direct(strategy: Light)"]),
            [one("integrator", "Direct(strategy: Light)", "--integrator")]
        );
        assert_eq!(
            list(&["--integrator", "pth"]),
            [one("integrator", "pth", "--integrator")]
        );
    }

    #[test]
    fn set_comes_after_everything() {
        let paths: Vec<String> = list(&[
            "--set",
            "film.width=1",
            "--set",
            "film.width=2",
            "--width",
            "3",
            "--crop",
            "0,0,1,1",
        ])
        .into_iter()
        .map(|(path, value, _)| format!("{path}={value}"))
        .collect();
        assert_eq!(
            paths,
            [
                "film.width=3",
                "film.crop=(0, 0, 1, 1)",
                "film.width=1",
                "film.width=2"
            ]
        );
    }
}
