//! Files appear whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A temporary file that is removed unless it is renamed.
struct Pending {
    temporary: PathBuf,
    target: PathBuf,
}

impl Drop for Pending {
    fn drop(&mut self) {
        // Gone already when it was renamed; otherwise there is nobody left to tell.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Write several files into a folder, which is made if need be. All are written under temporary
/// names first, then renamed, so that a full disk leaves older files as they were.
///
/// # Errors
/// Those of the file system, with the path that failed.
pub(crate) fn write_all(dir: &Path, files: &[(&Path, &[u8])]) -> Result<(), (PathBuf, io::Error)> {
    fs::create_dir_all(dir).map_err(|e| (dir.to_owned(), e))?;
    let mut pending = Vec::new();
    for (target, bytes) in files {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let temporary = dir.join(format!(".{name}.{}.tmp", std::process::id()));
        let file = Pending {
            temporary,
            target: target.to_path_buf(),
        };
        let write = || {
            let mut f = fs::File::create(&file.temporary)?;
            f.write_all(bytes)?;
            f.sync_all()
        };
        write().map_err(|e| (file.temporary.clone(), e))?;
        pending.push(file);
    }
    for file in &pending {
        fs::rename(&file.temporary, &file.target).map_err(|e| (file.target.clone(), e))?;
    }
    Ok(())
}
