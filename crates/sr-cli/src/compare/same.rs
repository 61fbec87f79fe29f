//! Whether two renders have the same expected picture.

use super::{VERSION, print, write_map};
use crate::args::CompareArgs;
use crate::console::Console;
use crate::failure::Failure;
use serde::Serialize;
use sr_experiment::same::{Answer, Settings, Side, Verdict, same};
use sr_pipeline::film_kernel::{ATTRIBUTE_PREFIX, Channels, Image, read_attributes, read_channels};
use std::path::Path;
use std::process::ExitCode;

/// What the test needs of a file.
const NAMES: [&str; 7] = [
    "R",
    "G",
    "B",
    "Variance.R",
    "Variance.G",
    "Variance.B",
    "SampleCount.Y",
];

/// One of the two.
struct Render {
    image: Image,
    variance: Image,
    /// Mean samples of a pixel.
    samples: f64,
    seed: Option<String>,
    config: Option<String>,
}

/// What is printed as JSON.
#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    #[serde(flatten)]
    verdict: &'a Verdict,
    samples_a: f64,
    samples_b: f64,
    warnings: &'a [String],
}

/// Reads both, judges, prints; the status is 1 if they differ.
pub fn run(args: &CompareArgs, console: &Console) -> Result<ExitCode, Failure> {
    let (a, b) = (Render::read(&args.image)?, Render::read(&args.reference)?);
    let verdict = same(a.side(), b.side(), &Settings::default())
        .map_err(|e| Failure::Input(format!("cannot compare: {e}")))?;
    let warnings = warnings(&a, &b);
    for warning in &warnings {
        console.note(format_args!("warning: {warning}"));
    }
    if let Some(output) = &args.output {
        write_map(output, &verdict.picture())?;
    }
    let report = Report {
        version: VERSION,
        verdict: &verdict,
        samples_a: a.samples,
        samples_b: b.samples,
        warnings: &warnings,
    };
    print(args, console, &report, || {
        format!(
            "{}\nsamples       {:.1} and {:.1} a pixel",
            verdict.describe(),
            a.samples,
            b.samples
        )
    })?;
    Ok(ExitCode::from(u8::from(verdict.answer != Answer::Same)))
}

/// What makes the verdict weaker than it looks.
fn warnings(a: &Render, b: &Render) -> Vec<String> {
    let mut found = Vec::new();
    if let (Some(seed), true) = (&a.seed, a.seed == b.seed) {
        let shared = "so their noise may be the same in part, and chance differences are not as likely as the test \
                      assumes: render one with another --seed";
        found.push(if a.config.is_some() && a.config == b.config {
            format!(
                "both are of one configuration with seed {seed}: this compares a picture with itself"
            )
        } else {
            format!("both were rendered with seed {seed}, {shared}")
        });
    }
    if a.image == b.image {
        found.push("the pictures are equal in every bit".into());
    }
    found
}

impl Render {
    fn read(path: &Path) -> Result<Self, Failure> {
        let channels = read_channels(path, &NAMES).map_err(|e| {
            Failure::Input(format!(
                "{e}\n--same needs renders with their variance, as `steradian render -o file.exr` writes them"
            ))
        })?;
        let attributes = read_attributes(path).map_err(|e| Failure::Input(e.to_string()))?;
        let attribute = |name: &str| {
            let full = format!("{ATTRIBUTE_PREFIX}{name}");
            let mut all = attributes.iter();
            all.find(|(key, _)| *key == full)
                .map(|(_, value)| value.clone())
        };
        let counts = &channels.planes[6];
        let samples: f64 = counts.iter().map(|&n| f64::from(n)).sum();
        Ok(Self {
            image: picture(&channels, 0),
            variance: picture(&channels, 3),
            samples: samples / counts.len() as f64,
            seed: attribute("seed"),
            config: attribute("config_hash"),
        })
    }

    fn side(&self) -> Side<'_> {
        Side {
            image: &self.image,
            variance_of_mean: &self.variance,
        }
    }
}

/// Three planes, from the given one on, as a picture.
pub fn picture(channels: &Channels, from: usize) -> Image {
    let planes = &channels.planes[from..from + 3];
    let pixel = |i: usize| [0, 1, 2].map(|c| planes[c][i]).into();
    Image {
        width: channels.width,
        height: channels.height,
        pixels: (0..planes[0].len()).map(pixel).collect(),
    }
}
