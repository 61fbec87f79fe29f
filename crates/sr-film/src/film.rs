//! The film as a whole.

use crate::clamp::{ClampReport, is_limit, luminance};
use crate::tile::FilmTile;
use crate::{
    AdaptiveReport, AdaptiveSpec, FilmError, FilmImage, Layer, Rect, Reject, Splats, TILE_SIZE,
    VarianceEstimator,
};
use glam::Vec3;
use std::ops::Range;

/// Most memory that a film may need, in bytes: 32 GiB. More is taken for a slip of the keyboard.
pub const MEMORY_LIMIT: u64 = 32 << 30;

/// What a film keeps.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSpec {
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// The part of the picture that is rendered.
    pub crop: Rect,
    /// Number of replicas that the samples of a pixel are divided among, for the variance: 1, 2, 4,
    /// 8 or 16. A film of R replicas takes 56 · (R + 1) bytes per pixel, layers and splats besides,
    /// 24 · R + 34 bytes for adaptive sampling, whose folds they are, and 56 for a clamp.
    pub replicas: u32,
    /// Layers to keep.
    pub layers: Vec<Layer>,
    /// Whether integrators splat.
    pub splats: bool,
    /// Adaptive sampling, when pixels get as many samples as they need. Not together with splats.
    pub adaptive: Option<AdaptiveSpec>,
    /// Samples and splats with a larger component are scaled down to it: less noise, and a picture
    /// that is too dark. Finite and above 0; `None` leaves them as they are.
    pub clamp: Option<f32>,
}

impl FilmSpec {
    /// A whole picture with two replicas, no layers and no splats.
    pub fn of_size(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            crop: Rect::of_size(width, height),
            replicas: 2,
            layers: Vec::new(),
            splats: false,
            adaptive: None,
            clamp: None,
        }
    }

    /// The pixels that are sampled: the crop, and the rest of the adaptive blocks that it cuts.
    pub fn sampled(&self) -> Rect {
        let crop = self.crop;
        let block = self.adaptive.map_or(1, |a| a.block);
        let up = |x: u32, end: u32| x.div_ceil(block).saturating_mul(block).min(end);
        Rect {
            x0: crop.x0 / block * block,
            y0: crop.y0 / block * block,
            x1: up(crop.x1, self.width),
            y1: up(crop.y1, self.height),
        }
    }

    /// Bytes that the film needs.
    ///
    /// # Errors
    /// Whatever keeps a film from being made, but for the memory at hand.
    pub fn bytes(&self) -> Result<u64, FilmError> {
        let (width, height, crop) = (self.width, self.height, self.crop);
        if width == 0 || height == 0 {
            return Err(FilmError::EmptyPicture { width, height });
        }
        if crop.is_empty() || crop.x1 > width || crop.y1 > height {
            return Err(FilmError::BadCrop {
                crop,
                width,
                height,
            });
        }
        if !self.replicas.is_power_of_two() || self.replicas > 16 {
            return Err(FilmError::BadReplicas(self.replicas));
        }
        if let Some(limit) = self.clamp
            && !is_limit(limit)
        {
            return Err(FilmError::BadClamp(limit));
        }
        for (i, &layer) in self.layers.iter().enumerate() {
            if self.layers[..i].contains(&layer) {
                return Err(FilmError::RepeatedLayer(layer));
            }
        }
        if let Some(AdaptiveSpec { block, .. }) = self.adaptive {
            if !block.is_power_of_two() || block > TILE_SIZE {
                return Err(FilmError::BadBlock(block));
            }
            if self.splats {
                return Err(FilmError::AdaptiveSplats);
            }
        }
        let per_pixel = FilmTile::bytes_per_pixel(self) + Splats::bytes_per_pixel(self);
        let pixels = self.sampled().pixel_count();
        let bytes = pixels.saturating_mul(per_pixel as u64);
        if bytes > MEMORY_LIMIT {
            return Err(FilmError::TooLarge { pixels, bytes });
        }
        Ok(bytes)
    }
}

/// Accumulates the samples of a picture.
pub struct Film {
    spec: FilmSpec,
    tiles: Vec<FilmTile>,
    splats: Splats,
}

impl Film {
    /// An empty film.
    ///
    /// # Errors
    /// A picture without pixels, a crop outside it, a number of replicas that is not 1, 2, 4, 8 or
    /// 16, a clamp that is not finite and above 0, a layer asked for twice, adaptive blocks of a side
    /// that is not 1, 2, 4, 8 or 16 or together with splats, or a need for more memory than
    /// [`MEMORY_LIMIT`] or the system has.
    pub fn new(spec: FilmSpec) -> Result<Self, FilmError> {
        let bytes = spec.bytes()?;
        // The film is many small vectors: asking for the whole first turns a failure into an error.
        let mut probe = Vec::<u8>::new();
        probe
            .try_reserve_exact(bytes as usize)
            .map_err(|_| FilmError::OutOfMemory { bytes })?;
        drop(probe);
        let tiles = tile_rects(spec.sampled())
            .map(|rect| FilmTile::new(rect, &spec))
            .collect();
        Ok(Self {
            tiles,
            splats: Splats::new(&spec),
            spec,
        })
    }

    /// What it was made for.
    pub fn spec(&self) -> &FilmSpec {
        &self.spec
    }

    /// The tiles, row by row.
    pub fn tiles(&self) -> &[FilmTile] {
        &self.tiles
    }

    /// The tiles, to add samples to, in parallel if wanted.
    pub fn tiles_mut(&mut self) -> &mut [FilmTile] {
        &mut self.tiles
    }

    /// Tiles and splats at once, for integrators that do both.
    pub fn parts_mut(&mut self) -> (&mut [FilmTile], &Splats) {
        (&mut self.tiles, &self.splats)
    }

    /// Adds a contribution to pixel (x, y) of the picture, from any thread.
    ///
    /// `sample` is the index of the sample that it belongs to. Splats are scaled such that the sum
    /// of those of one index is one estimate of the pixel: a light tracer that traces one path per
    /// pixel and index divides its contributions by the number of pixels of the *whole* picture,
    /// and traces the whole even when only a crop is kept. Contributions outside the crop are
    /// dropped. The pixel's value is the sum divided by the number of indices noted by
    /// [`Self::add_splat_samples`], plus the mean of what its tile was given.
    ///
    /// # Errors
    /// As [`Splats::add`].
    pub fn splat(&self, x: u32, y: u32, sample: u64, rgb: Vec3) -> Result<(), Reject> {
        self.splats.add(x, y, sample, rgb)
    }

    /// Notes that the samples of these indices have been splatted for the whole picture, whether or
    /// not anything landed. Call it once a pass.
    pub fn add_splat_samples(&mut self, indices: Range<u64>) {
        self.splats.add_samples(indices);
    }

    /// Accepted samples of all sampled pixels together; splats do not count.
    pub fn sample_count(&self) -> u64 {
        self.tiles
            .iter()
            .flat_map(|tile| (0..tile.pixel_count()).map(|p| tile.sample_count(p)))
            .sum()
    }

    /// Pixels that want samples.
    pub fn active_pixels(&self) -> u64 {
        self.tiles.iter().map(|t| t.active_count() as u64).sum()
    }

    /// What adaptive sampling has come to; `None` without it.
    pub fn adaptive_report(&self) -> Option<AdaptiveReport> {
        self.spec.adaptive?;
        let mut report = AdaptiveReport::default();
        for tile in &self.tiles {
            tile.report(&mut report);
        }
        Some(report)
    }

    /// What the clamp has taken from the picture so far; `None` without one.
    pub fn clamp_report(&self) -> Option<ClampReport> {
        self.spec.clamp?;
        let mut report = self.splats.clamp_report();
        // Neither estimator changes the means.
        let picture = self.resolve(VarianceEstimator::Samples).rgb;
        let light = picture.pixels.iter().map(|p| luminance(p.as_dvec3()));
        report.kept = light.sum();
        for tile in &self.tiles {
            for p in 0..tile.pixel_count() {
                let (x, y) = tile.pixel(p);
                if !self.spec.crop.contains(x, y) {
                    continue;
                }
                let (clamped, lost) = tile.lost(p);
                report.clamped += clamped;
                report.removed += luminance(lost) / tile.used_count(p).max(1) as f64;
            }
        }
        Some(report)
    }

    /// The picture so far.
    pub fn resolve(&self, estimator: VarianceEstimator) -> FilmImage {
        crate::resolve::resolve(&self.spec, &self.tiles, &self.splats, estimator)
    }
}

/// The cells of the tile grid that meet what is sampled, clipped to it, row by row.
fn tile_rects(crop: Rect) -> impl Iterator<Item = Rect> {
    let columns = crop.x0 / TILE_SIZE..crop.x1.div_ceil(TILE_SIZE);
    let rows = crop.y0 / TILE_SIZE..crop.y1.div_ceil(TILE_SIZE);
    rows.flat_map(move |row| {
        columns.clone().map(move |column| {
            // The far sides may pass 2³²; the crop's do not.
            crop.intersect(Rect {
                x0: column * TILE_SIZE,
                y0: row * TILE_SIZE,
                x1: (column * TILE_SIZE).saturating_add(TILE_SIZE),
                y1: (row * TILE_SIZE).saturating_add(TILE_SIZE),
            })
        })
    })
}
