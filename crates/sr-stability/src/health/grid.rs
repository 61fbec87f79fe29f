//! Which pixels are looked at.

use sr_film::Rect;

/// Every `step`-th pixel of each row and column of a crop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grid {
    crop: Rect,
    /// Distance of neighbours in pixels.
    pub step: u32,
}

impl Grid {
    /// All pixels of the crop.
    pub fn whole(crop: Rect) -> Self {
        Self { crop, step: 1 }
    }

    /// As many pixels as have together at most `most` samples, of `samples` each; never none.
    pub fn within(crop: Rect, samples: u64, most: u64) -> Self {
        let mut grid = Self::whole(crop);
        while grid.len() > 1 && grid.len() as u64 * samples > most {
            grid.step += 1;
        }
        grid
    }

    /// Pixels a row.
    pub fn columns(&self) -> u32 {
        self.crop.width().div_ceil(self.step)
    }

    /// Rows.
    pub fn rows(&self) -> u32 {
        self.crop.height().div_ceil(self.step)
    }

    /// How many pixels there are.
    pub fn len(&self) -> usize {
        self.columns() as usize * self.rows() as usize
    }

    /// The `i`-th, row by row, in the whole picture.
    pub fn pixel(&self, i: usize) -> [u32; 2] {
        let (row, column) = (i as u32 / self.columns(), i as u32 % self.columns());
        [
            self.crop.x0 + column * self.step,
            self.crop.y0 + row * self.step,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_picture_is_looked_at_in_steps() {
        let crop = Rect {
            x0: 5,
            y0: 7,
            x1: 105,
            y1: 57,
        };
        assert_eq!(Grid::within(crop, 64, 64 * 5000).step, 1);
        let grid = Grid::within(crop, 64, 64 * 600);
        assert_eq!((grid.step, grid.columns(), grid.rows()), (3, 34, 17));
        assert_eq!(grid.pixel(0), [5, 7]);
        assert_eq!(grid.pixel(grid.len() - 1), [104, 55]);
        assert_eq!(Grid::within(crop, 64, 1).len(), 1);
    }
}
