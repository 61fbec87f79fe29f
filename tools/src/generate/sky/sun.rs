//! The sun: what of its light reaches the ground, and its disk on a map.

use glam::{DVec3, Vec3};
use sr_light::{EnvironmentMap, direction_of};
use std::f64::consts::PI;

/// Angular radius of the sun at its mean distance, 959.63 seconds of arc (IAU 2015 B3: nominal radius
/// 6.957·10⁸ m, over 1 au).
pub const RADIUS: f64 = 959.63 / 3600.0 * PI / 180.0;

/// Temperature of the black body with the sun's total irradiance, K (IAU 2015 B3).
const TEMPERATURE: f64 = 5772.0;

/// Absorption of ozone, 1/cm, each 10 nm from 450 nm on (Vigroux's measurements, as tabulated by Iqbal
/// 1983 and Preetham, Shirley, Smits 1999, table 2). Below it is none.
const OZONE: [f64; 33] = [
    0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
    0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023,
    0.018, 0.014, 0.011, 0.010, 0.009, 0.007, 0.004,
];

/// Irradiance of a surface that faces the sun, linear Rec. 709, weighted by the colour matching functions:
/// a black body of the sun's size through the air of Preetham, Shirley, Smits 1999, appendix A.1, less
/// what water vapour and oxygen take, which the eye hardly sees.
pub fn irradiance(elevation: f64, turbidity: f64) -> DVec3 {
    let mass = air_mass(elevation);
    let solid_angle = PI * RADIUS.sin().powi(2);
    let mut xyz = DVec3::ZERO;
    for nm in (380..=780).step_by(5) {
        let nm = f64::from(nm);
        let spectral = black_body(nm) * solid_angle * transmittance(nm, mass, turbidity);
        xyz += spectral * 5.0 * colour_matching(nm);
    }
    to_rec709(xyz).max(DVec3::ZERO)
}

/// How many times the air overhead lies before the sun (Kasten, Young 1989).
fn air_mass(elevation: f64) -> f64 {
    let degrees = elevation.to_degrees();
    1.0 / (elevation.sin() + 0.50572 * (degrees + 6.07995).powf(-1.6364))
}

/// Radiance of a black body at the sun's temperature, W/(m² sr nm) (Planck 1901).
fn black_body(nm: f64) -> f64 {
    const H: f64 = 6.626_070_15e-34;
    const C: f64 = 299_792_458.0;
    const K: f64 = 1.380_649e-23;
    let lambda = nm * 1e-9;
    let exponent = H * C / (lambda * K * TEMPERATURE);
    2.0 * H * C * C / lambda.powi(5) / exponent.exp_m1() * 1e-9
}

/// Share of a wavelength that gets through: molecules, ozone (0.35 cm of it), aerosols of Ångström's
/// exponent 1.3.
fn transmittance(nm: f64, mass: f64, turbidity: f64) -> f64 {
    let micrometres = nm * 1e-3;
    let molecules = 0.008735 * micrometres.powf(-4.08);
    let beta = 0.04608 * turbidity - 0.04586;
    let aerosols = beta * micrometres.powf(-1.3);
    let at = (nm - 450.0) / 10.0;
    let ozone = if at < 0.0 {
        0.0
    } else {
        let entry = |i: usize| OZONE.get(i).copied().unwrap_or(0.0);
        let i = at as usize;
        entry(i) + (at - i as f64) * (entry(i + 1) - entry(i))
    };
    (-mass * (molecules + aerosols + 0.35 * ozone)).exp()
}

/// The CIE's colour matching functions of 1931 by the fit of Wyman, Sloan, Shirley 2013, eq. 4.
fn colour_matching(nm: f64) -> DVec3 {
    let lobe = |centre: f64, below: f64, above: f64| {
        let t = (nm - centre) * if nm < centre { below } else { above };
        (-0.5 * t * t).exp()
    };
    let x = 0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
        - 0.065 * lobe(501.1, 0.0490, 0.0382);
    let y = 0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322);
    let z = 1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725);
    DVec3::new(x, y, z)
}

/// XYZ to linear Rec. 709 (IEC 61966-2-1).
fn to_rec709(xyz: DVec3) -> DVec3 {
    DVec3::new(
        xyz.dot(DVec3::new(3.2406, -1.5372, -0.4986)),
        xyz.dot(DVec3::new(-0.9689, 1.8758, 0.0415)),
        xyz.dot(DVec3::new(0.0557, -0.2040, 1.0570)),
    )
}

/// The place on a map of a point inside a texel.
pub fn place([x, y]: [u32; 2], [a, b]: [f64; 2], [width, height]: [u32; 2]) -> [f64; 2] {
    let u = (f64::from(x) + a) / f64::from(width);
    [u, (f64::from(y) + b) / f64::from(height)]
}

/// Radiance by texel of a disk around `to_sun` whose irradiance, facing it, is 1 (less what is below the
/// horizon), however coarse the map: each texel has the share of it that the disk covers, and the whole
/// is scaled by the integral of the map as it will be read, bilinear.
pub fn disk(to_sun: DVec3, size: [u32; 2]) -> Vec<f64> {
    let [width, height] = size;
    let step = PI / f64::from(height);
    // Four points across a radius; a texel that is smaller has four a side.
    let side = (4.0 * step / RADIUS).ceil().max(4.0) as u32;
    let (mut above, mut below) = (0.0, 0.0);
    let mut cover = vec![0.0; width as usize * height as usize];
    for y in 0..height {
        let theta = (f64::from(y) + 0.5) * step;
        if (theta - to_sun.y.acos()).abs() > RADIUS + step {
            continue;
        }
        for x in 0..width {
            for k in 0..side * side {
                let inside = [k % side, k / side].map(|i| (f64::from(i) + 0.5) / f64::from(side));
                let place = place([x, y], inside, size);
                let d = DVec3::from(direction_of(place));
                // The chord, since a cosine near 1 says little.
                if (d - to_sun).length() > 2.0 * (0.5 * RADIUS).sin() {
                    continue;
                }
                let area = (PI * place[1]).sin();
                if d.y < 0.0 {
                    below += area;
                } else {
                    above += area;
                    cover[(y * width + x) as usize] += 1.0;
                }
            }
        }
    }
    let Some(most) = cover.iter().copied().reduce(f64::max).filter(|m| *m > 0.0) else {
        return cover;
    };
    let rgb = cover.iter().map(|c| Vec3::splat((c / most) as f32));
    let map = EnvironmentMap::new(width, height, rgb.collect());
    let average = map.map_or(1.0, |m| f64::from(m.average().x));
    let scale = above / (above + below) / (4.0 * PI * average * most);
    for c in &mut cover {
        *c *= scale;
    }
    cover
}
