//! Reading the input without trusting its name, which can lead to a pipe or an endless device,
//! where a plain read never returns.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// When it is missing, is not a regular file, is longer or cannot be read.
pub(crate) fn read_at_most(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let meta = std::fs::metadata(path)?;
    if meta.is_dir() {
        let message = "this is a folder; give the .dae file that is in it";
        return Err(io::Error::new(io::ErrorKind::IsADirectory, message));
    }
    if !meta.is_file() {
        let message = "this is a device or a pipe, and no file";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    // Told before gigabytes are read for nothing.
    if meta.len() > limit {
        return Err(too_long(limit));
    }
    let mut bytes = Vec::new();
    // The length is a hint that another process can change; what bounds the read is `take`. One
    // byte past the limit tells a file that is too long.
    File::open(path)?
        .take(limit.saturating_add(1))
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(too_long(limit));
    }
    Ok(bytes)
}

fn too_long(limit: u64) -> io::Error {
    let message = format!("longer than {limit} bytes");
    io::Error::new(io::ErrorKind::FileTooLarge, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_are_opened() {
        let dir = tempfile::tempdir().unwrap();
        let kind = |path: &Path| read_at_most(path, 10).unwrap_err().kind();
        assert_eq!(kind(&dir.path().join("none")), io::ErrorKind::NotFound);
        assert_eq!(kind(dir.path()), io::ErrorKind::IsADirectory);
        #[cfg(unix)]
        assert_eq!(kind(Path::new("/dev/zero")), io::ErrorKind::InvalidInput);
    }

    #[test]
    fn a_file_is_read_up_to_the_limit_and_refused_beyond() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.dae");
        std::fs::write(&path, [7u8; 100]).unwrap();
        assert_eq!(read_at_most(&path, 100).unwrap().len(), 100);
        let error = read_at_most(&path, 99).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
    }
}
