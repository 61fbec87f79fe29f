//! A clear sky as an environment map.

use super::{Error, Made};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `generate sky`.
#[derive(Args, Clone, Debug)]
pub struct SkyArgs {
    /// The map, latitude-longitude.
    #[arg(short, long, value_name = "MAP.EXR")]
    pub output: PathBuf,
    /// Height of the sun over the horizon, from 0 to 90 degrees.
    #[arg(long, value_name = "DEG", default_value_t = 45.0)]
    pub sun_elevation: f64,
    /// Direction of the sun, in degrees clockwise from −Z (the middle of the map) seen from above.
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub sun_azimuth: f64,
    /// Haze, from 1 (none) to 10 (much).
    #[arg(long, value_name = "T", default_value_t = 3.0)]
    pub turbidity: f64,
    /// Share of the light that the ground reflects, from 0 to 1.
    #[arg(long, value_name = "A", default_value_t = 0.3)]
    pub ground_albedo: f64,
    /// Width of the map in pixels; it is half as high.
    #[arg(long, value_name = "W", default_value_t = 1024)]
    pub width: u32,
    /// Leave out the sun's disk.
    #[arg(long)]
    pub no_sun: bool,
}

/// Make the sky and write it.
pub(super) fn write(args: &SkyArgs) -> Result<Made, Error> {
    Err(Error::Usage(format!(
        "{}: the sky itself is yet to come",
        args.output.display()
    )))
}
