//! Reader of glTF 2.0: `.gltf` with its buffers, `.glb`, and `data:` URIs (Khronos Group 2021,
//! "glTF 2.0 Specification", ISO/IEC 12113).
//!
//! The JSON is deserialised and validated by the `gltf` crate; everything that points into bytes is
//! read here, because that crate's readers panic on some valid and many invalid files. What a file
//! says about sizes is never believed: each allocation is paid from a budget that follows from
//! the bytes really there.
//!
//! What becomes of what (§ of the specification or name of the extension):
//!
//! | glTF | here |
//! |---|---|
//! | node matrix, or translation, rotation, scale | `LocalTransform.matrix`, or its other fields with the quaternion as angles |
//! | primitive without normals | faceted: `TriangleMesh.normals` is empty (§3.7.2.1) |
//! | primitive without material | a material called `default`: white, metallic 1, roughness 1 (§5.19) |
//! | metallic-roughness factors, `KHR_materials_ior` | `MetallicRoughness` |
//! | `emissiveFactor`, `KHR_materials_emissive_strength` | `Emission`, two-sided when the material is |
//! | `KHR_materials_transmission` | `MetallicRoughness.transmission` of a thin wall |
//! | …with `KHR_materials_volume` of non-zero thickness | `Dielectric`, tinted by the base colour at each crossing |
//! | camera | `PerspectiveCamera.vfov_deg`, `Orthographic.height` |
//! | `KHR_lights_punctual` | point, spot, directional light; cd and lx are W/sr and W/m² |
//! | lines and points, textures, skins, morph targets, animations, alpha modes, vertex colours | one warning each |

mod accessor;
mod budget;
mod buffers;
mod check;
mod container;
mod hierarchy;
mod material;
mod placed;
mod primitive;

#[cfg(test)]
mod tests;

use crate::file;
use crate::model::Model;
use crate::report::Report;
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Reads a `.gltf` or `.glb` file; which of them it is follows from its first bytes.
///
/// # Errors
/// All problems of the file, each with the path of its field in the JSON.
pub fn read(path: &Path) -> Result<Model, Vec<Diagnostic>> {
    guarded(path, || read_unguarded(path))
}

/// The last defence: no panic is known, but a file must never take the program down.
fn guarded(
    path: &Path,
    read: impl FnOnce() -> Result<Model, Vec<Diagnostic>>,
) -> Result<Model, Vec<Diagnostic>> {
    catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|_| {
        let mut report = Report::new(path);
        report.error(Diagnostic::error(
            "this file makes the glTF reader fail; please report it with the file",
        ));
        report.finish(Model::default())
    })
}

fn read_unguarded(path: &Path) -> Result<Model, Vec<Diagnostic>> {
    let mut report = Report::new(path);
    let model = match file::read(path) {
        Ok(bytes) => read_bytes(&bytes, path, &mut report).unwrap_or_default(),
        Err(why) => {
            report.error(Diagnostic::error(why));
            Model::default()
        }
    };
    report.finish(model)
}

/// Reads the bytes of a file whose buffers lie beside `path`. `None` after an error that leaves
/// nothing to go on with; other errors are in the report only.
fn read_bytes(bytes: &[u8], path: &Path, report: &mut Report) -> Option<Model> {
    let (root, chunk) = container::open(bytes, report)?;
    check::document(&root, report);
    if report.has_errors() {
        // Indices may point nowhere, so nothing below can be trusted.
        return None;
    }
    let buffers = buffers::load(&root, chunk, path, report)?;
    let input: usize = bytes.len() + buffers.iter().map(|b| b.len()).sum::<usize>();
    let mut model = Model {
        materials: material::read_all(&root, report),
        ..Model::default()
    };
    let mut meshes = primitive::Meshes::new(&root, &buffers, budget::Budget::for_input(input));
    model.nodes = hierarchy::read(&root, &mut meshes, report);
    if meshes.uses_default_material() {
        model.materials.push(material::default());
    }
    note_what_is_not_read(&root, report);
    Some(model)
}

/// Whole features that are left out, one warning each.
fn note_what_is_not_read(root: &gltf::json::Root, report: &mut Report) {
    let mut skip = |count: usize, what: &str| {
        if count > 0 {
            let text = format!("{what}: {count} ignored");
            report.note(Severity::Warning, &text, "");
        }
    };
    skip(root.animations.len(), "animations are not read");
    skip(
        root.skins.len(),
        "skins are not read, meshes keep their bind pose",
    );
    let images = root.images.len().max(root.textures.len().min(1));
    if images > 0 {
        let text = format!("textures are not read yet: {images} images ignored, factors are used");
        report.note(Severity::Warning, &text, "");
    }
}
