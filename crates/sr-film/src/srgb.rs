//! The sRGB transfer curve (IEC 61966-2-1:1999).

use glam::Vec3;

/// Linear light in [0, 1] to the code value in [0, 1]; outside it is clipped, NaN becomes 0.
pub fn encode(linear: f32) -> f32 {
    if linear >= 1.0 {
        1.0
    } else if linear > 0.003_130_8 {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    } else {
        // `max` turns NaN into 0.
        12.92 * linear.max(0.0)
    }
}

/// A code value in [0, 1] to linear light.
pub fn decode(code: f32) -> f32 {
    if code <= 0.040_45 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }
}

/// [`encode`] on every channel.
pub fn encode_rgb(linear: Vec3) -> Vec3 {
    linear.to_array().map(encode).into()
}

/// [`decode`] on every channel.
pub fn decode_rgb(code: Vec3) -> Vec3 {
    code.to_array().map(decode).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_points() {
        // 18 % grey is code 117.6 of 255, half intensity 187.5.
        for (linear, code) in [(0.0, 0.0), (1.0, 255.0), (0.18, 117.64), (0.5, 187.52)] {
            assert!((encode(linear) * 255.0 - code).abs() < 0.01, "{linear}");
        }
        assert_eq!(encode(f32::NAN), 0.0);
        assert_eq!((encode(-1.0), encode(f32::INFINITY)), (0.0, 1.0));
    }

    #[test]
    fn decode_undoes_encode_and_both_rise() {
        let mut last = -1.0;
        for i in 0..=65_535u32 {
            let code = i as f32 / 65_535.0;
            let linear = decode(code);
            assert!(linear > last);
            last = linear;
            // The two branches meet within 10⁻⁷ by the standard's rounding; powf adds a few ulp.
            assert!((encode(linear) - code).abs() < 1e-6, "{code}");
        }
    }
}
