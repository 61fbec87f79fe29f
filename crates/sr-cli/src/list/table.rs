//! Text in columns.

use super::fields::Field;
use std::fmt;

/// Longer entries do not widen their column, they push what follows to the right.
const WIDEST: usize = 28;

/// Headings, each with rows of path, type, default and documentation below.
#[derive(Default)]
pub struct Table {
    blocks: Vec<Block>,
}

struct Block {
    head: String,
    docs: String,
    fields: Vec<Field>,
}

impl Table {
    /// Starts a block.
    pub fn head(&mut self, head: &str, docs: &str) {
        self.blocks.push(Block {
            head: head.into(),
            docs: docs.into(),
            fields: Vec::new(),
        });
    }

    /// Adds rows to the last block.
    pub fn fields(&mut self, fields: Vec<Field>) {
        if let Some(block) = self.blocks.last_mut() {
            block.fields.extend(fields);
        }
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heads = widest(self.blocks.iter().map(|b| b.head.as_str()));
        let rows = || self.blocks.iter().flat_map(|b| &b.fields);
        let paths = rows().map(|r| r.path.chars().count()).max().unwrap_or(0);
        let kinds = widest(rows().map(|r| r.kind.as_str()));
        let defaults = widest(rows().map(|r| r.default.as_str()));
        for (i, Block { head, docs, fields }) in self.blocks.iter().enumerate() {
            if i > 0 && !fields.is_empty() {
                writeln!(f)?;
            }
            writeln!(f, "{}", format!("{head:heads$}  {docs}").trim_end())?;
            for row in fields {
                let Field {
                    path,
                    kind,
                    default,
                    docs,
                } = row;
                let line = format!("  {path:paths$}  {kind:kinds$}  {default:defaults$}  {docs}");
                writeln!(f, "{}", line.trim_end())?;
            }
        }
        Ok(())
    }
}

fn widest<'a>(texts: impl Iterator<Item = &'a str>) -> usize {
    texts
        .map(|t| t.chars().count())
        .filter(|w| *w <= WIDEST)
        .max()
        .unwrap_or(0)
}
