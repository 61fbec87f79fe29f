//! Rusty Object Notation into a tree in which every value knows its place.
//!
//! Why not the `ron` crate alone: a user wants *all* problems of a file in one go, each with line,
//! column, the path of the field and the nearest valid name. `serde` stops at the first error, and
//! `ron::Value` drops the names of structs and variants and every position. So the text becomes a
//! tree here, and [`reflect`](crate::reflect) walks the tree and goes on after a mistake. The
//! `ron` crate is the oracle of the tests: both accept the same documents.
//!
//! The grammar is that of RON 0.12 less byte strings and ranges, which nothing in a scene takes.
//! Syntax ends at the first error. Values nest at most [`MAX_DEPTH`] deep; memory is linear in the
//! length of the text.

mod cursor;
mod literal;
mod number;
mod parser;
mod write;

pub use number::Number;
pub use parser::parse;
pub use write::{is_identifier, quote};

use std::fmt;

/// Values nest at most this deep, so that no file can exhaust the stack.
pub const MAX_DEPTH: usize = 128;

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pos {
    /// Line from 1.
    pub line: u32,
    /// Column from 1, in characters.
    pub column: u32,
}

/// A value and where it begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What is written.
    pub value: Value,
    /// Where it begins.
    pub pos: Pos,
}

/// A named field of a struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub key: String,
    /// Where the name begins.
    pub key_pos: Pos,
    /// What it is set to.
    pub value: Node,
}

/// What can be written.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `()`
    Unit,
    /// `true`, `false`
    Bool(bool),
    /// `1`, `0.5`, `0xff`, `inf`
    Number(Number),
    /// `'x'`
    Char(char),
    /// `"text"`, `r#"text"#`
    String(String),
    /// `None`
    None,
    /// `Some(value)`
    Some(Box<Node>),
    /// `Name`
    Name(String),
    /// `(a: 1)` or `Name(a: 1)`
    Struct {
        /// What stands before the parenthesis.
        name: Option<String>,
        /// In the order of the text, repeated ones included.
        fields: Vec<Field>,
    },
    /// `(1, 2)` or `Name(1, 2)` or `Name()`
    Tuple {
        /// What stands before the parenthesis.
        name: Option<String>,
        /// In the order of the text.
        items: Vec<Node>,
    },
    /// `[1, 2]`
    List(Vec<Node>),
    /// `{"a": 1}`: key and value, in the order of the text, repeated keys included.
    Map(Vec<(Node, Node)>),
}

impl Value {
    /// What it is, for "expected a number, found ...".
    pub fn describe(&self) -> String {
        match self {
            Self::Unit => "`()`".into(),
            Self::Bool(b) => format!("`{b}`"),
            Self::Number(n) => format!("the number {n}"),
            Self::Char(c) => format!("the character {c:?}"),
            Self::String(s) => format!("the text {}", quote(s)),
            Self::None => "`None`".into(),
            Self::Some(_) => "`Some(…)`".into(),
            Self::Name(n) => format!("the name `{n}`"),
            Self::Struct { name: Some(n), .. } | Self::Tuple { name: Some(n), .. } => {
                format!("`{n}(…)`")
            }
            Self::Struct { .. } => "named fields `(…: …)`".into(),
            Self::Tuple { items, .. } => format!("a tuple of {}", items.len()),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Map(_) => "a map `{…}`".into(),
        }
    }
}

/// The text is not RON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// Where.
    pub pos: Pos,
    /// What was expected and what stands there.
    pub message: String,
}

impl fmt::Display for SyntaxError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.pos.line, self.pos.column, self.message)
    }
}

impl std::error::Error for SyntaxError {}

#[cfg(test)]
mod tests;
