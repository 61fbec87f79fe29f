//! From sums to a picture and its variance.
//!
//! The mean of a pixel is the sum of its accepted samples over their number, plus the sum of its
//! splats over the number of samples splatted. With [adaptive sampling](crate::adaptive) it is the
//! mean of the means of the replicas, all with the same weight.

use crate::{FilmSpec, FilmTile, Image, Layer, Rect, Splats};
use glam::{DVec3, Vec3};

/// How the variance of a pixel's mean is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VarianceEstimator {
    /// From the sum of squares: Σ(x − x̄)² / (n (n − 1)). Unbiased when the samples of a pixel are
    /// independent and identically distributed, too large when they are better spread than that.
    /// Cancellation leaves an error of about 10⁻¹⁶ x̄² / n. Films with splats cannot use it, since a
    /// splat does not know the other splats of its sample: they fall back on [`Self::Replicas`].
    Samples,
    /// From the spread of the replica means mᵣ of nᵣ samples: Σ nᵣ (mᵣ − m)² / (n (R − 1)).
    /// Unbiased for any kind of sampling as long as each replica (the samples whose index has the
    /// same remainder by R) is randomised independently of the others: a sampler of low discrepancy
    /// must give each replica a sequence of its own. Noisy per pixel: with R − 1 degrees of freedom
    /// its relative standard deviation is √(2/(R − 1)); use it averaged over pixels.
    Replicas,
}

/// A layer of a resolved film.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerImage {
    /// Which one.
    pub layer: Layer,
    /// One plane per channel, in the order of [`Layer::channel_names`], row-major.
    pub planes: Vec<Vec<f32>>,
}

/// A resolved film: the pixels of the crop, row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmImage {
    /// Width of the crop.
    pub width: u32,
    /// Height of the crop.
    pub height: u32,
    /// Where the crop lies in the picture.
    pub crop: Rect,
    /// Width and height of the whole picture.
    pub picture: (u32, u32),
    /// Mean radiance; 0 where no sample was accepted.
    pub rgb: Image,
    /// Estimated variance of `rgb`, that is of the mean; infinite where it is not known (fewer than
    /// two samples, or two replicas with samples).
    pub variance_of_mean: Image,
    /// The estimator that was used.
    pub estimator: VarianceEstimator,
    /// Accepted samples, or where the tile got none, samples splatted. With adaptive sampling some
    /// of them are not in the mean.
    pub sample_count: Vec<u32>,
    /// The layers asked for.
    pub layers: Vec<LayerImage>,
}

pub(crate) fn resolve(
    spec: &FilmSpec,
    tiles: &[FilmTile],
    splats: &Splats,
    estimator: VarianceEstimator,
) -> FilmImage {
    let (width, height) = (spec.crop.width(), spec.crop.height());
    let count = spec.crop.pixel_count() as usize;
    let estimator = if splats.is_on() {
        VarianceEstimator::Replicas
    } else {
        estimator
    };
    let mut image = FilmImage {
        width,
        height,
        crop: spec.crop,
        picture: (spec.width, spec.height),
        rgb: Image::filled(width, height, Vec3::ZERO),
        variance_of_mean: Image::filled(width, height, Vec3::ZERO),
        estimator,
        sample_count: vec![0; count],
        layers: spec
            .layers
            .iter()
            .map(|&layer| LayerImage {
                layer,
                planes: vec![vec![0.0; count]; layer.channel_names().len()],
            })
            .collect(),
    };
    for tile in tiles {
        for p in 0..tile.pixel_count() {
            let (x, y) = tile.pixel(p);
            if !spec.crop.contains(x, y) {
                continue;
            }
            let at = spec.crop.index(x, y);
            let pixel = PixelSums {
                equal_weights: spec.adaptive.is_some(),
                ..PixelSums::gather(tile, splats, p, at)
            };
            let mean = pixel.mean();
            image.rgb.pixels[at] = to_f32(mean);
            image.variance_of_mean.pixels[at] = match estimator {
                VarianceEstimator::Samples => pixel.variance_from_squares(tile.squares(p)),
                VarianceEstimator::Replicas => pixel.variance_from_replicas(mean),
            }
            .map_or(Vec3::INFINITY, to_f32);
            let samples = match tile.sample_count(p) {
                0 => pixel.splat_total.1,
                n => n,
            };
            image.sample_count[at] = u32::try_from(samples).unwrap_or(u32::MAX);
            for (i, layer) in image.layers.iter_mut().enumerate() {
                let value = tile.layer_value(i, p).to_array();
                for (plane, v) in layer.planes.iter_mut().zip(value) {
                    plane[at] = v;
                }
            }
        }
    }
    image
}

/// What is known of a pixel: per replica, and over them (always added in the replicas' order).
struct PixelSums {
    camera: [(DVec3, u64); 16],
    splats: [(DVec3, u64); 16],
    camera_total: (DVec3, u64),
    splat_total: (DVec3, u64),
    /// Replicas count the same however many samples they have.
    equal_weights: bool,
}

impl PixelSums {
    fn gather(tile: &FilmTile, splats: &Splats, in_tile: usize, in_crop: usize) -> Self {
        let fill = |values: &mut dyn Iterator<Item = (DVec3, u64)>| {
            let mut all = [(DVec3::ZERO, 0); 16];
            let mut total = (DVec3::ZERO, 0);
            for (slot, (sum, n)) in all.iter_mut().zip(values) {
                *slot = (sum, n);
                total = (total.0 + sum, total.1 + n);
            }
            (all, total)
        };
        let (camera, camera_total) = fill(&mut tile.replica_sums(in_tile));
        let (splats, splat_total) = fill(&mut splats.replica_sums(in_crop));
        Self {
            camera,
            splats,
            camera_total,
            splat_total,
            equal_weights: false,
        }
    }

    fn mean(&self) -> DVec3 {
        if self.equal_weights {
            let used = self.used_replicas();
            let sum = used.clone().fold(DVec3::ZERO, |sum, r| sum + ratio(r));
            return ratio((sum, used.count() as u64));
        }
        ratio(self.camera_total) + ratio(self.splat_total)
    }

    /// The replicas that have samples.
    fn used_replicas(&self) -> impl Iterator<Item = (DVec3, u64)> + Clone {
        self.camera.into_iter().filter(|r| r.1 > 0)
    }

    /// As [`VarianceEstimator::Samples`], but with spreads around the replicas' means, since the
    /// mean of all is not theirs, and with a share of σ²/nᵣ from each.
    fn variance_within_replicas(&self, squares: DVec3) -> Option<DVec3> {
        let (mut between, mut parts, mut used) = (DVec3::ZERO, 0.0, 0.0);
        for (sum, count) in self.used_replicas() {
            let n = count as f64;
            between += sum * sum / n;
            parts += 1.0 / n;
            used += 1.0;
        }
        let freedom = self.camera_total.1 as f64 - used;
        (freedom > 0.0)
            .then(|| (squares - between).max(DVec3::ZERO) / freedom * (parts / (used * used)))
    }

    fn variance_from_squares(&self, squares: DVec3) -> Option<DVec3> {
        if self.equal_weights {
            return self.variance_within_replicas(squares);
        }
        let (sum, count) = self.camera_total;
        let n = count as f64;
        // Rounding may leave the difference of two equal numbers below zero.
        (count >= 2).then(|| (squares - sum * sum / n).max(DVec3::ZERO) / (n - 1.0) / n)
    }

    fn variance_from_replicas(&self, mean: DVec3) -> Option<DVec3> {
        let (with_camera, with_splats) = (self.camera_total.1 > 0, self.splat_total.1 > 0);
        let (mut spread, mut weight, mut used) = (DVec3::ZERO, 0.0, 0.0);
        for (&camera, &splat) in self.camera.iter().zip(&self.splats) {
            // A replica that lacks one of the two parts estimates something else.
            if (with_camera && camera.1 == 0) || (with_splats && splat.1 == 0) {
                continue;
            }
            let n = match (self.equal_weights, with_camera) {
                (true, _) => 1.0,
                (false, true) => camera.1 as f64,
                (false, false) => splat.1 as f64,
            };
            let off = ratio(camera) + ratio(splat) - mean;
            if n > 0.0 {
                spread += n * off * off;
                weight += n;
                used += 1.0;
            }
        }
        (used >= 2.0).then(|| spread / (weight * (used - 1.0)))
    }
}

fn ratio((sum, n): (DVec3, u64)) -> DVec3 {
    if n == 0 { DVec3::ZERO } else { sum / n as f64 }
}

/// A variance may pass the largest float though the samples did not; infinity means "not known".
fn to_f32(v: DVec3) -> Vec3 {
    v.min(DVec3::splat(f64::from(f32::MAX))).as_vec3()
}
