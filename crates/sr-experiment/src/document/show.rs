//! `show`: how pictures are developed, cut, laid out and captioned.

use super::read::entry;
use super::{Axis, Show};
use sr_io::document::Reader;
use sr_io::ron::{Node, Value};
use sr_pipeline::diagnostics::suggest;

/// What stands below a picture: text with names in braces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Caption(pub Vec<Piece>);

/// A part of a caption.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// As it is.
    Text(String),
    /// What the run says.
    Value(Placeholder),
}

/// What a caption may ask for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Placeholder {
    /// The values that tell the picture from those beside it.
    Labels,
    /// The method's name.
    Method,
    /// Samples a pixel.
    Samples,
    /// Seconds of integration.
    Seconds,
    /// The metrics of the experiment.
    Error,
    /// Rays traced.
    Rays,
    /// Seed of the picture.
    Seed,
    /// The value of an axis, by its number.
    Axis(usize),
}

impl Default for Caption {
    fn default() -> Self {
        let value = |p| Piece::Value(p);
        let text = |t: &str| Piece::Text(t.into());
        Self(vec![
            value(Placeholder::Labels),
            text("\n"),
            value(Placeholder::Samples),
            text(", "),
            value(Placeholder::Seconds),
            text("\n"),
            value(Placeholder::Error),
        ])
    }
}

const FIELDS: [&str; 6] = [
    "exposure", "tone_map", "crop", "insets", "columns", "caption",
];

/// More would be no figure.
const MOST_INSETS: usize = 8;

pub(super) fn read(reader: &mut Reader<'_>, node: &Node, axes: &[Axis]) -> Show {
    let mut show = Show::default();
    for field in reader.fields(node, "show", &FIELDS) {
        let value = &field.value;
        match field.key.as_str() {
            "exposure" => show.post.push(entry("post.exposure", field.key_pos, value)),
            "tone_map" => show.post.push(entry("post.tone_map", field.key_pos, value)),
            "crop" => {
                show.crop = crop(reader, value, "show.crop");
                show.crop_at = Some(entry("show.crop", value.pos, value));
            }
            "insets" => insets(reader, value, &mut show),
            "columns" => {
                show.columns = whole(value).filter(|n| *n > 0);
                if show.columns.is_none() {
                    reader.expected(value, "show.columns", "a whole number above 0");
                }
            }
            _ => {
                if let Some(text) = reader.text(value, "show.caption") {
                    show.caption = caption(reader, value, &text, axes);
                }
            }
        }
    }
    show
}

fn whole(node: &Node) -> Option<u32> {
    match &node.value {
        Value::Number(n) => n.to_integer(),
        _ => None,
    }
}

/// A list of crops, each with its place.
fn insets(reader: &mut Reader<'_>, node: &Node, show: &mut Show) {
    let items = match &node.value {
        Value::List(items) if items.len() <= MOST_INSETS => items,
        _ => {
            let what = format!("up to {MOST_INSETS} crops as `[(x0, y0, x1, y1), …]`");
            return reader.expected(node, "show.insets", &what);
        }
    };
    for (i, item) in items.iter().enumerate() {
        let place = format!("show.insets[{i}]");
        if let Some(inset) = crop(reader, item, &place) {
            show.insets.push(inset);
            show.insets_at.push(entry(&place, item.pos, item));
        }
    }
}

fn crop(reader: &mut Reader<'_>, node: &Node, place: &str) -> Option<[u32; 4]> {
    let numbers: Option<Vec<u32>> = match &node.value {
        Value::Tuple { name: None, items } | Value::List(items) => {
            items.iter().map(whole).collect()
        }
        _ => None,
    };
    let crop: Option<[u32; 4]> = numbers.and_then(|n| n.try_into().ok());
    let Some([x0, y0, x1, y1]) = crop else {
        reader.expected(node, place, "pixels as `(x0, y0, x1, y1)`");
        return None;
    };
    if x0 >= x1 || y0 >= y1 {
        reader.error(node.pos, place, "nothing is inside");
        return None;
    }
    crop
}

/// Splits at braces; each name in them must be known.
fn caption(reader: &mut Reader<'_>, node: &Node, text: &str, axes: &[Axis]) -> Caption {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        if !before.is_empty() {
            pieces.push(Piece::Text(before.to_owned()));
        }
        let Some((name, after)) = after.split_once('}') else {
            let message = "a `{` is never closed by its `}`";
            reader.error(node.pos, "show.caption", message);
            return Caption(pieces);
        };
        match placeholder(name, axes) {
            Some(known) => pieces.push(Piece::Value(known)),
            None => {
                let axes = axes.iter().map(|a| a.short.as_str());
                let hint = suggest(name, PLACEHOLDERS.iter().map(|(n, _)| *n).chain(axes));
                let message = format!("a caption knows no `{{{name}}}`");
                reader.error_with_hint(node.pos, "show.caption", message, hint);
            }
        }
        rest = after;
    }
    if !rest.is_empty() {
        pieces.push(Piece::Text(rest.to_owned()));
    }
    Caption(pieces)
}

const PLACEHOLDERS: [(&str, Placeholder); 7] = [
    ("labels", Placeholder::Labels),
    ("method", Placeholder::Method),
    ("samples", Placeholder::Samples),
    ("seconds", Placeholder::Seconds),
    ("error", Placeholder::Error),
    ("rays", Placeholder::Rays),
    ("seed", Placeholder::Seed),
];

/// Names of ours come before those of axes, which also go by their whole path.
fn placeholder(name: &str, axes: &[Axis]) -> Option<Placeholder> {
    if let Some((_, known)) = PLACEHOLDERS.iter().find(|(n, _)| *n == name) {
        return Some(known.clone());
    }
    let axis = axes.iter().position(|a| a.short == name || a.name == name);
    axis.map(Placeholder::Axis)
}
