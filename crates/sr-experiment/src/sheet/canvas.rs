//! A white picture to draw on.

use super::text::Face;
use crate::pictures::{enlarged, light};
use sr_film::{DisplayImage, srgb};

/// Display values that grow as they are needed.
pub(super) struct Canvas {
    image: DisplayImage,
}

impl Canvas {
    /// White paper.
    pub fn new(width: u32, height: u32) -> Self {
        let pixels = vec![[255; 3]; width as usize * height as usize];
        Self {
            image: DisplayImage {
                width,
                height,
                pixels,
            },
        }
    }

    pub fn finish(self) -> DisplayImage {
        self.image
    }

    /// Draws a line of text in grey of the code `ink`.
    pub fn text(&mut self, face: &Face, text: &str, x: u32, y: u32, ink: u8) {
        face.draw(text, x, y, &mut |x, y, coverage| {
            let Some(pixel) = self.pixel(x, y) else {
                return;
            };
            // Mixing codes, not light, keeps thin dark strokes on white from fading.
            let share = coverage.clamp(0.0, 1.0);
            *pixel = pixel.map(|paper| {
                let mixed = f32::from(paper) * (1.0 - share) + f32::from(ink) * share;
                mixed.round() as u8
            });
        });
    }

    /// Puts a picture with its upper left corner at a place.
    pub fn picture(&mut self, picture: &DisplayImage, x: u32, y: u32) {
        let rows = picture.pixels.chunks(picture.width.max(1) as usize);
        for (row, dy) in rows.zip(0i64..) {
            for (source, dx) in row.iter().zip(0i64..) {
                if let Some(pixel) = self.pixel(i64::from(x) + dx, i64::from(y) + dy) {
                    *pixel = *source;
                }
            }
        }
    }

    fn pixel(&mut self, x: i64, y: i64) -> Option<&mut [u8; 3]> {
        let (x, y) = (u32::try_from(x).ok()?, u32::try_from(y).ok()?);
        if x >= self.image.width || y >= self.image.height {
            return None;
        }
        self.image
            .pixels
            .get_mut(y as usize * self.image.width as usize + x as usize)
    }
}

/// A picture for a place `width` wide: a wider one becomes just as wide, by averages of light over
/// what each pixel covers; a narrower one grows by a whole factor, so that its pixels stay square.
pub(super) fn fit(picture: &DisplayImage, width: u32) -> DisplayImage {
    let (w, h) = (picture.width, picture.height);
    if w <= width {
        return enlarged(picture, (width / w.max(1)).max(1));
    }
    let height = (f64::from(h) * f64::from(width) / f64::from(w))
        .round()
        .max(1.0) as u32;
    let across: Vec<Vec<(usize, f32)>> = (0..width).map(|x| shares(x, width, w)).collect();
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let down = shares(y, height, h);
        for across in &across {
            let mut sum = [0.0f32; 3];
            for (sy, wy) in &down {
                for (sx, wx) in across {
                    let source = light(picture.pixels[sy * w as usize + sx]);
                    for (sum, value) in sum.iter_mut().zip(source) {
                        *sum += wx * wy * value;
                    }
                }
            }
            pixels.push(sum.map(|v| (srgb::encode(v) * 255.0 + 0.5) as u8));
        }
    }
    DisplayImage {
        width,
        height,
        pixels,
    }
}

/// Which of `from` pixels the `i`th of `to` covers, and with what share of its length.
fn shares(i: u32, to: u32, from: u32) -> Vec<(usize, f32)> {
    let scale = f64::from(from) / f64::from(to);
    let (start, end) = (f64::from(i) * scale, (f64::from(i) + 1.0) * scale);
    let pixels = start as usize..(end.ceil() as usize).min(from as usize);
    pixels
        .map(|p| {
            let covered = end.min(p as f64 + 1.0) - start.max(p as f64);
            (p, (covered / scale) as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, value: impl Fn(u32, u32) -> u8) -> DisplayImage {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        DisplayImage {
            width,
            height,
            pixels: places.map(|(x, y)| [value(x, y); 3]).collect(),
        }
    }

    #[test]
    fn a_small_picture_grows_by_a_whole_factor() {
        let small = picture(3, 2, |x, y| (10 * x + y) as u8);
        let big = fit(&small, 10);
        assert_eq!((big.width, big.height), (9, 6));
        assert_eq!(big.pixels[5 * 9 + 8], [21; 3]);
        assert_eq!(fit(&small, 5), small);
    }

    #[test]
    fn a_large_picture_keeps_its_mean_light() {
        let noise = |x: u32, y: u32| (shuffled(x, y) % 256) as u8;
        let large = picture(301, 97, noise);
        let small = fit(&large, 80);
        assert_eq!((small.width, small.height), (80, 26));
        let mean = |p: &DisplayImage| {
            let sum: f32 = p.pixels.iter().map(|p| light(*p)[0]).sum();
            sum / p.pixels.len() as f32
        };
        // Rounding to codes is even, and the height is rounded to a pixel without a loss.
        assert!((mean(&small) - mean(&large)).abs() < 2e-3);
        let flat = fit(&picture(50, 50, |_, _| 77), 7);
        assert!(flat.pixels.iter().all(|p| *p == [77; 3]), "{flat:?}");
    }

    /// Knuth's multiplicative hash, which is enough to shuffle a test picture.
    fn shuffled(x: u32, y: u32) -> u32 {
        (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)).wrapping_mul(2_654_435_761) >> 13
    }
}
