//! Reading files that a model names, without trusting them.
//!
//! A name in a file can lead to a pipe or to an endless device, where a plain read never returns;
//! only regular files are opened.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes of a regular file, at most `limit` of them.
///
/// # Errors
/// When it is missing, is not a regular file or cannot be read: a phrase that fits after its name.
pub(crate) fn read_at_most(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let unreadable = |e: std::io::Error| match e.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_string(),
        _ => format!("cannot be read: {e}"),
    };
    let meta = std::fs::metadata(path).map_err(unreadable)?;
    if !meta.is_file() {
        return Err("is not a file".into());
    }
    let mut bytes = Vec::new();
    // The length is a hint that another process can change; `take` is what bounds the read.
    File::open(path)
        .and_then(|f| f.take(limit).read_to_end(&mut bytes))
        .map_err(unreadable)?;
    Ok(bytes)
}

/// The bytes of a regular file.
///
/// # Errors
/// As [`read_at_most`].
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, String> {
    let length = std::fs::metadata(path).map_or(0, |m| m.len());
    read_at_most(path, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_are_opened() {
        let dir = tempfile::tempdir().unwrap();
        let missing = read(&dir.path().join("none.bin")).unwrap_err();
        assert_eq!(missing, "there is no such file");
        assert_eq!(read(dir.path()).unwrap_err(), "is not a file");
        #[cfg(unix)]
        assert_eq!(
            read_at_most(Path::new("/dev/zero"), u64::MAX).unwrap_err(),
            "is not a file"
        );
    }

    #[test]
    fn no_more_than_the_limit_is_read() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a b.bin");
        std::fs::write(&path, [7u8; 100]).unwrap();
        assert_eq!(read_at_most(&path, 10).unwrap().len(), 10);
        assert_eq!(read(&path).unwrap().len(), 100);
    }
}
