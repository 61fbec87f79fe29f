//! Image files out: OpenEXR for data, PNG for looking at.
//!
//! An EXR has one part. The picture is in plain `R`, `G`, `B`; everything else has dotted names:
//! `Variance.R/G/B` (of the mean), `SampleCount.Y`, and the layers' ([`Layer::channel_names`]). The
//! data window is the crop, the display window the whole picture. Compression is ZIP over 16 lines,
//! lossless.
//!
//! [`Layer::channel_names`]: crate::Layer::channel_names

use crate::{DisplayImage, FilmImage, Image, ImageError, Rect, write_atomically};
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Layer as ExrLayer};
use exr::meta::attribute::{AttributeValue, IntegerBounds, LineOrder, Text};
use exr::meta::header::LayerAttributes;
use exr::prelude::{Blocks, Compression, SmallVec};
use glam::Vec3;
use half::f16;
use std::io::Write;
use std::path::Path;

/// What the names of our attributes begin with, so that none is taken for a standard one.
pub const ATTRIBUTE_PREFIX: &str = "steradian.";

/// Precision of the colours in an EXR. Variances, counts, ids and depths are always floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 16 bits: 11 significant bits up to 65504.
    Half,
    /// 32 bits: what was computed.
    Float,
}

/// What writing a file did to the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteReport {
    /// Values beyond ±65504 that became ±65504 in half precision.
    pub saturated: u64,
    /// Values other than 0 that became 0 in half precision: those of at most 2⁻²⁵, about 3·10⁻⁸.
    pub vanished: u64,
}

/// A value in half precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfValue {
    /// The nearest one that the format has, within ±65504.
    pub value: f16,
    /// It was out of range.
    pub saturated: bool,
    /// It was not 0 and is now.
    pub vanished: bool,
}

/// Writes a resolved film with all its layers.
///
/// Each provenance pair becomes a text attribute, [`ATTRIBUTE_PREFIX`] and name; values are UTF-8 of
/// any length. The file appears whole or not at all, see [`write_atomically`].
///
/// # Errors
/// An attribute name that is empty, repeated or longer than EXR allows (255 bytes with the prefix),
/// or a failure of the file system.
pub fn write_exr(
    path: impl AsRef<Path>,
    image: &FilmImage,
    precision: Precision,
    provenance: &[(String, String)],
) -> Result<WriteReport, ImageError> {
    let mut file = ExrFile::new(image.crop, image.picture, precision);
    file.push_rgb("", &image.rgb, false);
    file.push_rgb("Variance.", &image.variance_of_mean, true);
    let counts = image.sample_count.iter().map(|&n| n as f32);
    file.push("SampleCount.Y", counts.collect(), true);
    for layer in &image.layers {
        let names = layer.layer.channel_names();
        for (name, plane) in names.iter().zip(&layer.planes) {
            file.push(name, plane.clone(), layer.layer.needs_float());
        }
    }
    file.write(path.as_ref(), provenance)
}

/// Writes a plain picture; else as [`write_exr`].
///
/// # Errors
/// As [`write_exr`].
pub fn write_image_exr(
    path: impl AsRef<Path>,
    image: &Image,
    precision: Precision,
    provenance: &[(String, String)],
) -> Result<WriteReport, ImageError> {
    let (width, height) = (image.width, image.height);
    let mut file = ExrFile::new(Rect::of_size(width, height), (width, height), precision);
    file.push_rgb("", image, false);
    file.write(path.as_ref(), provenance)
}

/// Writes display code values as an 8-bit RGB PNG, whole or not at all.
///
/// # Errors
/// A failure of the file system.
pub fn write_png(path: impl AsRef<Path>, image: &DisplayImage) -> Result<(), ImageError> {
    let path = path.as_ref();
    write_atomically(path, |writer| {
        encode_png(writer, image).map_err(|e| ImageError::format(path, e))
    })
}

/// The bytes of the file that [`write_png`] writes.
///
/// # Errors
/// A picture without pixels, or of more than a PNG holds.
pub fn png_bytes(image: &DisplayImage) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    encode_png(&mut bytes, image).map_err(|e| e.to_string())?;
    Ok(bytes)
}

fn encode_png(writer: impl Write, image: &DisplayImage) -> image::ImageResult<()> {
    image::ImageEncoder::write_image(
        image::codecs::png::PngEncoder::new(writer),
        image.pixels.as_flattened(),
        image.width,
        image.height,
        image::ExtendedColorType::Rgb8,
    )
}

/// An EXR under construction.
struct ExrFile {
    window: Rect,
    picture: (u32, u32),
    precision: Precision,
    channels: SmallVec<[AnyChannel<FlatSamples>; 4]>,
    report: WriteReport,
}

impl ExrFile {
    fn new(window: Rect, picture: (u32, u32), precision: Precision) -> Self {
        Self {
            window,
            picture,
            precision,
            channels: SmallVec::new(),
            report: WriteReport::default(),
        }
    }

    fn push(&mut self, name: &str, values: Vec<f32>, needs_float: bool) {
        let samples = match self.precision {
            Precision::Half if !needs_float => {
                let report = &mut self.report;
                FlatSamples::F16(values.into_iter().map(|v| report.narrow(v)).collect())
            }
            _ => FlatSamples::F32(values),
        };
        self.channels.push(AnyChannel::new(name, samples));
    }

    fn push_rgb(&mut self, prefix: &str, image: &Image, needs_float: bool) {
        type Component = fn(&Vec3) -> f32;
        let components: [(&str, Component); 3] = [("R", |p| p.x), ("G", |p| p.y), ("B", |p| p.z)];
        for (name, component) in components {
            let plane = image.pixels.iter().map(component).collect();
            self.push(&format!("{prefix}{name}"), plane, needs_float);
        }
    }

    fn write(
        self,
        path: &Path,
        provenance: &[(String, String)],
    ) -> Result<WriteReport, ImageError> {
        let mut attributes = LayerAttributes::default();
        let corner = |x: u32, y: u32| (x as i32, y as i32);
        attributes.layer_position = corner(self.window.x0, self.window.y0).into();
        attributes.software_name = Some(Text::new_or_panic("Steradian"));
        for (name, value) in provenance {
            let key = attribute_name(name).map_err(|m| ImageError::format(path, m))?;
            // Not `Text::from`, which knows Latin-1 only; other readers take the bytes for UTF-8.
            let value = Text::from_slice_unchecked(value.as_bytes());
            let old = attributes.other.insert(key, AttributeValue::Text(value));
            if old.is_some() {
                let message = format!("attribute \"{name}\" is given twice");
                return Err(ImageError::format(path, message));
            }
        }
        let layer = ExrLayer::new(
            (self.window.width() as usize, self.window.height() as usize),
            attributes,
            Encoding {
                compression: Compression::ZIP16,
                blocks: Blocks::ScanLines,
                line_order: LineOrder::Increasing,
            },
            AnyChannels::sort(self.channels),
        );
        let mut image = exr::image::Image::from_layer(layer);
        let size = (self.picture.0 as usize, self.picture.1 as usize);
        image.attributes.display_window = IntegerBounds::new((0, 0), size);
        write_atomically(path, |writer| {
            // One thread: the only pool is the renderer's.
            let result = image.write().non_parallel().to_buffered(&mut *writer);
            result.map_err(|e| match e {
                exr::error::Error::Io(e) => ImageError::io(path, e),
                e => ImageError::format(path, e),
            })?;
            writer.flush().map_err(|e| ImageError::io(path, e))
        })?;
        Ok(self.report)
    }
}

/// Rounds to half precision; infinity is out of range like any other large value.
pub fn to_half(value: f32) -> HalfValue {
    let limit = f16::MAX.to_f32();
    let narrow = f16::from_f32(value.clamp(-limit, limit));
    HalfValue {
        value: narrow,
        saturated: value.abs() > limit,
        vanished: value != 0.0 && narrow.to_f32() == 0.0,
    }
}

impl WriteReport {
    /// Rounds a value and counts what that did to it.
    fn narrow(&mut self, value: f32) -> f16 {
        let half = to_half(value);
        self.saturated += u64::from(half.saturated);
        self.vanished += u64::from(half.vanished);
        half.value
    }
}

fn attribute_name(name: &str) -> Result<Text, String> {
    let full = format!("{ATTRIBUTE_PREFIX}{name}");
    if name.is_empty() || name.contains('\0') || full.len() > 255 {
        return Err(format!("\"{name}\" cannot be the name of an attribute"));
    }
    Ok(Text::from_slice_unchecked(full.as_bytes()))
}
