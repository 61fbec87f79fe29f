//! A table of a page: a heading a column, and cells that know by what they are sorted.

use super::markup::escape;
use std::fmt::Write;

/// A table.
#[derive(Default)]
pub(super) struct Table {
    heads: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

/// What stands in a place, and its number if it is one.
#[derive(Clone, Default)]
pub(super) struct Cell {
    text: String,
    key: Option<f64>,
}

impl Cell {
    /// Sorted by its letters.
    pub fn text(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            key: None,
        }
    }

    /// Sorted by a number; a dash when there is none.
    pub fn number(key: Option<f64>, text: impl Fn(f64) -> String) -> Self {
        Self {
            text: key.map_or("–".into(), text),
            key,
        }
    }

    /// A label that is a number is sorted as one.
    pub fn label(text: &str) -> Self {
        Self {
            key: text.parse().ok().filter(|x: &f64| x.is_finite()),
            text: text.to_owned(),
        }
    }
}

impl Table {
    pub fn new(heads: Vec<String>) -> Self {
        Self {
            heads,
            rows: Vec::new(),
        }
    }

    /// As many cells as there are heads.
    pub fn row(&mut self, cells: Vec<Cell>) {
        self.rows.push(cells);
    }

    /// Without the columns that have nothing in any row.
    pub fn html(&self, id: &str) -> String {
        let empty = |c: &usize| self.rows.iter().all(|r| r[*c].text == "–");
        let columns: Vec<usize> = (0..self.heads.len()).filter(|c| !empty(c)).collect();
        let mut text =
            format!("<div class=\"wide\">\n<table id=\"{id}\" class=\"sortable\">\n<thead><tr>");
        for c in &columns {
            let _ = write!(text, "<th scope=\"col\">{}</th>", escape(&self.heads[*c]));
        }
        text.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            text.push_str("<tr>");
            for c in &columns {
                let cell = &row[*c];
                let key = cell.key.map(|k| format!(" data-key=\"{k}\""));
                let key = key.unwrap_or_default();
                let _ = write!(text, "<td{key}>{}</td>", escape(&cell.text));
            }
            text.push_str("</tr>\n");
        }
        text + "</tbody>\n</table>\n</div>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_without_anything_are_left_out() {
        let mut table = Table::new(["a", "b", "<c>"].map(String::from).to_vec());
        let twice = |x: f64| format!("{}", 2.0 * x);
        table.row(vec![
            Cell::text("x & y"),
            Cell::number(None, twice),
            Cell::number(Some(0.5), twice),
        ]);
        table.row(vec![
            Cell::label("1e3"),
            Cell::number(None, twice),
            Cell::number(None, twice),
        ]);
        let html = table.html("t");
        assert!(
            html.contains("<th scope=\"col\">a</th><th scope=\"col\">&lt;c&gt;</th></tr>"),
            "{html}"
        );
        assert!(
            html.contains("<tr><td>x &amp; y</td><td data-key=\"0.5\">1</td></tr>"),
            "{html}"
        );
        assert!(
            html.contains("<tr><td data-key=\"1000\">1e3</td><td>–</td></tr>"),
            "{html}"
        );
    }
}
