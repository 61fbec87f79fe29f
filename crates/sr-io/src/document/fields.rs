//! Closed structs by hand: known fields, each at most once.

use super::OverrideEntry;
use crate::reflect::Origin;
use crate::ron::{Field, Node, Pos, Value};
use sr_scene::diagnostics::{Diagnostic, suggest};

/// Reads closed structs of one file and goes on after a mistake.
pub struct Reader<'a> {
    /// The file.
    pub origin: &'a Origin,
    /// Where mistakes go.
    pub diagnostics: &'a mut Vec<Diagnostic>,
}

impl Reader<'_> {
    /// Adds an error about a field.
    pub fn error(&mut self, pos: Pos, field: &str, message: impl Into<String>) {
        let diagnostic = Diagnostic::error(message)
            .at(self.origin.span(pos))
            .field(field);
        self.diagnostics.push(diagnostic);
    }

    /// Adds an error with advice.
    pub fn error_with_hint(
        &mut self,
        pos: Pos,
        field: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        let diagnostic = Diagnostic::error(message)
            .at(self.origin.span(pos))
            .field(field)
            .hint(hint);
        self.diagnostics.push(diagnostic);
    }

    /// Reports a value of the wrong kind.
    pub fn expected(&mut self, node: &Node, field: &str, what: &str) {
        let message = format!("expected {what}, found {}", node.value.describe());
        self.error(node.pos, field, message);
    }

    /// The fields of a struct that are `known` and set once; others are reported.
    pub fn fields<'n>(&mut self, node: &'n Node, path: &str, known: &[&str]) -> Vec<&'n Field> {
        let fields = match &node.value {
            Value::Struct { name: None, fields } => fields.as_slice(),
            Value::Unit => &[],
            _ => {
                self.expected(node, path, "named fields as `(field: value, …)`");
                &[]
            }
        };
        let mut seen: Vec<&Field> = Vec::new();
        for field in fields {
            let path = join(path, &field.key);
            if !known.contains(&field.key.as_str()) {
                let hint = suggest(&field.key, known.iter().copied());
                self.error_with_hint(field.key_pos, &path, "unknown field", hint);
            } else if seen.iter().any(|f| f.key == field.key) {
                self.error(field.key_pos, &path, "the field is set twice");
            } else {
                seen.push(field);
            }
        }
        seen
    }

    /// A text that is not empty.
    pub fn text(&mut self, node: &Node, path: &str) -> Option<String> {
        match &node.value {
            Value::String(text) if text.is_empty() => {
                self.error(node.pos, path, "the text is empty");
                None
            }
            Value::String(text) => Some(text.clone()),
            _ => {
                self.expected(node, path, "a text");
                None
            }
        }
    }

    /// The entries of a map from texts, repeated keys reported and left out.
    pub fn entries<'n>(
        &mut self,
        node: &'n Node,
        path: &str,
        what: &str,
    ) -> Vec<(&'n str, Pos, &'n Node)> {
        let Value::Map(entries) = &node.value else {
            self.expected(node, path, what);
            return Vec::new();
        };
        let mut known = std::collections::HashSet::new();
        let mut kept = Vec::new();
        for (key, value) in entries {
            let text = match &key.value {
                Value::String(text) if !text.is_empty() => text,
                Value::Name(text) => text,
                _ => {
                    self.expected(key, path, "a name as a text");
                    continue;
                }
            };
            if known.insert(text.as_str()) {
                kept.push((text.as_str(), key.pos, value));
            } else {
                self.error(key.pos, &join(path, text), "the name is there already");
            }
        }
        kept
    }

    /// Values by path.
    pub fn overrides(&mut self, node: &Node, path: &str) -> Vec<OverrideEntry> {
        self.entries(node, path, "paths and values as `{\"path\": value, …}`")
            .into_iter()
            .map(|(path, pos, value)| OverrideEntry {
                path: path.to_owned(),
                pos,
                value: value.clone(),
            })
            .collect()
    }
}

/// The path of a field of what `path` leads to.
pub fn join(path: &str, field: &str) -> String {
    if path.is_empty() {
        field.to_owned()
    } else {
        format!("{path}.{field}")
    }
}
