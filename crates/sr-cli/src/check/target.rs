//! What is to be checked.

use crate::experiment;
use crate::failure::Failure;
use sr_pipeline::diagnostics::suggest;
use sr_stability::{Renderer, Suite, suites};
use std::path::{Path, PathBuf};

/// A suite, or a file.
#[derive(Debug)]
pub enum Target {
    /// A built-in one.
    Suite(Suite),
    /// An experiment with `stability`.
    File(PathBuf),
}

/// What the words mean; without any all suites.
pub fn choose(what: &[String]) -> Result<Vec<Target>, Failure> {
    let all = suites::<Renderer>();
    if what.is_empty() {
        return Ok(all.into_iter().map(Target::Suite).collect());
    }
    what.iter().map(|word| one(word, &all)).collect()
}

fn one(word: &str, all: &[Suite]) -> Result<Target, Failure> {
    if let Some(suite) = all.iter().find(|s| s.name == word) {
        return Ok(Target::Suite(*suite));
    }
    let path = Path::new(word);
    if experiment::is_one(path) {
        return Ok(Target::File(path.to_owned()));
    }
    let names = all.iter().map(|s| s.name);
    Err(Failure::Input(format!(
        "there is no suite `{word}`: {}",
        suggest(word, names)
    )))
}
