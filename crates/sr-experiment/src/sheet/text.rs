//! Text in pictures: DejaVu Sans, which has the signs that captions need, by ab_glyph.

use ab_glyph::{Font, FontRef, GlyphId, InvalidFont, PxScale, PxScaleFont, ScaleFont};

/// A typeface at a size.
pub(super) struct Face {
    font: PxScaleFont<FontRef<'static>>,
}

/// Coverage of a pixel by ink: column, row, share.
type Ink<'a> = &'a mut dyn FnMut(i64, i64, f32);

impl Face {
    /// DejaVu Sans, `size` pixels from the highest to the lowest stroke.
    pub fn new(size: f32, bold: bool) -> Result<Self, String> {
        let bytes = if bold {
            dejavu::sans::bold()
        } else {
            dejavu::sans::regular()
        };
        let font = FontRef::try_from_slice(bytes);
        let font = font.map_err(|e: InvalidFont| format!("the embedded font: {e}"))?;
        let font = font.into_scaled(PxScale::from(size));
        Ok(Self { font })
    }

    /// Pixels from one line to the next.
    pub fn line(&self) -> u32 {
        (1.15 * self.font.height()).ceil() as u32
    }

    /// Width of a line of text in pixels.
    pub fn width(&self, text: &str) -> f32 {
        let mut end = 0.0;
        self.place(text, |_, at, advance| end = at + advance);
        end
    }

    /// Lines no wider than `width`, broken at spaces where there are any.
    pub fn wrap(&self, text: &str, width: f32) -> Vec<String> {
        let mut lines = Vec::new();
        for paragraph in text.lines() {
            let mut line = String::new();
            for word in paragraph.split_whitespace() {
                let longer = if line.is_empty() {
                    word.to_owned()
                } else {
                    format!("{line} {word}")
                };
                if self.width(&longer) <= width {
                    line = longer;
                    continue;
                }
                if !line.is_empty() {
                    lines.push(std::mem::take(&mut line));
                }
                line = self.broken(word, width, &mut lines);
            }
            lines.push(line);
        }
        lines
    }

    /// Cuts a word that is wider than a line; what is left of it begins the next.
    fn broken(&self, word: &str, width: f32, lines: &mut Vec<String>) -> String {
        let mut line = String::new();
        for c in word.chars() {
            line.push(c);
            if line.chars().count() > 1 && self.width(&line) > width {
                line.pop();
                lines.push(std::mem::replace(&mut line, c.to_string()));
            }
        }
        line
    }

    /// Draws a line with its upper left corner at a place.
    pub fn draw(&self, text: &str, x: u32, y: u32, ink: Ink<'_>) {
        let baseline = y as f32 + self.font.ascent();
        self.place(text, |glyph, at, _| {
            let position = ab_glyph::point(x as f32 + at, baseline);
            let glyph = glyph.with_scale_and_position(self.font.scale(), position);
            if let Some(outline) = self.font.outline_glyph(glyph) {
                let bounds = outline.px_bounds();
                let (left, top) = (bounds.min.x as i64, bounds.min.y as i64);
                outline.draw(|x, y, c| ink(left + i64::from(x), top + i64::from(y), c));
            }
        });
    }

    /// Tells each glyph with where it stands and how far it reaches.
    fn place(&self, text: &str, mut tell: impl FnMut(GlyphId, f32, f32)) {
        let (mut at, mut last) = (0.0, None);
        for c in text.chars().filter(|c| !c.is_control()) {
            let glyph = self.font.glyph_id(c);
            if let Some(last) = last {
                at += self.font.kern(last, glyph);
            }
            let advance = self.font.h_advance(glyph);
            tell(glyph, at, advance);
            at += advance;
            last = Some(glyph);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_keep_to_the_width_and_lose_no_word() {
        let face = Face::new(16.0, false).unwrap();
        let text =
            "relMSE ≈ 3.1e-3 ± 2e-4, an_entity_with_a_name_that_is_far_too_long_for_a_line end";
        let lines = face.wrap(text, 120.0);
        assert!(lines.len() > 3);
        assert!(lines.iter().all(|l| face.width(l) <= 120.0), "{lines:?}");
        let squeezed = |t: &str| t.replace(' ', "");
        assert_eq!(squeezed(&lines.concat()), squeezed(text));
        assert_eq!(face.wrap("a\n\nb", 100.0), ["a", "", "b"]);
        // Narrower than any letter: a letter a line.
        assert_eq!(face.wrap("abc", 1.0), ["a", "b", "c"]);
    }

    #[test]
    fn the_signs_of_captions_have_glyphs() {
        let face = Face::new(16.0, false).unwrap();
        for c in "αβ×±≈²₀°–…→σ".chars() {
            assert_ne!(face.font.glyph_id(c), GlyphId(0), "{c}");
        }
    }

    #[test]
    fn ink_stays_within_the_line() {
        let face = Face::new(20.0, true).unwrap();
        let (mut inked, width, line) = (0.0, face.width("Ägj|"), i64::from(face.line()));
        face.draw("Ägj|", 100, 50, &mut |x, y, c| {
            inked += c;
            if c > 0.0 {
                assert!((99..=101 + width as i64).contains(&x), "{x}");
                assert!((50..50 + line).contains(&y), "{y}");
            }
        });
        assert!(inked > 50.0, "{inked}");
    }
}
