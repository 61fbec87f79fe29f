//! Reader of Wavefront OBJ with its `.mtl` (Alias|Wavefront, "Advanced Visualizer Manual",
//! appendix B1, and `mtl` file format).
//!
//! A scan looks at the text first: it finds errors with their line and column, joins continued
//! lines, drops what is not drawn, and sorts the faces by object and material. `tobj` then builds
//! one indexed mesh of each. The order matters, as `tobj` alone takes polylines for triangles,
//! misplaces normals when only some faces have them, panics on a colour of two numbers, and says
//! neither line nor file.
//!
//! One node an object (`o`, or `g` in files without `o`), one part a material. Faces without
//! normals are faceted; smoothing groups are ignored. Polygons may be concave.
//!
//! Of a material, the first row that fits decides (r = roughness, α = r²):
//!
//! | statement | lobe |
//! |---|---|
//! | `illum` 4, 6, 7 or 9, or `d` below 1 with `Ni` above 1 | `Dielectric`: ior `Ni` (1.5), tinted by `Tf`, or else `Kd` unless that is black |
//! | `Pr` or `Pm` | `MetallicRoughness`: `Kd`, `Pm` (0), r = `Pr`, or from `Ns`, or 0.5 |
//! | `illum` 3 or 5 with `Ks` | `Mirror`: `Ks` |
//! | `Ks` with `Ns`, unless `illum` is 0 or 1 | `MetallicRoughness`: `Kd`, α = √(2/(`Ns`+2)) |
//! | anything else | `Lambert`: `Kd` (0.5) |
//!
//! `Ke` becomes a two-sided `Emission`, as OBJ knows no back sides. The exponent of a Phong lobe
//! becomes the α of a microfacet distribution of about the same width (Walter, Marschner, Li,
//! Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces", §5.2). f0 of
//! `MetallicRoughness` follows from `Ni` when that is above 1, not from `Ks`, in which programs
//! write very different things.

mod clean;
mod library;
mod material;
mod scan;
mod text;

#[cfg(test)]
mod tests;

use crate::model::{Model, Node, Part};
use crate::normals::unit_normals;
use crate::report::Report;
use crate::{file, polygon};
use library::Materials;
use scan::Scan;
use sr_scene::components::TriangleMesh;
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Corners stay together, so that the polygons can be cut here.
const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: true,
    triangulate: false,
    ignore_points: true,
    ignore_lines: true,
};

/// Reads an `.obj` file and the material libraries that it names.
///
/// # Errors
/// All problems of the file and of its libraries, with line and column.
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
            "this file makes the OBJ reader fail; please report it with the file",
        ));
        report.finish(Model::default())
    })
}

fn read_unguarded(path: &Path) -> Result<Model, Vec<Diagnostic>> {
    let mut report = Report::new(path);
    let model = match file::read(path) {
        Ok(bytes) => read_bytes(&bytes, path, &mut report),
        Err(why) => {
            report.error(Diagnostic::error(why));
            Model::default()
        }
    };
    report.finish(model)
}

/// Reads the bytes of a file whose libraries lie beside `path`; errors are in the report.
fn read_bytes(bytes: &[u8], path: &Path, report: &mut Report) -> Model {
    // Names and comments come in any encoding; everything else is ASCII.
    let text = String::from_utf8_lossy(bytes);
    let unnamed = path
        .file_stem()
        .map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let scan = scan::scan(&text, unnamed, report);
    drop(text);
    let materials = library::load(&scan, path, report);
    if report.has_errors() {
        return Model::default();
    }
    build(&scan, materials, report)
}

fn build(scan: &Scan, mut materials: Materials, report: &mut Report) -> Model {
    let clean = scan.clean_text();
    let no_library = |_: &Path| Ok((Vec::new(), HashMap::new()));
    let meshes = match tobj::load_obj_buf(&mut clean.as_bytes(), &OPTIONS, no_library) {
        Ok((meshes, _)) => meshes,
        Err(e) => {
            report.error(Diagnostic::error(format!("cannot be read: {e}")));
            return Model::default();
        }
    };
    drop(clean);
    let mut nodes: Vec<Node> = scan
        .objects
        .iter()
        .map(|name| Node {
            name: name.clone(),
            ..Node::default()
        })
        .collect();
    for tobj::Model { mesh, name } in meshes {
        let Some(bucket) = name.parse::<usize>().ok().and_then(|i| scan.buckets.get(i)) else {
            // What `tobj` adds at the end of a file without faces.
            continue;
        };
        let object = &scan.objects[bucket.object];
        let mesh = triangles(mesh, scan, object, report);
        if !mesh.indices.is_empty() {
            let material = Some(materials.index(bucket.material));
            nodes[bucket.object].parts.push(Part { mesh, material });
        }
    }
    nodes.retain(|n| !n.parts.is_empty());
    Model {
        nodes,
        materials: materials.list,
        notes: Vec::new(),
    }
}

/// Cuts the polygons of a mesh.
fn triangles(mesh: tobj::Mesh, scan: &Scan, object: &str, report: &mut Report) -> TriangleMesh {
    let vec3 = |flat: &[f32]| flat.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
    let mut result = TriangleMesh {
        positions: vec3(&mesh.positions),
        normals: vec3(&mesh.normals),
        indices: Vec::with_capacity(mesh.indices.len() / 3),
    };
    let mut rest = mesh.indices.as_slice();
    let mut arities = mesh.face_arities.iter();
    let mut corners = Vec::new();
    while !rest.is_empty() {
        // No arities at all means triangles only.
        let arity = arities.next().map_or(3, |a| *a as usize).min(rest.len());
        let (face, others) = rest.split_at(arity);
        rest = others;
        corners.clear();
        corners.extend(face.iter().map(|v| result.positions[*v as usize]));
        match polygon::triangulate(&corners) {
            Ok(cut) => {
                if !cut.simple {
                    let text = "polygons that cross themselves may be drawn wrongly";
                    report.note(Severity::Warning, text, format!("object `{object}`"));
                }
                let triangles = cut.triangles.iter().map(|t| t.map(|i| face[i]));
                // A corner named twice leaves no area.
                let proper = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
                result.indices.extend(triangles.filter(proper));
            }
            Err(corners) => {
                let limit = polygon::MAX_CONCAVE_CORNERS;
                let text = format!(
                    "a polygon of {corners} corners is not convex; those may have {limit} at most"
                );
                let span = scan
                    .line_of_large_face(corners)
                    .map(|line| report.span(line, 1));
                report.error(Diagnostic::error(text).at(span));
            }
        }
    }
    let replaced = unit_normals(&mut result);
    if replaced > 0 {
        let text = "normals without direction are replaced by those of the faces";
        report.note(
            Severity::Notice,
            text,
            format!("{replaced} in object `{object}`"),
        );
    }
    result
}
