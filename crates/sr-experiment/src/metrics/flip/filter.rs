//! Separable filters over planes, and the ones that ꟻLIP uses.
//!
//! Beyond the border stands the pixel of the border. All kernels are even or odd, so that one half
//! is kept.

use std::f64::consts::PI;

/// One number for each pixel.
#[derive(Clone)]
pub(super) struct Plane {
    pub width: usize,
    pub height: usize,
    pub values: Vec<f32>,
}

/// One dimension of a filter: weights at distance 0, 1, …; at −k the same, or its negative.
pub(super) struct Kernel {
    half: Vec<f32>,
    odd: bool,
}

impl Kernel {
    /// Even, of sum 1.
    fn gaussian(radius: usize, at: impl Fn(f64) -> f64) -> Self {
        let values: Vec<f64> = (0..=radius).map(|k| at(k as f64)).collect();
        let sum = values[0] + 2.0 * values[1..].iter().sum::<f64>();
        Self::new(values.iter().map(|v| v / sum), false)
    }

    fn new(half: impl Iterator<Item = f64>, odd: bool) -> Self {
        Self {
            half: half.map(|v| v as f32).collect(),
            odd,
        }
    }

    /// `out += weight · (after ± before)`, element by element.
    fn add_pair(&self, k: usize, before: &[f32], after: &[f32], out: &mut [f32]) {
        let weight = self.half[k];
        let pairs = before.iter().zip(after).zip(out);
        if self.odd {
            pairs.for_each(|((b, a), o)| *o += weight * (a - b));
        } else {
            pairs.for_each(|((b, a), o)| *o += weight * (a + b));
        }
    }
}

impl Plane {
    /// Filtered along the rows.
    pub fn rows(&self, kernel: &Kernel) -> Self {
        let radius = kernel.half.len() - 1;
        let mut padded = vec![0.0; self.width + 2 * radius];
        let mut out = self.zeroed();
        for (row, result) in self
            .values
            .chunks_exact(self.width)
            .zip(out.values.chunks_exact_mut(self.width))
        {
            padded[..radius].fill(row[0]);
            padded[radius..radius + self.width].copy_from_slice(row);
            padded[radius + self.width..].fill(row[self.width - 1]);
            scale_into(kernel.half[0], row, result);
            for k in 1..=radius {
                let from = |start: usize| &padded[start..start + self.width];
                kernel.add_pair(k, from(radius - k), from(radius + k), result);
            }
        }
        out
    }

    /// Filtered along the columns.
    pub fn columns(&self, kernel: &Kernel) -> Self {
        let radius = kernel.half.len() - 1;
        let row = |y: usize| &self.values[y * self.width..(y + 1) * self.width];
        let mut out = self.zeroed();
        for (y, result) in out.values.chunks_exact_mut(self.width).enumerate() {
            scale_into(kernel.half[0], row(y), result);
            for k in 1..=radius {
                let (before, after) = (y.saturating_sub(k), (y + k).min(self.height - 1));
                kernel.add_pair(k, row(before), row(after), result);
            }
        }
        out
    }

    fn zeroed(&self) -> Self {
        Self {
            values: vec![0.0; self.values.len()],
            ..*self
        }
    }
}

fn scale_into(weight: f32, from: &[f32], to: &mut [f32]) {
    for (f, t) in from.iter().zip(to) {
        *t = weight * f;
    }
}

/// Contrast sensitivity of one opponent channel as a filter in space: a sum of Gaussians.
struct Sensitivity(Vec<(f32, Kernel)>);

/// Parameters (a, b) of the Gaussians a √(π/b) exp(−π² d²/b), d in degrees.
const ACHROMATIC: &[(f64, f64)] = &[(1.0, 0.0047)];
const RED_GREEN: &[(f64, f64)] = &[(1.0, 0.0053)];
const BLUE_YELLOW: &[(f64, f64)] = &[(34.1, 0.04), (13.5, 0.025)];

impl Sensitivity {
    fn new(gaussians: &[(f64, f64)], ppd: f64) -> Self {
        // Three standard deviations of the widest Gaussian of all channels.
        let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * ppd).ceil() as usize;
        let at = |b: f64| move |k: f64| (-(PI * k / ppd).powi(2) / b).exp();
        // Each Gaussian is normalised by itself, and weighs as much as it has of the whole sum.
        let share = |&(a, b): &(f64, f64)| {
            let line = 1.0 + 2.0 * (1..=radius).map(|k| at(b)(k as f64)).sum::<f64>();
            a * (PI / b).sqrt() * line * line
        };
        let total: f64 = gaussians.iter().map(share).sum();
        let part = |g: &(f64, f64)| {
            let kernel = Kernel::gaussian(radius, at(g.1));
            ((share(g) / total) as f32, kernel)
        };
        Self(gaussians.iter().map(part).collect())
    }

    fn apply(&self, plane: &Plane) -> Plane {
        let mut sum = plane.zeroed();
        for (weight, kernel) in &self.0 {
            let filtered = plane.rows(kernel).columns(kernel);
            for (s, f) in sum.values.iter_mut().zip(&filtered.values) {
                *s += weight * f;
            }
        }
        sum
    }
}

/// All filters for one distance to the display.
pub(super) struct Filters {
    sensitivities: [Sensitivity; 3],
    smooth: Kernel,
    edge: Kernel,
    point: Kernel,
}

/// Edges and points of a picture: lengths of the gradients of each kind.
pub(super) struct Features {
    pub edges: Vec<f32>,
    pub points: Vec<f32>,
}

impl Filters {
    pub fn new(ppd: f64) -> Self {
        // The detectors' Gaussian has half of 0.082 degrees as standard deviation.
        let sigma = 0.5 * 0.082 * ppd;
        let radius = (3.0 * sigma).ceil() as usize;
        let gaussian = |k: f64| (-k * k / (2.0 * sigma * sigma)).exp();
        let distances = || (0..=radius).map(|k| k as f64);
        let slope = |k: f64| k * gaussian(k);
        let slopes: f64 = distances().map(slope).sum();
        let bend = |k: f64| (k * k / (sigma * sigma) - 1.0) * gaussian(k);
        // What is positive sums to 1, what is negative to −1.
        let sum_of = |sign: f64| {
            let both = |k: f64| if k == 0.0 { 1.0 } else { 2.0 };
            let part = distances().map(|k| both(k) * (sign * bend(k)).max(0.0));
            part.sum::<f64>()
        };
        let (above, below) = (sum_of(1.0), sum_of(-1.0));
        let normalised = |v: f64| if v > 0.0 { v / above } else { v / below };
        Self {
            sensitivities: [ACHROMATIC, RED_GREEN, BLUE_YELLOW].map(|g| Sensitivity::new(g, ppd)),
            smooth: Kernel::gaussian(radius, gaussian),
            edge: Kernel::new(distances().map(|k| slope(k) / slopes), true),
            point: Kernel::new(distances().map(|k| normalised(bend(k))), false),
        }
    }

    /// The opponent channels as the eye resolves them.
    pub fn seen(&self, channels: [&Plane; 3]) -> [Plane; 3] {
        [0, 1, 2].map(|c| self.sensitivities[c].apply(channels[c]))
    }

    /// Edges and points of a plane of relative luminance.
    pub fn features(&self, luminance: &Plane) -> Features {
        let smooth = luminance.rows(&self.smooth);
        let lengths = |kernel: &Kernel| {
            let along_x = luminance.rows(kernel).columns(&self.smooth);
            let along_y = smooth.columns(kernel);
            let both = along_x.values.iter().zip(&along_y.values);
            both.map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Features {
            edges: lengths(&self.edge),
            points: lengths(&self.point),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::PIXELS_PER_DEGREE;
    use super::*;

    fn plane(width: usize, height: usize, at: impl Fn(usize, usize) -> f32) -> Plane {
        let values = (0..width * height).map(|i| at(i % width, i / width));
        Plane {
            width,
            height,
            values: values.collect(),
        }
    }

    /// Weights of a filter add to 1 within the rounding of some twenty sums.
    #[test]
    fn constants_pass_and_have_no_features() {
        let filters = Filters::new(PIXELS_PER_DEGREE);
        let grey = plane(30, 25, |_, _| 0.5);
        for seen in filters.seen([&grey, &grey, &grey]) {
            assert!(seen.values.iter().all(|v| (v - 0.5).abs() < 1e-6));
        }
        let features = filters.features(&grey);
        for v in features.edges.iter().chain(&features.points) {
            assert!(v.abs() < 1e-6, "{v}");
        }
    }

    /// A step of 1 has an edge of length 1 where it is, which is what the kernel's norm is for.
    #[test]
    fn an_edge_is_found_where_it_is_in_both_directions() {
        let filters = Filters::new(PIXELS_PER_DEGREE);
        for turned in [false, true] {
            let step = plane(41, 41, |x, y| f32::from(if turned { y } else { x } > 20));
            let edges = filters.features(&step).edges;
            let at = |i: usize| edges[if turned { i * 41 + 20 } else { 20 * 41 + i }];
            assert!(
                (at(20) - 1.0).abs() < 1e-5 && (at(21) - 1.0).abs() < 1e-5,
                "{}",
                at(20)
            );
            assert!(at(0) == 0.0 && at(40) == 0.0);
        }
    }

    /// One pixel wide and high, far below any kernel: the border repeats.
    #[test]
    fn the_smallest_picture_is_filtered() {
        let dot = plane(1, 1, |_, _| 0.25);
        let filters = Filters::new(PIXELS_PER_DEGREE);
        assert!((filters.seen([&dot, &dot, &dot])[2].values[0] - 0.25).abs() < 1e-6);
    }
}
