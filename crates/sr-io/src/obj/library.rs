//! Material libraries: finding them, reading them, and matching names.

use super::clean::Cleaner;
use super::material::{convert, grey};
use super::scan::{Place, Scan};
use crate::file;
use crate::model::Material;
use crate::report::Report;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::{Diagnostic, Severity, suggest};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The materials of a model.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// All of the libraries, and a default when a face needs it.
    pub(super) list: Vec<Material>,
    /// For each `usemtl` of the file, where its material stands in the list.
    used: Vec<usize>,
    default: Option<usize>,
}

impl Materials {
    /// The index of a `usemtl` by its number, or of the default.
    pub(super) fn index(&mut self, used: Option<usize>) -> usize {
        if let Some(i) = used.and_then(|u| self.used.get(u)) {
            return *i;
        }
        *self.default.get_or_insert_with(|| {
            self.list.push(grey("default"));
            self.list.len() - 1
        })
    }
}

/// Reads the libraries of a file and finds the materials that its faces use.
pub(super) fn load(scan: &Scan, obj: &Path, report: &mut Report) -> Materials {
    let mut library = Library::default();
    let mut complete = true;
    let mut seen = Vec::new();
    for place in &scan.libraries {
        for path in find(place, obj, report) {
            match path {
                Some(path) if seen.contains(&path) => {}
                Some(path) => {
                    library.read(&path, place, report);
                    seen.push(path);
                }
                None => complete = false,
            }
        }
    }
    let mut materials = Materials {
        list: std::mem::take(&mut library.materials),
        ..Materials::default()
    };
    for place in &scan.materials {
        let index = library
            .by_name
            .get(&place.name)
            .copied()
            .unwrap_or_else(|| {
                if !scan.libraries.is_empty() && complete {
                    let d = Diagnostic::error(format!("there is no material `{}`", place.name))
                        .at(report.span(place.line, place.column));
                    let hint = (!report.is_full()).then(|| library.suggest(&place.name));
                    report.error(Diagnostic {
                        hint: hint.flatten(),
                        ..d
                    });
                } else if scan.libraries.is_empty() {
                    let text = "the file names no `mtllib`, its materials are grey";
                    let span = report.span(place.line, place.column);
                    report.note_at(
                        Severity::Warning,
                        text,
                        format!("`{}`", place.name),
                        Some(span),
                    );
                }
                materials.list.push(grey(&place.name));
                materials.list.len() - 1
            });
        materials.used.push(index);
    }
    materials
}

/// The files that a `mtllib` names: one whose name may have spaces, or several. A missing one is
/// an error and `None`.
fn find(place: &Place, obj: &Path, report: &mut Report) -> Vec<Option<PathBuf>> {
    let folder = obj.parent().unwrap_or(Path::new(""));
    let existing = |name: &str| -> Option<PathBuf> {
        // Some programs write the separators of their system.
        [name.to_string(), name.replace('\\', "/")]
            .iter()
            .map(|n| folder.join(n))
            .find(|p| p.is_file())
    };
    if let Some(path) = existing(&place.name) {
        return vec![Some(path)];
    }
    let words: Vec<&str> = place.name.split_ascii_whitespace().collect();
    let several: Vec<Option<PathBuf>> = words.iter().map(|w| existing(w)).collect();
    if several.iter().all(Option::is_none) {
        let text = format!(
            "there is no material library `{}`",
            folder.join(&place.name).display()
        );
        report.error(Diagnostic::error(text).at(report.span(place.line, place.column)));
        return vec![None];
    }
    for (word, _) in words
        .iter()
        .zip(&several)
        .filter(|(_, path)| path.is_none())
    {
        let text = format!(
            "there is no material library `{}`",
            folder.join(word).display()
        );
        report.error(Diagnostic::error(text).at(report.span(place.line, place.column)));
    }
    several
}

/// The materials of all libraries; of equal names the last counts.
#[derive(Debug, Default)]
struct Library {
    materials: Vec<Material>,
    by_name: HashMap<String, usize>,
}

impl Library {
    /// The nearest name. Comparing takes the product of the lengths, so long names get none.
    fn suggest(&self, name: &str) -> Option<String> {
        const LONG: usize = 100;
        let names = self
            .by_name
            .keys()
            .map(String::as_str)
            .filter(|n| n.len() <= LONG);
        (name.len() <= LONG).then(|| suggest(name, names))
    }

    fn read(&mut self, path: &Path, place: &Place, report: &mut Report) {
        match file::read(path) {
            Ok(bytes) => self.read_text(&String::from_utf8_lossy(&bytes), path, report),
            Err(why) => {
                let text = format!("the material library `{}`: {why}", path.display());
                report.error(Diagnostic::error(text).at(report.span(place.line, place.column)));
            }
        }
    }

    fn read_text(&mut self, text: &str, path: &Path, report: &mut Report) {
        let clean = Cleaner::new(path, report).clean(text);
        let span = SourceSpan::file(path.into());
        let materials = match tobj::load_mtl_buf(&mut clean.as_bytes()) {
            Ok((materials, _)) => materials,
            Err(e) => {
                report.error(Diagnostic::error(format!("cannot be read: {e}")).at(span));
                return;
            }
        };
        for parsed in materials {
            let material = convert(&parsed, &span, report);
            if let Some(&i) = self.by_name.get(&parsed.name) {
                let text = "of materials of the same name the last is used";
                let what = format!("`{}`", parsed.name);
                report.note_at(Severity::Warning, text, what, Some(span.clone()));
                self.materials[i] = material;
            } else {
                self.by_name.insert(parsed.name, self.materials.len());
                self.materials.push(material);
            }
        }
    }
}

#[cfg(test)]
pub(super) fn read_library(text: &str, path: &Path, report: &mut Report) -> Vec<Material> {
    let mut library = Library::default();
    library.read_text(text, path, report);
    library.materials
}
