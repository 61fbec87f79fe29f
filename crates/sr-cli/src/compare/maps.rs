//! Where an image and its reference differ, as a picture.

use crate::args::MapKind;
use sr_experiment::{CompareError, ErrorMap, PixelError, Scale, error_map};
use sr_pipeline::film_kernel::{DisplayImage, Image};

/// Decades that a map of squared errors shows, below the largest.
const DECADES: i32 = 6;

/// Relative error that has the full colour in a signed map.
const SIGNED_END: f32 = 0.5;

pub fn picture(
    kind: MapKind,
    image: &Image,
    reference: &Image,
    flip: &ErrorMap,
) -> Result<DisplayImage, CompareError> {
    let squared = |error| -> Result<DisplayImage, CompareError> {
        let map = error_map(image, reference, error)?;
        let end = map.max().min(f32::MAX);
        let scale = Scale::Log(end * 10f32.powi(-DECADES), end);
        Ok(map.false_colour(scale))
    };
    match kind {
        MapKind::Flip => Ok(flip.false_colour(Scale::Linear(1.0))),
        MapKind::Squared => squared(PixelError::Squared),
        MapKind::Relative => squared(PixelError::SquaredRelative),
        MapKind::Signed => {
            let map = error_map(image, reference, PixelError::Signed)?;
            Ok(map.false_colour(Scale::Diverging(SIGNED_END)))
        }
    }
}
