//! Nodes (§3.5): which of them are in the picture, in what order, and where they stand.
//!
//! The specification wants nodes to be disjoint trees. A document is free to say otherwise, so
//! that is checked first; afterwards a plain walk visits each node once.

use super::placed;
use super::primitive::Meshes;
use crate::model::Node;
use crate::report::Report;
use glam::{DQuat, EulerRot};
use gltf::json::{Root, scene::Node as NodeJson};
use sr_scene::components::LocalTransform;
use sr_scene::diagnostics::{Diagnostic, Severity};

/// The nodes of the default scene, or of the first one, or all when the file has no scene.
pub(super) fn read(root: &Root, meshes: &mut Meshes<'_>, report: &mut Report) -> Vec<Node> {
    let Some(parents) = parents(root, report) else {
        return Vec::new();
    };
    let Some(roots) = roots(root, &parents, report) else {
        return Vec::new();
    };
    let order = walk(root, &roots);
    let mut uses = vec![0usize; root.meshes.len()];
    for mesh in order.iter().filter_map(|&(n, _)| root.nodes[n].mesh) {
        uses[mesh.value()] += 1;
    }
    let mut nodes = Vec::with_capacity(order.len());
    for (n, parent) in order {
        let json = &root.nodes[n];
        let transform = transform(json).unwrap_or_else(|why| {
            report.error(Diagnostic::error(why).field(format!("nodes[{n}]")));
            LocalTransform::default()
        });
        if json.matrix.is_some() && has_trs(json) {
            let text = "a node has both a matrix and other placement; the matrix is used";
            report.note(Severity::Warning, text, format!("nodes[{n}]"));
        }
        let parts = json.mesh.map_or_else(Vec::new, |m| {
            uses[m.value()] -= 1;
            meshes.instance(m.value(), uses[m.value()] == 0, report)
        });
        nodes.push(Node {
            name: name(root, json),
            parent,
            transform,
            parts,
            camera: json
                .camera
                .and_then(|c| placed::camera(root, c.value(), report)),
            light: placed::light(root, json, report),
        });
    }
    nodes
}

/// The parent of each node, or `None` when a node has two or is above itself.
fn parents(root: &Root, report: &mut Report) -> Option<Vec<Option<usize>>> {
    let mut parents = vec![None; root.nodes.len()];
    let mut sound = true;
    for (n, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten().map(|c| c.value()) {
            if let Some(other) = parents[child].replace(n) {
                sound = false;
                let text = format!("node {child} is a child of node {other} already");
                report.error(Diagnostic::error(text).field(format!("nodes[{n}].children")));
            }
        }
    }
    if !sound {
        return None;
    }
    // With one parent each, what cannot be reached from a root stands in a cycle.
    let tops: Vec<usize> = (0..parents.len())
        .filter(|&n| parents[n].is_none())
        .collect();
    let mut reached = vec![false; parents.len()];
    for (n, _) in walk(root, &tops) {
        reached[n] = true;
    }
    if let Some(n) = reached.iter().position(|r| !r) {
        let text = "this node is its own ancestor";
        report.error(Diagnostic::error(text).field(format!("nodes[{n}]")));
        return None;
    }
    Some(parents)
}

/// The nodes at the top of the scene.
fn roots(root: &Root, parents: &[Option<usize>], report: &mut Report) -> Option<Vec<usize>> {
    let all = || {
        (0..parents.len())
            .filter(|&n| parents[n].is_none())
            .collect()
    };
    let s = root.scene.map_or(0, |s| s.value());
    let Some(scene) = root.scenes.get(s) else {
        return Some(all());
    };
    if root.scenes.len() > 1 {
        let text = format!(
            "the file has {} scenes, only scene {s} is read",
            root.scenes.len()
        );
        report.note(Severity::Notice, &text, "");
    }
    let roots: Vec<usize> = scene.nodes.iter().map(|n| n.value()).collect();
    let mut seen = vec![false; parents.len()];
    let mut sound = true;
    for &n in &roots {
        let twice = std::mem::replace(&mut seen[n], true);
        if twice || parents[n].is_some() {
            sound = false;
            let text = match twice {
                true => format!("node {n} is listed twice"),
                false => format!("node {n} has a parent, so it cannot be at the top of a scene"),
            };
            report.error(Diagnostic::error(text).field(format!("scenes[{s}].nodes")));
        }
    }
    sound.then_some(roots)
}

/// Nodes below `roots`, depth first, each with the position of its parent in the result. Needs
/// every node to have at most one parent; a list instead of recursion, as files can be deep.
fn walk(root: &Root, roots: &[usize]) -> Vec<(usize, Option<usize>)> {
    let mut order = Vec::new();
    let mut open: Vec<(usize, Option<usize>)> = roots.iter().rev().map(|&n| (n, None)).collect();
    while let Some((n, parent)) = open.pop() {
        let here = order.len();
        order.push((n, parent));
        let children = root.nodes[n].children.iter().flatten().rev();
        open.extend(children.map(|c| (c.value(), Some(here))));
    }
    order
}

/// The node's name, or else that of what it carries.
fn name(root: &Root, node: &NodeJson) -> String {
    let of_mesh = || root.meshes[node.mesh?.value()].name.clone();
    let of_camera = || root.cameras[node.camera?.value()].name.clone();
    node.name
        .clone()
        .or_else(of_mesh)
        .or_else(of_camera)
        .or_else(|| placed::light_name(root, node))
        .unwrap_or_default()
}

fn has_trs(node: &NodeJson) -> bool {
    node.translation.is_some() || node.rotation.is_some() || node.scale.is_some()
}

fn transform(node: &NodeJson) -> Result<LocalTransform, String> {
    if let Some(m) = node.matrix {
        finite("matrix", &m)?;
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            return Err("`matrix` is not affine: its last row must be 0 0 0 1".into());
        }
        return Ok(LocalTransform::from_matrix(m.map(f64::from)));
    }
    let translate = node.translation.unwrap_or_default();
    let scale = node.scale.unwrap_or([1.0; 3]);
    let rotation = node.rotation.unwrap_or_default().0;
    finite("translation", &translate)?;
    finite("scale", &scale)?;
    finite("rotation", &rotation)?;
    Ok(LocalTransform {
        translate: translate.map(f64::from),
        rotate_deg: angles(rotation)?,
        scale: scale.map(f64::from),
        matrix: None,
    })
}

/// A quaternion (x, y, z, w) as angles about x, y and z in degrees, so that people can override
/// one of them. Its length is of no account, as it only comes from rounding.
fn angles(q: [f32; 4]) -> Result<[f64; 3], String> {
    let q = DQuat::from_array(q.map(f64::from));
    let length = q.length();
    if length == 0.0 {
        return Err("`rotation` is a quaternion of length 0".into());
    }
    let (z, y, x) = (q * (1.0 / length)).to_euler(EulerRot::ZYX);
    Ok([x, y, z].map(f64::to_degrees))
}

fn finite(field: &str, numbers: &[f32]) -> Result<(), String> {
    match numbers.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(format!("`{field}` has {x}, which is not finite")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;

    #[test]
    fn angles_give_the_rotation_of_the_quaternion() {
        let h = std::f32::consts::FRAC_1_SQRT_2;
        let mut quaternions = vec![
            [0.0, 0.0, 0.0, 1.0],
            // Straight up and down, where the angles are not unique.
            [0.0, h, 0.0, h],
            [0.0, -h, 0.0, h],
            [0.5, 0.5, 0.5, 0.5],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, h, h, 0.0],
        ];
        let mut state = 7u32;
        let mut random = || {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        quaternions.extend((0..1000).map(|_| [random(), random(), random(), random()]));
        for q in quaternions {
            let t = LocalTransform {
                rotate_deg: angles(q).unwrap(),
                ..LocalTransform::default()
            };
            let wanted = DMat4::from_quat(DQuat::from_array(q.map(f64::from)).normalize());
            // Straight up, f64 trigonometry leaves some 1e-8: the square root of its rounding.
            let error = (t.to_matrix() - wanted).to_cols_array().map(f64::abs);
            assert!(error.iter().all(|e| *e < 1e-7), "{q:?}: {error:?}");
        }
    }
}
