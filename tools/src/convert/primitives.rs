//! The index lists of a mesh: `<triangles>`, `<polylist>`, `<polygons>`, `<tristrips>`,
//! `<trifans>`, as polygons of corners.

use super::xml::{Reader, Xml, child, children, start, tag};

/// A corner's place in each of a mesh's sources; [`ABSENT`] where it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Corner {
    pub position: u32,
    pub normal: u32,
    pub uv: u32,
}

/// No index.
pub(crate) const ABSENT: u32 = u32::MAX;

/// The elements that hold polygons.
pub(crate) const KINDS: [&str; 5] = ["triangles", "polylist", "polygons", "tristrips", "trifans"];

/// Inputs are interleaved; more than this per corner and the file is nonsense.
const MAX_OFFSET: usize = 64;

/// Which numbers of an interleaved tuple mean what, and how large they may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    pub position: Column,
    pub normal: Option<Column>,
    pub uv: Option<Column>,
    /// Numbers per corner.
    pub stride: usize,
}

/// One number of an interleaved tuple.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    pub offset: usize,
    /// Length of the source that it points into.
    pub len: usize,
}

/// Polygons as ranges of a list of corners.
#[derive(Default)]
pub(crate) struct Polygons {
    pub corners: Vec<Corner>,
    /// Number of corners of each polygon.
    pub sizes: Vec<usize>,
}

impl Polygons {
    /// The polygons one after the other.
    pub fn iter(&self) -> impl Iterator<Item = &[Corner]> {
        let mut rest = self.corners.as_slice();
        self.sizes.iter().map(move |&n| {
            let (polygon, tail) = rest.split_at(n);
            rest = tail;
            polygon
        })
    }

    fn push(&mut self, polygon: &[Corner]) {
        self.corners.extend_from_slice(polygon);
        self.sizes.push(polygon.len());
    }
}

impl<'a> Reader<'a> {
    /// The offset of an `<input>`, within reason.
    pub fn input_offset(&mut self, input: Xml<'a>) -> Option<usize> {
        let offset = self.count(input, "offset", 0)?;
        if offset > MAX_OFFSET {
            let message = format!("an <input> with offset {offset}");
            let hint = "offsets count the inputs of one corner";
            self.diag.error(start(input), message, hint);
            return None;
        }
        Some(offset)
    }

    /// All polygons of one primitive element.
    pub fn polygons(&mut self, primitive: Xml<'a>, layout: Layout) -> Option<Polygons> {
        let mut out = Polygons::default();
        match tag(primitive) {
            "triangles" => {
                let corners = self.single_list(primitive, layout)?;
                self.whole(primitive, corners.len() % 3 == 0);
                corners.chunks_exact(3).for_each(|t| out.push(t));
            }
            "polylist" => self.polylist(primitive, layout, &mut out)?,
            "polygons" => self.polygon_elements(primitive, layout, &mut out)?,
            kind => {
                let mut strips = 0;
                for p in children(primitive, "p") {
                    let corners = self.corners(p, layout)?;
                    strips += 1;
                    for (i, t) in corners.windows(3).enumerate() {
                        match kind {
                            "trifans" => out.push(&[corners[0], t[1], t[2]]),
                            // Every other triangle of a strip turns the other way.
                            _ if i % 2 == 1 => out.push(&[t[1], t[0], t[2]]),
                            _ => out.push(t),
                        }
                    }
                }
                self.check_count(primitive, strips)?;
                return Some(out);
            }
        }
        self.check_count(primitive, out.sizes.len())?;
        Some(out)
    }

    fn polylist(&mut self, node: Xml<'a>, layout: Layout, out: &mut Polygons) -> Option<()> {
        let corners = self.single_list(node, layout)?;
        let mut sizes = Vec::new();
        if let Some(vcount) = child(node, "vcount") {
            for (at, word) in self.words(vcount) {
                let Ok(n) = word.parse::<usize>() else {
                    let hint = "<vcount> holds the number of corners of each polygon";
                    self.diag.error(at, "not a number of corners", hint);
                    return None;
                };
                sizes.push(n);
            }
        }
        let mut rest = corners.as_slice();
        let mut complete = true;
        for n in sizes {
            let Some((polygon, tail)) = rest.split_at_checked(n) else {
                complete = false;
                break;
            };
            out.push(polygon);
            rest = tail;
        }
        self.whole(node, complete && rest.is_empty());
        Some(())
    }

    fn polygon_elements(
        &mut self,
        node: Xml<'a>,
        layout: Layout,
        out: &mut Polygons,
    ) -> Option<()> {
        for p in node.children().filter(|c| c.is_element()) {
            let ring = match tag(p) {
                "p" => p,
                "ph" => {
                    let message = "a polygon with a hole";
                    let remedy = "the hole is filled";
                    self.diag.fault(start(p), message, remedy);
                    match child(p, "p") {
                        Some(outline) => outline,
                        None => continue,
                    }
                }
                _ => continue,
            };
            let corners = self.corners(ring, layout)?;
            out.push(&corners);
        }
        Some(())
    }

    /// The one `<p>` of a primitive; none at all is an empty list, as Blender writes it.
    fn single_list(&mut self, node: Xml<'a>, layout: Layout) -> Option<Vec<Corner>> {
        match child(node, "p") {
            Some(p) => self.corners(p, layout),
            None => Some(Vec::new()),
        }
    }

    fn corners(&mut self, p: Xml<'a>, layout: Layout) -> Option<Vec<Corner>> {
        let mut indices = Vec::new();
        let mut places = Vec::new();
        for (at, word) in self.words(p) {
            let Ok(i) = word.parse::<u32>() else {
                let message = "not an index: a whole number, 0 or more, is needed";
                let hint = "export the file again; indices count from 0";
                self.diag.error(at, message, hint);
                return None;
            };
            indices.push(i);
            if indices.len() % layout.stride == 1 || layout.stride == 1 {
                places.push(at);
            }
        }
        self.whole(p, indices.len() % layout.stride == 0);
        let mut out = Vec::with_capacity(indices.len() / layout.stride);
        for (tuple, &at) in indices.chunks_exact(layout.stride).zip(&places) {
            let mut pick = |column: Option<Column>, what: &str| {
                let Some(Column { offset, len }) = column else {
                    return Some(ABSENT);
                };
                let i = tuple[offset];
                if (i as usize) < len {
                    return Some(i);
                }
                let message = format!("{what} {i} of {len} does not exist");
                let hint = "indices count from 0; the file is damaged";
                self.diag.error(at, message, hint);
                None
            };
            out.push(Corner {
                position: pick(Some(layout.position), "position")?,
                normal: pick(layout.normal, "normal")?,
                uv: pick(layout.uv, "texture coordinate")?,
            });
        }
        Some(out)
    }

    fn whole(&mut self, node: Xml<'a>, is: bool) {
        if !is {
            let message = format!("the indices of <{}> do not come out even", tag(node));
            let remedy = "the incomplete polygons at the end are left out";
            self.diag.fault(start(node), message, remedy);
        }
    }

    fn check_count(&mut self, node: Xml<'a>, found: usize) -> Option<()> {
        let declared = self.count(node, "count", found)?;
        if declared != found {
            let message = format!(
                "<{}> says count=\"{declared}\" and holds {found}",
                tag(node)
            );
            let remedy = "what is there is used";
            self.diag.fault(start(node), message, remedy);
        }
        Some(())
    }
}
