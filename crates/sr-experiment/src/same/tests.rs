//! Simulations of pictures whose truth is known.

use super::*;
use crate::Scale;
use glam::Vec3;
use sr_stats::SplitMix;

const SIZE: (u32, u32) = (64, 48);

/// A ramp with a black corner.
fn truth(x: u32, y: u32) -> f64 {
    if x < 8 && y < 8 {
        0.0
    } else {
        0.2 + 0.02 * f64::from(x)
    }
}

fn make(at: &mut dyn FnMut(u32, u32) -> Vec3) -> Image {
    let mut image = Image::filled(SIZE.0, SIZE.1, Vec3::ZERO);
    for (i, p) in image.pixels.iter_mut().enumerate() {
        *p = at(i as u32 % SIZE.0, i as u32 / SIZE.0);
    }
    image
}

/// The mean of `n` samples of a pixel and its estimated variance, from exponentially distributed
/// samples, whose tails are those of a diffuse scene; `shift` changes the truth.
fn render(n: u32, shift: &dyn Fn(u32, u32) -> f64, random: &mut SplitMix) -> (Image, Image) {
    let mut variance = Image::filled(SIZE.0, SIZE.1, Vec3::ZERO);
    let image = make(&mut |x, y| {
        let scale = truth(x, y) * (1.0 + shift(x, y));
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let v = -scale * (-random.uniform()).ln_1p();
            sum += v;
            squares += v * v;
        }
        let n = f64::from(n);
        let v = (squares - sum * sum / n) / (n - 1.0) / n;
        variance.pixels[(y * SIZE.0 + x) as usize] = Vec3::splat(v as f32);
        Vec3::splat((sum / n) as f32)
    });
    (image, variance)
}

fn by_variance(a: &(Image, Image), b: &(Image, Image)) -> Verdict {
    let [a, b] = [a, b].map(|(image, variance_of_mean)| Side {
        image,
        variance_of_mean,
    });
    same(a, b, &Settings::default()).unwrap()
}

fn seeds(a: &[Image], b: &[Image]) -> Answer {
    same(a, b, &Settings::default()).unwrap().answer
}

fn nothing(_: u32, _: u32) -> f64 {
    0.0
}

/// 200 pairs of equal expectation at a false-alarm rate of 1 %, with 16 and with 4 against 64
/// samples: 2 alarms are expected, more than 8 by chance in 2·10⁻⁴.
#[test]
fn equal_pictures_are_called_the_same() {
    let mut random = SplitMix::new(1);
    for samples in [(16, 16), (4, 64)] {
        let mut alarms = 0;
        for _ in 0..200 {
            let a = render(samples.0, &nothing, &mut random);
            let b = render(samples.1, &nothing, &mut random);
            alarms += u32::from(by_variance(&a, &b).answer != Answer::Same);
        }
        assert!(alarms <= 8, "{samples:?}: {alarms}");
    }
}

/// A hundredth too bright: the picture's mean is known to 1/√(64·48·16) = 0.45 % and the difference
/// to 0.64 %, so not with 16 samples, but with 256 (6σ).
#[test]
fn too_much_light_everywhere_is_found_in_the_mean() {
    let mut random = SplitMix::new(2);
    let a = render(256, &|_, _| 0.01, &mut random);
    let verdict = by_variance(&a, &render(256, &nothing, &mut random));
    assert!(
        verdict.answer == Answer::Different && !verdict.mean.passed,
        "{verdict:?}"
    );
    let m = &verdict.mean_difference[0];
    assert!((m.difference / m.b - 0.01).abs() < m.half_width / m.b * 2.0);
    assert!(verdict.describe().starts_with("DIFFERENT"));
}

/// One tile, 20 % brighter: 10 of its standard errors. The map shows it and nothing else in full
/// colour.
#[test]
fn a_wrong_tile_is_found_where_it_is() {
    let mut random = SplitMix::new(3);
    let wrong = |x: u32, y: u32| if x / 8 == 5 && y / 8 == 2 { 0.2 } else { 0.0 };
    let a = render(64, &wrong, &mut random);
    let verdict = by_variance(&a, &render(64, &nothing, &mut random));
    assert!(verdict.answer == Answer::Different && !verdict.tiles.passed);
    assert_eq!((verdict.worst[0].x, verdict.worst[0].y), (40, 16));
    assert_eq!(verdict.different_tiles, 1);
    let (map, picture) = (verdict.map(), verdict.picture());
    let at = |x: usize, y: usize| y * SIZE.0 as usize + x;
    assert!(map.values[at(44, 20)] > 5.0 && map.values[at(39, 20)] < 5.0);
    let full = Scale::Diverging(1.0).colour(1.0);
    let shown: Vec<usize> = (0..picture.pixels.len())
        .filter(|&i| picture.pixels[i] == full)
        .collect();
    assert_eq!((shown.len(), shown[0]), (64, at(40, 16)));
    assert!(
        verdict.describe().contains("at (40, 16)"),
        "{}",
        verdict.describe()
    );
}

/// Up and down by 5 % from tile to tile: 2.3 standard errors each, which no tile proves among 48·3
/// and the mean does not see.
#[test]
fn many_small_differences_are_found_in_the_distribution() {
    let mut random = SplitMix::new(4);
    let wavy = |x: u32, y: u32| 0.05 * (f64::from((x / 8 + y / 8) % 2) * 2.0 - 1.0);
    let a = render(64, &wavy, &mut random);
    let verdict = by_variance(&a, &render(64, &nothing, &mut random));
    assert!(
        verdict.answer == Answer::Different && !verdict.distribution.passed,
        "{verdict:?}"
    );
    assert!(verdict.p_histogram[0] > 40, "{verdict:?}");
}

/// 300 pairs of 3 against 5 seeds at 1 %: 3 alarms are expected, more than 10 by chance in 3·10⁻⁴.
/// Pixels share half of their noise in blocks of 4 × 4, which the variance of pixels would not
/// know.
#[test]
fn several_seeds_need_no_independent_pixels() {
    let mut random = SplitMix::new(5);
    let mut picture = |gain: f64| {
        let blocks: Vec<f64> = (0..16 * 12).map(|_| random.normal()).collect();
        make(&mut |x, y| {
            let shared = blocks[(y / 4 * 16 + x / 4) as usize];
            let v = truth(x, y) * gain * (1.0 + 0.05 * (shared + random.normal()));
            Vec3::splat(v as f32)
        })
    };
    let mut alarms = 0;
    for _ in 0..300 {
        let a: Vec<Image> = (0..3).map(|_| picture(1.0)).collect();
        let b: Vec<Image> = (0..5).map(|_| picture(1.0)).collect();
        alarms += u32::from(seeds(&a, &b) != Answer::Same);
    }
    assert!(alarms <= 10, "{alarms}");
    let a: Vec<Image> = (0..4).map(|_| picture(1.1)).collect();
    let b: Vec<Image> = (0..4).map(|_| picture(1.0)).collect();
    assert_eq!(seeds(&a, &b), Answer::Different);
}

/// Rare paths, one in 2000 samples, a thousand times as bright: 4 samples a pixel have met 20 in
/// the picture, 64 have met 16 times as many. 100 pairs at 1 %: 1 alarm is expected, more than 5 by
/// chance in 5·10⁻⁴.
#[test]
fn rare_bright_paths_seldom_raise_a_false_alarm() {
    let mut random = SplitMix::new(6);
    let mut rare = |n: u32| {
        let (image, mut variance) = render(n, &nothing, &mut random);
        let mut picture = image;
        for (p, v) in picture.pixels.iter_mut().zip(&mut variance.pixels) {
            let hits = (0..n).filter(|_| random.uniform() < 1.0 / 2000.0).count() as f32;
            let n = n as f32;
            *p += Vec3::splat(1000.0 * hits / n);
            *v += Vec3::splat(1e6 * (hits - hits * hits / n).max(0.0) / (n - 1.0) / n);
        }
        (picture, variance)
    };
    let (mut alarms, mut heavy) = (0, 0);
    for _ in 0..100 {
        let verdict = by_variance(&rare(4), &rare(64));
        alarms += u32::from(verdict.answer != Answer::Same);
        heavy += verdict.heavy_tiles;
    }
    assert!(heavy > 100, "{heavy}");
    assert!(alarms <= 5, "{alarms}");
}

#[test]
fn what_has_no_noise_is_equal_or_not() {
    let flat = |v: f32| {
        (
            Image::filled(16, 16, Vec3::splat(v)),
            Image::filled(16, 16, Vec3::ZERO),
        )
    };
    let verdict = by_variance(&flat(0.3), &flat(0.3));
    assert!(verdict.answer == Answer::Same && verdict.describe().starts_with("THE SAME"));
    assert_eq!(
        by_variance(&flat(0.3), &flat(0.300_1)).answer,
        Answer::Different
    );
    // The same number in half precision, which has only that many digits.
    let half = 0.300_048_83;
    assert_eq!(by_variance(&flat(half), &flat(0.3)).answer, Answer::Same);
}

#[test]
fn what_cannot_be_judged_is_refused_in_words() {
    let image = |w, v| Image::filled(w, 4, Vec3::splat(v));
    let ask = |a: &Image, v: &Image, b: &Image| {
        let side = |image, variance_of_mean| Side {
            image,
            variance_of_mean,
        };
        let known = Image::filled(b.width, b.height, Vec3::ONE);
        same(side(a, v), side(b, &known), &Settings::default())
            .unwrap_err()
            .to_string()
    };
    let one = image(4, 1.0);
    assert!(ask(&one, &one, &image(5, 1.0)).contains("4 × 4 pixels, the other 5 × 4"));
    let mut bad = one.clone();
    bad.pixels[6] = Vec3::NAN;
    assert!(ask(&bad, &one, &one).contains("1 pixels are not finite, the first at (2, 1)"));
    let unknown = image(4, f32::INFINITY);
    assert!(ask(&one, &unknown, &one).contains("16 pixels is not known"));
    let few = same(
        std::slice::from_ref(&one),
        [one.clone(), one.clone()].as_slice(),
        &Settings::default(),
    );
    assert_eq!(few.unwrap_err(), SameError::TooFewPictures(1));
}

/// As of a small lamp that directions find by chance: a share of 1/400 of the samples holds half of the light.
/// With 16 samples a tile meets it 2.6 times, and one in 14 never. Against the truth with little noise, 100
/// pairs: none may be called different with confidence (with an alarm rate of 1 %, 6 or more happen by
/// chance in 5·10⁻⁴), where p-values alone accuse most.
#[test]
fn what_rare_bright_samples_have_missed_is_no_difference() {
    let mut random = SplitMix::new(6);
    let mut render = |n: u32, rare: f64| {
        let mut variance = Image::filled(SIZE.0, SIZE.1, Vec3::ZERO);
        let image = make(&mut |x, y| {
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..n {
                let bright = if random.uniform() < rare {
                    0.5 / rare
                } else {
                    0.0
                };
                let v = 0.5 * (0.9 + 0.2 * random.uniform()) + bright;
                sum += v;
                squares += v * v;
            }
            let n = f64::from(n);
            let v = (squares - sum * sum / n) / (n - 1.0) / n;
            variance.pixels[(y * SIZE.0 + x) as usize] = Vec3::splat(v as f32);
            Vec3::splat((sum / n) as f32)
        });
        (image, variance)
    };
    let (mut accused, mut unclear) = (0, 0);
    for _ in 0..100 {
        let verdict = by_variance(&render(16, 0.0025), &render(16, 0.9));
        accused += u32::from(verdict.answer == Answer::Different);
        unclear += u32::from(verdict.answer == Answer::Unclear);
    }
    assert!(accused <= 5, "{accused} accused, {unclear} unclear");
    assert!(unclear >= 50, "{accused} accused, {unclear} unclear");
}
