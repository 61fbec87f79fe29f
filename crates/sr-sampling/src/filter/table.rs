//! A tabulated inverse of a distribution function.

/// Cells of a table, evenly spaced over `[0, 1]`.
const CELLS: usize = 256;

/// Draws from the piecewise linear interpolant of a density on `[0, 1]`.
///
/// The interpolant's distribution is inverted exactly, so the table's whole error is that of the
/// interpolant: at most h²/8 · max|f″| with h = 1/256, relative to the density at 0. For the
/// Blackman–Harris window max|f″| is π²(0.48829 + 4·0.14128 + 9·0.01168) = 11.4, an error of
/// 2.2·10⁻⁵; for a Gaussian cut at kσ it is k², an error of 1.9·10⁻⁶ k², 1.2·10⁻⁴ at the 8σ where
/// the caller stops.
#[derive(Clone, Debug)]
pub struct Table {
    /// The density at the nodes, 1 at the first.
    density: [f32; CELLS + 1],
    /// The distribution function at the nodes, from exactly 0 to exactly 1.
    cdf: [f32; CELLS + 1],
}

impl Table {
    /// From a density that is positive on `[0, 1)`; its scale does not matter.
    pub fn new(f: impl Fn(f64) -> f64) -> Self {
        let node = |i: usize| f(i as f64 / CELLS as f64) / f(0.0);
        let mut sum = [0.0f64; CELLS + 1];
        for i in 0..CELLS {
            sum[i + 1] = sum[i] + node(i) + node(i + 1);
        }
        Self {
            density: std::array::from_fn(|i| node(i) as f32),
            cdf: std::array::from_fn(|i| (sum[i] / sum[CELLS]) as f32),
        }
    }

    /// The point below which a share `v` in `[0, 1]` of the density lies.
    #[inline]
    pub fn invert(&self, v: f32) -> f32 {
        let i = self.cdf.partition_point(|&c| c <= v).clamp(1, CELLS) - 1;
        let (a, b) = (self.density[i], self.density[i + 1]);
        let width = self.cdf[i + 1] - self.cdf[i];
        // A tail below the resolution of f32 has no width: only v = 1 gets there.
        let share = if width > 0.0 {
            ((v - self.cdf[i]) / width).min(1.0)
        } else {
            1.0
        };
        // a t + (b − a) t²/2 = share (a + b)/2, solved so that nothing cancels.
        let root = ((1.0 - share) * a * a + share * b * b).sqrt();
        let t = share * (a + b) / (a + root);
        (i as f32 + t.min(1.0)) * (1.0 / CELLS as f32)
    }
}
