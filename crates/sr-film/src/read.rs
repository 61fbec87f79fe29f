//! Image files in: OpenEXR, PNG and Radiance HDR, told apart by their first bytes.
//!
//! Whatever a file holds, reading it ends with a picture or with an error that names it. The size
//! that a header claims is checked before anything is allocated: against a fixed limit, and
//! against what a file of this length could hold at the best compression. So a file of n bytes takes
//! at most 132 MiB + 36 KiB · n. The decoders are other people's code, so a panic in one of them is
//! caught and becomes an error as well.

use crate::{Image, ImageError, srgb};
use exr::image::{AnyChannel, AnyChannels, FlatSamples, Layer as ExrLayer};
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{ReadChannels, ReadLayers, SmallVec};
use glam::Vec3;
use std::io::{Cursor, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Most pixels of a file: 2²⁸, a square of 16384.
const MAX_PIXELS: u64 = 1 << 28;

/// Longest file read: 8 GiB.
const MAX_FILE_BYTES: u64 = 8 << 30;

/// Bytes that one byte of a file can stand for. Deflate reaches 1032, PIZ on constant pictures
/// about 400, run lengths 64; the headroom is for formats' overheads.
const MAX_EXPANSION: u64 = 4096;

/// Pixels that any file may have, however well it is compressed, and further ones for each of its bytes: blank
/// pictures of one bit a pixel reach 8256, and become 19 bytes a pixel in memory.
const FREE_PIXELS: u64 = 1 << 22;
const PIXELS_PER_BYTE: u64 = 1024;

/// Planes of a file, as asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Channels {
    /// Number of columns of the data window.
    pub width: u32,
    /// Number of rows of the data window.
    pub height: u32,
    /// One plane per name, in the order of the names, row-major.
    pub planes: Vec<Vec<f32>>,
}

/// Reads the colours of a file as linear Rec. 709.
///
/// - OpenEXR: channels `R`, `G`, `B` of the first part that has them, else `Y` as grey; the data
///   window only. Channels with dotted names are left alone.
/// - PNG of any kind: decoded by the sRGB curve; alpha and colour profiles are ignored.
/// - Radiance HDR: as it is.
///
/// # Errors
/// A file that cannot be read, is of another kind, malformed, too large, or without colours.
pub fn read_image(path: impl AsRef<Path>) -> Result<Image, ImageError> {
    let path = path.as_ref();
    let bytes = read_file(path)?;
    match kind_of(&bytes) {
        Some(Kind::Exr) => {
            let parts = exr_parts(path, &bytes)?;
            let colours = select(path, &parts, &["R", "G", "B"]);
            let channels = colours.or_else(|no_colours| {
                select(path, &parts, &["Y", "Y", "Y"]).map_err(|_| no_colours)
            })?;
            let [r, g, b] = [0, 1, 2].map(|i| channels.planes[i].iter());
            Ok(Image {
                width: channels.width,
                height: channels.height,
                pixels: r
                    .zip(g)
                    .zip(b)
                    .map(|((&r, &g), &b)| Vec3::new(r, g, b))
                    .collect(),
            })
        }
        Some(Kind::Png) => read_with_image_crate(path, &bytes, image::ImageFormat::Png),
        Some(Kind::Hdr) => read_with_image_crate(path, &signed(bytes), image::ImageFormat::Hdr),
        None => Err(unknown_kind(path)),
    }
}

/// Reads channels of an EXR by their full names, all from one part, as floats.
///
/// # Errors
/// As [`read_image`]; a missing channel is an error that lists those there are.
pub fn read_channels(path: impl AsRef<Path>, names: &[&str]) -> Result<Channels, ImageError> {
    let path = path.as_ref();
    select(path, &exr_parts(path, &read_exr_file(path)?)?, names)
}

/// Reads the text attributes of an EXR's first part, sorted by name; provenance has
/// [`crate::ATTRIBUTE_PREFIX`].
///
/// # Errors
/// A file that cannot be read, is no EXR, or is malformed.
pub fn read_attributes(path: impl AsRef<Path>) -> Result<Vec<(String, String)>, ImageError> {
    let path = path.as_ref();
    let bytes = read_exr_file(path)?;
    let meta = exr_meta(path, &bytes)?;
    let mut all: Vec<(String, String)> = meta.headers[0]
        .own_attributes
        .other
        .iter()
        .filter_map(|(name, value)| match value {
            AttributeValue::Text(value) => Some((to_string(name), to_string(value))),
            _ => None,
        })
        .collect();
    all.sort();
    Ok(all)
}

fn to_string(text: &Text) -> String {
    String::from_utf8_lossy(text.as_slice()).into_owned()
}

enum Kind {
    Exr,
    Png,
    Hdr,
}

fn kind_of(bytes: &[u8]) -> Option<Kind> {
    if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        Some(Kind::Exr)
    } else if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some(Kind::Png)
    } else if bytes.starts_with(b"#?RADIANCE") || bytes.starts_with(b"#?RGBE") {
        Some(Kind::Hdr)
    } else {
        None
    }
}

/// Both signatures of Radiance files mean the same; the decoder knows one of them.
fn signed(bytes: Vec<u8>) -> Vec<u8> {
    match bytes.strip_prefix(b"#?RGBE") {
        Some(rest) => [b"#?RADIANCE", rest].concat(),
        None => bytes,
    }
}

fn unknown_kind(path: &Path) -> ImageError {
    ImageError::format(path, "neither OpenEXR, PNG nor Radiance HDR")
}

fn read_file(path: &Path) -> Result<Vec<u8>, ImageError> {
    let at_path = |e| ImageError::io(path, e);
    // Asked before it is opened: to open a pipe is to wait for somebody who writes.
    let meta = std::fs::metadata(path).map_err(at_path)?;
    if !meta.is_file() {
        return Err(ImageError::format(path, "not a regular file"));
    }
    if meta.len() > MAX_FILE_BYTES {
        let message = format!("{} bytes are too many to read", meta.len());
        return Err(ImageError::format(path, message));
    }
    let file = std::fs::File::open(path).map_err(at_path)?;
    let mut bytes = Vec::new();
    // `take`, should the file grow meanwhile.
    file.take(MAX_FILE_BYTES)
        .read_to_end(&mut bytes)
        .map_err(at_path)?;
    Ok(bytes)
}

fn read_exr_file(path: &Path) -> Result<Vec<u8>, ImageError> {
    let bytes = read_file(path)?;
    match kind_of(&bytes) {
        Some(Kind::Exr) => Ok(bytes),
        _ => Err(ImageError::format(path, "not an OpenEXR file")),
    }
}

/// Runs a decoder; its errors and panics become ours.
fn guarded<T, E: std::fmt::Display>(
    path: &Path,
    decode: impl FnOnce() -> Result<T, E>,
) -> Result<T, ImageError> {
    match catch_unwind(AssertUnwindSafe(decode)) {
        Ok(result) => result.map_err(|e| ImageError::format(path, e)),
        Err(_) => Err(ImageError::format(path, "malformed: its decoder gave up")),
    }
}

/// Refuses sizes that are absurd as such, or for a file of this length.
fn check_size(
    path: &Path,
    [width, height]: [u64; 2],
    pixel_bits: u64,
    file_bytes: usize,
) -> Result<(), ImageError> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 || pixels > MAX_PIXELS {
        let message = format!("a size of {width} × {height} pixels, 1 to {MAX_PIXELS} can be read");
        return Err(ImageError::format(path, message));
    }
    let file_bytes = file_bytes as u64;
    let bits = file_bytes.saturating_mul(8 * MAX_EXPANSION);
    let most = FREE_PIXELS.saturating_add(file_bytes.saturating_mul(PIXELS_PER_BYTE));
    if pixels.saturating_mul(pixel_bits) > bits || pixels > most {
        let message = format!("claims {width} × {height} pixels in {file_bytes} bytes");
        return Err(ImageError::format(path, message));
    }
    Ok(())
}

fn exr_meta(path: &Path, bytes: &[u8]) -> Result<MetaData, ImageError> {
    let meta = guarded(path, || {
        MetaData::read_from_buffered(Cursor::new(bytes), false)
    })?;
    if meta.headers.is_empty() {
        return Err(ImageError::format(path, "has no part"));
    }
    let mut rest = bytes.len();
    for header in &meta.headers {
        let channels = &header.channels.list;
        let pixel_bits: u64 = channels
            .iter()
            .map(|c| 8 * c.sample_type.bytes_per_sample() as u64)
            .sum();
        let size = [header.layer_size.x() as u64, header.layer_size.y() as u64];
        check_size(path, size, pixel_bits, rest)?;
        // All parts are in memory at once, so what one of them claims is not there for the next.
        let claimed =
            size[0].saturating_mul(size[1]).saturating_mul(pixel_bits) / (8 * MAX_EXPANSION);
        rest -= (claimed as usize).min(rest);
    }
    if meta.headers.iter().any(|h| h.deep) {
        return Err(ImageError::format(path, "deep data cannot be read"));
    }
    Ok(meta)
}

type ExrPart = ExrLayer<AnyChannels<FlatSamples>>;

fn exr_parts(path: &Path, bytes: &[u8]) -> Result<SmallVec<[ExrPart; 2]>, ImageError> {
    exr_meta(path, bytes)?;
    let image = guarded(path, || {
        exr::image::read::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .non_parallel()
            .from_buffered(Cursor::new(bytes))
    })?;
    Ok(image.layer_data)
}

/// The planes of these names from the first part that has them all.
fn select(path: &Path, parts: &[ExrPart], names: &[&str]) -> Result<Channels, ImageError> {
    let found = parts
        .iter()
        .find_map(|layer| Some((layer, find_all(layer, names)?)));
    let Some((layer, channels)) = found else {
        let message = format!(
            "no part has the channels {}; there are {}",
            names.join(", "),
            channel_list(parts)
        );
        return Err(ImageError::format(path, message));
    };
    let (width, height) = (layer.size.x(), layer.size.y());
    let mut planes = Vec::with_capacity(names.len());
    for channel in channels {
        let plane: Vec<f32> = channel.sample_data.values_as_f32().collect();
        if plane.len() != width * height {
            let message = format!("channel {} is subsampled", channel.name);
            return Err(ImageError::format(path, message));
        }
        planes.push(plane);
    }
    Ok(Channels {
        width: width as u32,
        height: height as u32,
        planes,
    })
}

/// The channels of these names, when the part has them all.
fn find_all<'a>(part: &'a ExrPart, names: &[&str]) -> Option<Vec<&'a AnyChannel<FlatSamples>>> {
    let find = |name: &&str| part.channel_data.list.iter().find(|c| c.name.eq(name));
    names.iter().map(find).collect()
}

fn channel_list(parts: &[ExrPart]) -> String {
    let names: Vec<String> = parts
        .iter()
        .flat_map(|part| part.channel_data.list.iter().map(|c| c.name.to_string()))
        .collect();
    names.join(", ")
}

fn read_with_image_crate(
    path: &Path,
    bytes: &[u8],
    format: image::ImageFormat,
) -> Result<Image, ImageError> {
    let reader = || image::ImageReader::with_format(Cursor::new(bytes), format);
    let (width, height) = guarded(path, || reader().into_dimensions())?;
    let pixel_bits = match format {
        image::ImageFormat::Hdr => 32,
        // A PNG may have one bit a pixel.
        _ => 1,
    };
    let size = [u64::from(width), u64::from(height)];
    check_size(path, size, pixel_bits, bytes.len())?;
    let decoded = guarded(path, || {
        let mut reader = reader();
        let mut limits = image::Limits::default();
        // At most four channels of four bytes, and the same again for the decoder.
        limits.max_alloc = Some(u64::from(width) * u64::from(height) * 32 + (1 << 20));
        reader.limits(limits);
        reader.decode()
    })?;
    let pixels = match format {
        image::ImageFormat::Hdr => {
            let pixels = decoded.into_rgb32f();
            pixels.pixels().map(|p| Vec3::from_array(p.0)).collect()
        }
        _ => {
            // 8-bit codes times 257 are the same fractions of 65535.
            let table: Vec<f32> = (0..=u16::MAX)
                .map(|code| srgb::decode(f32::from(code) / 65_535.0))
                .collect();
            let pixels = decoded.into_rgb16();
            pixels
                .pixels()
                .map(|p| Vec3::from_array(p.0.map(|code| table[usize::from(code)])))
                .collect()
        }
    };
    Ok(Image {
        width,
        height,
        pixels,
    })
}
