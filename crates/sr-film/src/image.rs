//! A plain picture in memory.

use glam::Vec3;

/// A picture: linear Rec. 709, row-major from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Vec<Vec3>,
}

impl Image {
    /// A picture of one colour.
    pub fn filled(width: u32, height: u32, colour: Vec3) -> Self {
        Self {
            width,
            height,
            pixels: vec![colour; width as usize * height as usize],
        }
    }

    /// The pixel in column `x`, row `y`, which must lie inside.
    pub fn pixel(&self, x: u32, y: u32) -> Vec3 {
        self.pixels[y as usize * self.width as usize + x as usize]
    }
}
