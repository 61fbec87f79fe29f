//! Files that appear whole or not at all.

use crate::ImageError;
use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes a file by way of a temporary one in the same folder, which takes its place once all of it
/// is on the disk. A reader sees the old file or the new one; when anything fails, or `write`
/// panics, the old one stays and the temporary one goes.
///
/// # Errors
/// What `write` returns, or the system's refusal to create, write or rename.
pub fn write_atomically<T>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<T, ImageError>,
) -> Result<T, ImageError> {
    let at_path = |e| ImageError::io(path, e);
    let (temporary, file) = Temporary::create(path).map_err(at_path)?;
    let mut writer = BufWriter::new(file);
    let value = write(&mut writer)?;
    writer.flush().map_err(at_path)?;
    let file = writer.into_parts().0;
    file.sync_all().map_err(at_path)?;
    drop(file);
    std::fs::rename(&temporary.path, path).map_err(at_path)?;
    temporary.keep();
    sync_folder(path);
    Ok(value)
}

/// Removes its file when dropped.
struct Temporary {
    path: PathBuf,
}

impl Temporary {
    fn create(target: &Path) -> io::Result<(Self, File)> {
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        let name = target
            .file_name()
            .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not a file name"))?;
        let mut hidden = OsString::from(".");
        hidden.push(name);
        let (process, n) = (std::process::id(), COUNTER.fetch_add(1, Ordering::Relaxed));
        hidden.push(format!(".{process}.{n}.tmp"));
        let path = target.with_file_name(hidden);
        let file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&path)?;
        Ok((Self { path }, file))
    }

    fn keep(mut self) {
        self.path = PathBuf::new();
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.path.as_os_str().is_empty() {
            // Nothing is left to be done about a failure here.
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Makes the rename outlast a power cut, where folders can be opened at all. The file is complete
/// either way, so a refusal is no failure.
fn sync_folder(path: &Path) {
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<OsString> {
        std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name())
            .collect()
    }

    #[test]
    fn replaces_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for text in ["first", "second"] {
            write_atomically(&path, |w| {
                w.write_all(text.as_bytes()).unwrap();
                Ok(())
            })
            .unwrap();
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_keeps_the_old_file_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old").unwrap();
        let failed: Result<(), _> = write_atomically(&path, |w| {
            w.write_all(b"half of the new").unwrap();
            Err(ImageError::format(&path, "no more"))
        });
        assert_eq!(
            failed.unwrap_err().to_string(),
            format!("{}: no more", path.display())
        );
        let panicked = std::panic::catch_unwind(|| {
            let _ = write_atomically::<()>(&path, |_| std::panic::resume_unwind(Box::new(())));
        });
        assert!(panicked.is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_target_that_cannot_be_replaced_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        std::fs::create_dir(&path).unwrap();
        std::fs::write(path.join("inside"), "").unwrap();
        let error = write_atomically(&path, |_| Ok(())).unwrap_err();
        assert_eq!(error.path(), path);
        assert_eq!(names(folder.path()), ["taken"]);

        let missing = folder.path().join("no/such/folder.exr");
        assert!(write_atomically(&missing, |_| Ok(())).is_err());
    }
}
