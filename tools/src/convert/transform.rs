//! The transform elements of a `<node>`.

use super::xml::{Reader, Xml, start, tag};
use glam::{DMat4, DVec3};

/// The elements that place a node.
const TRANSFORMS: [&str; 6] = ["matrix", "translate", "rotate", "scale", "lookat", "skew"];

impl<'a> Reader<'a> {
    /// Node to parent: the product of the node's transform elements in their order.
    ///
    /// `None` when one of them cannot be read.
    pub fn local_matrix(&mut self, node: Xml<'a>) -> Option<DMat4> {
        let mut product = DMat4::IDENTITY;
        let mut good = true;
        for element in node.children().filter(|c| c.is_element()) {
            if !TRANSFORMS.contains(&tag(element)) {
                continue;
            }
            match self.transform(element) {
                Some(m) => product *= m,
                None => good = false,
            }
        }
        good.then_some(product)
    }

    fn transform(&mut self, element: Xml<'a>) -> Option<DMat4> {
        match tag(element) {
            "matrix" => self.matrix(element),
            "translate" => {
                let t = self.array::<3>(element)?;
                Some(DMat4::from_translation(t.into()))
            }
            "scale" => {
                let s = self.array::<3>(element)?;
                // `DMat4::from_scale` refuses zeros, which flatten a model on purpose.
                Some(DMat4::from_diagonal(DVec3::from(s).extend(1.0)))
            }
            "rotate" => {
                let [x, y, z, degrees] = self.array::<4>(element)?;
                match DVec3::new(x, y, z).try_normalize() {
                    Some(axis) => Some(DMat4::from_axis_angle(axis, degrees.to_radians())),
                    None => {
                        let message = "a rotation about an axis of length 0";
                        self.diag.fault(start(element), message, "it is left out");
                        Some(DMat4::IDENTITY)
                    }
                }
            }
            "lookat" => self.look_at(element),
            kind => {
                let message = format!("<{kind}> is not supported");
                let hint = "bake it into a <matrix> or into the mesh";
                self.diag.error(start(element), message, hint);
                None
            }
        }
    }

    fn matrix(&mut self, element: Xml<'a>) -> Option<DMat4> {
        let mut rows = self.floats(element)?;
        let n = rows.len();
        if n != 16 {
            let message = format!("<matrix> holds {n} numbers, 16 are needed");
            // Twelve numbers are all that matter in an affine matrix; fewer say nothing.
            let remedy = match n {
                0..12 => "the identity is taken",
                12..16 => "the missing numbers at its end are taken as 0",
                _ => "the numbers beyond the 16th are left out",
            };
            self.diag.fault(start(element), message, remedy);
            if n < 12 {
                return Some(DMat4::IDENTITY);
            }
            rows.resize(16, 0.0);
        }
        let rows: [f64; 16] = rows.try_into().ok()?;
        if n == 16 && rows[12..] != [0.0, 0.0, 0.0, 1.0] {
            let message = "the last row of a <matrix> must be 0 0 0 1";
            self.diag.fault(start(element), message, "it is ignored");
        }
        let mut m = DMat4::from_cols_array(&rows).transpose();
        for column in [&mut m.x_axis, &mut m.y_axis, &mut m.z_axis] {
            column.w = 0.0;
        }
        m.w_axis.w = 1.0;
        Some(m)
    }

    fn look_at(&mut self, element: Xml<'a>) -> Option<DMat4> {
        let v = self.array::<9>(element)?;
        let eye = DVec3::new(v[0], v[1], v[2]);
        let interest = DVec3::new(v[3], v[4], v[5]);
        let up = DVec3::new(v[6], v[7], v[8]);
        let z = (eye - interest).try_normalize();
        let x = z.and_then(|z| up.cross(z).try_normalize());
        let (Some(z), Some(x)) = (z, x) else {
            let message = "<lookat> without a direction";
            let hint = "the points must differ, and `up` must not lie along the view";
            self.diag.error(start(element), message, hint);
            return None;
        };
        Some(DMat4::from_cols(
            x.extend(0.0),
            z.cross(x).extend(0.0),
            z.extend(0.0),
            eye.extend(1.0),
        ))
    }
}

/// Rotation angles about x, then y, then z in degrees (`Rz · Ry · Rx`) of an orthonormal,
/// right-handed frame.
///
/// The angle about x is taken after undoing the one about z, so that the three fit together
/// where the frame leaves the one about z undetermined too.
pub(crate) fn euler_degrees(x: DVec3, y: DVec3, z: DVec3) -> [f64; 3] {
    let about_z = x.y.atan2(x.x);
    let about_y = (-x.z).atan2(x.x.hypot(x.y));
    let (s, c) = about_z.sin_cos();
    let about_x = (s * z.x - c * z.y).atan2(c * y.y - s * y.x);
    [about_x, about_y, about_z].map(f64::to_degrees)
}

/// The right-handed orthonormal frame whose Z is along `z` and whose Y is as near to `y` as can
/// be; any frame around `z` when `y` gives no direction. `None` when `z` is zero.
pub(crate) fn frame_along(z: DVec3, y: DVec3) -> Option<[DVec3; 3]> {
    let z = z.try_normalize()?;
    let x = y
        .cross(z)
        .try_normalize()
        .unwrap_or_else(|| z.any_orthonormal_vector());
    Some([x, z.cross(x), z])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    #[test]
    fn angles_give_the_frame_back_in_gimbal_lock_too() {
        for i in 0..20_000 {
            let u = |k: u32| ((i as f64 + 1.0) * (k as f64).sqrt()).fract();
            let angle = |k| (u(k) - 0.5) * 360.0;
            let mut wanted = [angle(2), angle(3) * 0.5, angle(5)];
            if i % 3 == 0 {
                wanted[1] = if i % 2 == 0 { 90.0 } else { -90.0 };
            }
            let matrix = |[x, y, z]: [f64; 3]| {
                DMat3::from_rotation_z(z.to_radians())
                    * DMat3::from_rotation_y(y.to_radians())
                    * DMat3::from_rotation_x(x.to_radians())
            };
            let m = matrix(wanted);
            let back = matrix(euler_degrees(m.x_axis, m.y_axis, m.z_axis));
            // Some ten roundings of numbers up to 1.
            let error = (m - back).abs().to_cols_array();
            let worst = error.into_iter().fold(0.0, f64::max);
            assert!(worst < 20.0 * f64::EPSILON, "{wanted:?}: {worst}");
        }
    }
}
