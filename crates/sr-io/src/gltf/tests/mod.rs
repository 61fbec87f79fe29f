//! Fixtures are written here, byte by byte, so that each test says what its file holds.

mod builder;
mod features;
mod geometry;
mod malformed;
mod materials;
mod mutation;

use crate::model::{Model, Part};
use crate::report::Report;
use sr_scene::diagnostics::Diagnostic;
use std::path::Path;

/// What the reader makes of bytes, without the guard against panics.
fn try_read(bytes: &[u8]) -> Result<Model, Vec<Diagnostic>> {
    let path = Path::new("nowhere/test.gltf");
    let mut report = Report::new(path);
    let model = super::read_bytes(bytes, path, &mut report).unwrap_or_default();
    report.finish(model)
}

fn read(bytes: &[u8]) -> Model {
    try_read(bytes).unwrap_or_else(|e| panic!("{}", lines(&e)))
}

fn lines(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| format!("{d}\n")).collect()
}

/// All errors of a file that must not be read.
fn errors(bytes: &[u8]) -> String {
    let errors = try_read(bytes).expect_err("the file is not valid");
    assert!(!errors.is_empty());
    for e in &errors {
        assert!(e.to_string().starts_with("nowhere/test.gltf"), "{e}");
    }
    lines(&errors)
}

/// The only part of a model with one node.
fn only_part(model: &Model) -> &Part {
    assert_eq!((model.nodes.len(), model.nodes[0].parts.len()), (1, 1));
    &model.nodes[0].parts[0]
}
