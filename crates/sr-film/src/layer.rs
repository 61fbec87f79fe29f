//! Layers beside the picture: what the camera sees rather than how bright it is.

use crate::Reject;
use crate::block_sum::{BlockSum, block_of};
use glam::{DVec3, Vec3};

/// A layer of auxiliary values per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layer {
    /// Mean world-space shading normal at the first hit, not renormalised. 0 where nothing was hit.
    Normal,
    /// Mean distance to the first hit along the view axis in metres (`x`), of the samples that hit.
    /// Infinite where nothing was hit.
    Depth,
    /// Mean albedo at the first hit. 0 where nothing was hit.
    Albedo,
    /// Shape (`x`) and material (`y`) of the first accepted sample of the pixel: ids are not
    /// averaged. −1 for none. As floats, so exact up to 2²⁴.
    Ids,
    /// Mean number of bounces (`x`).
    Bounces,
    /// Seconds that a thread spent on the pixel (`x`), over all its samples: a sum, the only layer
    /// that is none of the scene. See [`FilmTile::add_seconds`](crate::FilmTile::add_seconds).
    Seconds,
}

impl Layer {
    /// Every layer.
    pub const ALL: [Self; 6] = [
        Self::Normal,
        Self::Depth,
        Self::Albedo,
        Self::Ids,
        Self::Bounces,
        Self::Seconds,
    ];

    /// Names of its channels in a file, in the order of the components.
    pub const fn channel_names(self) -> &'static [&'static str] {
        match self {
            Self::Normal => &["N.X", "N.Y", "N.Z"],
            Self::Depth => &["Depth.Z"],
            Self::Albedo => &["Albedo.R", "Albedo.G", "Albedo.B"],
            Self::Ids => &["Id.Shape", "Id.Material"],
            Self::Bounces => &["Bounces.Y"],
            Self::Seconds => &["Seconds.Y"],
        }
    }

    /// Whether its values need all of a float whatever precision the colours are written in.
    pub(crate) const fn needs_float(self) -> bool {
        matches!(self, Self::Depth | Self::Ids | Self::Seconds)
    }

    /// The value of a pixel that no sample reached.
    const fn empty_value(self) -> Vec3 {
        match self {
            Self::Normal | Self::Albedo | Self::Bounces | Self::Seconds => Vec3::ZERO,
            Self::Depth => Vec3::INFINITY,
            Self::Ids => Vec3::NEG_ONE,
        }
    }

    /// Bytes that a film keeps per pixel for it.
    pub(crate) const fn bytes_per_pixel(self) -> usize {
        match self {
            Self::Ids => size_of::<Option<Vec3>>(),
            Self::Seconds => size_of::<f64>(),
            _ => size_of::<MeanPixel>(),
        }
    }
}

#[derive(Clone, Copy, Default)]
struct MeanPixel {
    sum: BlockSum,
    block: u64,
    count: u64,
}

enum Values {
    /// Averaged over the samples.
    Mean(Vec<MeanPixel>),
    /// The first one stays.
    First(Vec<Option<Vec3>>),
    /// Added up: one component.
    Sum(Vec<f64>),
}

/// The values of one layer in one tile.
pub(crate) struct LayerTile {
    pub layer: Layer,
    values: Values,
}

impl LayerTile {
    pub fn new(layer: Layer, pixels: usize) -> Self {
        let values = match layer {
            Layer::Ids => Values::First(vec![None; pixels]),
            Layer::Seconds => Values::Sum(vec![0.0; pixels]),
            _ => Values::Mean(vec![MeanPixel::default(); pixels]),
        };
        Self { layer, values }
    }

    pub fn add(&mut self, pixel: usize, sample: u64, value: Vec3) -> Result<(), Reject> {
        if !value.is_finite() {
            return Err(Reject::NonFinite);
        }
        match &mut self.values {
            Values::Mean(pixels) => {
                let p = &mut pixels[pixel];
                if p.block != block_of(sample) {
                    p.sum.fold();
                    p.block = block_of(sample);
                }
                p.sum.add(value.as_dvec3());
                p.count += 1;
            }
            Values::First(pixels) => {
                pixels[pixel].get_or_insert(value);
            }
            Values::Sum(pixels) => pixels[pixel] += f64::from(value.x),
        }
        Ok(())
    }

    pub fn value(&self, pixel: usize) -> Vec3 {
        match &self.values {
            Values::Mean(pixels) if pixels[pixel].count > 0 => {
                let p = &pixels[pixel];
                (p.sum.total() / DVec3::splat(p.count as f64)).as_vec3()
            }
            Values::Mean(_) => self.layer.empty_value(),
            Values::First(pixels) => pixels[pixel].unwrap_or(self.layer.empty_value()),
            Values::Sum(pixels) => Vec3::splat(pixels[pixel] as f32),
        }
    }
}
