//! The sky is bright where and as it should be.

use super::*;
use glam::DVec3;
use sr_film::Image;
use sr_light::{EnvironmentMap, direction_of};
use std::f64::consts::PI;

const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// Integral of a map over the sphere, as the renderer reads it.
fn integral(image: &Image) -> DVec3 {
    let map = EnvironmentMap::new(image.width, image.height, image.pixels.clone());
    4.0 * PI * map.expect("a map").average().as_dvec3()
}

/// However small the disk is against a texel, and wherever it stands: at the zenith, over the seam, in
/// between. The maps are `f32`, the sky and the disk are added in them.
#[test]
fn the_sun_has_its_irradiance_at_every_resolution() {
    for width in [16, 64, 1024] {
        for (sun_elevation, sun_azimuth) in [(90.0, 0.0), (40.0, 180.0), (12.3, 77.7), (0.3, 10.0)]
        {
            let with = SkyArgs {
                width,
                sun_elevation,
                sun_azimuth,
                ground_albedo: 0.0,
                ..args()
            };
            let without = SkyArgs {
                no_sun: true,
                ..with.clone()
            };
            let sky = make(&with);
            let got = integral(&sky.image(width)) - integral(&make(&without).image(width));
            let error = (got - sky.sun).abs().max_element();
            let slack = 1e-5 * integral(&sky.image(width)).max_element();
            assert!(
                error < slack,
                "{width} {sun_elevation}: {got} is not {}",
                sky.sun
            );
        }
    }
}

/// Half of a sun on the horizon is below it.
#[test]
fn a_setting_sun_is_half_a_sun() {
    let with = SkyArgs {
        sun_elevation: 0.0,
        turbidity: 1.0,
        ground_albedo: 0.0,
        width: 2048,
        ..args()
    };
    let without = SkyArgs {
        no_sun: true,
        ..with.clone()
    };
    let sky = make(&with);
    let got = integral(&sky.image(2048)) - integral(&make(&without).image(2048));
    let share = got.x / sky.sun.x;
    assert!((share - 0.5).abs() < 0.02, "{share}");
}

#[test]
fn the_brightest_texel_is_where_the_sun_was_asked_for() {
    for (sun_elevation, sun_azimuth) in [(30.0, 0.0), (50.0, 90.0), (10.0, -90.0), (70.0, 179.0)] {
        let args = SkyArgs {
            sun_elevation,
            sun_azimuth,
            ..args()
        };
        let image = make(&args).image(256);
        let at = (0..image.pixels.len())
            .max_by(|a, b| image.pixels[*a].y.total_cmp(&image.pixels[*b].y))
            .expect("pixels") as u32;
        let u = (f64::from(at % 256) + 0.5) / 256.0;
        let v = (f64::from(at / 256) + 0.5) / 128.0;
        let expected_u = (0.5 + sun_azimuth / 360.0).rem_euclid(1.0);
        assert!((u - expected_u).abs() <= 1.0 / 256.0, "{sun_azimuth}: {u}");
        assert!((v - (90.0 - sun_elevation) / 180.0).abs() <= 1.0 / 128.0);
    }
}

/// Against what handbooks give for clear days: a sun of 80 to 105 klx and a sky of 8 to 25 klx at 60°
/// (IES Lighting Handbook; CIE S 011), a zenith of some thousand cd/m², a reddish sun at 5°.
#[test]
fn brightness_is_that_of_the_world() {
    let high = make(&SkyArgs {
        sun_elevation: 60.0,
        ..args()
    });
    let klx = |e: DVec3| 0.683 * e.dot(LUMINANCE);
    let (sun, sky) = (klx(high.sun), klx(high.from_sky));
    assert!((80.0..105.0).contains(&sun), "{sun} klx");
    assert!((8.0..25.0).contains(&sky), "{sky} klx");
    let zenith = 683.0 * high.radiance(DVec3::Y).dot(LUMINANCE);
    assert!((2000.0..15000.0).contains(&zenith), "{zenith} cd/m²");
    let blue = make(&args()).radiance(DVec3::new(0.6, 0.8, 0.0));
    assert!(blue.z > 1.3 * blue.x, "{blue}");
    let low = make(&SkyArgs {
        sun_elevation: 5.0,
        ..args()
    });
    assert!(low.sun.x > 3.0 * low.sun.z, "{}", low.sun);
    assert!(klx(low.sun) < 0.5 * sun);
    let hazy = make(&SkyArgs {
        sun_elevation: 60.0,
        turbidity: 8.0,
        ..args()
    });
    assert!(klx(hazy.sun) < 0.8 * sun && klx(hazy.from_sky) > sky);
}

#[test]
fn the_ground_reflects_its_share_and_meets_the_sky_at_the_horizon() {
    let sky = make(&args());
    let light = sky.from_sky + sky.sun * sky.to_sun.y;
    assert!((sky.ground - 0.3 / PI * light).abs().max_element() < 1e-9);
    let below = sky.radiance(DVec3::NEG_Y);
    assert!((below / sky.ground - 1.0).abs().max_element() < 0.02);
    for k in 0..16 {
        let (sin, cos) = (0.4 * f64::from(k)).sin_cos();
        let at = |y: f64| sky.radiance(DVec3::new(sin, y, cos).normalize());
        let step = (at(1e-7) / at(-1e-7) - 1.0).abs().max_element();
        assert!(step < 0.01, "{k}: {step}");
    }
    // The irradiance that lights it is that of the map's upper half.
    let upper = SkyArgs {
        ground_albedo: 0.0,
        no_sun: true,
        ..args()
    };
    let sky = make(&upper);
    let image = sky.image(256);
    let mut sum = DVec3::ZERO;
    for (i, pixel) in image.pixels.iter().enumerate().take(256 * 64) {
        let v = ((i / 256) as f64 + 0.5) / 128.0;
        let d: [f64; 3] = direction_of([0.5, v]);
        sum += pixel.as_dvec3() * d[1] * (PI * v).sin() * 2.0 * PI * PI / (256.0 * 128.0);
    }
    assert!(
        (sum / sky.from_sky - 1.0).abs().max_element() < 0.01,
        "{sum} {}",
        sky.from_sky
    );
}

#[test]
fn no_argument_makes_a_texel_that_is_no_radiance() {
    for sun_elevation in [0.0, 0.1, 3.0, 45.0, 90.0] {
        for turbidity in [1.0, 1.7, 10.0] {
            for ground_albedo in [0.0, 1.0] {
                let image = make(&SkyArgs {
                    sun_elevation,
                    turbidity,
                    ground_albedo,
                    width: 64,
                    ..args()
                })
                .image(64);
                let map = EnvironmentMap::new(64, 32, image.pixels);
                assert!(map.is_ok(), "{sun_elevation} {turbidity}: {map:?}");
            }
        }
    }
}

#[test]
fn arguments_out_of_range_are_named() {
    let cases: [(SkyArgs, &str); 6] = [
        (
            SkyArgs {
                sun_elevation: -1.0,
                ..args()
            },
            "--sun-elevation -1: it must be from 0 to 90",
        ),
        (
            SkyArgs {
                sun_azimuth: f64::NAN,
                ..args()
            },
            "--sun-azimuth NaN: it must be from -360 to 360",
        ),
        (
            SkyArgs {
                turbidity: 11.0,
                ..args()
            },
            "--turbidity 11: it must be from 1 to 10",
        ),
        (
            SkyArgs {
                ground_albedo: 1.5,
                ..args()
            },
            "--ground-albedo 1.5: it must be from 0 to 1",
        ),
        (
            SkyArgs { width: 2, ..args() },
            "--width 2: it must be from 16 to 16384",
        ),
        (
            SkyArgs {
                width: 101,
                ..args()
            },
            "--width 101: it must be even",
        ),
    ];
    for (args, wanted) in cases {
        let error = Sky::new(&args).err().expect("refused");
        assert_eq!(error.to_string(), wanted);
    }
}
