//! A picture of sample counts in false colour.
//!
//! The colour map is Turbo (Mikhailov 2019, "Turbo, an improved rainbow colormap"): from blue for
//! few to red for many, as sampling rates are usually drawn, but without the false edges of the
//! plain rainbow, and steady in lightness on either side of the middle.

use crate::{DisplayImage, FilmImage};

/// The sample counts of a picture over `most`: dark blue for none, red for `most` and above.
pub fn rate_picture(image: &FilmImage, most: u64) -> DisplayImage {
    let most = most.max(1) as f64;
    let colour = |&count: &u32| {
        let share = (f64::from(count) / most).min(1.0);
        colorous::TURBO.eval_continuous(share).as_array()
    };
    DisplayImage {
        width: image.width,
        height: image.height,
        pixels: image.sample_count.iter().map(colour).collect(),
    }
}
