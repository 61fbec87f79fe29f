//! From the file's axes and unit to the world: +Y up, metres.

use super::geometry::below_root;
use super::xml::{Reader, start};
use glam::{DMat4, DVec3, DVec4};

/// Which axis of the file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UpAxis {
    X,
    Y,
    Z,
}

/// Two ways to stand a file upright; they differ by half a turn about +Y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Convention {
    /// The smallest rotation that takes the up axis to +Y.
    Standard,
    /// As the classic assignment's viewer does it.
    Course,
}

/// The change of frame from a file to the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub up: UpAxis,
    pub convention: Convention,
    /// Metres per unit of the file.
    pub metres: f64,
}

impl Frame {
    /// File to world.
    pub fn matrix(&self) -> DMat4 {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        // Where the file's axes go. Adding zero takes the sign off negative zeros.
        let columns = match (self.up, self.convention) {
            (UpAxis::Y, _) => [x, y, z],
            (UpAxis::Z, Convention::Standard) => [x, -z, y],
            (UpAxis::Z, Convention::Course) => [-x, z, y],
            (UpAxis::X, Convention::Standard) => [y, -x, z],
            (UpAxis::X, Convention::Course) => [y, x, -z],
        };
        let [a, b, c] = columns.map(|v| (v * self.metres + DVec3::ZERO).extend(0.0));
        DMat4::from_cols(a, b, c, DVec4::W)
    }

    /// In words, for the report.
    pub fn describe(&self) -> String {
        let map = match (self.up, self.convention) {
            (UpAxis::Y, _) => "Y_UP, as it is",
            (UpAxis::Z, Convention::Standard) => "Z_UP, (x, y, z) -> (x, z, -y)",
            (UpAxis::Z, Convention::Course) => "Z_UP, the course's way: (x, y, z) -> (-x, z, y)",
            (UpAxis::X, Convention::Standard) => "X_UP, (x, y, z) -> (-y, x, z)",
            (UpAxis::X, Convention::Course) => "X_UP, the course's way: (x, y, z) -> (y, x, -z)",
        };
        format!("{map}; unit {} m", self.metres)
    }

    /// Rotation about +Y in degrees of an environment map with `flip_u` that makes it the
    /// course's map.
    ///
    /// The course looks up u = 1/2 + atan2(−z, x)/2π; a flipped map turned by θ about +Y is
    /// looked up at u = 1/2 − atan2(x, −z)/2π − θ/2π, and atan2(−z, x) = π/2 − atan2(x, −z). So θ
    /// is −90° in the course's world, and half a turn more in one that is turned by half a turn.
    pub fn environment_rotation(&self) -> f64 {
        match (self.up, self.convention) {
            (UpAxis::Y, _) | (_, Convention::Course) => -90.0,
            _ => 90.0,
        }
    }
}

impl<'a> Reader<'a> {
    /// The frame that `<asset>` declares.
    pub fn frame(&mut self, convention: Convention) -> Frame {
        let mut up = UpAxis::Y;
        if let Some(node) = below_root(self, &["asset", "up_axis"]) {
            up = match node.text().unwrap_or_default().trim() {
                "X_UP" => UpAxis::X,
                "Y_UP" => UpAxis::Y,
                "Z_UP" => UpAxis::Z,
                _ => {
                    let message = "<up_axis> must be X_UP, Y_UP or Z_UP";
                    self.diag.fault(start(node), message, "Y_UP is taken");
                    UpAxis::Y
                }
            };
        }
        let mut metres = 1.0;
        if let Some(unit) = below_root(self, &["asset", "unit"])
            && let Some(attribute) = unit.attribute_node("meter")
        {
            match attribute.value().trim().parse::<f64>() {
                // Both ends keep products with ordinary coordinates in the range of f32.
                Ok(m) if (1e-15..=1e15).contains(&m) => metres = m,
                _ => {
                    let message = "`meter` must be a number above 0, the length of the unit";
                    let at = attribute.range_value().start;
                    self.diag.fault(at, message, "1 is taken");
                }
            }
        }
        Frame {
            up,
            convention,
            metres,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    const UPS: [UpAxis; 3] = [UpAxis::X, UpAxis::Y, UpAxis::Z];

    fn frame(up: UpAxis, convention: Convention) -> Frame {
        Frame {
            up,
            convention,
            metres: 1.0,
        }
    }

    #[test]
    fn conventions_are_rotations_that_take_up_to_y() {
        for up in UPS {
            let axis = match up {
                UpAxis::X => DVec3::X,
                UpAxis::Y => DVec3::Y,
                UpAxis::Z => DVec3::Z,
            };
            let standard = frame(up, Convention::Standard).matrix();
            let course = frame(up, Convention::Course).matrix();
            for m in [standard, course] {
                assert_eq!(m.determinant(), 1.0);
                assert_eq!(m.transform_vector3(axis), DVec3::Y);
            }
            if up != UpAxis::Y {
                let half_turn = DMat4::from_diagonal(DVec4::new(-1.0, 1.0, -1.0, 1.0));
                assert_eq!(half_turn * standard, course);
            }
        }
    }

    #[test]
    fn a_turned_flipped_map_is_looked_up_where_the_course_looks() {
        let wrap = |u: f64| u.rem_euclid(1.0);
        for up in UPS {
            for convention in [Convention::Standard, Convention::Course] {
                let f = frame(up, convention);
                let theta = f.environment_rotation().to_radians();
                let to_course = frame(up, Convention::Course).matrix() * f.matrix().inverse();
                for i in 0..100 {
                    let phi = i as f64 * 0.0628;
                    let d = DVec3::new(phi.cos(), 0.3, phi.sin());
                    // The direction in the map's own frame, then the house's formula, flipped.
                    let local = DMat4::from_rotation_y(-theta).transform_vector3(d);
                    let ours = wrap(1.0 - (0.5 + local.x.atan2(-local.z) / TAU));
                    let c = to_course.transform_vector3(d);
                    let theirs = wrap(((-c.z).atan2(c.x) + PI) / TAU);
                    let apart = (ours - theirs).abs();
                    assert!(apart.min(1.0 - apart) < 1e-12, "{ours} {theirs}");
                }
            }
        }
    }
}
