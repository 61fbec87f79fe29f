//! What a reader has to say about one model file.

use crate::model::Model;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Errors listed for one file; a broken file can have as many as it has lines.
const LISTED_ERRORS: usize = 100;

/// Collects errors and notes, so that all problems of a file come in one go.
pub(crate) struct Report {
    file: Arc<Path>,
    errors: Vec<Diagnostic>,
    unlisted_errors: usize,
    notes: Vec<Note>,
    note_index: HashMap<String, usize>,
}

/// A note and how often it applies.
struct Note {
    diagnostic: Diagnostic,
    first: String,
    count: usize,
}

impl Report {
    /// An empty one for a file as the user named it.
    pub(crate) fn new(file: &Path) -> Self {
        Self {
            file: file.into(),
            errors: Vec::new(),
            unlisted_errors: 0,
            notes: Vec::new(),
            note_index: HashMap::new(),
        }
    }

    /// A place in the file.
    pub(crate) fn span(&self, line: u32, column: u32) -> SourceSpan {
        SourceSpan {
            file: self.file.clone(),
            line,
            column,
        }
    }

    /// Adds an error; without a place it gets the file.
    pub(crate) fn error(&mut self, mut d: Diagnostic) {
        if self.is_full() {
            self.unlisted_errors += 1;
            return;
        }
        d.span
            .get_or_insert_with(|| SourceSpan::file(self.file.clone()));
        self.errors.push(d);
    }

    /// Whether there is any error yet.
    pub(crate) fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    /// Whether further errors are counted only.
    pub(crate) fn is_full(&self) -> bool {
        self.errors.len() == LISTED_ERRORS
    }

    /// A warning or notice about `what`; the same message is said once, with a count.
    pub(crate) fn note(&mut self, severity: Severity, message: &str, what: impl Into<String>) {
        self.note_at(severity, message, what, None);
    }

    /// As [`Report::note`], with the place of the first one.
    pub(crate) fn note_at(
        &mut self,
        severity: Severity,
        message: &str,
        what: impl Into<String>,
        span: Option<SourceSpan>,
    ) {
        if let Some(&i) = self.note_index.get(message) {
            self.notes[i].count += 1;
            return;
        }
        let span = span.unwrap_or_else(|| SourceSpan::file(self.file.clone()));
        self.note_index
            .insert(message.to_string(), self.notes.len());
        self.notes.push(Note {
            diagnostic: Diagnostic::new(severity, message).at(span),
            first: what.into(),
            count: 1,
        });
    }

    /// The model with its notes, or all errors.
    pub(crate) fn finish(mut self, model: Model) -> Result<Model, Vec<Diagnostic>> {
        if !self.errors.is_empty() {
            if self.unlisted_errors > 0 {
                let more = format!("and {} more errors", self.unlisted_errors);
                let span = SourceSpan::file(self.file.clone());
                self.errors.push(Diagnostic::error(more).at(span));
            }
            return Err(self.errors);
        }
        let notes = self.notes.into_iter().map(Note::finish).collect();
        Ok(Model { notes, ..model })
    }
}

impl Note {
    fn finish(self) -> Diagnostic {
        let Note {
            mut diagnostic,
            first,
            count,
        } = self;
        let message = &mut diagnostic.message;
        match (first.is_empty(), count) {
            (true, _) => {}
            (false, 1) => *message += &format!(" ({first})"),
            (false, n) => *message += &format!(" ({first} and {} more)", n - 1),
        }
        diagnostic
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_note_is_said_once_and_counted() {
        let mut r = Report::new(Path::new("a.obj"));
        for what in ["`x`", "`y`", "`z`"] {
            r.note(Severity::Warning, "not read", what);
        }
        let model = r.finish(Model::default()).unwrap();
        assert_eq!(model.notes.len(), 1);
        assert_eq!(
            model.notes[0].to_string(),
            "a.obj: warning: not read (`x` and 2 more)"
        );
    }

    #[test]
    fn errors_beyond_the_list_are_counted() {
        let mut r = Report::new(Path::new("a.obj"));
        for i in 0..LISTED_ERRORS + 5 {
            r.error(Diagnostic::error(format!("{i}")));
        }
        let errors = r.finish(Model::default()).unwrap_err();
        assert_eq!(errors.len(), LISTED_ERRORS + 1);
        assert_eq!(
            errors[LISTED_ERRORS].to_string(),
            "a.obj: error: and 5 more errors"
        );
    }
}
