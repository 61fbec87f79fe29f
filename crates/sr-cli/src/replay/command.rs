//! The command that replays a sample of a render: the same scene, changed in the same ways.

use crate::args::SceneArgs;
use sr_pipeline::Pipeline;
use sr_pipeline::replay::SampleId;
use std::borrow::Cow;

/// How samples of a render can be replayed.
pub struct Replays<'a> {
    command_line: &'a str,
    args: &'a SceneArgs,
    /// The integrator can.
    possible: bool,
}

impl<'a> Replays<'a> {
    /// Of a compiled pipeline, and the command line as it was typed.
    pub fn new(pipeline: &Pipeline, args: &'a SceneArgs, command_line: &'a str) -> Self {
        Self {
            command_line,
            args,
            possible: pipeline.tracer().is_ok(),
        }
    }

    /// The command for a sample; `None` where the integrator cannot replay any.
    pub fn command(&self, id: SampleId) -> Option<String> {
        self.possible
            .then(|| replay_command(self.command_line, self.args, id))
    }
}

/// `steradian render FILE … --replay x,y,sample` for a shell, as the command line `command_line` names the
/// program. What decides how many samples are taken, by how many threads and where is left out: a sample
/// does not depend on it.
pub fn replay_command(command_line: &str, args: &SceneArgs, id: SampleId) -> String {
    let SceneArgs {
        input,
        set,
        spp: _,
        time: _,
        target_error: _,
        adaptive: _,
        max_depth,
        width,
        height,
        integrator,
        threads: _,
        seed,
        crop: _,
    } = args;
    let program = command_line.split(' ').next().unwrap_or("steradian");
    let mut words = vec![
        program.to_owned(),
        "render".to_owned(),
        input.display().to_string(),
    ];
    let mut option = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            words.extend([name.to_owned(), value]);
        }
    };
    option("--integrator", integrator.clone());
    option("--max-depth", max_depth.map(|n| n.to_string()));
    option("--width", width.map(|n| n.to_string()));
    option("--height", height.map(|n| n.to_string()));
    option("--seed", seed.map(|n| n.to_string()));
    for (path, value) in set {
        option("--set", Some(format!("{path}={value}")));
    }
    option("--replay", Some(id.to_string()));
    let words: Vec<_> = words.iter().map(|w| quoted(w)).collect();
    words.join(" ")
}

/// A word as a POSIX shell takes it for one.
fn quoted(word: &str) -> Cow<'_, str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,=:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.into();
    }
    format!("'{}'", word.replace('\'', r"'\''")).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;

    fn command(options: &[&str]) -> String {
        let line = ["/bin/steradian", "render"].iter().chain(options);
        let Command::Render(args) = Cli::try_parse_from(line).unwrap().command else {
            panic!("it was `render`");
        };
        let id = SampleId {
            pixel: [3, 4],
            sample: 99,
        };
        replay_command("steradian render", &args.scene, id)
    }

    #[test]
    fn what_changes_the_sample_is_kept_and_nothing_else() {
        assert_eq!(
            command(&[
                "a b.ron",
                "--spp",
                "16",
                "-o",
                "x.exr",
                "--stats",
                "s.json",
                "--threads",
                "2",
                "--seed",
                "7",
                "--set",
                "integrator=Path(max_depth: 3)",
                "--set",
                "film.width=8",
                "--integrator",
                "direct",
                "-q",
            ]),
            "steradian render 'a b.ron' --integrator direct --seed 7 \
             --set 'integrator=Path(max_depth: 3)' --set film.width=8 --replay 3,4,99"
        );
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
