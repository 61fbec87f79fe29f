//! The film: accumulation, variance, tone mapping and image files.
//!
//! A [`Film`] is cut into [`FilmTile`]s that own their pixels, so that threads add samples without
//! locks; light tracing goes through [`Splats`], whose sums do not depend on order. When the
//! samples are in, [`Film::resolve`] gives a [`FilmImage`]: means, variance of the means, counts
//! and layers. Files are read by [`read_image`] and [`read_channels`], written atomically by
//! [`write_exr`] and [`write_png`]; [`develop`] turns radiance into display code values.
//!
//! Colour is linear Rec. 709 throughout; pixel (0, 0) is top left, y runs down.

pub mod adaptive;
mod atomic;
mod block_sum;
mod clamp;
mod error;
mod estimate;
mod film;
mod image;
mod layer;
mod rate;
mod read;
mod rect;
mod resolve;
mod splat;
pub mod srgb;
mod tile;
mod tonemap;
mod write;

pub use adaptive::{AdaptiveReport, AdaptiveSpec, Criterion, StoppingRule};
pub use atomic::write_atomically;
pub use clamp::{ClampReport, clamped, luminance};
pub use error::{FilmError, ImageError, Reject};
pub use estimate::{ErrorEstimate, RELMSE_OFFSET};
pub use film::{Film, FilmSpec, MEMORY_LIMIT};
pub use image::Image;
pub use layer::Layer;
pub use rate::rate_picture;
pub use read::{Channels, read_attributes, read_channels, read_image};
pub use rect::Rect;
pub use resolve::{FilmImage, LayerImage, VarianceEstimator};
pub use splat::{SPLAT_LIMIT, SPLAT_RESOLUTION, Splats};
pub use tile::{FilmTile, TILE_SIZE, check_colour};
pub use tonemap::{DisplayImage, ToneMap, develop};
pub use write::{
    ATTRIBUTE_PREFIX, HalfValue, Precision, WriteReport, png_bytes, to_half, write_exr,
    write_image_exr, write_png,
};
