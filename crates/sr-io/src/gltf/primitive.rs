//! Primitives into triangle meshes (§3.7.2).
//!
//! A mesh keeps those vertices only that its triangles use, because files let many primitives
//! share one large accessor.

use super::accessor::{self, Accessor, Usage};
use super::budget::Budget;
use super::buffers::Bytes;
use crate::model::Part;
use crate::normals::unit_normals;
use crate::report::Report;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Index, Root, accessor::Accessor as AccessorJson};
use sr_scene::components::TriangleMesh;
use sr_scene::diagnostics::{Diagnostic, Severity};

/// Bytes of a vertex with its normal, and of a triangle.
const VERTEX_BYTES: u64 = 24;
const TRIANGLE_BYTES: u64 = 12;

/// The meshes of a file, each decoded when first used.
pub(super) struct Meshes<'a> {
    root: &'a Root,
    buffers: &'a [Bytes<'a>],
    budget: Budget,
    decoded: Vec<Option<Vec<Part>>>,
    uses_default_material: bool,
}

impl<'a> Meshes<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a [Bytes<'a>], budget: Budget) -> Self {
        Self {
            root,
            buffers,
            budget,
            decoded: vec![None; root.meshes.len()],
            uses_default_material: false,
        }
    }

    /// Some part has no material of the file's; its index is the number of those.
    pub(super) fn uses_default_material(&self) -> bool {
        self.uses_default_material
    }

    /// The parts of mesh `m` for one more node; `last` means that no other will ask.
    pub(super) fn instance(&mut self, m: usize, last: bool, report: &mut Report) -> Vec<Part> {
        if self.decoded[m].is_none() {
            self.decoded[m] = Some(self.decode(m, report));
        }
        if last {
            return self.decoded[m].take().unwrap_or_default();
        }
        let parts = self.decoded[m].as_deref().unwrap_or_default();
        let size = |p: &Part| {
            VERTEX_BYTES * p.mesh.positions.len() as u64
                + TRIANGLE_BYTES * p.mesh.indices.len() as u64
        };
        match self.budget.pay(parts.iter().map(size).sum(), 1) {
            Ok(()) => parts.to_vec(),
            Err(why) => {
                report.error(Diagnostic::error(why).field(format!("meshes[{m}]")));
                Vec::new()
            }
        }
    }

    fn decode(&mut self, m: usize, report: &mut Report) -> Vec<Part> {
        let root = self.root;
        let mut parts = Vec::new();
        for (p, primitive) in root.meshes[m].primitives.iter().enumerate() {
            let field = format!("meshes[{m}].primitives[{p}]");
            note_what_is_not_read(primitive, &field, report);
            match self.primitive(primitive, &field, report) {
                Ok(mesh) if mesh.indices.is_empty() => {}
                Ok(mesh) => {
                    let material = primitive.material.map(|i| i.value());
                    self.uses_default_material |= material.is_none();
                    let material = Some(material.unwrap_or(root.materials.len()));
                    parts.push(Part { mesh, material });
                }
                Err((sub, why)) => {
                    report.error(Diagnostic::error(why).field(format!("{field}{sub}")));
                }
            }
        }
        parts
    }

    /// The mesh of one primitive, or the field below it and what is wrong there.
    fn primitive(
        &mut self,
        primitive: &Primitive,
        field: &str,
        report: &mut Report,
    ) -> Result<TriangleMesh, (String, String)> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err((".mode".into(), "the value is not valid here".into()));
        };
        if !matches!(
            mode,
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        ) {
            let text = "points and lines are not drawn";
            report.note(Severity::Warning, text, field);
            return Ok(TriangleMesh::default());
        }
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let positions = attribute(Semantic::Positions).ok_or((
            ".attributes".to_string(),
            "there is no POSITION".to_string(),
        ))?;
        let positions = self.accessor(positions, Usage::Position, ".attributes.POSITION")?;
        let normals = attribute(Semantic::Normals)
            .map(|i| self.accessor(i, Usage::Normal, ".attributes.NORMAL"))
            .transpose()?;
        if normals.as_ref().is_some_and(|n| n.count != positions.count) {
            let text = format!(
                "there are not as many normals as positions: {}",
                positions.count
            );
            return Err((".attributes.NORMAL".into(), text));
        }
        let indices = primitive
            .indices
            .map(|i| self.accessor(i, Usage::Index, ".indices"))
            .transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |i| i.count);
        if mode == Mode::Triangles && !corners.is_multiple_of(3) || corners < 3 {
            let text = "corners that make no whole triangle are ignored";
            report.note(Severity::Warning, text, field);
        }
        let triangles = self
            .triangles(mode, corners, indices.as_ref(), positions.count)
            .map_err(|why| (".indices".to_string(), why))?;
        let mut mesh = self
            .compact(triangles, &positions, normals.as_ref())
            .map_err(|why| (".attributes".to_string(), why))?;
        let replaced = unit_normals(&mut mesh);
        if replaced > 0 {
            let text = "normals without direction are replaced by those of the faces";
            report.note(Severity::Notice, text, format!("{replaced} in {field}"));
        }
        Ok(mesh)
    }

    fn accessor(
        &mut self,
        index: Index<AccessorJson>,
        usage: Usage,
        field: &str,
    ) -> Result<Accessor<'a>, (String, String)> {
        accessor::open(self.root, self.buffers, index, usage, &mut self.budget).map_err(|why| {
            (
                field.to_string(),
                format!("accessors[{}]: {why}", index.value()),
            )
        })
    }

    /// Three vertices each, with the winding of §3.7.2.1. Triangles that name a vertex twice join
    /// strips and have no area; they are left out.
    fn triangles(
        &mut self,
        mode: Mode,
        corners: usize,
        indices: Option<&Accessor<'_>>,
        vertices: usize,
    ) -> Result<Vec<[u32; 3]>, String> {
        let count = match mode {
            Mode::Triangles => corners / 3,
            _ => corners.saturating_sub(2),
        };
        self.budget.pay(count as u64, TRIANGLE_BYTES)?;
        let vertex = |corner: usize| -> Result<u32, String> {
            let Some(indices) = indices else {
                return u32::try_from(corner).map_err(|_| "there are too many vertices".into());
            };
            let v = indices.index(corner);
            if (v as usize) < vertices {
                return Ok(v);
            }
            Err(match v == indices.restart_value() {
                true => format!("index {corner} is {v}, the restart value, which is not allowed"),
                false => format!("index {corner} is {v}, but there are {vertices} vertices"),
            })
        };
        let mut triangles = Vec::with_capacity(count);
        for i in 0..count {
            let [a, b, c] = match mode {
                Mode::Triangles => [3 * i, 3 * i + 1, 3 * i + 2],
                Mode::TriangleFan => [i + 1, i + 2, 0],
                _ => [i, i + 1 + i % 2, i + 2 - i % 2],
            };
            let [a, b, c] = [vertex(a)?, vertex(b)?, vertex(c)?];
            if a != b && b != c && c != a {
                triangles.push([a, b, c]);
            }
        }
        Ok(triangles)
    }

    /// A mesh of the vertices that the triangles use, in the order of the file.
    fn compact(
        &mut self,
        mut triangles: Vec<[u32; 3]>,
        positions: &Accessor<'_>,
        normals: Option<&Accessor<'_>>,
    ) -> Result<TriangleMesh, String> {
        self.budget.pay(triangles.len() as u64, TRIANGLE_BYTES)?;
        let used = used_vertices(&triangles, positions.count);
        self.budget.pay(used.len() as u64, VERTEX_BYTES)?;
        // When all are used, as in most files, each keeps its number.
        if used
            .last()
            .is_some_and(|last| *last as usize + 1 != used.len())
        {
            for corner in triangles.iter_mut().flatten() {
                let at = used
                    .binary_search(corner)
                    .expect("every corner is among the used");
                *corner = u32::try_from(at).expect("no more vertices than numbers of vertices");
            }
        }
        let mut mesh = TriangleMesh {
            indices: triangles,
            ..TriangleMesh::default()
        };
        mesh.positions.reserve_exact(used.len());
        for &v in &used {
            let p = positions.vec3(v as usize);
            if !p.iter().all(|x| x.is_finite()) {
                return Err(format!("position {v} is not finite: {p:?}"));
            }
            mesh.positions.push(p);
        }
        if let Some(normals) = normals {
            mesh.normals = used.iter().map(|&v| normals.vec3(v as usize)).collect();
        }
        Ok(mesh)
    }
}

/// The vertices that triangles use, rising.
fn used_vertices(triangles: &[[u32; 3]], vertices: usize) -> Vec<u32> {
    let corners = triangles.iter().flatten().copied();
    // A table of all vertices is quick, but a small part of a large accessor must not pay for it.
    if vertices / 4 <= 3 * triangles.len() {
        let mut used = vec![false; vertices];
        corners.for_each(|v| used[v as usize] = true);
        return (0u32..)
            .zip(used)
            .filter_map(|(v, u)| u.then_some(v))
            .collect();
    }
    let mut used: Vec<u32> = corners.collect();
    used.sort_unstable();
    used.dedup();
    used
}

fn note_what_is_not_read(primitive: &Primitive, field: &str, report: &mut Report) {
    if primitive.targets.is_some() {
        report.note(Severity::Warning, "morph targets are not read", field);
    }
    let is_color = |s: &Checked<Semantic>| matches!(s, Checked::Valid(Semantic::Colors(_)));
    if primitive.attributes.keys().any(is_color) {
        report.note(Severity::Warning, "vertex colours are not read", field);
    }
}
