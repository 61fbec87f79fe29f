//! A tile of the film: the pixels that one thread at a time adds samples to.

use crate::adaptive::Adaptive;
use crate::block_sum::{BlockSum, block_of};
use crate::clamp::ClampTile;
use crate::layer::LayerTile;
use crate::{AdaptiveReport, Criterion, FilmSpec, Layer, Rect, Reject};
use glam::{DVec3, Vec3};

/// Side of a tile in pixels. A constant, so that nothing can come to depend on it.
pub const TILE_SIZE: u32 = 16;

/// What a pixel keeps whatever its replicas.
#[derive(Clone, Copy, Default)]
struct Pixel {
    squares: BlockSum,
    /// Block of the last sample.
    block: u64,
}

/// What a pixel keeps per replica.
#[derive(Clone, Copy, Default)]
struct Replica {
    sum: BlockSum,
    accepted: u64,
}

/// The pixels of a 16 × 16 cell of the grid that starts at the picture's (0, 0), as far as they lie
/// in the crop. It owns them: no locks, and no sum that depends on threads.
pub struct FilmTile {
    rect: Rect,
    replicas: usize,
    pixels: Vec<Pixel>,
    /// The replicas of a pixel stand together.
    sums: Vec<Replica>,
    layers: Vec<LayerTile>,
    adaptive: Option<Adaptive>,
    clamp: Option<ClampTile>,
}

impl FilmTile {
    pub(crate) fn new(rect: Rect, spec: &FilmSpec) -> Self {
        let count = rect.pixel_count() as usize;
        let replicas = spec.replicas as usize;
        Self {
            rect,
            replicas,
            pixels: vec![Pixel::default(); count],
            sums: vec![Replica::default(); count * replicas],
            layers: spec
                .layers
                .iter()
                .map(|&layer| LayerTile::new(layer, count))
                .collect(),
            adaptive: spec.adaptive.map(|a| Adaptive::new(rect, a, replicas)),
            clamp: spec.clamp.map(|limit| ClampTile::new(limit, count)),
        }
    }

    /// Bytes per pixel of a tile of this specification.
    pub(crate) fn bytes_per_pixel(spec: &FilmSpec) -> usize {
        let layers: usize = spec.layers.iter().map(|l| l.bytes_per_pixel()).sum();
        let replicas = spec.replicas as usize;
        let adaptive = spec
            .adaptive
            .map_or(0, |_| Adaptive::bytes_per_pixel(replicas));
        let clamp = spec.clamp.map_or(0, |_| ClampTile::bytes_per_pixel());
        size_of::<Pixel>() + replicas * size_of::<Replica>() + layers + adaptive + clamp
    }

    /// Its pixels, in the picture's coordinates.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// How many pixels it has.
    pub fn pixel_count(&self) -> usize {
        self.pixels.len()
    }

    /// Coordinates in the picture of the `i`-th pixel, row by row.
    #[inline]
    pub fn pixel(&self, i: usize) -> (u32, u32) {
        let width = self.rect.width();
        (
            self.rect.x0 + i as u32 % width,
            self.rect.y0 + i as u32 / width,
        )
    }

    /// The pixels that want samples, in rising order: all of them, unless adaptive sampling has
    /// finished some.
    pub fn active_pixels(&self) -> Vec<usize> {
        let pixels = 0..self.pixel_count();
        match &self.adaptive {
            None => pixels.collect(),
            Some(adaptive) => pixels.filter(|p| adaptive.is_active(*p)).collect(),
        }
    }

    /// How many of them there are.
    pub(crate) fn active_count(&self) -> usize {
        match &self.adaptive {
            None => self.pixel_count(),
            Some(_) => self.active_pixels().len(),
        }
    }

    /// Ends the folds that have enough samples; nothing without adaptive sampling. Call it between
    /// passes, at sample counts that depend on no sample.
    pub fn decide(&mut self, criterion: &Criterion<'_>) {
        if let Some(adaptive) = &mut self.adaptive {
            adaptive.decide(criterion);
        }
    }

    /// Adds one sample of radiance to a pixel (row-major in [`Self::rect`]).
    ///
    /// `sample` is the sample's index within the pixel, counted over all passes. It names the
    /// replica (`sample` mod replicas) and the block of 64 whose sum it enters. The samples of a
    /// pixel come in rising order: any other order gives the same mean up to rounding, but not the
    /// same bits. Samples of a pixel that is not active are passed over. With a clamp the sample is
    /// scaled down to it before anything is made of it.
    ///
    /// # Errors
    /// A sample that is not finite or is negative is not added, and not counted as accepted.
    #[inline]
    pub fn add(&mut self, pixel: usize, sample: u64, rgb: Vec3) -> Result<(), Reject> {
        check_colour(rgb)?;
        let whole = rgb;
        let rgb = self.clamp.as_ref().map_or(rgb, |c| c.limit(rgb));
        let replica = sample as usize & (self.replicas - 1);
        if let Some(adaptive) = &mut self.adaptive
            && !adaptive.watch(pixel, replica, rgb)
        {
            return Ok(());
        }
        let p = &mut self.pixels[pixel];
        let sums = &mut self.sums[pixel * self.replicas..][..self.replicas];
        if p.block != block_of(sample) {
            p.block = block_of(sample);
            p.squares.fold();
            for r in &mut *sums {
                r.sum.fold();
            }
            if let Some(clamp) = &mut self.clamp {
                clamp.fold(pixel);
            }
        }
        if let Some(clamp) = &mut self.clamp {
            clamp.note(pixel, whole, rgb);
        }
        let value = rgb.as_dvec3();
        p.squares.add(value * value);
        let replica = &mut sums[replica];
        replica.sum.add(value);
        replica.accepted += 1;
        Ok(())
    }

    /// Whether the film keeps this layer.
    pub fn has_layer(&self, layer: Layer) -> bool {
        self.layers.iter().any(|l| l.layer == layer)
    }

    /// Adds one sample of a layer to a pixel; indices as in [`Self::add`]. Layers of one component
    /// take `x`, [`Layer::Ids`] takes shape and material in `x` and `y`. A layer that the film does
    /// not keep is left alone.
    ///
    /// # Errors
    /// A value that is not finite is not added.
    pub fn add_layer(
        &mut self,
        pixel: usize,
        layer: Layer,
        sample: u64,
        value: Vec3,
    ) -> Result<(), Reject> {
        match self.layers.iter_mut().find(|l| l.layer == layer) {
            Some(tile) => tile.add(pixel, sample, value),
            None => Ok(()),
        }
    }

    /// Shares out the seconds that a pass spent on this tile among the pixels that it sampled, which
    /// all got the same number of samples: [`Layer::Seconds`] tells tiles apart, not the pixels of
    /// one. Call it before [`Self::decide`]; without that layer nothing is kept.
    pub fn add_seconds(&mut self, seconds: f64) {
        if !self.has_layer(Layer::Seconds) {
            return;
        }
        let pixels = self.active_pixels();
        let share = Vec3::splat((seconds / pixels.len().max(1) as f64) as f32);
        for pixel in pixels {
            // A duration is finite, so nothing is refused.
            let _ = self.add_layer(pixel, Layer::Seconds, 0, share);
        }
    }

    /// Accepted samples of a pixel, those included that adaptive sampling leaves out of the mean.
    pub fn sample_count(&self, pixel: usize) -> u64 {
        match &self.adaptive {
            None => self.used_count(pixel),
            Some(adaptive) => adaptive.taken(pixel),
        }
    }

    /// Samples in the mean of a pixel.
    pub(crate) fn used_count(&self, pixel: usize) -> u64 {
        self.replica_sums(pixel).map(|(_, n)| n).sum()
    }

    /// Samples of a pixel that a clamp scaled down, and the sum of what it cut off.
    pub(crate) fn lost(&self, pixel: usize) -> (u64, DVec3) {
        self.clamp
            .as_ref()
            .map_or((0, DVec3::ZERO), |c| c.lost(pixel))
    }

    /// Adds what adaptive sampling has come to here.
    pub(crate) fn report(&self, total: &mut AdaptiveReport) {
        if let Some(adaptive) = &self.adaptive {
            adaptive.report(total);
            let pixels = 0..self.pixel_count();
            total.used += pixels.map(|p| self.used_count(p)).sum::<u64>();
        }
    }

    /// Sum and number of the accepted samples of each replica of a pixel.
    pub(crate) fn replica_sums(&self, pixel: usize) -> impl Iterator<Item = (DVec3, u64)> {
        self.sums[pixel * self.replicas..][..self.replicas]
            .iter()
            .map(|r| (r.sum.total(), r.accepted))
    }

    /// Sum of the squares of the accepted samples of a pixel.
    pub(crate) fn squares(&self, pixel: usize) -> DVec3 {
        self.pixels[pixel].squares.total()
    }

    /// Mean of a layer; `layer` counts in the order of the specification.
    pub(crate) fn layer_value(&self, layer: usize, pixel: usize) -> Vec3 {
        self.layers[layer].value(pixel)
    }
}

/// What the film asks of every sample and splat: finite, and no component below 0.
///
/// # Errors
/// What is wrong with it.
#[inline]
pub fn check_colour(rgb: Vec3) -> Result<(), Reject> {
    if !rgb.is_finite() {
        return Err(Reject::NonFinite);
    }
    if rgb.min_element() < 0.0 {
        return Err(Reject::Negative);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash;

    /// Twenty-four orders of magnitude: sums of floats of like size would be exact in `f64`.
    fn sample(i: u64) -> Vec3 {
        let v = |c| 10f32.powf(24.0 * hash::unit_f32(hash::mix(i as u32, c)) - 12.0);
        Vec3::new(v(0), v(1), v(2))
    }

    fn tile_of(samples: std::ops::Range<u64>) -> FilmTile {
        let spec = FilmSpec::of_size(1, 1);
        let mut tile = FilmTile::new(spec.crop, &spec);
        for i in samples {
            tile.add(0, i, sample(i)).unwrap();
        }
        tile
    }

    /// Shards of whole blocks merge to the very bits of one run; a running sum would not give them.
    #[test]
    fn sums_are_made_block_by_block() {
        let whole = tile_of(0..640);
        let mut merged = [DVec3::ZERO; 2];
        let mut squares = DVec3::ZERO;
        for block in 0..10 {
            let shard = tile_of(block * 64..block * 64 + 64);
            for (m, (sum, _)) in merged.iter_mut().zip(shard.replica_sums(0)) {
                *m += sum;
            }
            squares += shard.squares(0);
        }
        let sums: Vec<DVec3> = whole.replica_sums(0).map(|r| r.0).collect();
        assert_eq!(sums, merged);
        assert_eq!(whole.squares(0), squares);

        let even = (0..640).step_by(2).map(|i| sample(i).as_dvec3());
        assert_ne!(sums[0], even.fold(DVec3::ZERO, |sum, v| sum + v));
    }
}
