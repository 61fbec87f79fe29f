//! Places of a map in proportion to its bilinear luminance and to the solid angle.
//!
//! The map is cut into cells between the centres of texels: W columns, the last of which holds the
//! seam, and H + 1 rows, of which the first and the last are the caps above the first and below the
//! last centre. In a cell the luminance is bilinear, so its integral against sin θ has a closed form
//! and is the cell's weight. Inside, θ is drawn from the exact density (linear times sine), then u
//! from the linear one at that θ. So the density of the whole is luminance over its integral,
//! everywhere, and needs no table to be evaluated.

use super::Texels;
use sr_math::distribution::Distribution1D;
use std::f64::consts::PI;

/// What is needed to draw places.
#[derive(Debug)]
pub struct Table {
    /// Weights of the rows.
    rows: Distribution1D,
    /// Weights within each row; `None` where it is black.
    columns: Vec<Option<Distribution1D>>,
    /// Integral of the luminance over the sphere.
    pub integral: f64,
}

/// From and to which θ a row of cells goes.
#[derive(Clone, Copy, Debug)]
pub struct RowSpan {
    from: f64,
    height: f64,
}

impl RowSpan {
    /// Row `row` of the `height + 1` rows of cells.
    pub fn new(row: u32, height: u32) -> Self {
        let n = f64::from(height);
        let from = (f64::from(row) - 0.5).max(0.0);
        let to = (f64::from(row) + 0.5).min(n);
        Self {
            from: PI * from / n,
            height: PI * (to - from) / n,
        }
    }

    /// Integrals against sin θ dθ over the row of a number that falls from 1 to 0, and of one that
    /// rises from 0 to 1.
    pub fn weights(&self) -> [f64; 2] {
        let (zeroth, first) = self.moments(self.height);
        let rising = first / self.height;
        [zeroth - rising, rising]
    }

    /// ∫ sin(θ₀ + y) dy and ∫ y sin(θ₀ + y) dy for y from 0 to x. Products in place of differences
    /// of cosines: the error is a few ulp of x², which is 10⁻⁹ of the result in the cap of a map of
    /// 8192 rows, and less elsewhere.
    fn moments(&self, x: f64) -> (f64, f64) {
        let middle = self.from + 0.5 * x;
        let half = 2.0 * (0.5 * x).sin();
        let zeroth = middle.sin() * half;
        let first = middle.cos() * half - x * (self.from + x).cos();
        (zeroth, first)
    }

    /// A θ of this row with density in proportion to sin θ times a number that goes linearly from
    /// `top` to `bottom`, which are at least 0 and not both 0.
    ///
    /// Newton's method on the integral, kept between two bounds. Directions are `f32`, so a step below
    /// 2⁻²⁴ of the row cannot be told; Newton's error after it is the square of that.
    pub fn sample(&self, top: f64, bottom: f64, u: f64) -> f64 {
        let slope = (bottom - top) / self.height;
        let integral = |x| {
            let (zeroth, first) = self.moments(x);
            top * zeroth + slope * first
        };
        let target = u * integral(self.height);
        let (mut low, mut high) = (0.0, self.height);
        let ends = [
            top * self.from.sin(),
            bottom * (self.from + self.height).sin().max(0.0),
        ];
        let mut x = self.height * sample_linear(ends[0], ends[1], u);
        let resolution = self.height * f64::from(f32::EPSILON) / 2.0;
        // Halving alone would take 24 steps.
        for _ in 0..48 {
            let excess = integral(x) - target;
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let density = (top + slope * x) * (self.from + x).sin();
            let mut next = x - excess / density;
            // A density of 0 leads nowhere, too.
            if !(low..=high).contains(&next) {
                next = 0.5 * (low + high);
            }
            let step = (next - x).abs();
            x = next;
            if step <= resolution {
                break;
            }
        }
        self.from + x
    }
}

/// A number in `[0, 1]` with density in proportion to one that goes linearly from `a` to `b`: the root
/// of the quadratic, in the form that does not cancel. `u` itself where both are 0.
fn sample_linear(a: f64, b: f64, u: f64) -> f64 {
    let denominator = a + (a * a * (1.0 - u) + b * b * u).sqrt();
    if denominator > 0.0 {
        (u * (a + b) / denominator).min(1.0)
    } else {
        u
    }
}

impl Table {
    /// `None` for a black map.
    pub fn new(texels: &Texels) -> Option<Self> {
        let width = texels.width();
        let spans = (0..=texels.height()).map(|row| RowSpan::new(row, texels.height()));
        let mut columns = Vec::with_capacity(texels.height() as usize + 1);
        let mut rows = Vec::with_capacity(texels.height() as usize + 1);
        for (row, span) in spans.enumerate() {
            let [falling, rising] = span.weights();
            // The mean of two neighbours is the integral between them.
            let mean = |column| {
                let [a, b, c, d] = texels.luminances(column, row as u32);
                0.5 * (falling * (a + b) + rising * (c + d))
            };
            rows.push((0..width).map(mean).sum::<f64>());
            columns.push(Distribution1D::new((0..width).map(mean)));
        }
        let integral = 2.0 * PI / f64::from(width) * rows.iter().sum::<f64>();
        Some(Self {
            rows: Distribution1D::new(rows)?,
            columns,
            integral,
        })
    }

    /// A place `[u, v]` in `[0, 1]²`; `None` when rounding has chosen a black row.
    pub fn sample(&self, texels: &Texels, [u, v]: [f64; 2]) -> Option<[f64; 2]> {
        let (row, _, rest_v) = self.rows.sample(v);
        let (column, _, rest_u) = self.columns[row].as_ref()?.sample(u);
        let (row, column) = (row as u32, column as u32);
        let [a, b, c, d] = texels.luminances(column, row);
        let span = RowSpan::new(row, texels.height());
        let theta = span.sample(a + b, c + d, rest_v);
        let t = (theta - span.from) / span.height;
        let across = sample_linear(a + t * (c - a), b + t * (d - b), rest_u);
        // The column between the last centre and the first holds the seam.
        let u = (f64::from(column) + 0.5 + across) / f64::from(texels.width());
        Some([u.fract(), theta / PI])
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let columns = self.columns.iter().flatten();
        let numbers: usize = columns.map(|c| c.len() + 1).sum::<usize>() + self.rows.len() + 1;
        numbers * size_of::<f64>() + size_of_val(self.columns.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against Simpson's rule over 2000 intervals, good to 10⁻¹² here.
    #[test]
    fn weights_are_integrals_in_every_row() {
        for height in [1, 2, 7, 400] {
            let mut total = 0.0;
            for row in 0..=height {
                let span = RowSpan::new(row, height);
                let n = 2000;
                let step = span.height / f64::from(n);
                let simpson = |f: &dyn Fn(f64) -> f64| -> f64 {
                    let weight = |k| match k {
                        0 => 1.0,
                        k if k == n => 1.0,
                        k if k % 2 == 1 => 4.0,
                        _ => 2.0,
                    };
                    let at = |k| f64::from(k) * step;
                    (0..=n).map(|k| weight(k) * f(at(k))).sum::<f64>() * step / 3.0
                };
                let sine = |x: f64| (span.from + x).sin();
                let rising = simpson(&|x| x / span.height * sine(x));
                let falling = simpson(&|x| (1.0 - x / span.height) * sine(x));
                let got = span.weights();
                let scale = rising + falling;
                assert!((got[0] - falling).abs() < 1e-9 * scale, "{height} {row}");
                assert!((got[1] - rising).abs() < 1e-9 * scale, "{height} {row}");
                total += got[0] + got[1];
            }
            assert!((total - 2.0).abs() < 1e-12, "{height}: {total}");
        }
    }

    /// The integral up to the θ drawn is `u` of the whole, to the resolution that the method stops at
    /// times the density there, relative to the mean: 2⁻²³ times at most 4.
    #[test]
    fn a_drawn_angle_has_the_share_asked_for() {
        for height in [1, 2, 3, 50, 8192] {
            for row in [0, 1, height / 2, height - 1, height] {
                let span = RowSpan::new(row, height);
                for (top, bottom) in [
                    (1.0, 1.0),
                    (0.0, 1.0),
                    (1.0, 0.0),
                    (1e-20, 1e20),
                    (3.0, 2.0),
                ] {
                    let share = |theta: f64| {
                        let x = theta - span.from;
                        let of = |x| {
                            let (zeroth, first) = span.moments(x);
                            top * zeroth + (bottom - top) / span.height * first
                        };
                        of(x) / of(span.height)
                    };
                    let mut last = span.from;
                    for k in 0..64 {
                        let u = f64::from(k) / 64.0;
                        let theta = span.sample(top, bottom, u);
                        assert!(theta >= last, "{height} {row} {u}: {theta} after {last}");
                        last = theta;
                        let error = share(theta) - u;
                        assert!(
                            error.abs() < 5e-7,
                            "{height} {row} {top} {bottom} {u}: {error}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn linear_densities_are_inverted_at_both_extremes() {
        for (a, b) in [
            (0.0, 1.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (2.0, 5.0),
            (1e30, 1e-30),
        ] {
            for k in 0..=32 {
                let u = f64::from(k) / 32.0;
                let x = sample_linear(a, b, u);
                let share = (a * x + 0.5 * (b - a) * x * x) / (0.5 * (a + b));
                assert!((share - u).abs() < 1e-12, "{a} {b} {u}: {share}");
            }
        }
        assert_eq!(sample_linear(0.0, 0.0, 0.25), 0.25);
    }
}
