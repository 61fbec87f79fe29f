//! Files: what is written comes back, and nothing that is read can do harm.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

use glam::Vec3;
use sr_film::{
    DisplayImage, Film, FilmImage, FilmSpec, Image, Layer, Precision, Rect, VarianceEstimator,
    read_attributes, read_channels, read_image, srgb, write_exr, write_image_exr, write_png,
};
use sr_math::hash;
use std::path::Path;

/// A crop of 21 × 18 with all layers and values of all sizes.
fn film_image() -> FilmImage {
    let mut film = Film::new(FilmSpec {
        crop: Rect {
            x0: 3,
            y0: 2,
            x1: 24,
            y1: 20,
        },
        layers: Layer::ALL.to_vec(),
        ..FilmSpec::of_size(32, 24)
    })
    .unwrap();
    for tile in film.tiles_mut() {
        for p in 0..tile.pixel_count() {
            let (x, y) = tile.pixel(p);
            for i in 0..4 {
                let u = |c| hash::unit_f32(hash::mix(hash::mix(x, y), hash::mix(i as u32, c)));
                let rgb = Vec3::new(u(0), 1e3 * u(1), 1e-3 * u(2));
                tile.add(p, i, rgb).unwrap();
                for layer in Layer::ALL {
                    // Ids and distances that half precision would spoil.
                    tile.add_layer(p, layer, i, Vec3::new(12_345.0 + u(3), 4_097.0, -0.25))
                        .unwrap();
                }
            }
        }
    }
    film.resolve(VarianceEstimator::Samples)
}

fn provenance() -> Vec<(String, String)> {
    [
        ("seed", "42"),
        (
            "config",
            &"(scene: \"a.ron\") // Größe ≤ 4 μm\n".repeat(5000),
        ),
        ("a_name_of_more_than_thirty_one_characters", "long"),
        ("empty", ""),
        // Names that EXR itself uses.
        ("channels", "not the channel list"),
        ("compression", "none"),
    ]
    .map(|(k, v)| (k.to_owned(), v.to_owned()))
    .into()
}

fn planes_of(image: &Image) -> [Vec<f32>; 3] {
    [0, 1, 2].map(|c| image.pixels.iter().map(|p| p[c]).collect())
}

#[test]
fn an_exr_of_floats_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.exr");
    let image = film_image();
    let report = write_exr(&path, &image, Precision::Float, &provenance()).unwrap();
    assert_eq!(report.saturated, 0);
    assert_eq!(read_image(&path).unwrap(), image.rgb);

    let variance = read_channels(&path, &["Variance.R", "Variance.G", "Variance.B"]).unwrap();
    assert_eq!((variance.width, variance.height), (21, 18));
    assert_eq!(variance.planes[..], planes_of(&image.variance_of_mean));
    let count = read_channels(&path, &["SampleCount.Y"]).unwrap();
    assert!(count.planes[0].iter().all(|&n| n == 4.0));
    for layer in &image.layers {
        let read = read_channels(&path, layer.layer.channel_names()).unwrap();
        assert_eq!(read.planes, layer.planes, "{:?}", layer.layer);
    }
    // The order of names is the caller's.
    let swapped = read_channels(&path, &["B", "R"]).unwrap();
    let [r, _, b] = planes_of(&image.rgb);
    assert_eq!(swapped.planes, [b, r]);

    let mut expected: Vec<_> = provenance()
        .into_iter()
        .map(|(k, v)| (format!("steradian.{k}"), v))
        .collect();
    expected.sort();
    assert_eq!(read_attributes(&path).unwrap(), expected);
}

#[test]
fn the_names_in_the_file_are_the_documented_ones() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.exr");
    write_exr(&path, &film_image(), Precision::Half, &[]).unwrap();
    let meta = exr::meta::MetaData::read_from_file(&path, true).unwrap();
    assert_eq!(meta.headers.len(), 1);
    let header = &meta.headers[0];
    let (mut halves, mut floats) = (Vec::new(), Vec::new());
    for channel in &header.channels.list {
        match channel.sample_type {
            exr::prelude::SampleType::F16 => halves.push(channel.name.to_string()),
            exr::prelude::SampleType::F32 => floats.push(channel.name.to_string()),
            exr::prelude::SampleType::U32 => panic!("no integers"),
        }
    }
    let colours = "Albedo.B Albedo.G Albedo.R B Bounces.Y G N.X N.Y N.Z R";
    let data =
        "Depth.Z Id.Material Id.Shape SampleCount.Y Seconds.Y Variance.B Variance.G Variance.R";
    assert_eq!(halves.join(" "), colours);
    assert_eq!(floats.join(" "), data);
    assert_eq!(header.compression, exr::prelude::Compression::ZIP16);
    let data_window = header.data_window();
    assert_eq!((data_window.position.x(), data_window.position.y()), (3, 2));
    let display = header.shared_attributes.display_window.size;
    assert_eq!((display.x(), display.y()), (32, 24));
}

#[test]
fn half_rounds_colours_saturates_and_leaves_data_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.exr");
    let mut image = film_image();
    let big = [65_504.0, 65_505.0, 1e9, f32::MAX];
    for (pixel, v) in image.rgb.pixels.iter_mut().zip(big) {
        *pixel = Vec3::new(v, 0.0, 1.0);
    }
    let report = write_exr(&path, &image, Precision::Half, &[]).unwrap();
    assert_eq!(report.saturated, 3);
    let read = read_image(&path).unwrap();
    for (read, written) in read.pixels.iter().zip(&image.rgb.pixels) {
        let written = written.min(Vec3::splat(65_504.0));
        // 11 significant bits: half an ulp is 2⁻¹¹ of the value, or 2⁻²⁵ among the subnormals.
        let bound = written * 2f32.powi(-11) + 2f32.powi(-25);
        assert!((*read - written).abs().cmple(bound).all(), "{written}");
    }
    let data = ["Variance.G", "Depth.Z", "Id.Shape"];
    let read = read_channels(&path, &data).unwrap();
    assert_eq!(read.planes[0], planes_of(&image.variance_of_mean)[1]);
    assert_eq!(read.planes[1], image.layers[1].planes[0]);
    assert_eq!(read.planes[2], image.layers[3].planes[0]);

    // Half of the smallest subnormal, 2⁻²⁴, rounds to the even neighbour, 0.
    let tiny = [2f32.powi(-25), 2f32.powi(-25).next_up(), 0.0];
    let report = write_image_exr(
        &path,
        &Image::filled(1, 1, tiny.into()),
        Precision::Half,
        &[],
    );
    assert_eq!(report.unwrap().vanished, 1);
    let stored = read_image(&path).unwrap().pixels[0];
    assert_eq!(stored, Vec3::new(0.0, 2f32.powi(-24), 0.0));

    let infinite = Image::filled(1, 1, Vec3::new(f32::INFINITY, f32::NEG_INFINITY, 0.0));
    let report = write_image_exr(&path, &infinite, Precision::Half, &[]).unwrap();
    assert_eq!((report.saturated, report.vanished), (2, 0));
    assert_eq!(
        read_image(&path).unwrap().pixels[0],
        Vec3::new(65_504.0, -65_504.0, 0.0)
    );
}

#[test]
fn a_failed_write_keeps_the_earlier_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.exr");
    let image = film_image();
    write_exr(&path, &image, Precision::Float, &[]).unwrap();
    let before = std::fs::read(&path).unwrap();
    let pair = |k: &str| (k.to_owned(), String::new());
    let failures = [
        vec![pair("")],
        vec![pair("a\0b")],
        vec![pair(&"x".repeat(300))],
        vec![pair("seed"), pair("seed")],
    ];
    for bad in failures {
        let error = write_exr(&path, &image, Precision::Float, &bad).unwrap_err();
        assert!(error.to_string().contains("film.exr"), "{error}");
    }
    // One that only shows while the pixels are written.
    let mut broken = image.clone();
    broken.sample_count.truncate(5);
    let written = std::panic::catch_unwind(|| write_exr(&path, &broken, Precision::Float, &[]));
    assert!(!matches!(written, Ok(Ok(_))));
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_png_comes_back_through_the_curve() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("codes.png");
    let image = DisplayImage {
        width: 256,
        height: 1,
        pixels: (0..=255).map(|v| [v, 255 - v, 7]).collect(),
    };
    write_png(&path, &image).unwrap();
    let read = read_image(&path).unwrap();
    assert_eq!((read.width, read.height), (256, 1));
    for (linear, codes) in read.pixels.iter().zip(&image.pixels) {
        let code = srgb::encode_rgb(*linear) * 255.0;
        let off = code - Vec3::from_array(codes.map(f32::from));
        assert!(off.abs().max_element() < 1e-3, "{codes:?}: {code}");
    }
}

#[test]
fn pngs_of_other_kinds_are_decoded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let grey = image::ImageBuffer::from_pixel(2, 1, image::Luma([0x8001u16]));
    grey.save(&path).unwrap();
    let linear = srgb::decode(f32::from(0x8001u16) / 65_535.0);
    assert_eq!(read_image(&path).unwrap().pixels, [Vec3::splat(linear); 2]);
    // Alpha is ignored, not multiplied in.
    let clear = image::ImageBuffer::from_pixel(2, 1, image::Rgba([255u8, 0, 51, 0]));
    clear.save(&path).unwrap();
    let linear = Vec3::new(1.0, 0.0, srgb::decode(0.2));
    assert_eq!(read_image(&path).unwrap().pixels, [linear; 2]);
}

fn write_hdr(path: &Path) {
    let file = std::fs::File::create(path).unwrap();
    let pixels: Vec<_> = (0..40 * 9)
        .map(|i| image::Rgb([i as f32, 1.0, 0.25]))
        .collect();
    image::codecs::hdr::HdrEncoder::new(file)
        .encode(&pixels, 40, 9)
        .unwrap();
}

#[test]
fn radiance_files_are_linear() {
    let folder = tempfile::tempdir().unwrap();
    // The kind is in the file, not in its name.
    let path = folder.path().join("sky.png");
    write_hdr(&path);
    let read = read_image(&path).unwrap();
    // The other signature that programs write.
    let bytes = std::fs::read(&path).unwrap();
    let rest = bytes.strip_prefix(b"#?RADIANCE").unwrap();
    std::fs::write(&path, [b"#?RGBE", rest].concat()).unwrap();
    assert_eq!(read_image(&path).unwrap(), read);
    assert_eq!((read.width, read.height), (40, 9));
    for (i, p) in read.pixels.iter().enumerate() {
        let written = Vec3::new(i as f32, 1.0, 0.25);
        // Eight bits of mantissa under the exponent of the largest channel.
        assert!(
            (*p - written).abs().max_element() <= written.max_element() / 128.0,
            "{p}"
        );
    }
}

#[test]
fn greys_and_foreign_parts_are_found() {
    use exr::prelude::*;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("parts.exr");
    let layer = |name: &str, channels: &[(&str, f32)]| {
        let channels = channels
            .iter()
            .map(|&(name, v)| AnyChannel::new(name, FlatSamples::F32(vec![v; 6])));
        Layer::new(
            (3, 2),
            LayerAttributes::named(name),
            Encoding::UNCOMPRESSED,
            AnyChannels::sort(channels.collect()),
        )
    };
    let beauty = layer("beauty", &[("R", 1.0), ("G", 2.0), ("B", 3.0), ("A", 0.5)]);
    let depth = layer("depth", &[("Z", 9.0)]);
    let grey = layer("grey", &[("Y", 4.0)]);
    let write = |layers: Vec<_>| {
        let size = IntegerBounds::from_dimensions((3, 2));
        Image::from_layers(ImageAttributes::new(size), layers)
            .write()
            .to_file(&path)
            .unwrap();
    };
    write(vec![depth.clone(), grey.clone(), beauty]);
    assert_eq!(
        read_image(&path).unwrap().pixels,
        [Vec3::new(1.0, 2.0, 3.0); 6]
    );
    write(vec![depth.clone(), grey]);
    assert_eq!(read_image(&path).unwrap().pixels, [Vec3::splat(4.0); 6]);
    write(vec![depth]);
    let error = read_image(&path).unwrap_err().to_string();
    assert!(
        error.contains("R, G, B") && error.contains("there are Z"),
        "{error}"
    );
}

#[test]
fn errors_name_the_file_and_the_trouble() {
    let folder = tempfile::tempdir().unwrap();
    let check = |name: &str, bytes: Option<&[u8]>, wanted: &str| {
        let path = folder.path().join(name);
        if let Some(bytes) = bytes {
            std::fs::write(&path, bytes).unwrap();
        }
        let error = read_image(&path).unwrap_err();
        let text = error.to_string();
        assert_eq!(error.path(), path);
        assert!(text.contains(name) && text.contains(wanted), "{text}");
    };
    check("missing.exr", None, "No such file");
    check("empty.exr", Some(b""), "neither OpenEXR, PNG nor Radiance");
    check(
        "text.png",
        Some(b"hello"),
        "neither OpenEXR, PNG nor Radiance",
    );
    check("short.exr", Some(&[0x76, 0x2f, 0x31, 0x01]), "");
    check("", None, "not a regular file");
    let path = folder.path().join("codes.png");
    let image = DisplayImage {
        width: 1,
        height: 1,
        pixels: vec![[0; 3]],
    };
    write_png(&path, &image).unwrap();
    let error = read_channels(&path, &["R"]).unwrap_err().to_string();
    assert!(error.contains("not an OpenEXR file"), "{error}");
}

/// A picture of 20000 × 20000 that its file cannot hold is refused before memory is asked for.
#[test]
fn claims_of_size_are_checked_against_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.exr");
    write_image_exr(
        &path,
        &Image::filled(4, 4, Vec3::ONE),
        Precision::Float,
        &[],
    )
    .unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    for window in ["dataWindow\0box2i\0", "displayWindow\0box2i\0"] {
        let name = window.as_bytes();
        let at = bytes.windows(name.len()).position(|w| w == name).unwrap();
        // Size of the attribute, then two corners.
        let corner = at + name.len() + 4 + 8;
        for (i, size) in [(0, 9_999i32), (4, 9_999)] {
            bytes[corner + i..corner + i + 4].copy_from_slice(&size.to_le_bytes());
        }
    }
    std::fs::write(&path, &bytes).unwrap();
    let error = read_image(&path).unwrap_err().to_string();
    assert!(error.contains("claims 10000 × 10000 pixels"), "{error}");

    let path = folder.path().join("bomb.hdr");
    std::fs::write(
        &path,
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n",
    )
    .unwrap();
    let error = read_image(&path).unwrap_err().to_string();
    assert!(error.contains("30000 × 30000 pixels"), "{error}");
}

/// A picture of one colour may be small, but not so small that a few kilobytes become gigabytes.
#[test]
fn blank_pictures_are_read_up_to_what_their_files_may_ask_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("blank.png");
    let blank = |side: u32| {
        image::GrayImage::new(side, side).save(&path).unwrap();
        std::fs::metadata(&path).unwrap().len()
    };
    let length = blank(2048);
    assert!(length < 30_000, "{length}");
    assert_eq!(read_image(&path).unwrap().pixels.len(), 1 << 22);
    // One bit a pixel, the best that PNG can do: 40 kB that could hold 2²⁸ pixels.
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    bytes.extend([0, 0, 0x40, 0, 0, 0, 0x40, 0, 1, 0, 0, 0, 0]);
    bytes.extend(0x81b32d29_u32.to_be_bytes());
    bytes.extend(b"\0\0\x9c\x40IDAT");
    bytes.resize(40_000, 0);
    std::fs::write(&path, bytes).unwrap();
    let error = read_image(&path).unwrap_err().to_string();
    assert!(error.contains("claims 16384 × 16384 pixels"), "{error}");
}

/// Every prefix, and thousands of files with some bytes changed: an error or a picture, no panic.
#[test]
fn malformed_files_end_in_an_error_or_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let exr = folder.path().join("a.exr");
    write_exr(
        &exr,
        &film_image(),
        Precision::Half,
        &[("k".into(), "v".into())],
    )
    .unwrap();
    let png = folder.path().join("a.png");
    let pixels = (0..400u32).map(|i| [i as u8, (i / 3) as u8, 9]).collect();
    write_png(
        &png,
        &DisplayImage {
            width: 20,
            height: 20,
            pixels,
        },
    )
    .unwrap();
    let hdr = folder.path().join("a.hdr");
    write_hdr(&hdr);
    let victim = folder.path().join("victim");
    for path in [exr, png, hdr] {
        let good = std::fs::read(&path).unwrap();
        // The head is where the dangerous numbers are.
        let prefixes = (0..good.len().min(1200)).chain((1200..good.len()).step_by(97));
        for length in prefixes {
            std::fs::write(&victim, &good[..length]).unwrap();
            assert!(
                read_image(&victim).is_err() || length + 16 > good.len(),
                "{length}"
            );
        }
        for round in 0..3000u32 {
            let mut bad = good.clone();
            for k in 0..=round % 4 {
                let r = hash::mix(round, k);
                let span = if r & 1 == 0 {
                    good.len().min(1000)
                } else {
                    good.len()
                };
                let at = hash::mix(r, 1) as usize % span;
                bad[at] = match hash::mix(r, 2) % 4 {
                    0 => 0xff,
                    1 => 0x7f,
                    2 => 0,
                    _ => bad[at] ^ (1 << (r >> 29)),
                };
            }
            std::fs::write(&victim, &bad).unwrap();
            if let Ok(image) = read_image(&victim) {
                let count = u64::from(image.width) * u64::from(image.height);
                assert_eq!(image.pixels.len() as u64, count);
            }
            let _ = read_attributes(&victim);
        }
    }
}
