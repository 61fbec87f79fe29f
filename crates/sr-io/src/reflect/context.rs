//! What applying a tree needs to know, and where its complaints go.

use super::Places;
use crate::ron::{Node, Pos};
use bevy_ecs::entity::Entity;
use bevy_reflect::TypeRegistry;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::Diagnostic;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where a tree was written.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The file, or the name of a command line's option.
    pub name: Arc<Path>,
    /// The folder that relative paths start from.
    pub folder: PathBuf,
    /// Whether it is a file, so that line and column mean something. On a command line they do
    /// not, and a bare word is as good as a text in quotes, which shells take off.
    pub is_file: bool,
}

impl Origin {
    /// A file as the user named it.
    pub fn file(path: &Path) -> Self {
        Self {
            name: path.into(),
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            is_file: true,
        }
    }

    /// An option of the command line, such as `--set`.
    pub fn option(name: &str) -> Self {
        Self {
            name: Path::new(name).into(),
            folder: PathBuf::new(),
            is_file: false,
        }
    }

    /// A place in it.
    pub fn span(&self, pos: Pos) -> SourceSpan {
        if self.is_file {
            SourceSpan {
                file: self.name.clone(),
                line: pos.line,
                column: pos.column,
            }
        } else {
            SourceSpan::file(self.name.clone())
        }
    }
}

/// The way to a field, written `entities.gold.Conductor.eta[2]`.
#[derive(Clone, Copy)]
pub enum FieldPath<'a> {
    /// Where it starts; may be empty.
    Root(&'a str),
    /// A named field.
    Field(&'a FieldPath<'a>, &'a str),
    /// A place in an array, tuple or list.
    Index(&'a FieldPath<'a>, usize),
}

impl fmt::Display for FieldPath<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Root(root) => f.write_str(root),
            Self::Field(FieldPath::Root(""), name) => f.write_str(name),
            Self::Field(parent, name) => write!(f, "{parent}.{name}"),
            Self::Index(parent, index) => write!(f, "{parent}[{index}]"),
        }
    }
}

/// What an entity's name turns out to be.
pub type Resolved = Result<Entity, Option<String>>;

/// Applies trees of one origin.
pub struct Context<'a> {
    /// Types and their defaults.
    pub registry: &'a TypeRegistry,
    /// Where the trees were written.
    pub origin: &'a Origin,
    /// The entity of a name; or a hint about the nearest names; or nothing at all, when the name
    /// belongs to a file that could not be read, of which the user is told already.
    pub entity: &'a dyn Fn(&str) -> Resolved,
    /// Where each field was set.
    pub places: &'a mut Places,
    /// What is wrong.
    pub diagnostics: &'a mut Vec<Diagnostic>,
    /// Set when a name stood for no entity, so that the value holds a placeholder.
    pub unresolved: bool,
}

impl Context<'_> {
    /// Reports an error at a place of the tree.
    pub fn error(&mut self, pos: Pos, path: &FieldPath<'_>, message: impl Into<String>) {
        self.report(pos, path, message, None);
    }

    /// Reports an error with advice.
    pub fn error_with_hint(
        &mut self,
        pos: Pos,
        path: &FieldPath<'_>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.report(pos, path, message, Some(hint.into()));
    }

    /// Reports a value of the wrong kind.
    pub(super) fn expected(&mut self, what: &str, node: &Node, path: &FieldPath<'_>) {
        let message = format!("expected {what}, found {}", node.value.describe());
        self.error(node.pos, path, message);
    }

    fn report(
        &mut self,
        pos: Pos,
        path: &FieldPath<'_>,
        message: impl Into<String>,
        hint: Option<String>,
    ) {
        self.places.mark_faulty(path.to_string());
        let mut diagnostic = Diagnostic::error(message)
            .at(self.origin.span(pos))
            .field(path.to_string());
        diagnostic.hint = hint;
        self.diagnostics.push(diagnostic);
    }
}
