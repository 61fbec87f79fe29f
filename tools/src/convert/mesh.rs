//! Triangle meshes out of polygons: cutting, shared vertices, normals.

use super::polygon::{Cut, triangulate};
use super::primitives::{ABSENT, Corner, Polygons};
use super::source::Tuples;
use glam::DVec3;
use std::collections::HashMap;

/// A mesh in the frame of its file.
#[derive(Debug)]
pub(crate) struct Mesh {
    pub name: String,
    pub parts: Vec<Part>,
}

/// The triangles of one primitive element: one material.
#[derive(Debug)]
pub(crate) struct Part {
    /// The name by which a node binds a material.
    pub symbol: Option<String>,
    pub positions: Vec<DVec3>,
    /// Unit length; `None` leaves them to the reader of the mesh.
    pub normals: Option<Vec<DVec3>>,
    /// With v downwards, as glTF has it.
    pub uvs: Option<Vec<[f64; 2]>>,
    pub triangles: Vec<[u32; 3]>,
}

/// What cutting a primitive came across.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    /// Polygons of more than three corners.
    pub cut: usize,
    /// Of these, the ones without area or crossing themselves.
    pub approximate: usize,
    /// Polygons of fewer than three corners, and triangles that use a position twice.
    pub degenerate: usize,
}

/// The sources that corners point into.
pub(crate) struct Sources<'s> {
    pub positions: &'s Tuples,
    pub normals: Option<&'s Tuples>,
    pub uvs: Option<&'s Tuples>,
}

/// Cut polygons into triangles of corners.
pub(crate) fn cut(polygons: &Polygons, positions: &Tuples) -> (Vec<[Corner; 3]>, Tally) {
    let mut triangles = Vec::new();
    let mut tally = Tally::default();
    let (mut points, mut local) = (Vec::new(), Vec::new());
    for polygon in polygons.iter() {
        local.clear();
        points.clear();
        points.extend(polygon.iter().map(|c| position(positions, c.position)));
        if triangulate(&points, &mut local) == Cut::Approximate {
            tally.approximate += 1;
        }
        tally.cut += usize::from(polygon.len() > 3);
        tally.degenerate += usize::from(polygon.len() < 3);
        for t in &local {
            let [a, b, c] = t.map(|i| polygon[i]);
            if a.position == b.position || b.position == c.position || c.position == a.position {
                tally.degenerate += 1;
            } else {
                triangles.push([a, b, c]);
            }
        }
    }
    (triangles, tally)
}

fn position(positions: &Tuples, i: u32) -> DVec3 {
    DVec3::from_array(positions.get(i as usize))
}

/// Twice the area vector of a triangle.
fn area_vector(positions: &Tuples, t: &[Corner; 3]) -> DVec3 {
    let [a, b, c] = t.map(|c| position(positions, c.position));
    (b - a).cross(c - a)
}

/// Normals by position: the sum of the area vectors of the triangles around, not yet of unit
/// length. Positions that are written twice are two positions.
pub(crate) fn add_smooth_normals(sum: &mut [DVec3], positions: &Tuples, list: &[[Corner; 3]]) {
    for t in list {
        let n = area_vector(positions, t);
        for corner in t {
            sum[corner.position as usize] += n;
        }
    }
}

/// Vertices and indices out of triangles of corners. `smooth` are normals by position, of any
/// length, that take the place of the file's.
pub(crate) fn build_part(
    symbol: Option<String>,
    list: &[[Corner; 3]],
    sources: &Sources<'_>,
    smooth: Option<&[DVec3]>,
) -> Part {
    let key = |mut corner: Corner| {
        if smooth.is_some() {
            corner.normal = ABSENT;
        }
        corner
    };
    let mut vertices: Vec<Corner> = Vec::new();
    let mut seen: HashMap<Corner, u32> = HashMap::new();
    let mut triangles = Vec::with_capacity(list.len());
    for t in list {
        triangles.push(t.map(|corner| {
            *seen.entry(key(corner)).or_insert_with(|| {
                vertices.push(key(corner));
                // Fewer vertices than index words in the text of the file, of which the reader
                // takes less than 4 GiB.
                (vertices.len() - 1) as u32
            })
        }));
    }
    let normals = match (smooth, sources.normals) {
        (Some(by_position), _) => Some(
            vertices
                .iter()
                .map(|v| by_position[v.position as usize])
                .collect::<Vec<_>>(),
        ),
        (None, Some(normals)) => Some(
            vertices
                .iter()
                .map(|v| DVec3::from_array(normals.get(v.normal as usize)))
                .collect(),
        ),
        (None, None) => None,
    };
    let normals = normals.map(|n| repair_normals(n, &triangles, list, sources.positions));
    Part {
        symbol,
        positions: vertices
            .iter()
            .map(|v| position(sources.positions, v.position))
            .collect(),
        normals,
        uvs: sources.uvs.map(|uvs| {
            let flip = |[s, t]: [f64; 2]| [s, 1.0 - t];
            vertices
                .iter()
                .map(|v| flip(uvs.get(v.uv as usize)))
                .collect()
        }),
        triangles,
    }
}

/// Normals of unit length. Those that have none get the area-weighted normal of their triangles,
/// and +Z where even that is nothing.
fn repair_normals(
    normals: Vec<DVec3>,
    triangles: &[[u32; 3]],
    list: &[[Corner; 3]],
    positions: &Tuples,
) -> Vec<DVec3> {
    let unit: Vec<Option<DVec3>> = normals.iter().map(|n| n.try_normalize()).collect();
    let mut fallback = Vec::new();
    if unit.contains(&None) {
        fallback = vec![DVec3::ZERO; normals.len()];
        for (t, corners) in triangles.iter().zip(list) {
            let n = area_vector(positions, corners);
            for &v in t {
                fallback[v as usize] += n;
            }
        }
    }
    unit.into_iter()
        .enumerate()
        .map(|(i, n)| n.unwrap_or_else(|| fallback[i].normalize_or(DVec3::Z)))
        .collect()
}
