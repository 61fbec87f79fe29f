//! Noise and bias apart, from pictures that differ in their seeds only.

use glam::{DVec3, Vec3};
use serde::Serialize;
use sr_film::{Image, RELMSE_OFFSET};
use std::fmt;

/// Why noise cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseError {
    /// It takes two pictures.
    TooFewPictures,
    /// Pictures differ in size.
    SizesDiffer,
    /// Some pixels are not finite, so many of all pictures together.
    NotFinite(u64),
}

impl fmt::Display for NoiseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewPictures => f.write_str("it takes two pictures with different seeds"),
            Self::SizesDiffer => f.write_str("the pictures differ in size"),
            Self::NotFinite(n) => write!(f, "{n} pixels are not finite"),
        }
    }
}

impl std::error::Error for NoiseError {}

/// What several pictures say of their noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Mean of all.
    pub mean: Image,
    /// Sample variance Σ(x − x̄)²/(K − 1) of each pixel and channel: of one picture, not of the
    /// mean.
    pub variance: Image,
    /// Mean of the variance: an unbiased estimate of a single picture's MSE, if the method is
    /// unbiased.
    pub mse: f64,
    /// Mean of variance/(mean² + 0.01): its relMSE by plug-in of the mean, off by a relative
    /// O(variance/K).
    pub relmse: f64,
}

/// The noise of one of several pictures.
///
/// # Errors
/// Fewer than two pictures, different sizes, or pixels that are not finite.
pub fn noise(images: &[Image]) -> Result<Noise, NoiseError> {
    let [first, _, ..] = images else {
        return Err(NoiseError::TooFewPictures);
    };
    check(images.iter(), first)?;
    let n = images.len() as f64;
    let mut mean = Image::filled(first.width, first.height, Vec3::ZERO);
    let mut variance = mean.clone();
    let (mut mse, mut relmse) = (0.0, 0.0);
    for i in 0..first.pixels.len() {
        let value = |image: &Image| image.pixels[i].as_dvec3();
        let m = images.iter().map(value).sum::<DVec3>() / n;
        let off = |image: &Image| (value(image) - m) * (value(image) - m);
        let v = images.iter().map(off).sum::<DVec3>() / (n - 1.0);
        mse += v.element_sum();
        relmse += (v / (m * m + RELMSE_OFFSET)).element_sum();
        mean.pixels[i] = m.as_vec3();
        variance.pixels[i] = v.as_vec3();
    }
    let values = 3.0 * first.pixels.len() as f64;
    Ok(Noise {
        mean,
        variance,
        mse: mse / values,
        relmse: relmse / values,
    })
}

/// Mean over pixels and channels of a variance, which is the MSE of an unbiased picture with that
/// variance of its mean; `None` if it is not known everywhere.
pub fn mean_variance(variance: &Image) -> Option<f64> {
    let sum: f64 = variance
        .pixels
        .iter()
        .map(|v| v.as_dvec3().element_sum())
        .sum();
    let known = variance
        .pixels
        .iter()
        .all(|v| v.is_finite() && v.min_element() >= 0.0);
    (known && !variance.pixels.is_empty()).then(|| sum / (3.0 * variance.pixels.len() as f64))
}

/// The mean squared error of one of several pictures, in its parts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Split {
    /// Noise: the mean variance of one picture.
    pub noise: f64,
    /// Squared bias: the mean of (x̄ − r)² less what noise of x̄ and r make of it. Unbiased itself,
    /// so below 0 about half of the time when there is no bias.
    pub squared_bias: f64,
}

/// Tells noise from bias: `images` differ in their seeds only, `variance` is that of the
/// reference's mean, if known; without it the reference's noise counts as bias.
///
/// # Errors
/// As [`noise`].
pub fn split(
    images: &[Image],
    reference: &Image,
    variance: Option<&Image>,
) -> Result<Split, NoiseError> {
    let found = noise(images)?;
    check([reference].into_iter().chain(variance), &found.mean)?;
    let both = found.mean.pixels.iter().zip(&reference.pixels);
    let sum: f64 = both
        .map(|(x, r)| (x.as_dvec3() - r.as_dvec3()).length_squared())
        .sum();
    let measured = sum / (3.0 * reference.pixels.len() as f64);
    let own = variance.and_then(mean_variance).unwrap_or(0.0);
    Ok(Split {
        noise: found.mse,
        squared_bias: measured - found.mse / images.len() as f64 - own,
    })
}

fn check<'a>(images: impl Iterator<Item = &'a Image>, as_: &Image) -> Result<(), NoiseError> {
    let mut bad = 0;
    for image in images {
        if (image.width, image.height) != (as_.width, as_.height) {
            return Err(NoiseError::SizesDiffer);
        }
        bad += image.pixels.iter().filter(|p| !p.is_finite()).count() as u64;
    }
    if bad > 0 {
        return Err(NoiseError::NotFinite(bad));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_stats::SplitMix;

    /// Pictures of truth 0.5 with noise of variance 0.04 and an offset.
    fn picture(offset: f64, random: &mut SplitMix) -> Image {
        let mut image = Image::filled(64, 64, Vec3::ZERO);
        for p in &mut image.pixels {
            *p = Vec3::from_array([0; 3].map(|_| (0.5 + offset + 0.2 * random.normal()) as f32));
        }
        image
    }

    /// 4 pictures of 12,288 values: the mean variance has a relative σ of √(2/(3·12288)) = 0.74 %;
    /// the bound is 4σ. The squared bias of 0.1, 0.01, has σ = 2·0.1·0.1/√12288 = 1.8·10⁻⁴, the one
    /// of none 1.3·10⁻⁴.
    #[test]
    fn noise_and_bias_are_told_apart() {
        let mut random = SplitMix::new(8);
        let truth = Image::filled(64, 64, Vec3::splat(0.5));
        for offset in [0.0, 0.1] {
            let images: Vec<Image> = (0..4).map(|_| picture(offset, &mut random)).collect();
            let found = split(&images, &truth, None).unwrap();
            assert!((found.noise / 0.04 - 1.0).abs() < 0.03, "{found:?}");
            assert!(
                (found.squared_bias - offset * offset).abs() < 8e-4,
                "{found:?}"
            );
            // The reference's own noise, 0.04, is taken off.
            let reference = picture(0.0, &mut random);
            let variance = Image::filled(64, 64, Vec3::splat(0.04));
            let found = split(&images, &reference, Some(&variance)).unwrap();
            assert!(
                (found.squared_bias - offset * offset).abs() < 3e-3,
                "{found:?}"
            );
        }
    }

    #[test]
    fn by_hand() {
        let image = |v: f32| Image::filled(1, 1, Vec3::splat(v));
        let found = noise(&[image(1.0), image(3.0)]).unwrap();
        assert_eq!((found.mse, found.mean.pixels[0].x), (2.0, 2.0));
        assert!((found.relmse - 2.0 / 4.01).abs() < 1e-15);
        assert_eq!(mean_variance(&found.variance), Some(2.0));
        assert_eq!(mean_variance(&image(f32::INFINITY)), None);
        assert_eq!(noise(&[image(1.0)]), Err(NoiseError::TooFewPictures));
        let wide = Image::filled(2, 1, Vec3::ONE);
        assert_eq!(noise(&[image(1.0), wide]), Err(NoiseError::SizesDiffer));
        assert_eq!(
            noise(&[image(1.0), image(f32::NAN)]),
            Err(NoiseError::NotFinite(1))
        );
    }
}
