//! What is to be checked.

use crate::experiment;
use crate::failure::Failure;
use sr_pipeline::diagnostics::suggest;
use sr_stability::{Renderer, Suite, suites};
use std::path::{Path, PathBuf};

/// What a scene can be in; experiments are `.ron` too, and come first.
const SCENES: [&str; 4] = [".ron", ".gltf", ".glb", ".obj"];

/// What the words mean.
#[derive(Debug)]
pub enum Targets {
    /// Suites, and experiments with `stability`.
    Bounds(Vec<Target>),
    /// A scene, a configuration or a model.
    Scene(PathBuf),
}

/// A suite, or a file.
#[derive(Debug)]
pub enum Target {
    /// A built-in one.
    Suite(Suite),
    /// An experiment with `stability`.
    File(PathBuf),
}

/// What the words mean; without any all suites.
pub fn choose(what: &[String]) -> Result<Targets, Failure> {
    let all = suites::<Renderer>();
    if what.is_empty() {
        return Ok(Targets::Bounds(
            all.into_iter().map(Target::Suite).collect(),
        ));
    }
    let mut targets = Vec::new();
    for word in what {
        match one(word, &all)? {
            Some(target) => targets.push(target),
            None if what.len() == 1 => return Ok(Targets::Scene(word.into())),
            None => {
                return Err(Failure::Input(format!(
                    "`{word}` is a scene, and a scene is examined alone: `check {word}`, without anything beside it"
                )));
            }
        }
    }
    Ok(Targets::Bounds(targets))
}

/// A suite or an experiment; `None` for a scene.
fn one(word: &str, all: &[Suite]) -> Result<Option<Target>, Failure> {
    if let Some(suite) = all.iter().find(|s| s.name == word) {
        return Ok(Some(Target::Suite(*suite)));
    }
    let path = Path::new(word);
    if experiment::is_one(path) {
        return Ok(Some(Target::File(path.to_owned())));
    }
    if path.is_file() && is_scene(word) {
        return Ok(None);
    }
    let otherwise = match path.exists() {
        true => {
            "is neither a suite nor a file that can be checked (.exp.ron, .ron, .scene.ron, .gltf, .glb, .obj)"
        }
        false => "is neither a suite nor a file",
    };
    let names = all.iter().map(|s| s.name);
    Err(Failure::Input(format!(
        "`{word}` {otherwise}; of the suites, {}",
        suggest(word, names)
    )))
}

fn is_scene(word: &str) -> bool {
    let name = word.to_lowercase();
    SCENES.iter().any(|end| name.ends_with(end))
}
