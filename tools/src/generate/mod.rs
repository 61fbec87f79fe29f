//! Things made from numbers alone, so that the project's scenes need no download.
//!
//! Each is a subcommand of `steradian-tools generate`: its arguments, and a function that makes it.
//! What is made depends on the arguments and on nothing else.

mod festival;
mod mesh;
mod sky;

pub use festival::FestivalArgs;
pub use mesh::{MeshArgs, Shape};
pub use sky::{Sky, SkyArgs};

use crate::convert::output::write_all;
use clap::Subcommand;
use sr_film::ImageError;
use std::fmt;
use std::path::{Path, PathBuf};

/// What can be made.
#[derive(Subcommand, Clone, Debug)]
pub enum Generate {
    /// A clear sky with its sun, as an environment map (EXR).
    Sky(SkyArgs),
    /// A mesh of the project's own scenes (binary glTF).
    Mesh(MeshArgs),
    /// A scene of hundreds of coloured lamps on strings over a square (RON).
    Festival(FestivalArgs),
}

/// Why nothing was made.
#[derive(Debug)]
pub enum Error {
    /// The arguments make no sense together.
    Usage(String),
    /// A file cannot be written.
    Write {
        /// The file.
        path: PathBuf,
        /// What is in the way.
        reason: String,
    },
}

impl Error {
    /// A picture that cannot be written.
    fn of_image(error: &ImageError) -> Self {
        Self::Write {
            path: error.path().to_owned(),
            reason: match error {
                ImageError::Io { source, .. } => source.to_string(),
                ImageError::Format { message, .. } => message.clone(),
            },
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(what) => f.write_str(what),
            Self::Write { path, reason } => write!(f, "{}: {reason}", path.display()),
        }
    }
}

impl std::error::Error for Error {}

/// What was made.
#[derive(Clone, Debug, Default)]
pub struct Made {
    /// What is in it, a line each.
    pub summary: Vec<String>,
    /// The files written.
    pub written: Vec<PathBuf>,
}

/// Make it and write it.
///
/// # Errors
/// Arguments that make no sense together, or files that cannot be written; nothing is written then.
pub fn generate(what: &Generate) -> Result<Made, Error> {
    match what {
        Generate::Sky(args) => sky::write(args),
        Generate::Mesh(args) => mesh::write(args),
        Generate::Festival(args) => festival::write(args),
    }
}

/// Writes a file whole or not at all, making its folder if need be.
fn save(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    write_all(folder, &[(path, bytes)]).map_err(|(path, e)| Error::Write {
        path,
        reason: e.to_string(),
    })
}
