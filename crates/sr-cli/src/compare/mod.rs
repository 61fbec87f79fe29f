//! `steradian compare`.

use crate::args::CompareArgs;
use crate::console::Console;
use crate::failure::Failure;
use sr_pipeline::film_kernel::read_image;

/// Reads both pictures and prints every metric.
pub fn run(args: &CompareArgs, console: &Console) -> Result<(), Failure> {
    let read = |path| read_image(path).map_err(|e| Failure::Input(e.to_string()));
    let (image, reference) = (read(&args.image)?, read(&args.reference)?);
    let comparison = sr_experiment::compare(&image, &reference)
        .map_err(|e| Failure::Input(format!("cannot compare: {e}")))?;
    if args.json {
        let json = serde_json::to_string_pretty(&comparison)
            .map_err(|e| Failure::Work(format!("cannot write JSON: {e}")))?;
        console.say(json);
    } else {
        console.say(comparison.describe());
    }
    Ok(())
}
