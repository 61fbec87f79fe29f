//! Whether a document is one that the rest of the reader may trust: versions, extensions, and the
//! `gltf` crate's validation, which checks that every index leads somewhere.

use crate::report::Report;
use gltf::json::mesh::Semantic;
use gltf::json::validation::{Checked, Error, Validate};
use gltf::json::{Path, Root};
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::collections::BTreeSet;

/// Extensions that are read, so that a file may require them.
const READ: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
];

/// Extensions that only say how to read textures: the one warning about textures covers them.
const ABOUT_TEXTURES: &[&str] = &[
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "MSFT_texture_dds",
];

/// Extensions that do not change the picture when the file does not require them. Of a compressed
/// mesh the file then has a plain copy; of variants the default is shown.
const WITHOUT_EFFECT: &[&str] = &[
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_materials_variants",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Extensions whose absence people ask about, and what they are.
const KNOWN: &[(&str, &str)] = &[
    ("EXT_lights_image_based", "light from an environment map"),
    ("EXT_mesh_gpu_instancing", "instances of meshes"),
    ("EXT_meshopt_compression", "compressed buffers"),
    ("KHR_animation_pointer", "animation of any property"),
    ("KHR_draco_mesh_compression", "compressed meshes"),
    ("KHR_materials_anisotropy", "anisotropic reflection"),
    ("KHR_materials_clearcoat", "a clear coat"),
    ("KHR_materials_diffuse_transmission", "diffuse transmission"),
    ("KHR_materials_dispersion", "dispersion"),
    ("KHR_materials_iridescence", "thin-film interference"),
    (
        "KHR_materials_pbrSpecularGlossiness",
        "the specular-glossiness material",
    ),
    ("KHR_materials_sheen", "sheen"),
    (
        "KHR_materials_specular",
        "strength and colour of the specular part",
    ),
    ("KHR_materials_unlit", "materials without light"),
    ("KHR_materials_variants", "sets of materials to choose from"),
    ("KHR_node_visibility", "hidden nodes"),
];

/// Looks at the whole document; all problems go to the report.
pub(super) fn document(root: &Root, report: &mut Report) {
    versions(root, report);
    extensions(root, report);
    if positions_exist(root, report) {
        validate(root, report);
    }
}

fn versions(root: &Root, report: &mut Report) {
    let major = |v: &str| v.split('.').next().and_then(|m| m.parse::<u32>().ok());
    let asset = &root.asset;
    if major(&asset.version) != Some(2) {
        let text = format!("glTF {}, only glTF 2 can be read", asset.version);
        report.error(Diagnostic::error(text).field("asset.version"));
    }
    if let Some(v) = asset.min_version.as_deref().filter(|v| *v != "2.0") {
        let text = format!("the file needs a reader of glTF {v}, this one is for 2.0");
        report.error(Diagnostic::error(text).field("asset.minVersion"));
    }
}

fn extensions(root: &Root, report: &mut Report) {
    let accepted = |name: &str| READ.contains(&name) || ABOUT_TEXTURES.contains(&name);
    for (i, name) in root.extensions_required.iter().enumerate() {
        if !accepted(name) {
            let text = format!(
                "the file requires `{name}`{}, which is not read",
                meaning(name)
            );
            report.error(Diagnostic::error(text).field(format!("extensionsRequired[{i}]")));
        }
    }
    let used: BTreeSet<&str> = root.extensions_used.iter().map(String::as_str).collect();
    for name in used {
        // Its default values mean nothing, so materials decide.
        let decided_later = name == "KHR_materials_specular";
        if !accepted(name) && !WITHOUT_EFFECT.contains(&name) && !decided_later {
            let text = format!("the extension `{name}`{} is not read", meaning(name));
            report.note(Severity::Warning, &text, "");
        }
    }
}

fn meaning(name: &str) -> String {
    let known = KNOWN.iter().find(|(n, _)| *n == name);
    known.map_or(String::new(), |(_, what)| format!(" ({what})"))
}

/// The crate's validation of a primitive looks up its positions before it has checked the index,
/// and panics.
fn positions_exist(root: &Root, report: &mut Report) -> bool {
    let mut all = true;
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let positions = primitive
                .attributes
                .get(&Checked::Valid(Semantic::Positions));
            if positions.is_some_and(|a| a.value() >= root.accessors.len()) {
                all = false;
                let field = format!("meshes[{m}].primitives[{p}].attributes.POSITION");
                report.error(Diagnostic::error("there is no such accessor").field(field));
            }
        }
    }
    all
}

fn validate(root: &Root, report: &mut Report) {
    root.validate(root, Path::new, &mut |path, error| {
        let path = path();
        let what = match error {
            // Extensions are checked above, by what this reader reads.
            Error::Unsupported => return,
            // Attributes that are not read may have any name.
            Error::Invalid if path.as_str().contains("<invalid semantic name>") => return,
            Error::Missing | Error::Invalid if is_position_bound(path.as_str()) => {
                // The bounds are required, but of no use here.
                let text = "positions have no valid `min` and `max`, which the format requires";
                return report.note(Severity::Notice, text, path.as_str());
            }
            Error::IndexOutOfBounds => "there is nothing at this index",
            Error::Invalid => "the value is not valid here",
            Error::Missing => "this is required",
            Error::Oversize => "the number is too large",
        };
        report.error(Diagnostic::error(what).field(path.as_str()));
    });
}

fn is_position_bound(path: &str) -> bool {
    path.ends_with("[\"POSITION\"].min") || path.ends_with("[\"POSITION\"].max")
}
