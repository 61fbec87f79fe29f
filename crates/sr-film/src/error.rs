//! What can go wrong with samples, films and image files.

use crate::{Layer, Rect};
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a sample was not added. Nothing of it was, and the caller counts the cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Reject {
    /// A component is infinite or not a number.
    NonFinite,
    /// A component of a colour is below zero.
    Negative,
    /// A splat is larger than the fixed-point sums hold, or would carry one past its end.
    OutOfRange,
    /// The film was made without splats.
    NoSplats,
}

impl fmt::Display for Reject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NonFinite => "not finite",
            Self::Negative => "negative",
            Self::OutOfRange => "out of the range of splats",
            Self::NoSplats => "splatted onto a film without splats",
        })
    }
}

impl std::error::Error for Reject {}

/// Why a film cannot be made.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmError {
    /// The picture has no pixels.
    EmptyPicture {
        /// Picture width.
        width: u32,
        /// Picture height.
        height: u32,
    },
    /// The crop is empty or not inside the picture.
    BadCrop {
        /// The crop asked for.
        crop: Rect,
        /// Picture width.
        width: u32,
        /// Picture height.
        height: u32,
    },
    /// The number of replicas is not 1, 2, 4, 8 or 16.
    BadReplicas(u32),
    /// The clamp is not finite and above 0.
    BadClamp(f32),
    /// A layer was asked for twice.
    RepeatedLayer(Layer),
    /// The side of adaptive blocks is not 1, 2, 4, 8 or 16.
    BadBlock(u32),
    /// Adaptive sampling of a film with splats.
    AdaptiveSplats,
    /// The film would need more than [`crate::MEMORY_LIMIT`].
    TooLarge {
        /// Pixels of the crop.
        pixels: u64,
        /// Bytes that they need.
        bytes: u64,
    },
    /// The system has no memory for the film.
    OutOfMemory {
        /// Bytes that the film needs.
        bytes: u64,
    },
}

impl fmt::Display for FilmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let gib = |bytes: u64| bytes as f64 / (1u64 << 30) as f64;
        match self {
            Self::EmptyPicture { width, height } => {
                write!(f, "a picture of {width} × {height} has no pixels")
            }
            Self::BadCrop {
                crop: Rect { x0, y0, x1, y1 },
                width,
                height,
            } => write!(
                f,
                "crop {x0},{y0},{x1},{y1} is empty or not inside the picture of {width} × {height} \
                 (left, top, one past right, one past bottom)"
            ),
            Self::BadReplicas(n) => write!(f, "{n} replicas: the film keeps 1, 2, 4, 8 or 16"),
            Self::BadClamp(limit) => {
                write!(f, "a clamp at {limit}: it must be finite and above 0")
            }
            Self::RepeatedLayer(layer) => write!(f, "layer {layer:?} is asked for twice"),
            Self::BadBlock(side) => {
                write!(
                    f,
                    "adaptive blocks of side {side}: it must be 1, 2, 4, 8 or 16"
                )
            }
            Self::AdaptiveSplats => write!(f, "a film with splats cannot be sampled adaptively"),
            Self::TooLarge { pixels, bytes } => write!(
                f,
                "a film of {pixels} pixels needs {:.1} GiB of memory, the limit is {:.0} GiB: \
                 render a smaller picture, or several crops",
                gib(*bytes),
                gib(crate::MEMORY_LIMIT)
            ),
            Self::OutOfMemory { bytes } => {
                write!(f, "no memory for a film of {:.2} GiB", gib(*bytes))
            }
        }
    }
}

impl std::error::Error for FilmError {}

/// Why an image file could not be read or written; always names the file.
#[derive(Debug)]
pub enum ImageError {
    /// The operating system refused.
    Io {
        /// The file.
        path: PathBuf,
        /// Its reason.
        source: std::io::Error,
    },
    /// The file is malformed, of an unknown kind, or lacks what was asked for.
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
}

impl ImageError {
    pub(crate) fn io(path: &Path, source: std::io::Error) -> Self {
        Self::Io {
            path: path.to_owned(),
            source,
        }
    }

    pub(crate) fn format(path: &Path, message: impl fmt::Display) -> Self {
        Self::Format {
            path: path.to_owned(),
            message: message.to_string(),
        }
    }

    /// The file that the error is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::Io { path, .. } | Self::Format { path, .. } => path,
        }
    }
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Format { path, message } => write!(f, "{}: {message}", path.display()),
        }
    }
}

impl std::error::Error for ImageError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Format { .. } => None,
        }
    }
}
