//! How far an image is from a reference.

use super::{VERSION, maps, print, write_map};
use crate::args::CompareArgs;
use crate::console::Console;
use crate::failure::Failure;
use serde::Serialize;
use sr_experiment::{
    CompareError, Comparison, Debiased, ErrorMap, PIXELS_PER_DEGREE, compare, debiased, hdr_flip,
    ldr_flip,
};
use sr_pipeline::film_kernel::{Image, read_channels, read_image};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// What is printed.
#[derive(Serialize)]
struct Figures {
    version: u32,
    #[serde(flatten)]
    comparison: Comparison,
    debiased: Option<Debiased>,
    /// Why there is nothing debiased.
    not_debiased: Option<String>,
    flip: Flip,
}

/// ꟻLIP of the pictures.
#[derive(Serialize)]
struct Flip {
    /// `ldr` or `hdr`.
    range: &'static str,
    mean: Option<f64>,
    pixels_per_degree: f64,
    /// First and last, in stops; HDR only.
    exposures: Option<(f64, f64)>,
    exposure_count: Option<u32>,
}

/// Reads both pictures and prints every metric.
pub fn run(args: &CompareArgs, console: &Console) -> Result<(), Failure> {
    let read = |path| read_image(path).map_err(|e| Failure::Input(e.to_string()));
    let (image, reference) = (read(&args.image)?, read(&args.reference)?);
    let failed = |e: CompareError| Failure::Input(format!("cannot compare: {e}"));
    let comparison = compare(&image, &reference).map_err(failed)?;
    warn_of_left_out(&comparison, console);
    let ppd = args.ppd.unwrap_or(PIXELS_PER_DEGREE);
    let display = is_png(&args.image) && is_png(&args.reference);
    let (flip, map) = see(&image, &reference, ppd, display).map_err(failed)?;
    let (debiased, not_debiased) = match without_noise(&image, &reference, &args.reference) {
        Ok(found) => (Some(found), None),
        Err(why) => (None, Some(why)),
    };
    let figures = Figures {
        version: VERSION,
        comparison,
        debiased,
        not_debiased,
        flip,
    };
    if let Some(output) = &args.output {
        let picture = maps::picture(args.map, &image, &reference, &map).map_err(failed)?;
        write_map(output, &picture)?;
    }
    print(args, console, &figures, || figures.describe())
}

fn warn_of_left_out(comparison: &Comparison, console: &Console) {
    let (image, reference) = (comparison.non_finite_image, comparison.non_finite_reference);
    if image + reference > 0 {
        console.note(format_args!(
            "warning: pixels that are not finite say nothing: {image} of the image, {reference} of the reference"
        ));
    }
}

/// ꟻLIP and its map.
fn see(
    image: &Image,
    reference: &Image,
    ppd: f64,
    display: bool,
) -> Result<(Flip, ErrorMap), CompareError> {
    let mut flip = Flip {
        range: "ldr",
        mean: None,
        pixels_per_degree: ppd,
        exposures: None,
        exposure_count: None,
    };
    let map = if display {
        ldr_flip(image, reference, ppd)?
    } else {
        let found = hdr_flip(image, reference, ppd)?;
        flip.range = "hdr";
        flip.exposures = Some(found.exposures);
        flip.exposure_count = Some(found.count);
        found.map
    };
    flip.mean = map.mean();
    Ok((flip, map))
}

/// Errors less the reference's noise, if its file tells that.
fn without_noise(image: &Image, reference: &Image, path: &Path) -> Result<Debiased, String> {
    let names = ["Variance.R", "Variance.G", "Variance.B"];
    let channels = read_channels(path, &names)
        .map_err(|_| "the reference has no channels Variance.R, .G and .B".to_owned())?;
    let variance = super::same::picture(&channels, 0);
    debiased(image, reference, &variance).map_err(|e| e.to_string())
}

/// By its first bytes; what cannot be read is none.
fn is_png(path: &Path) -> bool {
    let mut start = [0; 8];
    File::open(path).is_ok_and(|mut f| f.read_exact(&mut start).is_ok())
        && &start == b"\x89PNG\r\n\x1a\n"
}

impl Figures {
    fn describe(&self) -> String {
        let mut text = self.comparison.describe();
        text += &match (&self.debiased, &self.not_debiased) {
            (Some(d), _) => format!(
                "\nwithout the reference's noise, by its own variance:\n\
                 MSE    {:.4e}  of which {:.1e} was taken off\n\
                 relMSE {:.4e}  of which {:.1e} was taken off",
                d.mse, d.reference_mse, d.relmse, d.reference_relmse
            ),
            (None, why) => format!(
                "\nwithout the reference's noise: not known, since {}",
                why.as_deref().unwrap_or_default()
            ),
        };
        let mean = self.flip.mean.unwrap_or(f64::NAN);
        let ppd = self.flip.pixels_per_degree;
        text += &match self.flip.exposures {
            None => format!(
                "\nFLIP   {mean:.4e}  LDR-FLIP: what one sees when flipping between them, 0 to 1, at \
                 {ppd:.0} pixels a degree"
            ),
            Some((start, stop)) => format!(
                "\nFLIP   {mean:.4e}  HDR-FLIP: what one sees when flipping between them at the worst of \
                 {} exposures\n       from {start:+.1} to {stop:+.1} stops, 0 to 1, at {ppd:.0} pixels a degree",
                self.flip.exposure_count.unwrap_or_default()
            ),
        };
        text
    }
}
