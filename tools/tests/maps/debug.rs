//! The picture shows the density that the samples have.

use glam::Vec3;
use sr_light::EnvironmentMap;
use sr_tools::envmap_debug::draw;

fn map(hot: Option<usize>) -> EnvironmentMap {
    let mut rgb = vec![Vec3::ONE; 32 * 16];
    if let Some(hot) = hot {
        rgb[hot] = Vec3::splat(1e6);
    }
    EnvironmentMap::new(32, 16, rgb).expect("a map")
}

/// Grey d/(1 + d) of sin θ over its mean, 2/π, to a code.
#[test]
fn an_even_map_is_drawn_as_the_sine_of_its_rows() {
    let picture = draw(&map(None), 64, 0, 0).expect("light");
    for y in 0..32 {
        let d = (std::f64::consts::PI * (f64::from(y) + 0.5) / 32.0).sin()
            * std::f64::consts::FRAC_PI_2;
        let grey = 255.0 * d / (1.0 + d);
        for x in 0..64 {
            let got = picture.pixels[(y * 64 + x) as usize];
            assert!(got[0] == got[1] && got[1] == got[2]);
            assert!(
                (f64::from(got[0]) - grey).abs() < 1.5,
                "{y}: {got:?} {grey}"
            );
        }
    }
}

#[test]
fn samples_crowd_where_the_density_is() {
    let picture = draw(&map(Some(5 * 32 + 20)), 64, 500, 7).expect("light");
    // One sample in 2000 falls elsewhere; three of 500 by a chance of 0.2 %, and the seed is fixed.
    let (mut points, mut strays) = (0, 0);
    for (i, pixel) in picture.pixels.iter().enumerate() {
        if pixel[0] != pixel[1] {
            let (x, y) = (i % 64, i / 64);
            // Texel 20, 5 lies at pixels 40 and 10; its slopes end a texel away, a point is three wide.
            if x.abs_diff(40) < 5 && y.abs_diff(10) < 5 {
                points += 1;
            } else {
                strays += 1;
            }
        }
    }
    assert!(points > 10 && strays <= 2 * 5, "{points} {strays}");
    assert_eq!(Some(picture), draw(&map(Some(5 * 32 + 20)), 64, 500, 7));
}

#[test]
fn a_black_map_has_no_picture() {
    let black = EnvironmentMap::new(4, 2, vec![Vec3::ZERO; 8]).expect("a map");
    assert!(draw(&black, 64, 10, 0).is_none());
}
