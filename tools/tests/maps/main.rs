//! `generate sky` and `envmap-debug`.

mod debug;
mod program;
mod sky;

use sr_tools::generate::{Sky, SkyArgs};

/// Arguments as the command line has them by default.
fn args() -> SkyArgs {
    SkyArgs {
        output: "sky.exr".into(),
        sun_elevation: 45.0,
        sun_azimuth: 0.0,
        turbidity: 3.0,
        ground_albedo: 0.3,
        width: 256,
        no_sun: false,
    }
}

fn make(args: &SkyArgs) -> Sky {
    Sky::new(args).unwrap_or_else(|e| panic!("{e}"))
}
