//! Directions and places of a latitude–longitude map.
//!
//! In the map's own frame: v = θ/π from the top, θ the angle from +Y; u = 1/2 + atan2(x, −z)/2π. So
//! the middle column is −Z, and u grows towards +X. The area of a place is dω = 2π² sin θ du dv.

use sr_math::Real;

/// The place `[u, v]` in `[0, 1]²` of a direction of any length. At the poles u is some number.
///
/// θ comes from both sides of the angle: acos(y) would know it to √ulp near the poles only.
#[inline]
pub fn place_of<R: Real>([x, y, z]: [R; 3]) -> [R; 2] {
    let u = R::lit(0.5) + R::lit(0.5) * R::INV_PI * x.atan2(-z);
    let v = R::INV_PI * (x.sqr() + z.sqr()).sqrt().atan2(y);
    [u, v]
}

/// The unit direction of a place.
#[inline]
pub fn direction_of<R: Real>([u, v]: [R; 2]) -> [R; 3] {
    let phi = R::lit(2.0) * R::PI * (u - R::lit(0.5));
    let theta = R::PI * v;
    let sin_theta = theta.sin();
    [sin_theta * phi.sin(), theta.cos(), -(sin_theta * phi.cos())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_lie_where_the_convention_says() {
        let places = [
            ([0.0, 0.0, -1.0], [0.5, 0.5]),
            ([1.0, 0.0, 0.0], [0.75, 0.5]),
            ([-1.0, 0.0, 0.0], [0.25, 0.5]),
            ([1e-300, 0.0, 1.0], [1.0, 0.5]),
            ([-1e-300, 0.0, 1.0], [0.0, 0.5]),
            ([0.0, 1.0, -1e-300], [0.5, 0.0]),
            ([0.0, -1.0, -1e-300], [0.5, 1.0]),
        ];
        for (d, place) in places {
            let [u, v]: [f64; 2] = place_of(d);
            assert!((u - place[0]).abs() < 1e-15 && (v - place[1]).abs() < 1e-15);
        }
    }

    /// The `f32` place of a direction is that of `f64` to four roundings of a number below 1 (the two
    /// arc tangents, the product, the sum), at every distance from the poles: u too, for it depends
    /// on ratios only.
    #[test]
    fn places_are_exact_up_to_the_poles_and_lead_back() {
        for k in 0..2000u32 {
            let u = (f64::from(k) + 0.5) / 2000.0;
            for distance in [0.5, 0.1, 1e-3, 1e-6, 1e-12] {
                for v in [distance, 1.0 - distance] {
                    let d = direction_of([u, v]).map(|x: f64| x as f32);
                    let exact: [f64; 2] = place_of(d.map(f64::from));
                    let rounded: [f32; 2] = place_of(d);
                    for (a, b) in rounded.iter().zip(exact) {
                        assert!((f64::from(*a) - b).abs() < 4.0 * f64::from(f32::EPSILON));
                    }
                    // Below 1 − ulp the pole swallows what is left of the angle.
                    if v < 0.9 {
                        assert!((exact[0] - u).abs() < 1e-6, "{exact:?} {u} {v}");
                        assert!((exact[1] - v).abs() < 1e-7 * v + 1e-9);
                    }
                }
            }
        }
    }
}
