//! A clear sky as an environment map.
//!
//! The sky is the model of Hosek and Wilkie 2012 ("An Analytic Model for Full Spectral Sky-Dome
//! Radiance"), in their RGB version. The sun is a disk of even radiance with the irradiance that
//! the same air lets through ([`sun`]). Below the horizon lies even, matt ground that both shine on.
//!
//! Radiance is weighted by the eye's sensitivity as in the model: W/(m² sr) of what the colour matching
//! functions let through, so luminance times 683 is cd/m². A clear sky then is some units bright, the
//! sun 2·10⁶.

mod sun;

use super::{Error, Made};
use clap::Args;
use glam::{DVec3, Vec3};
use hw_skymodel::rgb::{Channel, SkyParams, SkyState};
use sr_film::{Image, Precision, write_image_exr};
use sr_light::direction_of;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::PathBuf;

/// Arguments of `generate sky`.
#[derive(Args, Clone, Debug)]
pub struct SkyArgs {
    /// The map, latitude-longitude; −Z is in the middle, +X in the middle of the right half.
    #[arg(short, long, value_name = "MAP.EXR")]
    pub output: PathBuf,
    /// Height of the sun over the horizon, from 0 to 90 degrees.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 45.0,
        allow_negative_numbers = true
    )]
    pub sun_elevation: f64,
    /// Direction of the sun, in degrees clockwise from −Z (the middle of the map) seen from above.
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pub sun_azimuth: f64,
    /// Haze: 1 none, 3 a clear day, 10 much.
    #[arg(long, value_name = "T", default_value_t = 3.0)]
    pub turbidity: f64,
    /// Share of the light that the ground reflects, from 0 to 1.
    #[arg(long, value_name = "A", default_value_t = 0.3)]
    pub ground_albedo: f64,
    /// Width of the map in pixels, even, 16 to 16384; it is half as high.
    #[arg(long, value_name = "W", default_value_t = 1024)]
    pub width: u32,
    /// Leave out the sun's disk, here and in what lights the ground.
    #[arg(long)]
    pub no_sun: bool,
}

/// How fast haze takes the place of the ground towards the horizon: height of the eye over the distance
/// that light gets, for 2 m and 10 km. From a hill the haze under a low sun would light the ground to the nadir.
const HAZE: f64 = 2e-4;

/// Make the sky and write it.
pub(super) fn write(args: &SkyArgs) -> Result<Made, Error> {
    let sky = Sky::new(args)?;
    let image = sky.image(args.width);
    let texts = [
        ("made_by", "steradian-tools generate sky".to_owned()),
        ("sun_elevation_deg", args.sun_elevation.to_string()),
        ("sun_azimuth_deg", args.sun_azimuth.to_string()),
        ("turbidity", args.turbidity.to_string()),
        ("ground_albedo", args.ground_albedo.to_string()),
        ("sun", (!args.no_sun).to_string()),
    ];
    let attributes = texts.map(|(name, text)| (name.to_owned(), text));
    // Half floats end long before the sun.
    write_image_exr(&args.output, &image, Precision::Float, &attributes)
        .map_err(|e| Error::of_image(&e))?;
    let colour = |c: DVec3| format!("({:.4}, {:.4}, {:.4})", c.x, c.y, c.z);
    Ok(Made {
        summary: vec![
            format!(
                "sky: irradiance {} W/m² on the ground",
                colour(sky.from_sky)
            ),
            format!("sun: irradiance {} W/m² facing it", colour(sky.sun)),
            format!("ground: radiance {} W/(m² sr)", colour(sky.ground)),
        ],
        written: vec![args.output.clone()],
    })
}

/// A clear sky with sun and ground.
pub struct Sky {
    model: SkyState,
    /// Unit direction towards the sun.
    pub to_sun: DVec3,
    /// Irradiance from the sun on a surface that faces it; 0 without.
    pub sun: DVec3,
    /// Irradiance from the sky on level ground.
    pub from_sky: DVec3,
    /// Radiance of the ground.
    pub ground: DVec3,
}

impl Sky {
    /// # Errors
    /// An argument that is out of its range.
    pub fn new(args: &SkyArgs) -> Result<Self, Error> {
        let within = |name: &str, x: f64, low: f64, high: f64| {
            if (low..=high).contains(&x) {
                return Ok(());
            }
            let text = format!("--{name} {x}: it must be from {low} to {high}");
            Err(Error::Usage(text))
        };
        within("sun-elevation", args.sun_elevation, 0.0, 90.0)?;
        within("sun-azimuth", args.sun_azimuth, -360.0, 360.0)?;
        within("turbidity", args.turbidity, 1.0, 10.0)?;
        within("ground-albedo", args.ground_albedo, 0.0, 1.0)?;
        within("width", args.width.into(), 16.0, 16384.0)?;
        if args.width % 2 == 1 {
            let text = format!("--width {}: it must be even", args.width);
            return Err(Error::Usage(text));
        }
        let elevation = args.sun_elevation.to_radians();
        let params = SkyParams {
            // π/2 in `f32` is its own rounding.
            elevation: (elevation as f32).min(std::f32::consts::FRAC_PI_2),
            turbidity: args.turbidity as f32,
            albedo: [args.ground_albedo as f32; 3],
        };
        let model = SkyState::new(&params).map_err(|e| Error::Usage(e.to_string()))?;
        let azimuth = args.sun_azimuth.to_radians();
        let (sin, cos) = elevation.sin_cos();
        let sun = if args.no_sun {
            DVec3::ZERO
        } else {
            sun::irradiance(elevation, args.turbidity)
        };
        let mut sky = Self {
            model,
            to_sun: DVec3::new(cos * azimuth.sin(), sin, -cos * azimuth.cos()),
            sun,
            from_sky: DVec3::ZERO,
            ground: DVec3::ZERO,
        };
        sky.from_sky = sky.irradiance();
        sky.ground = args.ground_albedo / PI * (sky.from_sky + sky.sun * sin);
        Ok(sky)
    }

    /// Radiance of the sky without the sun in a unit direction at or over the horizon.
    fn over_horizon(&self, d: DVec3) -> DVec3 {
        let theta = d.y.clamp(0.0, 1.0).acos().min(FRAC_PI_2) as f32;
        let gamma = d.dot(self.to_sun).clamp(-1.0, 1.0).acos() as f32;
        let channel = |c| f64::from(self.model.radiance(theta, gamma, c));
        // The fits dip below 0 where the sky is nearly black.
        DVec3::new(
            channel(Channel::R),
            channel(Channel::G),
            channel(Channel::B),
        )
        .max(DVec3::ZERO)
    }

    /// Radiance without the sun in a unit direction. The ground fades into the sky at the horizon,
    /// as through haze: what is seen δ below it is `HAZE`/sin δ of the way that light gets through
    /// (Koschmieder 1924).
    pub fn radiance(&self, d: DVec3) -> DVec3 {
        if d.y >= 0.0 {
            return self.over_horizon(d);
        }
        let level = DVec3::new(d.x, 0.0, d.z).normalize_or(DVec3::NEG_Z);
        let clear = (HAZE / d.y).exp();
        self.over_horizon(level).lerp(self.ground, clear)
    }

    /// Irradiance of level ground by a midpoint rule of half a degree, over sin² of the height, in
    /// which level ground counts all alike.
    fn irradiance(&self) -> DVec3 {
        let (rings, sectors) = (180, 720);
        let mut sum = DVec3::ZERO;
        for i in 0..rings {
            let y = ((f64::from(i) + 0.5) / f64::from(rings)).sqrt();
            let level = (1.0 - y * y).sqrt();
            for k in 0..sectors {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(sectors)).sin_cos();
                sum += self.over_horizon(DVec3::new(level * sin, y, -level * cos));
            }
        }
        PI * sum / f64::from(rings * sectors)
    }

    /// The map, `width` wide and half as high.
    pub fn image(&self, width: u32) -> Image {
        let height = width / 2;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let d = direction_of(sun::place([x, y], [0.5, 0.5], [width, height]));
                pixels.push(self.radiance(d.into()).as_vec3());
            }
        }
        if self.sun != DVec3::ZERO {
            let disk = sun::disk(self.to_sun, [width, height]);
            for (pixel, share) in pixels.iter_mut().zip(disk) {
                *pixel += (self.sun * share).as_vec3();
            }
        }
        // The model's arithmetic is `f32`; a number that is none would be its mistake.
        debug_assert!(
            pixels
                .iter()
                .all(|p| p.is_finite() && p.cmpge(Vec3::ZERO).all())
        );
        Image {
            width,
            height,
            pixels,
        }
    }
}
