//! Access to the XML tree: elements by local name, numbers with their place, references.
//!
//! Namespaces are ignored: files by hand often lack the right one, and nothing in COLLADA has
//! the same local name in two.

use super::diagnostics::Diagnostics;
use roxmltree::{Document, Node};
use std::collections::HashMap;

/// An element of the document.
pub(crate) type Xml<'a> = Node<'a, 'a>;

/// Nodes that a document may have; each takes some hundred bytes of memory.
const NODES_LIMIT: u32 = 4_000_000;

/// Parse a text whose byte order mark has been taken off.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, roxmltree::Error> {
    let options = roxmltree::ParsingOptions {
        nodes_limit: NODES_LIMIT,
        ..Default::default()
    };
    Document::parse_with_options(text, options)
}

/// The element children with a local name.
pub(crate) fn children<'a>(node: Xml<'a>, name: &'static str) -> impl Iterator<Item = Xml<'a>> {
    node.children()
        .filter(move |c| c.is_element() && c.tag_name().name() == name)
}

/// The first element child with a local name.
pub(crate) fn child<'a>(node: Xml<'a>, name: &'static str) -> Option<Xml<'a>> {
    children(node, name).next()
}

/// The element at the end of a path of first children.
pub(crate) fn path<'a>(node: Xml<'a>, names: &[&'static str]) -> Option<Xml<'a>> {
    names.iter().try_fold(node, |n, name| child(n, name))
}

/// The local name of an element.
pub(crate) fn tag<'a>(node: Xml<'a>) -> &'a str {
    node.tag_name().name()
}

/// How to call an element when talking about it: its name, or its id, or its tag.
pub(crate) fn label<'a>(node: Xml<'a>) -> &'a str {
    node.attribute("name")
        .filter(|s| !s.is_empty())
        .or_else(|| node.attribute("id"))
        .unwrap_or_else(|| tag(node))
}

/// The `<technique>` of the classic assignment among the `<extra>` children of an element.
pub(crate) fn course_technique<'a>(node: Xml<'a>) -> Option<Xml<'a>> {
    children(node, "extra")
        .flat_map(|e| children(e, "technique"))
        .find(|t| t.attribute("profile") == Some("CGL"))
}

/// The open document and what has been found out about it.
pub(crate) struct Reader<'a> {
    pub doc: &'a Document<'a>,
    pub diag: Diagnostics<'a>,
    ids: HashMap<&'a str, Xml<'a>>,
}

impl<'a> Reader<'a> {
    pub fn new(doc: &'a Document<'a>, lenient: bool) -> Self {
        let mut reader = Self {
            doc,
            diag: Diagnostics::new(doc.input_text(), lenient),
            ids: HashMap::new(),
        };
        for node in doc.descendants().filter(|n| n.is_element()) {
            let Some(id) = node.attribute("id") else {
                continue;
            };
            if reader.ids.contains_key(id) {
                let message = format!("the id `{id}` is used twice");
                let remedy = "the first element of that id is meant";
                reader.diag.fault(start(node), message, remedy);
            } else {
                reader.ids.insert(id, node);
            }
        }
        reader
    }

    /// The element that an attribute such as `url="#id"` points to, of one of the wanted kinds.
    pub fn resolve(&mut self, node: Xml<'a>, attribute: &str, wanted: &[&str]) -> Option<Xml<'a>> {
        let Some(reference) = node.attribute(attribute) else {
            let message = format!("<{}> has no `{attribute}`", tag(node));
            let hint = format!("name a <{}> as `#id`", wanted.join("> or <"));
            self.diag.error(start(node), message, hint);
            return None;
        };
        let at = node
            .attribute_node(attribute)
            .map_or(start(node), |a| a.range_value().start);
        let Some(id) = reference.strip_prefix('#') else {
            let message = format!("`{reference}` points into another file");
            let hint = "only references of the form `#id` are read; merge the files first";
            self.diag.error(at, message, hint);
            return None;
        };
        match self.ids.get(id) {
            Some(found) if wanted.contains(&tag(*found)) => Some(*found),
            Some(found) => {
                let (is, want) = (tag(*found), wanted.join("> or <"));
                let message = format!("`#{id}` is a <{is}>, a <{want}> is needed");
                self.diag
                    .error(at, message, "point it to the right element");
                None
            }
            None => {
                let message = format!("nothing in the file has the id `{id}`");
                let hint = self.nearest(id, wanted);
                self.diag.error(at, message, hint);
                None
            }
        }
    }

    fn nearest(&self, id: &str, wanted: &[&str]) -> String {
        let mut candidates: Vec<&str> = self
            .ids
            .iter()
            .filter(|(_, n)| wanted.contains(&tag(**n)))
            .map(|(id, _)| *id)
            .take(1000)
            .collect();
        candidates.sort_unstable();
        candidates.sort_by_key(|c| edit_distance(c, id));
        match candidates.first() {
            Some(best) => format!("did you mean `#{best}`?"),
            None => format!("the file has no <{}> at all", wanted.join("> or <")),
        }
    }

    /// The words of an element's text with their byte offsets. Comments in between are skipped.
    pub fn words(&self, node: Xml<'a>) -> impl Iterator<Item = (usize, &'a str)> + use<'a> {
        let input = self.doc.input_text();
        let (base, size) = (input.as_ptr() as usize, input.len());
        node.children()
            .filter(|c| c.is_text())
            .flat_map(move |text| {
                let fallback = text.range().start;
                let words = text.text().unwrap_or_default().split_ascii_whitespace();
                words.map(move |w| {
                    // The text is a slice of the input, except where an entity was expanded.
                    let offset = (w.as_ptr() as usize).wrapping_sub(base);
                    (if offset < size { offset } else { fallback }, w)
                })
            })
    }

    /// All numbers in an element's text; `None` when one of them is not a number.
    pub fn floats(&mut self, node: Xml<'a>) -> Option<Vec<f64>> {
        let mut out = Vec::new();
        let mut good = true;
        for (at, word) in self.words(node) {
            match word.parse::<f64>() {
                Ok(x) if x.is_finite() => out.push(x),
                Ok(_) => {
                    let message = format!("`{word}` is not a finite number");
                    self.diag.fault(at, message, "0 is taken");
                    out.push(0.0);
                }
                Err(_) if good => {
                    let message = format!("`{}` is not a number", shortened(word));
                    let hint = "numbers are separated by blanks and have a decimal point";
                    self.diag.error(at, message, hint);
                    good = false;
                }
                Err(_) => {}
            }
        }
        good.then_some(out)
    }

    /// A fixed number of numbers.
    pub fn array<const N: usize>(&mut self, node: Xml<'a>) -> Option<[f64; N]> {
        let values = self.floats(node)?;
        if let Ok(array) = values.as_slice().try_into() {
            return Some(array);
        }
        let message = format!(
            "<{}> holds {} numbers, {N} are needed",
            tag(node),
            values.len()
        );
        self.diag
            .error(start(node), message, "correct the number of values");
        None
    }

    /// One number.
    pub fn number(&mut self, node: Xml<'a>) -> Option<f64> {
        self.array::<1>(node).map(|[x]| x)
    }

    /// A number in an attribute; `default` when it is absent.
    pub fn count(&mut self, node: Xml<'a>, attribute: &str, default: usize) -> Option<usize> {
        let Some(attr) = node.attribute_node(attribute) else {
            return Some(default);
        };
        let parsed = attr.value().trim().parse();
        if parsed.is_err() {
            let message = format!(
                "`{attribute}=\"{}\"` is not a count",
                shortened(attr.value())
            );
            let hint = "a whole number, 0 or more, is needed";
            self.diag.error(attr.range_value().start, message, hint);
        }
        parsed.ok()
    }

    /// A colour of three numbers, or four of which the last (alpha) is left out.
    pub fn color(&mut self, node: Xml<'a>) -> Option<[f64; 3]> {
        let values = self.floats(node)?;
        let (&[r, g, b] | &[r, g, b, _]) = values.as_slice() else {
            let n = values.len();
            let message = format!("a colour of {n} numbers; 3 or 4 are needed");
            let hint = "write red, green and blue, and alpha if need be";
            self.diag.error(start(node), message, hint);
            return None;
        };
        let color = [r, g, b];
        if color.iter().any(|&x| x < 0.0) {
            let message = "a colour below 0";
            self.diag.fault(start(node), message, "0 is taken");
        }
        Some(color.map(|x| x.max(0.0)))
    }
}

/// Where an element begins.
pub(crate) fn start(node: Xml<'_>) -> usize {
    node.range().start
}

/// A word for a message.
fn shortened(word: &str) -> String {
    let mut s: String = word.chars().take(30).collect();
    if s.len() < word.len() {
        s.push('…');
    }
    s
}

/// Levenshtein distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().take(64).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &cb) in b.iter().enumerate() {
            let change = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = change.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
