//! `sample_li` against `pdf_li`, and both against the definition of the map.

use super::*;
use glam::DVec3;
use sr_light::{BadTexels, MapError};
use sr_stats::{chi2_test, sidak};

const SAMPLES: u32 = 100_000;

/// The samples fall where the bilinear luminance of the oracle says, bin by bin of half a texel, which
/// knows nothing of cells. 20 cases share a false-alarm rate of 10⁻⁴. A density wrong by 3 % over half of
/// the sphere is found in each; broken by hand, exchanging the two weights of a row or leaving the polar
/// caps out of the table fails it.
#[test]
fn samples_are_distributed_as_the_luminance_of_the_map() {
    for (name, o) in maps() {
        for to_map in [Mat3::IDENTITY, turned()] {
            let light = light(&o, to_map, EnvironmentSampling::Importance);
            let weights = o.integrate(|place, _| o.luminance(place));
            let total: f64 = weights.iter().sum();
            let mut counts = vec![0u64; weights.len()];
            let mut failed = 0;
            for i in 0..SAMPLES {
                let Some(s) = light.sample_li(Vec3::ZERO, u(i)) else {
                    failed += 1;
                    continue;
                };
                assert_eq!(s.pdf, light.pdf_li(Vec3::ZERO, s.wi, s.dist, s.ng));
                assert_eq!(s.radiance, light.le_environment(s.wi));
                assert!((s.wi.length() - 1.0).abs() < 5e-7);
                counts[o.bin((to_map * s.wi).as_dvec3())] += 1;
            }
            assert!(failed < 3, "{name}: {failed} samples without density");
            let samples = f64::from(SAMPLES);
            let expected: Vec<f64> = weights.iter().map(|w| w / total * samples).collect();
            // Rounding may carry a sample over the edge of a black bin.
            let lost: u64 = (counts.iter().zip(&expected))
                .filter(|(_, e)| **e == 0.0)
                .map(|(c, _)| c)
                .sum();
            assert!(lost < 3, "{name}: {lost} samples where all is black");
            for (count, _) in counts.iter_mut().zip(&expected).filter(|(_, e)| **e == 0.0) {
                *count = 0;
            }
            let p_value = chi2_test(&counts, &expected, 5.0).p_value;
            assert!(p_value > sidak(1e-4, 20), "{name}: {p_value}");
        }
    }
}

/// The density is the luminance over its integral, up to the poles and across the seam, and so
/// integrates to 1. The bound is relative to the steepest texel around: the place of a direction is known
/// to a few ulp.
#[test]
fn the_density_is_that_of_the_definition_everywhere() {
    for (name, o) in maps() {
        let light = light(&o, Mat3::IDENTITY, EnvironmentSampling::Importance);
        let total: f64 = o.integrate(|place, _| o.luminance(place)).iter().sum();
        let pdf =
            |d: DVec3| f64::from(light.pdf_li(Vec3::ZERO, d.as_vec3(), f32::INFINITY, Vec3::X));
        let sum: f64 = o.integrate(|_, d| pdf(d)).iter().sum();
        assert!((sum - 1.0).abs() < 2e-6, "{name}: {sum}");
        let brightest = o.rgb.iter().fold(0.0f32, |m, c| m.max(c.max_element()));
        let slack = 1e-5 * f64::from(brightest) / total;
        for i in 0..2000 {
            let near = f64::from(numbers(i, 3)).powi(4);
            let (a, b) = (f64::from(numbers(i, 4)), f64::from(numbers(i, 5)));
            // Anywhere, near either pole, near the seam.
            for place in [
                [a, b],
                [a, 1e-3 * near],
                [a, 1.0 - 1e-3 * near],
                [near, b],
                [1.0 - near, b],
            ] {
                let d = oracle::direction(place);
                let exact = o.luminance(oracle::place(d.as_vec3().as_dvec3())) / total;
                let error = (pdf(d) - exact).abs();
                assert!(
                    error < slack + 1e-6 * exact,
                    "{name} {place:?}: {error} of {exact}"
                );
            }
        }
    }
}

#[test]
fn uniform_sampling_is_uniform_and_sees_the_same_map() {
    let o = oracle(9, 5, noise);
    let [a, b] = [
        EnvironmentSampling::Uniform,
        EnvironmentSampling::Importance,
    ]
    .map(|sampling| light(&o, turned(), sampling));
    let mut counts = [0u64; 8];
    for i in 0..SAMPLES {
        let s = a.sample_li(Vec3::ZERO, u(i)).expect("every direction");
        assert_eq!(s.pdf, 0.25 / std::f32::consts::PI);
        assert_eq!(s.pdf, a.pdf_li(Vec3::ZERO, s.wi, s.dist, s.ng));
        assert_eq!(s.radiance, b.le_environment(s.wi));
        let octant = s.wi.to_array().map(|c| usize::from(c > 0.0));
        counts[octant[0] + 2 * octant[1] + 4 * octant[2]] += 1;
    }
    let expected = [f64::from(SAMPLES) / 8.0; 8];
    assert!(chi2_test(&counts, &expected, 5.0).p_value > 1e-4);
}

#[test]
fn a_black_map_gives_nothing_and_is_never_divided_by() {
    let o = oracle(4, 2, |_, _| Vec3::ZERO);
    let light = light(&o, Mat3::IDENTITY, EnvironmentSampling::Importance);
    assert_eq!(light.sample_li(Vec3::ZERO, u(1)), None);
    assert_eq!(light.sample_le(u(1), u(2), Vec3::ZERO, 1.0), None);
    assert_eq!(
        light.pdf_li(Vec3::ZERO, Vec3::Y, f32::INFINITY, Vec3::Y),
        0.0
    );
    assert_eq!(light.le_environment(Vec3::Y), Vec3::ZERO);
    assert_eq!(light.power(Vec3::ZERO, 1.0), Vec3::ZERO);
}

/// Texels at both ends of `f32`, corners of the unit square, axes: nothing is infinite or NaN.
#[test]
fn extremes_stay_finite() {
    let corner = [0.0, f32::MIN_POSITIVE, 0.5, 1.0 - f32::EPSILON / 2.0];
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let tiny = f32::from_bits(1);
    for brightest in [tiny, f32::MIN_POSITIVE, 1.0, EnvironmentMap::BRIGHTEST] {
        for other in [0.0, tiny, brightest] {
            let o = oracle(3, 2, |x, y| {
                Vec3::splat(if x == y { brightest } else { other })
            });
            let light = light(&o, Mat3::IDENTITY, EnvironmentSampling::Importance);
            for (a, b) in corner.into_iter().flat_map(|a| corner.map(|b| (a, b))) {
                if let Some(s) = light.sample_li(Vec3::ZERO, Vec2::new(a, b)) {
                    assert!(s.wi.is_finite() && s.radiance.is_finite());
                    assert!(s.pdf > 0.0 && s.pdf.is_finite());
                    assert!(s.radiance.min_element() >= 0.0);
                }
            }
            for d in axes.into_iter().flat_map(|d| [d, -d]) {
                let pdf = light.pdf_li(Vec3::ZERO, d, f32::INFINITY, d);
                assert!(pdf >= 0.0 && pdf.is_finite());
                assert!(light.le_environment(d).is_finite());
            }
        }
    }
}

#[test]
fn texels_that_are_no_radiance_are_refused_with_their_place() {
    let with = |value: f32| {
        let mut rgb = vec![Vec3::ONE; 12];
        rgb[6].y = value;
        rgb[11].z = value;
        EnvironmentMap::new(4, 3, rgb).expect_err("no radiance")
    };
    let bad = BadTexels {
        count: 2,
        first: (2, 1),
    };
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
        assert_eq!(with(value), MapError::OutOfRange(bad));
    }
    assert_eq!(with(-1e-9), MapError::Negative(bad));
    assert_eq!(
        with(-1.0).to_string(),
        "2 texels, the first at (2, 1), are negative"
    );
    for (width, height, texels) in [(0, 0, 0), (4, 0, 0), (2, 2, 3), (2, 2, 5)] {
        let map = EnvironmentMap::new(width, height, vec![Vec3::ONE; texels]);
        assert_eq!(map.err(), Some(MapError::Size));
    }
}

#[test]
fn negative_channels_are_taken_for_zero_and_told_but_no_others() {
    let mut rgb = [
        Vec3::ONE,
        Vec3::new(0.5, -2.0, 1.0),
        Vec3::NAN,
        Vec3::NEG_INFINITY,
    ];
    let bad = sr_light::clamp_negative(2, &mut rgb);
    assert_eq!(
        bad,
        Some(BadTexels {
            count: 1,
            first: (1, 0)
        })
    );
    assert_eq!(rgb[..2], [Vec3::ONE, Vec3::new(0.5, 0.0, 1.0)]);
    assert!(rgb[2].is_nan() && rgb[3] == Vec3::NEG_INFINITY);
    assert_eq!(sr_light::clamp_negative(2, &mut rgb), None);
}

/// The memory that the documentation promises: 20 bytes a texel and little else.
#[test]
fn memory_is_twenty_bytes_a_texel() {
    let map = EnvironmentMap::new(512, 256, vec![Vec3::ONE; 512 * 256]).expect("a map");
    let bytes = map.bytes() as f64 / f64::from(512 * 256);
    assert!((bytes - 20.0).abs() < 0.5, "{bytes}");
}
