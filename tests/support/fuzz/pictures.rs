//! Pictures: EXR, PNG and HDR, told apart by what they hold.

use super::scratch::with_file;
use super::{Allowance, Fate};
use sr_pipeline::film_kernel::{read_attributes, read_channels, read_image};

/// As the reader promises.
pub(super) const ALLOWANCE: Allowance = Allowance {
    per_byte: 36 << 10,
    free: 132 << 20,
};

pub(super) fn picture(bytes: &[u8]) -> Fate {
    with_file("damaged.exr", bytes, |path| {
        let name = path.display().to_string();
        let is_exr = bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]);
        if is_exr {
            if let Ok(channels) = read_channels(path, &["R"]) {
                let pixels = channels.width as usize * channels.height as usize;
                assert!(pixels > 0 && channels.planes.iter().all(|p| p.len() == pixels));
            }
            if let Ok(attributes) = read_attributes(path) {
                let length: usize = attributes.iter().map(|(k, v)| k.len() + v.len()).sum();
                // Bytes that are no UTF-8 become three each.
                assert!(length <= 3 * bytes.len());
            }
        }
        match read_image(path) {
            Ok(image) => {
                let pixels = image.width as usize * image.height as usize;
                assert!(pixels > 0 && image.pixels.len() == pixels);
                // The bits of an EXR are anybody's; the others have no way to say infinity.
                assert!(
                    is_exr
                        || image
                            .pixels
                            .iter()
                            .all(|p| p.is_finite() && p.min_element() >= 0.0)
                );
                Fate::Read
            }
            Err(error) => {
                assert!(
                    error.to_string().contains(&name),
                    "the file is not named: {error}"
                );
                Fate::Refused(error.to_string())
            }
        }
    })
}
