//! What varies: axes by path, zips of several paths, methods.

use super::read::entry;
use super::{Axis, Setting};
use sr_io::document::{Reader, join};
use sr_io::ron::{Node, Value};
use std::collections::HashSet;

/// More axes than this nobody could look at.
pub(super) const MOST_AXES: usize = 64;

/// Characters of a value that a label shows.
const LONGEST_LABEL: usize = 40;

/// `{"path": [values], "path": {"label": value}}`.
pub(super) fn axes(reader: &mut Reader<'_>, node: &Node) -> Vec<Axis> {
    let what = "paths and their values as `{\"path\": [value, …], …}`";
    let mut axes = Vec::new();
    for (path, pos, value) in reader.entries(node, "axes", what) {
        let place = join("axes", path);
        let setting = |label: String, value: &Node| Setting {
            label,
            changes: vec![entry(path, pos, value)],
        };
        let settings: Vec<Setting> = match &value.value {
            Value::List(items) => items.iter().map(|v| setting(label(v), v)).collect(),
            Value::Map(_) => reader
                .entries(value, &place, "labels and values")
                .into_iter()
                .map(|(label, _, v)| setting(label.to_owned(), v))
                .collect(),
            _ => {
                let what = "values as `[value, …]` or `{\"label\": value, …}`";
                reader.expected(value, &place, what);
                continue;
            }
        };
        check(reader, value, &place, &settings);
        axes.push(Axis {
            name: path.to_owned(),
            short: String::new(),
            settings,
        });
    }
    axes
}

/// `{"name": {"label": {"path": value, …}, …}, …}`.
pub(super) fn zips(reader: &mut Reader<'_>, node: &Node) -> Vec<Axis> {
    let what = "axes as `{\"name\": {\"label\": {\"path\": value, …}, …}, …}`";
    let mut axes = Vec::new();
    for (name, _, value) in reader.entries(node, "zip", what) {
        axes.push(Axis {
            name: join("zip", name),
            short: name.to_owned(),
            settings: settings(reader, value, &join("zip", name)),
        });
    }
    axes
}

/// `{"label": {"path": value, …}, …}`.
pub(super) fn settings(reader: &mut Reader<'_>, node: &Node, place: &str) -> Vec<Setting> {
    let what = "names and changes as `{\"name\": {\"path\": value, …}, …}`";
    let before = reader.diagnostics.len();
    let mut settings = Vec::new();
    for (label, _, value) in reader.entries(node, place, what) {
        settings.push(Setting {
            label: label.to_owned(),
            changes: reader.overrides(value, &join(place, label)),
        });
    }
    if reader.diagnostics.len() == before {
        check(reader, node, place, &settings);
    }
    settings
}

/// Something must be there, and no label twice: labels tell rows of data apart.
fn check(reader: &mut Reader<'_>, node: &Node, place: &str, settings: &[Setting]) {
    if settings.is_empty() {
        reader.error(node.pos, place, "there is no value");
    }
    let mut known = HashSet::new();
    for setting in settings {
        if !known.insert(&setting.label) {
            let pos = setting.changes.first().map_or(node.pos, |c| c.value.pos);
            let message = format!("the value {} is there already", setting.label);
            reader.error(pos, place, message);
        }
    }
}

/// Text as it is, everything else as RON, cut when it is long.
fn label(node: &Node) -> String {
    let text = match &node.value {
        Value::String(text) => text.clone(),
        _ => node.to_string(),
    };
    if text.chars().count() <= LONGEST_LABEL {
        return text;
    }
    let start: String = text.chars().take(LONGEST_LABEL - 1).collect();
    format!("{start}…")
}

/// Gives axes by path the shortest end of their path that tells them from the others. At most
/// [`MOST_AXES`] are named; more have been reported.
pub(super) fn name(axes: &mut [Axis]) {
    let all: Vec<String> = axes.iter().map(|a| a.name.clone()).collect();
    for (i, axis) in axes.iter_mut().enumerate().take(MOST_AXES) {
        if !axis.short.is_empty() {
            continue;
        }
        // Each other path, and how many bytes it has in common at the end.
        let others = all.iter().enumerate().filter(|(j, _)| *j != i);
        let others: Vec<(&[u8], usize)> = others
            .map(|(_, other)| (other.as_bytes(), common_end(&axis.name, other)))
            .collect();
        let is_other_end = |end: &str| {
            others.iter().any(|(other, common)| {
                let before = other.len().checked_sub(end.len() + 1);
                *common >= end.len() && before.is_none_or(|b| other[b] == b'.')
            })
        };
        let ends = axis
            .name
            .rmatch_indices('.')
            .map(|(at, _)| &axis.name[at + 1..]);
        let short = ends.into_iter().find(|end| !is_other_end(end));
        axis.short = short.unwrap_or(&axis.name).to_owned();
    }
}

/// Bytes that two texts have in common at their ends.
fn common_end(a: &str, b: &str) -> usize {
    let pairs = a.bytes().rev().zip(b.bytes().rev());
    pairs.take_while(|(a, b)| a == b).count()
}
