//! The pixels of a map and what is between them.

use glam::Vec3;
use sr_math::color::LUMINANCE_WEIGHTS;
use sr_math::{Real, vec3};

/// Texels in rows from the top, each with its centre at half integers. Beyond the left and right edge
/// the map goes on at the other side; above the first and below the last centre it is constant along v.
#[derive(Debug)]
pub struct Texels {
    width: u32,
    height: u32,
    rgb: Vec<Vec3>,
}

impl Texels {
    /// `rgb` has `width · height` entries, of which there is at least one.
    pub fn new(width: u32, height: u32, rgb: Vec<Vec3>) -> Self {
        debug_assert_eq!(rgb.len(), width as usize * height as usize);
        Self { width, height, rgb }
    }

    pub fn width(&self) -> u32 {
        self.width
    }

    pub fn height(&self) -> u32 {
        self.height
    }

    /// All of them.
    pub fn rgb(&self) -> &[Vec3] {
        &self.rgb
    }

    #[inline]
    fn texel(&self, x: u32, y: u32) -> Vec3 {
        self.rgb[y as usize * self.width as usize + x as usize]
    }

    /// The four texels around a cell between centres, top left, top right, bottom left, bottom right;
    /// column W − 1 holds the seam, row 0 the upper cap and row H the lower one.
    #[inline]
    pub fn corners(&self, column: u32, row: u32) -> [Vec3; 4] {
        let right = if column + 1 == self.width {
            0
        } else {
            column + 1
        };
        let (top, bottom) = (row.max(1) - 1, row.min(self.height - 1));
        [
            self.texel(column, top),
            self.texel(right, top),
            self.texel(column, bottom),
            self.texel(right, bottom),
        ]
    }

    /// Their luminances in `f64`, above 0 wherever a channel is: all weights are, and the smallest `f32`
    /// times the smallest weight is far from the end of `f64`.
    #[inline]
    pub fn luminances(&self, column: u32, row: u32) -> [f64; 4] {
        self.corners(column, row)
            .map(|c| c.as_dvec3().dot(LUMINANCE_WEIGHTS.as_dvec3()))
    }

    /// The bilinear colour at a place in `[0, 1]²`.
    #[inline]
    pub fn at<R: Real>(&self, [u, v]: [R; 2]) -> [R; 3] {
        // Half a texel on, so that truncation is the floor.
        let x = u * R::lit(f64::from(self.width)) + R::lit(0.5);
        let y = v * R::lit(f64::from(self.height)) + R::lit(0.5);
        let whole = |x: R| x.to_f64() as u32;
        let (i, j) = (whole(x), whole(y).min(self.height));
        let s = x - R::lit(f64::from(i));
        let t = (y - R::lit(f64::from(j))).min(R::ONE);
        let column = if i == 0 {
            self.width
        } else {
            i.min(self.width)
        } - 1;
        let [a, b, c, d] = self.corners(column, j).map(vec3::lift::<R>);
        std::array::from_fn(|k| {
            let top = a[k] + s * (b[k] - a[k]);
            let bottom = c[k] + s * (d[k] - c[k]);
            // A sum of a small and the difference to a large number may end below 0.
            (top + t * (bottom - top)).max(R::ZERO)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: u32, height: u32) -> Texels {
        let rgb = (0..width * height).map(|i| Vec3::new(i as f32, 1.0, 0.0));
        Texels::new(width, height, rgb.collect())
    }

    #[test]
    fn centres_have_their_texel_and_places_between_are_linear() {
        let m = map(4, 2);
        let at = |u: f32, v: f32| m.at([u, v])[0];
        for y in 0..2 {
            for x in 0..4 {
                let (u, v) = ((x as f32 + 0.5) / 4.0, (y as f32 + 0.5) / 2.0);
                assert_eq!(at(u, v), (4 * y + x) as f32);
            }
        }
        assert_eq!(at(0.25, 0.25), 0.5);
        assert_eq!(at(0.375, 0.5), 3.0);
    }

    #[test]
    fn the_seam_joins_and_the_poles_are_flat() {
        let m = map(4, 2);
        for v in [0.0, 0.1, 0.25] {
            assert_eq!(m.at([0.0, v])[0], 1.5);
            assert_eq!(m.at([1.0, v])[0], 1.5);
            assert_eq!(m.at([0.9375, v])[0], 2.25);
            assert_eq!(m.at([0.125, v])[0], 0.0);
        }
        assert_eq!(m.at([0.375, 1.0])[0], 5.0);
    }

    #[test]
    fn the_smallest_maps_are_maps() {
        for (width, height) in [(1, 1), (2, 1), (1, 2)] {
            let m = map(width, height);
            for u in [0.0, 0.2, 0.5, 0.8, 1.0] {
                for v in [0.0, 0.5, 1.0] {
                    let x = m.at([u, v])[0];
                    assert!((0.0..=1.0).contains(&x));
                    assert_eq!(m.at([u, v])[1], 1.0);
                }
            }
        }
    }
}
