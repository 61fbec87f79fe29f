//! A folder with the files that the seeds name, one a thread.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

thread_local! {
    static FOLDER: RefCell<Option<TempDir>> = const { RefCell::new(None) };
}

/// What lies beside the file under test.
const BESIDE: &[(&str, &[u8])] = &[
    (
        "model.obj",
        include_bytes!("../../fuzz/corpus/obj/everything.obj"),
    ),
    (
        "model.mtl",
        include_bytes!("../../fuzz/corpus/mtl/everything.mtl"),
    ),
    (
        "model.glb",
        include_bytes!("../../fuzz/corpus/gltf/everything.glb"),
    ),
    (
        "sky.hdr",
        include_bytes!("../../fuzz/corpus/picture/runs.hdr"),
    ),
    (
        "models.scene.ron",
        include_bytes!("../../fuzz/corpus/scene/models.ron"),
    ),
    (
        "base.ron",
        include_bytes!("../../fuzz/corpus/config/short.ron"),
    ),
];

/// Four corners and two triangles.
fn square() -> Vec<u8> {
    let corners = [
        0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0,
    ];
    let indices = [0u8, 1, 2, 0, 2, 3];
    corners
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .chain(indices)
        .collect()
}

/// Writes a file beside the others and hands its path on.
pub(super) fn with_file<T>(name: &str, bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    let path: PathBuf = FOLDER.with_borrow_mut(|folder| {
        let folder = folder.get_or_insert_with(|| {
            let folder = tempfile::tempdir().expect("a folder for temporary files");
            for (name, bytes) in BESIDE {
                std::fs::write(folder.path().join(name), bytes).expect("a file");
            }
            std::fs::write(folder.path().join("model.bin"), square()).expect("a file");
            folder
        });
        folder.path().join(name)
    });
    std::fs::write(&path, bytes).expect("a file");
    read(&path)
}
