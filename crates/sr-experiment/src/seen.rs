//! What a person would see: FLIP between pictures as the experiment shows them.

use crate::metrics::{CompareError, ErrorMap, PIXELS_PER_DEGREE, ldr_flip};
use glam::Vec3;
use sr_film::{DisplayImage, Image, ToneMap, develop, srgb};
use sr_pipeline::settings::{PostSettings, ToneMapName};

/// A reference as it is shown, to compare other pictures with.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    reference: Image,
    exposure: f32,
    tone_map: ToneMap,
}

impl Seen {
    /// Develops a reference.
    pub fn new(reference: &Image, post: &PostSettings) -> Self {
        let (exposure, tone_map) = (post.exposure, tone_map(post));
        Self {
            reference: light(&develop(reference, exposure, tone_map)),
            exposure,
            tone_map,
        }
    }

    /// LDR-FLIP of a picture that is developed likewise. A pixel that is not finite is shown as black,
    /// and counts as such.
    pub fn flip(&self, image: &Image) -> Result<ErrorMap, CompareError> {
        let shown = light(&develop(image, self.exposure, self.tone_map));
        ldr_flip(&shown, &self.reference, PIXELS_PER_DEGREE)
    }
}

/// The curve by its name.
pub(crate) fn tone_map(post: &PostSettings) -> ToneMap {
    match post.tone_map {
        ToneMapName::Srgb => ToneMap::Srgb,
        ToneMapName::AgX => ToneMap::AgX,
        ToneMapName::PbrNeutral => ToneMap::PbrNeutral,
    }
}

/// Display values as light.
fn light(image: &DisplayImage) -> Image {
    let pixel = |p: &[u8; 3]| Vec3::from(p.map(|c| srgb::decode(f32::from(c) / 255.0)));
    Image {
        width: image.width,
        height: image.height,
        pixels: image.pixels.iter().map(pixel).collect(),
    }
}
