//! The square onto a regular polygon.

use crate::Real;

/// Radius of the concentric map, and its angle in turns from 0 to 1.
#[inline(always)]
fn concentric_turn<R: Real>(u: [R; 2]) -> (R, R) {
    let two = R::lit(2.0);
    let (a, b) = (two * u[0] - R::ONE, two * u[1] - R::ONE);
    let eighth = R::lit(0.125);
    let (signed, turn) = if a.abs() > b.abs() {
        (a, eighth * (b / a))
    } else if b != R::ZERO {
        (b, R::lit(0.25) - eighth * (a / b))
    } else {
        return (R::ZERO, R::ZERO);
    };
    let turn = if signed < R::ZERO {
        turn + R::lit(0.5)
    } else if turn < R::ZERO {
        turn + R::ONE
    } else {
        turn
    };
    (signed.abs(), turn)
}

/// A uniform point of the regular polygon with `corners` ≥ 3 corners on the unit circle, one of
/// them at `(1, 0)`; its area is [`regular_polygon_area`].
///
/// The disk of the concentric map (Shirley, Chiu 1997), each radius of it stretched to a line
/// from the centre to the polygon's edge: where the angle runs evenly through a wedge, the end of
/// the line runs evenly along the edge, so area stays in proportion (`r dr |E × E'| dφ`, constant
/// in `φ` since `E` moves straight). Like the concentric map it is continuous, so that `u` that
/// are spread well stay so; picking one of the triangles first would tear them apart.
#[inline]
pub fn regular_polygon<R: Real>(u: [R; 2], corners: u32) -> [R; 2] {
    let n = R::lit(f64::from(corners));
    let (radius, turn) = concentric_turn(u);
    let along = turn * n;
    let wedge = along.floor();
    let half = R::lit(0.5);
    // The wedge whose middle lies on +x, then turned to its place.
    let half_angle = R::PI / n;
    let x = radius * half_angle.cos();
    let y = radius * half_angle.sin() * (R::lit(2.0) * (along - wedge) - R::ONE);
    let angle = R::lit(2.0) * half_angle * (wedge + half);
    let (c, s) = (angle.cos(), angle.sin());
    [x * c - y * s, x * s + y * c]
}

/// Area of the regular polygon with `corners` corners on the unit circle.
#[inline]
pub fn regular_polygon_area<R: Real>(corners: u32) -> R {
    let n = R::lit(f64::from(corners));
    R::lit(0.5) * n * (R::lit(2.0) * R::PI / n).sin()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash;
    use std::f64::consts::PI;

    const CORNERS: [u32; 6] = [3, 4, 5, 6, 9, 1000];

    fn hashed() -> impl Iterator<Item = [f32; 2]> {
        (0..5000u32).map(|i| [0, 1].map(|k| hash::unit_f32(hash::mix(i, k))))
    }

    /// How far out a point lies: 1 on the edge of the polygon.
    fn out(p: [f64; 2], corners: u32) -> f64 {
        let n = f64::from(corners);
        let wedge = (p[1].atan2(p[0]) * n / (2.0 * PI)).floor() + 0.5;
        let (s, c) = (2.0 * PI / n * wedge).sin_cos();
        (p[0] * c + p[1] * s) / (PI / n).cos()
    }

    /// Equal areas of the square become equal areas of the polygon: the determinant of the
    /// derivative is its area. Central differences of 10⁻⁵ err by about 10⁻¹⁰/r² and 10⁻¹¹; points
    /// within 1 % of the diagonals, the centre and the wedges' borders, where the derivative
    /// jumps, are left out.
    #[test]
    fn area_stays_in_proportion() {
        for corners in [3, 4, 5, 6, 9] {
            let area = regular_polygon_area::<f64>(corners);
            let mut tried = 0;
            for u in hashed() {
                let u = u.map(f64::from);
                let (radius, turn) = concentric_turn(u);
                let near = |x: f64| (x - x.round()).abs() < 0.01;
                if radius < 0.05 || near(turn * f64::from(corners)) || near(turn * 4.0 + 0.5) {
                    continue;
                }
                tried += 1;
                let h = 1e-5;
                let at = |du: f64, dv: f64| regular_polygon([u[0] + du, u[1] + dv], corners);
                let d = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (a[k] - b[k]) / (2.0 * h));
                let (du, dv) = (d(at(h, 0.0), at(-h, 0.0)), d(at(0.0, h), at(0.0, -h)));
                let determinant = du[0] * dv[1] - du[1] * dv[0];
                assert!(
                    (determinant / area - 1.0).abs() < 1e-6,
                    "{corners} {u:?}: {determinant} {area}"
                );
            }
            assert!(tried > 4000, "{tried}");
        }
    }

    #[test]
    fn the_square_fills_the_polygon_and_no_more() {
        for corners in CORNERS {
            // The angle is one rounded product of up to 2π, the turn one of up to `corners`.
            let bound = (4.0 + 2.0 * PI) * f64::from(f32::EPSILON);
            for u in hashed() {
                let p = regular_polygon(u, corners);
                let exact = regular_polygon(u.map(f64::from), corners);
                let radius = concentric_turn(u.map(f64::from)).0;
                assert!((out(exact, corners) - radius).abs() < 1e-12);
                for k in 0..2 {
                    let apart = (f64::from(p[k]) - exact[k]).abs();
                    assert!(apart < bound, "{corners} {u:?} {p:?} {exact:?}");
                }
            }
        }
        for u in [[0.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 0.0], [1.0, 1.0]] {
            for corners in [3, 7, u32::MAX] {
                let p = regular_polygon::<f32>(u, corners);
                assert!(p[0].hypot(p[1]) <= 1.0 + 4.0 * f32::EPSILON, "{u:?} {p:?}");
            }
        }
    }

    #[test]
    fn a_corner_lies_on_the_first_axis() {
        // The middle of the right side of the square is turn 0 at radius 1.
        let [x, y] = regular_polygon::<f64>([1.0, 0.5], 5);
        assert!((x - 1.0).abs() < 1e-15 && y.abs() < 1e-15, "{x} {y}");
        assert!((regular_polygon_area::<f64>(4) - 2.0).abs() < 1e-15);
    }
}
