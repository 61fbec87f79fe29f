//! `steradian render --replay x,y,sample`: one sample again, with all that happens to it.
//!
//! Its bits are those of the sample in the picture, so a sample that was rejected, or is too bright, can be
//! followed from vertex to vertex.

mod command;
mod place;
mod text;
mod view;

pub use command::{Replays, replay_command};

use crate::Context;
use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::session::Session;
use sr_pipeline::replay::{ReplayError, SampleId};
use view::View;

/// `x,y,sample`.
pub fn parse_sample(text: &str) -> Result<SampleId, String> {
    let wrong =
        "expected x,y,sample: a pixel from the top left and the index of a sample, such as 12,34,5";
    let [x, y, sample] = text
        .split(',')
        .map(str::trim)
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|_| wrong)?;
    let pixel = |t: &str| t.parse::<u32>().map_err(|_| wrong);
    Ok(SampleId {
        pixel: [pixel(x)?, pixel(y)?],
        sample: sample.parse().map_err(|_| wrong)?,
    })
}

/// Loads, compiles, traces the one sample and tells. No file is written.
pub fn run(args: &RenderArgs, id: SampleId, context: &Context<'_>) -> Result<(), Failure> {
    let mut session = Session::new(&args.scene, context)?;
    let loaded = session.pipeline.load();
    session.settle(loaded)?;
    let compiled = session.pipeline.compile();
    session.settle(compiled)?;
    let replay = session.pipeline.replay(id).map_err(|error| match error {
        ReplayError::Outside { .. } => Failure::Input(format!("--replay {id}: {error}")),
        ReplayError::NoTracer(_) => Failure::Input(format!("--replay: {error}")),
    })?;
    let view = View::new(&session.pipeline.world, &replay);
    if args.json {
        let json = serde_json::to_string_pretty(&view)
            .map_err(|e| Failure::Work(format!("cannot write JSON: {e}")))?;
        context.console.say(json);
    } else {
        context.console.say(text::of(&view).trim_end());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_three_whole_numbers() {
        let id = SampleId {
            pixel: [12, 34],
            sample: 1 << 40,
        };
        assert_eq!(parse_sample("12, 34,1099511627776"), Ok(id));
        assert_eq!(parse_sample(&id.to_string()), Ok(id));
        for bad in [
            "",
            "1,2",
            "1,2,3,4",
            "a,2,3",
            "-1,2,3",
            "1,2,3.5",
            "4294967296,0,0",
        ] {
            assert!(parse_sample(bad).is_err(), "{bad}");
        }
    }
}
