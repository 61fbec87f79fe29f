//! Numbers of pictures inside of a page: planes of `f32` as text that a browser can undo by itself.
//!
//! The bytes of a plane are dealt to four parts, first bytes first, so that the exponents of
//! neighbours, which hardly differ, come together; then zlib (RFC 1950, with its checksum), which
//! `DecompressionStream("deflate")` reads; then base64. Nothing is rounded.

use base64::Engine;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

/// A plane of a picture or of a map.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    pub width: u32,
    pub height: u32,
    pub values: Vec<f32>,
}

impl Plane {
    /// The part x0, y0, x1, y1, which lies inside.
    pub fn cut(&self, [x0, y0, x1, y1]: [u32; 4]) -> Self {
        let rows = (y0..y1).flat_map(|y| {
            let row = (y * self.width) as usize;
            &self.values[row + x0 as usize..row + x1 as usize]
        });
        Self {
            width: x1 - x0,
            height: y1 - y0,
            values: rows.copied().collect(),
        }
    }

    /// Means over blocks of `factor` × `factor` pixels; those at the far edges may be smaller.
    pub fn reduced(self, factor: u32) -> Self {
        if factor <= 1 {
            return self;
        }
        let (width, height) = (self.width.div_ceil(factor), self.height.div_ceil(factor));
        let mean = |bx: u32, by: u32| {
            let ys = by * factor..((by + 1) * factor).min(self.height);
            let xs = bx * factor..((bx + 1) * factor).min(self.width);
            let all = ys.flat_map(|y| xs.clone().map(move |x| (y * self.width + x) as usize));
            let (sum, count) = all.fold((0.0f64, 0u32), |(s, n), i| {
                (s + f64::from(self.values[i]), n + 1)
            });
            (sum / f64::from(count)) as f32
        };
        let blocks = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self {
            values: blocks.map(|(x, y)| mean(x, y)).collect(),
            width,
            height,
        }
    }
}

/// Planes of one size, one after the other, as text.
pub(super) fn encode(planes: &[&Plane]) -> Result<String, String> {
    let values = || planes.iter().flat_map(|p| &p.values);
    let bytes = (0..4).flat_map(|i| values().map(move |v| v.to_le_bytes()[i]));
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let all: Vec<u8> = bytes.collect();
    let written = encoder.write_all(&all).and_then(|()| encoder.finish());
    let written = written.map_err(|e| format!("cannot compress a picture: {e}"))?;
    Ok(base64::engine::general_purpose::STANDARD.encode(written))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    fn plane(width: u32, height: u32) -> Plane {
        let value = |i: u32| i as f32;
        Plane {
            width,
            height,
            values: (0..width * height).map(value).collect(),
        }
    }

    #[test]
    fn what_is_encoded_comes_back_bit_for_bit() {
        let (mut a, b) = (plane(3, 2), plane(3, 2));
        a.values[1] = f32::NAN;
        a.values[2] = -0.0;
        a.values[3] = f32::MIN_POSITIVE / 8.0;
        let text = encode(&[&a, &b]).unwrap();
        let packed = base64::engine::general_purpose::STANDARD
            .decode(text)
            .unwrap();
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(packed.as_slice())
            .read_to_end(&mut bytes)
            .unwrap();
        let part = bytes.len() / 4;
        let back = (0..part).map(|i| [0, 1, 2, 3].map(|k| bytes[k * part + i]));
        let back: Vec<u32> = back.map(u32::from_le_bytes).collect();
        let both = a.values.iter().chain(&b.values).map(|v| v.to_bits());
        assert_eq!(back, both.collect::<Vec<u32>>());
    }

    #[test]
    fn parts_and_blocks_are_where_they_should_be() {
        let p = plane(5, 3);
        assert_eq!(p.cut([1, 1, 3, 3]).values, [6.0, 7.0, 11.0, 12.0]);
        let small = p.reduced(2);
        assert_eq!((small.width, small.height), (3, 2));
        // The last block of the first row has one column, the last row one row.
        assert_eq!(small.values, [3.0, 5.0, 6.5, 10.5, 12.5, 14.0]);
    }
}
