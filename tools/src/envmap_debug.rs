//! A picture of how an environment map is sampled: the density, and samples over it.
//!
//! The picture lies as the map does, so the density is that per area of the picture: the renderer's,
//! per solid angle, times sin θ. In grey levels it is d/(1 + d) of the density d relative to the mean of
//! the picture, so that an even density is mid-grey and a sun does not turn all else black. Red points
//! are samples, drawn by the renderer's own sampler.

use clap::Args;
use sr_film::{DisplayImage, read_image, write_png};
use sr_light::{EnvironmentMap, clamp_negative, direction_of, place_of};
use sr_sampling::{BounceDim, Dim, Sampler, SamplerSpec};
use std::f64::consts::PI;
use std::path::PathBuf;

/// Arguments of `envmap-debug`.
#[derive(Args, Clone, Debug)]
pub struct EnvmapDebugArgs {
    /// The map: OpenEXR, Radiance HDR or PNG.
    pub map: PathBuf,
    /// The picture.
    #[arg(short, long, value_name = "PICTURE.PNG")]
    pub output: PathBuf,
    /// How many samples are drawn.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    #[arg(value_parser = clap::value_parser!(u32).range(..=10_000_000))]
    pub samples: u32,
    /// Another seed, other samples.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Width of the picture in pixels; it is half as high.
    #[arg(long, value_name = "W", default_value_t = 1024)]
    #[arg(value_parser = clap::value_parser!(u32).range(16..=16384))]
    pub width: u32,
}

/// What was drawn, or why not.
#[derive(Debug)]
pub enum Error {
    /// The map cannot be read or sampled.
    Map(String),
    /// The picture cannot be written.
    Write(String),
}

/// Draws the picture and writes it; what there is to tell, a line each.
///
/// # Errors
/// A map that cannot be read or has no light, a picture that cannot be written.
pub fn write(args: &EnvmapDebugArgs) -> Result<Vec<String>, Error> {
    let name = args.map.display();
    let image = read_image(&args.map).map_err(|e| Error::Map(e.to_string()))?;
    let (width, height, mut rgb) = (image.width, image.height, image.pixels);
    let clamped = clamp_negative(width, &mut rgb);
    let map =
        EnvironmentMap::new(width, height, rgb).map_err(|e| Error::Map(format!("{name}: {e}")))?;
    let picture = draw(&map, args.width, args.samples, args.seed)
        .ok_or_else(|| Error::Map(format!("{name}: all of it is black")))?;
    write_png(&args.output, &picture).map_err(|e| Error::Write(e.to_string()))?;
    let mut told = vec![format!("{name}: {width} × {height}")];
    told.extend(clamped.map(|bad| format!("{bad} negative and taken for 0")));
    told.push(format!("wrote {}", args.output.display()));
    Ok(told)
}

/// The picture; `None` when the map is black.
pub fn draw(map: &EnvironmentMap, width: u32, samples: u32, seed: u64) -> Option<DisplayImage> {
    let height = width / 2;
    let density = density(map, [width, height]);
    let mean = density.iter().sum::<f64>() / density.len() as f64;
    if mean <= 0.0 {
        return None;
    }
    let grey = |d: &f64| {
        let d = d / mean;
        [(255.0 * d / (1.0 + d) + 0.5) as u8; 3]
    };
    let mut picture = DisplayImage {
        width,
        height,
        pixels: density.iter().map(grey).collect(),
    };
    let spec = SamplerSpec {
        seed,
        ..SamplerSpec::default()
    };
    for i in 0..u64::from(samples) {
        let u = spec.sobol([0, 0], i).d2(Dim::bounce(0, BounceDim::Light));
        if let Some(d) = map.sample(u.to_array()) {
            point(&mut picture, place_of(d.as_dvec3().to_array()));
        }
    }
    Some(picture)
}

/// Density per area of the picture, relative to a density over the sphere of 1, by pixel: the mean of a
/// grid fine enough for each texel to be met.
fn density(map: &EnvironmentMap, [width, height]: [u32; 2]) -> Vec<f64> {
    let side = |texels: u32, pixels: u32| 2 * texels.div_ceil(pixels);
    let (across, down) = (side(map.width(), width), side(map.height(), height));
    let mut density = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let mut sum = 0.0;
            for k in 0..across * down {
                let a = (f64::from(k % across) + 0.5) / f64::from(across);
                let b = (f64::from(k / across) + 0.5) / f64::from(down);
                let u = (f64::from(x) + a) / f64::from(width);
                let v = (f64::from(y) + b) / f64::from(height);
                let d = glam::DVec3::from(direction_of([u, v])).as_vec3();
                sum += f64::from(map.pdf(d)) * (PI * v).sin();
            }
            density.push(sum / f64::from(across * down));
        }
    }
    density
}

/// A red point, three pixels across, that is the same over light and dark.
fn point(picture: &mut DisplayImage, [u, v]: [f64; 2]) {
    let (w, h) = (i64::from(picture.width), i64::from(picture.height));
    let (x, y) = ((u * w as f64) as i64, (v * h as f64) as i64);
    for (dx, dy) in [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)] {
        let (x, y) = ((x + dx).rem_euclid(w), y + dy);
        if (0..h).contains(&y) {
            picture.pixels[(y * w + x) as usize] = [255, 40, 20];
        }
    }
}
