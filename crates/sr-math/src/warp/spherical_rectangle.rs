//! Uniform directions over the solid angle of a rectangle.
//!
//! The map is that of Ureña, Fajardo, King 2013, "An Area-Preserving Parametrization for Spherical
//! Rectangles": `u` divides the solid angle by lines of constant x, `v` divides each of them. Their
//! closed form loses all digits of an `f32` near the plane of the rectangle, where differences of
//! numbers near 1 decide; it is worked out afresh here.
//!
//! Put the reference point at the origin and the rectangle at height z. All lines of constant y
//! meet, seen from there, in the direction +X. The part of the strip `y0..y1` beyond x is therefore
//! a spherical triangle with one corner at +X, and its solid angle β(x) falls from twice
//! Δ = ψ1 − ψ0 (with tan ψ = y/z) at x = −∞ to 0 at x = +∞. Solving for x, with h = β/2 and
//! k = Δ − h:
//!
//! ```text
//! x = z · sin(k − h) / (2 √(sin h · sin k · cos(ψ1 − h) · cos(ψ1 − k)))
//! ```
//!
//! With y mirrored so that y1 ≥ |y0| each factor can be had without cancellation, so the error of x
//! stems from that of β alone, a few roundings of β(x0): relative to the solid angle Ω of the
//! rectangle, `β(x0)/Ω` times that. [`SphericalRectangle::is_well_conditioned`] bounds this ratio;
//! beyond it the rectangle is small against its distance, and sampling its area does as well.

use crate::Real;

/// A rectangle parallel to the XY plane, seen from the origin.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle<R> {
    x: [R; 2],
    y: [R; 2],
    z: R,
    mirror_x: bool,
    mirror_y: bool,
    solid_angle: R,
    /// β(x0): the solid angle of the strip from x0 to +∞.
    strip: R,
}

/// `l + x`, where `l² = x² + rest`, without cancellation.
#[inline(always)]
fn lift<R: Real>(l: R, x: R, rest: R) -> R {
    if x < R::ZERO { rest / (l - x) } else { l + x }
}

/// Solid angle of the spherical triangle `abc` with `det = |a · (b × c)|`: van Oosterom, Strackee
/// 1983, "The Solid Angle of a Plane Triangle", eq. 8.
#[inline(always)]
fn triangle_solid_angle<R: Real>(a: [R; 3], b: [R; 3], c: [R; 3], det: R) -> R {
    let dot = |p: [R; 3], q: [R; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (la, lb, lc) = (dot(a, a).sqrt(), dot(b, b).sqrt(), dot(c, c).sqrt());
    let den = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    R::lit(2.0) * det.atan2(den)
}

/// Solid angle of `0..x` × `y[0]..y[1]` at height z, for `x ≥ 0` and `|y[0]| ≤ y[1]`.
///
/// The difference of atan(x y/(z r)) at the two corners, as one arc tangent.
#[inline(always)]
fn on_axis_solid_angle<R: Real>(x: R, [y0, y1]: [R; 2], z: R) -> R {
    let d2 = x * x + z * z;
    let (r0, r1) = ((d2 + y0 * y0).sqrt(), (d2 + y1 * y1).sqrt());
    let difference = if y0 > R::ZERO {
        (y1 - y0) * (y1 + y0) * d2 / (y1 * r0 + y0 * r1)
    } else {
        y1 * r0 - y0 * r1
    };
    (x * z * difference).atan2(z * z * (r0 * r1) + x * x * (y0 * y1))
}

impl<R: Real> SphericalRectangle<R> {
    /// The rectangle `x[0]..x[1]` × `y[0]..y[1]` at height `z` (its sign does not matter).
    ///
    /// `None` when its solid angle is zero or not a number.
    #[inline]
    pub fn new(x: [R; 2], y: [R; 2], z: R) -> Option<Self> {
        let mirror_x = x[0] + x[1] < R::ZERO;
        let mirror_y = y[0] + y[1] < R::ZERO;
        let flip = |v: [R; 2], mirror| if mirror { [-v[1], -v[0]] } else { v };
        let ([x0, x1], [y0, y1], z) = (flip(x, mirror_x), flip(y, mirror_y), z.abs());

        let solid_angle = if x0 < R::ZERO {
            on_axis_solid_angle(-x0, [y0, y1], z) + on_axis_solid_angle(x1, [y0, y1], z)
        } else if y0 < R::ZERO {
            on_axis_solid_angle(-y0, [x0, x1], z) + on_axis_solid_angle(y1, [x0, x1], z)
        } else {
            // Each half of the rectangle spans the volume det/6 with the origin, and all corners
            // are in one octant: no subtraction.
            let det = (x1 - x0) * (y1 - y0) * z;
            let (a, c) = ([x0, y0, z], [x1, y1, z]);
            triangle_solid_angle(a, [x1, y0, z], c, det)
                + triangle_solid_angle(a, c, [x0, y1, z], det)
        };

        // Van Oosterom and Strackee's formula for the triangle of (x0, y0), (x0, y1) and +X.
        let (q0, q1) = (y0 * y0 + z * z, y1 * y1 + z * z);
        let (l0, l1) = ((x0 * x0 + q0).sqrt(), (x0 * x0 + q1).sqrt());
        let den = lift(l0, x0, q0) * lift(l1, x0, q1) + y0 * y1 + z * z;
        let strip = R::lit(2.0) * ((y1 - y0) * z).atan2(den);

        (solid_angle > R::ZERO && strip > R::ZERO).then_some(Self {
            x: [x0, x1],
            y: [y0, y1],
            z,
            mirror_x,
            mirror_y,
            solid_angle,
            strip,
        })
    }

    /// Solid angle in steradian, to a few ulp however small.
    #[inline]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// [`Self::sample`] follows the uniform density: a few times 128 roundings, the tests find 2⁹
    /// ulp, is the most by which it honours another `u` than it was given.
    ///
    /// Where this is false the rectangle spans less than some 1/128 of its distance along x, and
    /// the density of area sampling is flat over it to a few per cent. Let x be the longer side.
    #[inline]
    pub fn is_well_conditioned(&self) -> bool {
        self.solid_angle * R::lit(128.0) > self.strip
    }

    /// The point `[x, y]` of the rectangle in a uniform direction. Each coordinate grows with its
    /// `u`, or falls with it where the rectangle lies mostly on the negative side.
    #[inline]
    pub fn sample(&self, u: [R; 2]) -> [R; 2] {
        let x = self.x_at(u[0]);
        let y = self.y_at(x, u[1]);
        [
            if self.mirror_x { -x } else { x },
            if self.mirror_y { -y } else { y },
        ]
    }

    #[inline(always)]
    fn x_at(&self, u: R) -> R {
        let ([y0, y1], z) = (self.y, self.z);
        let (s0, s1) = ((y0 * y0 + z * z).sqrt(), (y1 * y1 + z * z).sqrt());
        let sin_delta = (y1 - y0) * z / (s0 * s1);
        let cos_delta = (z * z + y0 * y1) / (s0 * s1);
        let h = R::lit(0.5) * (self.strip - u * self.solid_angle);
        let (sin_h, cos_h) = (h.sin(), h.cos());
        let sin_k = sin_delta * cos_h - cos_delta * sin_h;
        let cos_k = cos_delta * cos_h + sin_delta * sin_h;
        // ψ1 − h = ψ0 + k and ψ1 − k = ψ0 + h: the form whose terms are both positive. A negative
        // cosine means Δ > π/2, hence y0 < 0.
        let upper = |s: R, c: R| (z * c + y1 * s) / s1;
        let lower = |s: R, c: R| (z * c - y0 * s) / s0;
        let a = if cos_h < R::ZERO {
            lower(sin_k, cos_k)
        } else {
            upper(sin_h, cos_h)
        };
        let b = if cos_k < R::ZERO {
            lower(sin_h, cos_h)
        } else {
            upper(sin_k, cos_k)
        };
        let den = R::lit(2.0) * (sin_h * sin_k * a * b).safe_sqrt();
        let x = z * (sin_k * cos_h - cos_k * sin_h) / den;
        x.clamp_to(self.x[0], self.x[1])
    }

    /// On the line of constant x the sine η = y/r of the elevation is uniform (Archimedes). The
    /// cosine comes from 1 − η and 1 + η, both mixtures of positive numbers.
    #[inline(always)]
    fn y_at(&self, x: R, v: R) -> R {
        let d2 = x * x + self.z * self.z;
        let ends = self.y.map(|y| {
            let r = (d2 + y * y).sqrt();
            [y / r, lift(r, -y, d2) / r, lift(r, y, d2) / r]
        });
        let mix = |k: usize| (R::ONE - v) * ends[0][k] + v * ends[1][k];
        let y = mix(0) * (d2 / (mix(1) * mix(2))).sqrt();
        y.clamp_to(self.y[0], self.y[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash;

    /// What `u` led to a point: the share of the solid angle on its left and below it.
    fn inverse(x: [f64; 2], y: [f64; 2], z: f64, p: [f64; 2]) -> [f64; 2] {
        let omega = |a, b| SphericalRectangle::new([a, b], y, z).map_or(0.0, |r| r.solid_angle());
        // The smaller side is the accurate one.
        let (left, right) = (omega(x[0], p[0]), omega(p[0], x[1]));
        let d2 = p[0] * p[0] + z * z;
        let eta = |y: f64| y / (d2 + y * y).sqrt();
        // ∫ dy / (d² + y²)^{3/2} by its difference form: η is differenced without loss.
        let between = |a: f64, b: f64| {
            let (ra, rb) = ((d2 + a * a).sqrt(), (d2 + b * b).sqrt());
            if a * b > 0.0 {
                d2 * (b * b - a * a) / (ra * rb * (b * ra + a * rb))
            } else {
                eta(b) - eta(a)
            }
        };
        let (below, above) = (between(y[0], p[1]), between(p[1], y[1]));
        [left / (left + right), below / (below + above)]
    }

    /// Rectangles from nearly touching to far, from overhead to grazing, fat and thin.
    fn rectangles() -> impl Iterator<Item = ([f32; 2], [f32; 2], f32)> {
        (0..4000u32).map(|i| {
            let h = |k| hash::unit_f32(hash::mix(i, k));
            let aspect = 10f32.powf(-3.0 * h(0) * h(0));
            let far = 10f32.powf(3.5 * h(1) - 1.0);
            let (x0, y0) = (far * (2.0 * h(2) - 1.0) - 0.5, far * (2.0 * h(3) - 1.0));
            let z = far * 10f32.powf(-5.0 * h(4));
            ([x0, x0 + 1.0], [y0, y0 + aspect], z)
        })
    }

    /// The bounds of the module's text: 2⁹ ulp, and the grid of the coordinates themselves.
    #[test]
    fn the_inverse_returns_u_where_it_is_well_conditioned() {
        let mut tried = 0;
        for (i, (x, y, z)) in rectangles().enumerate() {
            let Some(r) = SphericalRectangle::new(x, y, z).filter(|r| r.is_well_conditioned())
            else {
                continue;
            };
            tried += 1;
            for k in 0..16 {
                let u = [0, 1].map(|j| hash::unit_f32(hash::mix(i as u32, 100 + 2 * k + j)));
                let p = r.sample(u).map(f64::from);
                let back = inverse(x.map(f64::from), y.map(f64::from), z.into(), p);
                for (axis, mirror, ends) in [(0, r.mirror_x, x), (1, r.mirror_y, y)] {
                    let back = if mirror { 1.0 - back[axis] } else { back[axis] };
                    let ulps = (back - f64::from(u[axis])).abs() / f64::from(f32::EPSILON);
                    let grid = ends[0].abs().max(ends[1].abs()) / (ends[1] - ends[0]);
                    let bound = 512.0 + 8.0 * f64::from(grid);
                    assert!(
                        ulps < bound,
                        "{axis} {x:?} {y:?} {z} {u:?}: {ulps} > {bound}"
                    );
                }
            }
        }
        assert!(tried > 3500, "{tried}");
    }

    #[test]
    fn the_solid_angle_is_accurate_at_any_size() {
        for (x, y, z) in rectangles() {
            let narrow = SphericalRectangle::new(x, y, z).expect("it is seen");
            let wide = SphericalRectangle::new(x.map(f64::from), y.map(f64::from), z.into())
                .expect("it is seen");
            // Some twenty roundings, beside those of the edge lengths.
            let grid = [x, y].map(|v| v[0].abs().max(v[1].abs()) / (v[1] - v[0]));
            let bound = 20.0 * f64::from(f32::EPSILON) * f64::from(1.0 + grid[0].max(grid[1]));
            let error = f64::from(narrow.solid_angle()) / wide.solid_angle() - 1.0;
            assert!(error.abs() < bound, "{x:?} {y:?} {z}: {error} > {bound}");
        }
        let face = SphericalRectangle::new([-1.0, 1.0], [-1.0, 1.0], 1.0f64).expect("seen");
        assert!((face.solid_angle() - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-15);
    }

    /// A rectangle is its four quarters, wherever the foot of the perpendicular falls: the three
    /// formulas for the solid angle agree.
    #[test]
    fn solid_angles_add_up() {
        for (x, y, z) in rectangles() {
            let (x, y, z) = (x.map(f64::from), y.map(f64::from), f64::from(z));
            let omega = |x, y| SphericalRectangle::new(x, y, z).map_or(0.0, |r| r.solid_angle());
            let (mx, my) = (0.6 * x[0] + 0.4 * x[1], 0.3 * y[0] + 0.7 * y[1]);
            let sum = omega([x[0], mx], [y[0], my])
                + omega([x[0], mx], [my, y[1]])
                + omega([mx, x[1]], [y[0], my])
                + omega([mx, x[1]], [my, y[1]]);
            assert!((sum / omega(x, y) - 1.0).abs() < 1e-9, "{x:?} {y:?} {z}");
        }
    }

    #[test]
    fn ends_of_u_are_ends_of_the_rectangle_and_a_plane_seen_edge_on_is_none() {
        for (x, y, z) in rectangles() {
            let Some(r) = SphericalRectangle::new(x, y, z).filter(|r| r.is_well_conditioned())
            else {
                continue;
            };
            for u in [[0.0, 0.0], [1.0 - f32::EPSILON / 2.0; 2]] {
                let [px, py] = r.sample(u);
                assert!(x[0] <= px && px <= x[1] && y[0] <= py && py <= y[1]);
            }
        }
        assert!(SphericalRectangle::new([1.0, 2.0], [1.0, 2.0], 0.0f32).is_none());
        assert!(SphericalRectangle::new([1.0, 1.0], [1.0, 2.0], 1.0f32).is_none());
        assert!(SphericalRectangle::new([f32::NAN, 1.0], [1.0, 2.0], 1.0).is_none());
    }
}
