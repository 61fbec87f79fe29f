//! A map in `f64`, by its definition, and its integrals.

use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// Five-point Gauss–Legendre rule on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_45),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

pub struct Oracle {
    pub width: u32,
    pub height: u32,
    pub rgb: Vec<Vec3>,
}

impl Oracle {
    /// The bilinear colour at a place.
    pub fn at(&self, [u, v]: [f64; 2]) -> DVec3 {
        let (w, h) = (self.width as i64, self.height as i64);
        let texel = |x: i64, y: i64| {
            let i = y.clamp(0, h - 1) * w + x.rem_euclid(w);
            self.rgb[i as usize].as_dvec3()
        };
        let (x, y) = (u * w as f64 - 0.5, v * h as f64 - 0.5);
        let (i, j) = (x.floor(), y.floor());
        let (s, t) = (x - i, y - j);
        let (i, j) = (i as i64, j as i64);
        let top = texel(i, j) * (1.0 - s) + texel(i + 1, j) * s;
        let bottom = texel(i, j + 1) * (1.0 - s) + texel(i + 1, j + 1) * s;
        top * (1.0 - t) + bottom * t
    }

    pub fn luminance(&self, place: [f64; 2]) -> f64 {
        self.at(place).dot(DVec3::new(0.2126, 0.7152, 0.0722))
    }

    /// Integral over each rectangle of half a texel a side, within which the map is smooth, of a
    /// function of place and direction against the solid angle.
    pub fn integrate(&self, f: impl Fn([f64; 2], DVec3) -> f64) -> Vec<f64> {
        let (w, h) = (2 * self.width, 2 * self.height);
        let area = 1.0 / (f64::from(w) * f64::from(h));
        let bin = |i: u32| {
            let (x, y) = (f64::from(i % w), f64::from(i / w));
            let mut sum = 0.0;
            for (a, wa) in GAUSS {
                for (b, wb) in GAUSS {
                    let place = [(x + a) / f64::from(w), (y + b) / f64::from(h)];
                    let sin_theta = (PI * place[1]).sin();
                    sum += wa * wb * f(place, direction(place)) * sin_theta;
                }
            }
            sum * area * 2.0 * PI * PI
        };
        (0..w * h).map(bin).collect()
    }

    /// The rectangle of [`Oracle::integrate`] that a direction of the map's frame falls into.
    pub fn bin(&self, d: DVec3) -> usize {
        let (w, h) = (2 * self.width as usize, 2 * self.height as usize);
        let [u, v] = place(d);
        let x = ((u * w as f64) as usize).min(w - 1);
        let y = ((v * h as f64) as usize).min(h - 1);
        y * w + x
    }
}

pub fn place(d: DVec3) -> [f64; 2] {
    let u = 0.5 + d.x.atan2(-d.z) / TAU;
    [u, d.x.hypot(d.z).atan2(d.y) / PI]
}

pub fn direction([u, v]: [f64; 2]) -> DVec3 {
    let (sin_phi, cos_phi) = (TAU * (u - 0.5)).sin_cos();
    let (sin_theta, cos_theta) = (PI * v).sin_cos();
    DVec3::new(sin_theta * sin_phi, cos_theta, -sin_theta * cos_phi)
}
