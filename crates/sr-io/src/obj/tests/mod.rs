//! The reader, statement by statement, without the guard against panics.

mod geometry;
mod malformed;
mod materials;

use crate::model::{Model, Part};
use crate::report::Report;
use sr_scene::diagnostics::Diagnostic;
use std::path::Path;

/// What the reader makes of a text that names no libraries.
fn try_read(bytes: &[u8]) -> Result<Model, Vec<Diagnostic>> {
    let path = Path::new("nowhere/test.obj");
    let mut report = Report::new(path);
    let model = super::read_bytes(bytes, path, &mut report);
    report.finish(model)
}

fn read(text: &str) -> Model {
    try_read(text.as_bytes()).unwrap_or_else(|e| panic!("{}", lines(&e)))
}

fn lines(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| format!("{d}\n")).collect()
}

/// The only part of a model with one node.
fn only_part(model: &Model) -> &Part {
    assert_eq!((model.nodes.len(), model.nodes[0].parts.len()), (1, 1));
    &model.nodes[0].parts[0]
}
