//! The pictures that are shown: those of runs with what they wrote beside them, and attached ones.

use crate::document::Attachment;
use crate::folder::Folder;
use crate::plan::Plan;
use crate::run::Outcome;
use crate::seen::tone_map;
use sr_film::{DisplayImage, ToneMap, develop, png_bytes, read_image, srgb};
use std::path::PathBuf;

/// A picture to show.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    /// What it is, such as `rate`; empty for the picture itself.
    pub what: String,
    path: PathBuf,
    /// Stops and tone map of a file that holds radiance; one that was developed is shown as it is.
    post: Option<(f32, ToneMap)>,
}

/// A point's picture (or the part of it that the experiment shows), and what stands beside it.
pub(crate) fn of_point(
    plan: &Plan,
    outcome: &Outcome,
    point: usize,
    folder: &Folder,
) -> Vec<Picture> {
    let Some(shown) = outcome.shown(plan, point) else {
        return Vec::new();
    };
    let id = &plan.runs[shown.run].id;
    let picture = |(what, path)| Picture {
        what,
        path,
        post: None,
    };
    let (cut, beside): (Vec<_>, Vec<_>) = folder
        .further_pictures(id)
        .into_iter()
        .partition(|(what, _)| what == CROP);
    let whole = (String::new(), folder.run(id, ".png"));
    let first = cut.into_iter().next().unwrap_or(whole);
    [first].into_iter().chain(beside).map(picture).collect()
}

/// The end of the name of a picture's part.
const CROP: &str = "crop";

/// Attached pictures with their captions, developed as the first point's picture is but for an exposure
/// of their own.
pub(crate) fn attached(plan: &Plan) -> Vec<(Picture, String)> {
    let first = plan.facts.first();
    let post = first.map(|f| (f.post.exposure, tone_map(&f.post)));
    let picture = |attachment: &Attachment| {
        let extension = attachment.path.extension();
        let extension = extension.unwrap_or_default().to_string_lossy();
        let post = post.filter(|_| !extension.eq_ignore_ascii_case("png"));
        Picture {
            what: String::new(),
            path: attachment.path.clone(),
            post: post.map(|(ours, tone_map)| (attachment.exposure.unwrap_or(ours), tone_map)),
        }
    };
    let attached = plan.experiment.attach.iter();
    attached.map(|a| (picture(a), a.caption.clone())).collect()
}

impl Picture {
    /// For the screen.
    pub fn display(&self) -> Result<DisplayImage, String> {
        let image = read_image(&self.path).map_err(|e| e.to_string())?;
        let (exposure, tone_map) = self.post.unwrap_or((0.0, ToneMap::Srgb));
        Ok(develop(&image, exposure, tone_map))
    }

    /// The bytes of a PNG file.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        if self.post.is_none() {
            let cause = |e| format!("{}: {e}", self.path.display());
            return std::fs::read(&self.path).map_err(cause);
        }
        png_bytes(&self.display()?).map_err(|e| format!("{}: {e}", self.path.display()))
    }
}

/// The part x0, y0, x1, y1 of a picture, which lies inside of it.
pub(crate) fn cut(image: &DisplayImage, [x0, y0, x1, y1]: [u32; 4]) -> DisplayImage {
    let rows = (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y)));
    let pixel = |(x, y): (u32, u32)| image.pixels[y as usize * image.width as usize + x as usize];
    DisplayImage {
        width: x1 - x0,
        height: y1 - y0,
        pixels: rows.map(pixel).collect(),
    }
}

/// Each pixel as a square of so many.
pub(crate) fn enlarged(picture: &DisplayImage, factor: u32) -> DisplayImage {
    let (width, height) = (picture.width * factor, picture.height * factor);
    let source = |x: u32, y: u32| (y / factor * picture.width + x / factor) as usize;
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    DisplayImage {
        width,
        height,
        pixels: places.map(|(x, y)| picture.pixels[source(x, y)]).collect(),
    }
}

/// A display value as light, for averages.
pub(crate) fn light(pixel: [u8; 3]) -> [f32; 3] {
    pixel.map(|c| srgb::decode(f32::from(c) / 255.0))
}
