//! `<geometry>`: a mesh, or a sphere of the classic assignment.

use super::mesh::{Mesh, Sources, Tally, add_smooth_normals, build_part, cut};
use super::primitives::{Column, Corner, KINDS, Layout};
use super::source::Tuples;
use super::xml::{Reader, Xml, child, children, course_technique, label, path, start, tag};
use glam::DVec3;
use roxmltree::NodeId;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// What a `<geometry>` turned out to be.
pub(crate) enum Shape {
    Mesh(Mesh),
    Sphere { radius: f64 },
}

/// One primitive element, cut into triangles.
struct Cuttings {
    symbol: Option<String>,
    triangles: Vec<[Corner; 3]>,
    normals: Option<NodeId>,
    uvs: Option<NodeId>,
}

/// The sources of a mesh, each read once.
type Cache = HashMap<NodeId, Tuples>;

/// Which sources a primitive uses.
struct Inputs {
    layout: Layout,
    normals: Option<NodeId>,
    uvs: Option<NodeId>,
}

/// The inputs of a primitive that are used.
#[derive(Default)]
struct Chosen<'a> {
    /// Numbers per corner.
    stride: usize,
    /// Offset of the vertex.
    vertex: Option<usize>,
    /// Offset and input of the normals.
    normal: Option<(usize, Xml<'a>)>,
    /// Set, offset and input of the texture coordinates.
    uv: Option<(usize, usize, Xml<'a>)>,
}

impl<'a> Reader<'a> {
    /// Read a `<geometry>`; `smooth` computes normals instead of taking the file's.
    pub fn geometry(&mut self, node: Xml<'a>, smooth: bool) -> Option<Shape> {
        if let Some(mesh) = child(node, "mesh") {
            return self.mesh(node, mesh, smooth).map(Shape::Mesh);
        }
        let sphere = course_technique(node).and_then(|t| child(t, "sphere"));
        if let Some(sphere) = sphere {
            let Some(radius) = child(sphere, "radius") else {
                let message = "a <sphere> without a <radius>";
                self.diag.error(start(sphere), message, "give it one");
                return None;
            };
            let r = self.number(radius)?;
            if r <= 0.0 {
                let message = "the radius of a sphere must be above 0";
                self.diag.error(start(radius), message, "correct it");
                return None;
            }
            return Some(Shape::Sphere { radius: r });
        }
        let message = format!("geometry `{}` holds no <mesh>", label(node));
        let remedy = "it is left out";
        self.diag.fault(start(node), message, remedy);
        None
    }

    fn mesh(&mut self, geometry: Xml<'a>, mesh: Xml<'a>, smooth: bool) -> Option<Mesh> {
        let Some(vertices) = child(mesh, "vertices") else {
            let message = "a <mesh> without <vertices>";
            let hint = "the <vertices> say where the positions are";
            self.diag.error(start(mesh), message, hint);
            return None;
        };
        let mut cache = Cache::new();
        let position_input =
            children(vertices, "input").find(|i| i.attribute("semantic") == Some("POSITION"));
        let Some(position_input) = position_input else {
            let message = "<vertices> without an <input semantic=\"POSITION\">";
            self.diag
                .error(start(vertices), message, "name the source of the positions");
            return None;
        };
        let positions_id = self.source(position_input, 3, &mut cache)?;
        let mut list = Vec::new();
        let mut tally = Tally::default();
        for primitive in mesh.children().filter(|c| c.is_element()) {
            let kind = tag(primitive);
            if matches!(kind, "lines" | "linestrips") {
                let name = label(geometry);
                self.diag
                    .note(format!("dropped <{kind}> of `{name}`: nothing to render"));
            }
            if !KINDS.contains(&kind) {
                continue;
            }
            let inputs = self.inputs(primitive, vertices, positions_id, &mut cache)?;
            let polygons = self.polygons(primitive, inputs.layout)?;
            let (triangles, t) = cut(&polygons, &cache[&positions_id]);
            tally.cut += t.cut;
            tally.approximate += t.approximate;
            tally.degenerate += t.degenerate;
            if !triangles.is_empty() {
                list.push(Cuttings {
                    symbol: primitive.attribute("material").map(str::to_owned),
                    triangles,
                    normals: inputs.normals,
                    uvs: inputs.uvs,
                });
            }
        }
        self.tell(geometry, tally, &list, smooth);
        Some(assemble(
            label(geometry),
            &list,
            &cache,
            positions_id,
            smooth,
        ))
    }

    fn tell(&mut self, geometry: Xml<'a>, tally: Tally, list: &[Cuttings], smooth: bool) {
        let name = label(geometry);
        let Tally {
            cut,
            approximate,
            degenerate,
        } = tally;
        if cut > 0 {
            let text = format!("cut {cut} polygons of `{name}` into triangles");
            self.diag.note(text);
        }
        if approximate > 0 {
            self.diag.note(format!(
                "approximated {approximate} polygons of `{name}`: without area, crossing \
                 themselves, or of very many corners"
            ));
        }
        if degenerate > 0 {
            let text = format!("dropped {degenerate} polygons without area from `{name}`");
            self.diag.note(text);
        }
        if list.is_empty() {
            self.diag
                .note(format!("dropped `{name}`: it has no triangles"));
        }
        if !smooth && list.iter().any(|c| c.normals.is_none()) {
            let text = "meshes without normals in the file are flat, unless --normals smooth";
            self.diag.note(text);
        }
    }

    /// Read the source of an `<input>`, or find it in the cache.
    fn source(&mut self, input: Xml<'a>, width: usize, cache: &mut Cache) -> Option<NodeId> {
        let source = self.resolve(input, "source", &["source"])?;
        let id = source.id();
        if let Entry::Vacant(place) = cache.entry(id) {
            let tuples = self.tuples(source, width)?;
            if (0..tuples.len()).any(|i| !fits(tuples.get::<3>(i))) {
                let message = "numbers beyond the range of 32-bit floats";
                self.diag
                    .error(start(source), message, "scale the model down");
                return None;
            }
            place.insert(tuples);
        }
        Some(id)
    }

    /// Which columns of a primitive's indices mean what.
    fn inputs(
        &mut self,
        primitive: Xml<'a>,
        vertices: Xml<'a>,
        positions: NodeId,
        cache: &mut Cache,
    ) -> Option<Inputs> {
        let chosen = self.choose_inputs(primitive, vertices)?;
        let Some(offset) = chosen.vertex else {
            let message = format!(
                "<{}> without an <input semantic=\"VERTEX\">",
                tag(primitive)
            );
            let hint = "the corners need positions";
            self.diag.error(start(primitive), message, hint);
            return None;
        };
        let mut column = |offset: usize, input: Xml<'a>, width: usize| {
            let id = self.source(input, width, cache)?;
            let len = cache[&id].len();
            Some((id, Column { offset, len }))
        };
        let normal = match chosen.normal {
            Some((o, input)) => Some(column(o, input, 3)?),
            None => None,
        };
        let uv = match chosen.uv {
            Some((_, o, input)) => Some(column(o, input, 2)?),
            None => None,
        };
        let len = cache[&positions].len();
        Some(Inputs {
            layout: Layout {
                position: Column { offset, len },
                normal: normal.map(|(_, c)| c),
                uv: uv.map(|(_, c)| c),
                stride: chosen.stride,
            },
            normals: normal.map(|(id, _)| id),
            uvs: uv.map(|(id, _)| id),
        })
    }

    /// Which `<input>` to take for what, those that all corners share included.
    fn choose_inputs(&mut self, primitive: Xml<'a>, vertices: Xml<'a>) -> Option<Chosen<'a>> {
        let mut chosen = Chosen::default();
        for input in children(primitive, "input") {
            let offset = self.input_offset(input)?;
            chosen.stride = chosen.stride.max(offset + 1);
            if input.attribute("semantic") == Some("VERTEX") {
                chosen.vertex = Some(offset);
                for shared in children(vertices, "input") {
                    self.choose(&mut chosen, offset, shared)?;
                }
            }
            self.choose(&mut chosen, offset, input)?;
        }
        Some(chosen)
    }

    fn choose(&mut self, chosen: &mut Chosen<'a>, offset: usize, input: Xml<'a>) -> Option<()> {
        let set = self.count(input, "set", 0)?;
        match input.attribute("semantic") {
            Some("NORMAL") => chosen.normal = chosen.normal.or(Some((offset, input))),
            // The set with the lowest number is the first.
            Some("TEXCOORD" | "UV") if chosen.uv.is_none_or(|(first, ..)| set < first) => {
                chosen.uv = Some((set, offset, input));
            }
            Some("VERTEX" | "POSITION" | "TEXCOORD" | "UV") => {}
            other => {
                let what = other.unwrap_or("without semantic");
                self.diag.note(format!("dropped the mesh input {what}"));
            }
        }
        Some(())
    }
}

fn fits(v: [f64; 3]) -> bool {
    v.iter().all(|&x| (x as f32).is_finite())
}

fn assemble(name: &str, list: &[Cuttings], cache: &Cache, id: NodeId, smooth: bool) -> Mesh {
    let positions = &cache[&id];
    let mut by_position = Vec::new();
    if smooth {
        by_position = vec![DVec3::ZERO; positions.len()];
        for c in list {
            add_smooth_normals(&mut by_position, positions, &c.triangles);
        }
    }
    let parts = list
        .iter()
        .map(|c| {
            let sources = Sources {
                positions,
                normals: c.normals.map(|id| &cache[&id]),
                uvs: c.uvs.map(|id| &cache[&id]),
            };
            let smooth = smooth.then_some(by_position.as_slice());
            build_part(c.symbol.clone(), &c.triangles, &sources, smooth)
        })
        .collect();
    Mesh {
        name: name.to_owned(),
        parts,
    }
}

/// Does the document use the classic assignment's extensions?
pub(crate) fn uses_course_blocks(doc: &roxmltree::Document<'_>) -> bool {
    doc.descendants()
        .any(|n| n.is_element() && tag(n) == "technique" && n.attribute("profile") == Some("CGL"))
}

/// The first element at a path below the root.
pub(crate) fn below_root<'a>(reader: &Reader<'a>, names: &[&'static str]) -> Option<Xml<'a>> {
    path(reader.doc.root_element(), names)
}
