//! A tree back to text, on one line: for provenance and messages.

use super::cursor::{is_identifier_continue, is_identifier_start};
use super::{Node, Value};
use std::fmt;

/// Text in quotes, with the escapes that RON reads.
pub fn quote(text: &str) -> String {
    let mut quoted = String::with_capacity(text.len() + 2);
    quoted.push('"');
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\r' => quoted.push_str("\\r"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() => quoted.push_str(&format!("\\u{{{:x}}}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// Whether RON reads it as an identifier without `r#`.
pub fn is_identifier(text: &str) -> bool {
    text.starts_with(is_identifier_start) && text.chars().all(is_identifier_continue)
}

fn write_identifier(f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
    let raw = if is_identifier(name) { "" } else { "r#" };
    write!(f, "{raw}{name}")
}

fn write_items<T>(
    f: &mut fmt::Formatter<'_>,
    brackets: [&str; 2],
    items: &[T],
    write: impl Fn(&mut fmt::Formatter<'_>, &T) -> fmt::Result,
) -> fmt::Result {
    f.write_str(brackets[0])?;
    for (i, item) in items.iter().enumerate() {
        if i > 0 {
            f.write_str(", ")?;
        }
        write(f, item)?;
    }
    f.write_str(brackets[1])
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit => f.write_str("()"),
            Self::Bool(b) => write!(f, "{b}"),
            Self::Number(n) => write!(f, "{n}"),
            Self::Char('\'') => f.write_str("'\\''"),
            Self::Char(c) if c.is_control() => write!(f, "'\\u{{{:x}}}'", u32::from(*c)),
            Self::Char('\\') => f.write_str("'\\\\'"),
            Self::Char(c) => write!(f, "'{c}'"),
            Self::String(s) => f.write_str(&quote(s)),
            Self::None => f.write_str("None"),
            Self::Some(value) => write!(f, "Some({value})"),
            Self::Name(name) => write_identifier(f, name),
            Self::Struct { name, fields } => {
                name.iter().try_for_each(|n| write_identifier(f, n))?;
                write_items(f, ["(", ")"], fields, |f, field| {
                    write_identifier(f, &field.key)?;
                    write!(f, ": {}", field.value)
                })
            }
            Self::Tuple { name, items } => {
                name.iter().try_for_each(|n| write_identifier(f, n))?;
                write_items(f, ["(", ")"], items, |f, item| write!(f, "{item}"))
            }
            Self::List(items) => write_items(f, ["[", "]"], items, |f, item| write!(f, "{item}")),
            Self::Map(entries) => {
                write_items(f, ["{", "}"], entries, |f, (k, v)| write!(f, "{k}: {v}"))
            }
        }
    }
}
