//! Colour spaces of ꟻLIP: linear Rec. 709, the opponent space YCxCz, and CIELAB with Hunt's effect.
//!
//! XYZ is always relative to the white of Rec. 709, so that white is (1, 1, 1) in it.

use glam::{DMat3, DVec3, Mat3, Vec3};

/// Conversions, derived once from the chromaticities of Rec. 709.
#[derive(Clone, Copy)]
pub(super) struct Colours {
    to_xyz: Mat3,
    to_rgb: Mat3,
}

/// Chromaticities (x, y) of Rec. 709 in columns of (x, y, 1 − x − y) (ITU-R BT.709-6, table 1).
const PRIMARIES: [DVec3; 3] = [
    DVec3::new(0.64, 0.33, 0.03),
    DVec3::new(0.30, 0.60, 0.10),
    DVec3::new(0.15, 0.06, 0.79),
];

/// Its white, D65.
const WHITE: DVec3 = DVec3::new(0.3127, 0.3290, 0.3583);

impl Colours {
    pub fn new() -> Self {
        let primaries = DMat3::from_cols(PRIMARIES[0], PRIMARIES[1], PRIMARIES[2]);
        // How much of each primary makes white; then relative to white.
        let amounts = primaries.inverse() * WHITE;
        let to_xyz =
            DMat3::from_diagonal(WHITE.recip()) * primaries * DMat3::from_diagonal(amounts);
        Self {
            to_xyz: to_xyz.as_mat3(),
            to_rgb: to_xyz.inverse().as_mat3(),
        }
    }

    /// Relative luminance, and the other two.
    pub fn xyz(&self, rgb: Vec3) -> Vec3 {
        self.to_xyz * rgb
    }

    /// The linearised opponent space (Flohr, Kolpatzik, Balasubramanian, Carrara, Bouman, Allebach
    /// 1993).
    pub fn ycxcz(&self, rgb: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = self.xyz(rgb);
        Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
    }

    /// Back to linear Rec. 709.
    pub fn rgb(&self, ycxcz: Vec3) -> Vec3 {
        let y = luminance(ycxcz.x);
        self.to_rgb * Vec3::new(y + ycxcz.y / 500.0, y, y - ycxcz.z / 200.0)
    }

    /// CIELAB (CIE 15:2004), its chroma scaled with lightness after Hunt 1952.
    pub fn hunt_lab(&self, rgb: Vec3) -> Vec3 {
        let f = self.xyz(rgb).to_array().map(lab_curve);
        let lightness = 116.0 * f[1] - 16.0;
        let hunt = 0.01 * lightness;
        Vec3::new(
            lightness,
            hunt * 500.0 * (f[0] - f[1]),
            hunt * 200.0 * (f[1] - f[2]),
        )
    }
}

/// The achromatic channel of YCxCz as a fraction of white.
pub(super) fn luminance(achromatic: f32) -> f32 {
    (achromatic + 16.0) / 116.0
}

fn lab_curve(t: f32) -> f32 {
    const DELTA: f32 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA {
        t.cbrt()
    } else {
        t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
    }
}

/// The distance for large differences of Abasi, Tehran and Fairchild 2020: city blocks
/// between lightness and chroma, Euclid in chroma.
pub(super) fn hyab(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    d.x.abs() + (d.y * d.y + d.z * d.z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_the_way_back_leads_back() {
        let c = Colours::new();
        let close = |a: Vec3, b: Vec3| assert!((a - b).abs().max_element() < 2e-4, "{a} {b}");
        close(c.ycxcz(Vec3::ONE), Vec3::new(100.0, 0.0, 0.0));
        close(c.hunt_lab(Vec3::ONE), Vec3::new(100.0, 0.0, 0.0));
        close(c.hunt_lab(Vec3::ZERO), Vec3::ZERO);
        for rgb in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.2, 0.7, 0.1)] {
            close(c.rgb(c.ycxcz(rgb)), rgb);
        }
        // CIELAB of the sRGB primary green: (87.735, −86.183, 83.180) (Lindbloom's tables).
        let green = c.hunt_lab(Vec3::Y);
        let hunt = 0.877_35;
        assert!((green.x - 87.735).abs() < 0.01);
        assert!((green.y + 86.183 * hunt).abs() < 0.05, "{green}");
        assert!((green.z - 83.180 * hunt).abs() < 0.05, "{green}");
    }

    #[test]
    fn hyab_adds_lightness_to_chroma() {
        assert_eq!(
            hyab(Vec3::new(10.0, 3.0, 0.0), Vec3::new(8.0, 0.0, 4.0)),
            7.0
        );
    }
}
