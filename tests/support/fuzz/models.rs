//! Model files: what comes out is bounded, finite and whole.

use super::Fate;
use super::scratch::with_file;
use super::texts::refused;
use sr_io::model::{Model, Part};
use sr_pipeline::diagnostics::Diagnostic;
use sr_tools::convert::{Options, convert};

pub(super) fn gltf(bytes: &[u8]) -> Fate {
    let model = with_file("damaged.gltf", bytes, sr_io::gltf::read);
    judge(model, |model| {
        let size: usize = parts(model)
            .map(|p| 24 * p.mesh.positions.len() + 12 * p.mesh.indices.len())
            .sum();
        assert!(
            size <= (64 << 20) + 512 * (bytes.len() + 128),
            "{size} bytes of meshes"
        );
    })
}

pub(super) fn obj(bytes: &[u8]) -> Fate {
    let model = with_file("damaged.obj", bytes, sr_io::obj::read);
    judge(model, |model| {
        for part in parts(model) {
            // A corner takes two bytes at least.
            assert!(part.mesh.indices.len() < bytes.len());
            assert!(part.mesh.positions.len() < bytes.len());
        }
    })
}

/// A library of materials, for a model that uses two of them.
pub(super) fn mtl(bytes: &[u8]) -> Fate {
    let model = "mtllib damaged.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n";
    let model = with_file("damaged.mtl", bytes, |_| {
        with_file("library.obj", model.as_bytes(), sr_io::obj::read)
    });
    judge(model, |model| {
        // The default, and what the library has.
        assert!(model.materials.len() <= bytes.len() + 1);
    })
}

fn parts(model: &Model) -> impl Iterator<Item = &Part> {
    model.nodes.iter().flat_map(|n| &n.parts)
}

/// Looks at a model that was read, or at the reasons why there is none.
fn judge(model: Result<Model, Vec<Diagnostic>>, further: impl FnOnce(&Model)) -> Fate {
    let model = match model {
        Ok(model) => model,
        Err(errors) => return refused(&errors),
    };
    for (i, node) in model.nodes.iter().enumerate() {
        assert!(node.parent.is_none_or(|p| p < i), "children before parents");
    }
    for part in parts(&model) {
        let (mesh, vertices) = (&part.mesh, part.mesh.positions.len());
        assert!(
            mesh.indices
                .iter()
                .flatten()
                .all(|v| (*v as usize) < vertices)
        );
        assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
        assert!(mesh.normals.is_empty() || mesh.normals.len() == vertices);
        let is_unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5;
        assert!(mesh.normals.iter().all(is_unit));
        assert!(part.material.is_some_and(|m| m < model.materials.len()));
    }
    further(&model);
    Fate::Read
}

/// Both ways to convert: strictly, and letting pass what can be passed over. What comes out is read by
/// the renderer's own reader.
pub(super) fn collada(bytes: &[u8]) -> Fate {
    let fates = [false, true].map(|lenient| {
        let options = Options {
            lenient,
            ..Default::default()
        };
        match convert(bytes, "damaged.dae", &options) {
            Ok(converted) => {
                let ron = sr_io::ron::parse(&converted.ron);
                assert!(ron.is_ok(), "the scene file is no RON: {ron:?}");
                let model = with_file("converted.glb", &converted.glb, sr_io::gltf::read);
                assert!(model.is_ok(), "the .glb is refused: {:?}", model.err());
                Fate::Read
            }
            Err(problems) => {
                assert!(!problems.is_empty(), "no reason is given");
                assert!(problems.iter().all(|p| p.line > 0 && p.column > 0));
                Fate::Refused(format!("{}", problems[0]))
            }
        }
    });
    let [strict, lenient] = fates;
    assert!(
        strict != Fate::Read || lenient == Fate::Read,
        "lenient is not stricter"
    );
    strict
}
