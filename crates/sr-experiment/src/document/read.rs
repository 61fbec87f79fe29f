//! The frame of an experiment file: which fields there are, and what each holds.

use super::{Attachment, Experiment, ReferenceSpec, Show, axes, measuring, show, stability, stem};
use crate::metric::Metric;
use sr_io::document::{OverrideEntry, Reader, join};
use sr_io::nearest_file;
use sr_io::reflect::Origin;
use sr_io::ron::{self, Node, Pos, Value};
use sr_pipeline::diagnostics::Diagnostic;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// How the names of experiment files end.
pub const EXTENSION: &str = ".exp.ron";

/// More bytes are no experiment that somebody wrote.
const LARGEST_FILE: u64 = 16 << 20;

/// More pictures are a slip of the pen, and could not even be listed.
const MOST_RUNS: usize = 10_000;

const FIELDS: [&str; 17] = [
    "title",
    "note",
    "base",
    "set",
    "axes",
    "zip",
    "methods",
    "baseline",
    "seeds",
    "budget",
    "log",
    "reference",
    "metrics",
    "target",
    "show",
    "attach",
    "stability",
];

/// Reads an experiment file.
///
/// # Errors
/// Everything that is wrong with its frame, each with its place. Values by path are looked at when
/// runs are loaded.
pub fn read(path: &Path) -> Result<Experiment, Vec<Diagnostic>> {
    let text = text_of(path).map_err(|message| {
        let mut diagnostic = Diagnostic::error(format!("`{}`: {message}", path.display()));
        diagnostic.hint = missing_hint(path);
        vec![diagnostic]
    })?;
    parse(path, &text)
}

fn text_of(path: &Path) -> Result<String, String> {
    let meta = std::fs::metadata(path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => format!("cannot be read: {e}"),
    })?;
    if !meta.is_file() {
        return Err("is not a file".into());
    }
    if meta.len() > LARGEST_FILE {
        return Err(format!("{} bytes are too many", meta.len()));
    }
    let bytes = std::fs::read(path).map_err(|e| format!("cannot be read: {e}"))?;
    String::from_utf8(bytes).map_err(|_| "the file is no UTF-8 text".to_owned())
}

fn missing_hint(path: &Path) -> Option<String> {
    let near = (!path.exists()).then(|| nearest_file(path)).flatten()?;
    Some(format!("did you mean `{}`?", near.display()))
}

/// Reads the text of an experiment file.
pub(super) fn parse(path: &Path, text: &str) -> Result<Experiment, Vec<Diagnostic>> {
    let origin = Origin::file(path);
    let mut diagnostics = Vec::new();
    let mut reader = Reader {
        origin: &origin,
        diagnostics: &mut diagnostics,
    };
    let experiment = match ron::parse(text) {
        Ok(node) => document(&mut reader, &node, text),
        Err(error) => {
            reader.error(error.pos, "", error.message);
            None
        }
    };
    match experiment {
        Some(experiment) if diagnostics.is_empty() => Ok(experiment),
        _ => Err(diagnostics),
    }
}

/// `None` when something is missing without which there is no experiment.
fn document(reader: &mut Reader<'_>, node: &Node, text: &str) -> Option<Experiment> {
    let mut experiment = Experiment {
        origin: reader.origin.clone(),
        text: text.to_owned(),
        title: stem(reader.origin),
        note: String::new(),
        base: PathBuf::new(),
        set: Vec::new(),
        axes: Vec::new(),
        methods: Vec::new(),
        baseline: None,
        target: None,
        log_seconds: Vec::new(),
        seeds: Vec::new(),
        budget: None,
        reference: None,
        metrics: vec![Metric::RelMse],
        show: Show::default(),
        attach: Vec::new(),
        stability: None,
    };
    let fields = reader.fields(node, "", &FIELDS);
    for field in &fields {
        let value = &field.value;
        match field.key.as_str() {
            "title" => experiment.title = reader.text(value, "title").unwrap_or_default(),
            "note" => experiment.note = reader.text(value, "note").unwrap_or_default(),
            "base" => experiment.base = file(reader, value, "base").unwrap_or_default(),
            "set" => experiment.set = reader.overrides(value, "set"),
            "axes" => experiment.axes.extend(axes::axes(reader, value)),
            "zip" => experiment.axes.extend(axes::zips(reader, value)),
            "methods" => experiment.methods = axes::settings(reader, value, "methods"),
            "seeds" => experiment.seeds = seeds(reader, value),
            "budget" => experiment.budget = Some(entry("budget", field.key_pos, value)),
            "reference" => experiment.reference = reference(reader, value),
            "metrics" => experiment.metrics = measuring::metrics(reader, value),
            "target" => experiment.target = measuring::target(reader, value),
            "log" => experiment.log_seconds = measuring::log(reader, value),
            "attach" => experiment.attach = attachments(reader, value),
            // These name axes and methods, which may stand further down.
            _ => {}
        }
    }
    axes::name(&mut experiment.axes);
    let count = experiment.axes.len();
    if count > axes::MOST_AXES {
        let most = axes::MOST_AXES;
        let message = format!("these are {count} axes; at most {most} can be shown");
        reader.error(node.pos, "axes", message);
    }
    if let Some(field) = fields.iter().find(|f| f.key == "baseline") {
        experiment.baseline = measuring::baseline(reader, &field.value, &experiment);
    }
    if let Some(field) = fields.iter().find(|f| f.key == "show") {
        experiment.show = show::read(reader, &field.value, &experiment.axes);
    }
    if let Some(field) = fields.iter().find(|f| f.key == "stability") {
        experiment.stability = stability::read(reader, &field.value, &experiment);
    }
    let values = experiment.axes.iter().map(|a| a.settings.len());
    let others = [
        experiment.methods.len().max(1),
        experiment.seeds.len().max(1),
    ];
    let runs = values.chain(others).fold(1, usize::saturating_mul);
    if runs > MOST_RUNS {
        let message = format!("these are {runs} runs; at most {MOST_RUNS} make sense");
        reader.error(node.pos, "axes", message);
    }
    if fields.iter().all(|f| f.key != "base") {
        reader.error_with_hint(
            node.pos,
            "base",
            "an experiment needs a base",
            "add `base: \"path/to/a.ron\"`, a configuration, scene or model",
        );
        return None;
    }
    Some(experiment)
}

pub(super) fn entry(path: &str, pos: Pos, value: &Node) -> OverrideEntry {
    OverrideEntry {
        path: path.into(),
        pos,
        value: value.clone(),
    }
}

/// A file that is there, relative to the experiment's folder.
fn file(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<PathBuf> {
    let text = reader.text(node, path)?;
    let file = reader.origin.folder.join(text);
    if file.is_file() {
        return Some(file);
    }
    let message = if file.exists() {
        format!("`{}` is not a file", file.display())
    } else {
        format!("`{}`: there is no such file", file.display())
    };
    match missing_hint(&file) {
        Some(hint) => reader.error_with_hint(node.pos, path, message, hint),
        None => reader.error(node.pos, path, message),
    }
    None
}

/// `8` for seeds 0 to 7, or a list of them.
fn seeds(reader: &mut Reader<'_>, node: &Node) -> Vec<u64> {
    const MOST: u64 = MOST_RUNS as u64;
    let seeds = match &node.value {
        Value::Number(n) => match n.to_integer() {
            Some(count @ 1..=MOST) => return (0..count).collect(),
            _ => None,
        },
        Value::List(items) => items
            .iter()
            .map(|n| match &n.value {
                Value::Number(n) => n.to_integer(),
                _ => None,
            })
            .collect::<Option<Vec<u64>>>(),
        _ => None,
    };
    let Some(seeds) = seeds.filter(|s| !s.is_empty()) else {
        let what = format!("a number of seeds from 1 to {MOST}, or a list of seeds");
        reader.expected(node, "seeds", &what);
        return Vec::new();
    };
    let mut known = HashSet::new();
    let repeated = seeds.iter().position(|seed| !known.insert(seed));
    if let (Some(i), Value::List(items)) = (repeated, &node.value) {
        let message = format!("seed {} is there already", seeds[i]);
        reader.error(items[i].pos, "seeds", message);
    }
    seeds
}

/// `(file: "x.exr")`, or `(integrator: Path(), samples: 4096, set: {…})`.
fn reference(reader: &mut Reader<'_>, node: &Node) -> Option<ReferenceSpec> {
    let before = reader.diagnostics.len();
    let known = ["file", "integrator", "samples", "seconds", "set"];
    let fields = reader.fields(node, "reference", &known);
    if let Some(field) = fields.iter().find(|f| f.key == "file") {
        if let Some(other) = fields.iter().find(|f| f.key != "file") {
            let path = join("reference", &other.key);
            let message = "a file is not rendered, so it has no settings";
            reader.error(other.key_pos, &path, message);
        }
        let path = file(reader, &field.value, "reference.file")?;
        let change = entry("reference.file", field.value.pos, &field.value);
        return Some(ReferenceSpec::File { path, change });
    }
    let has_budget = fields
        .iter()
        .any(|f| f.key == "samples" || f.key == "seconds");
    // A slip of the pen may have been the budget.
    if !has_budget && reader.diagnostics.len() == before {
        reader.error_with_hint(
            node.pos,
            "reference",
            "a reference needs a file or a budget",
            "write `(file: \"x.exr\")` or `(samples: 4096)`",
        );
    }
    let mut changes = Vec::new();
    for field in &fields {
        let mut push = |path: &str| changes.push(entry(path, field.key_pos, &field.value));
        match field.key.as_str() {
            "integrator" => push("integrator"),
            "samples" => push("budget.samples"),
            "seconds" => push("budget.seconds"),
            _ => changes.extend(reader.overrides(&field.value, "reference.set")),
        }
    }
    Some(ReferenceSpec::Render(changes))
}

/// An exposure that leaves something of any picture.
fn stops(node: &Node) -> Option<f32> {
    match &node.value {
        Value::Number(n) => Some(n.to_f32()).filter(|x| x.abs() <= 30.0),
        _ => None,
    }
}

fn attachments(reader: &mut Reader<'_>, node: &Node) -> Vec<Attachment> {
    let Value::List(items) = &node.value else {
        let what = "a list as `[(file: \"…\", caption: \"…\")]`";
        reader.expected(node, "attach", what);
        return Vec::new();
    };
    let mut attachments = Vec::new();
    for (i, item) in items.iter().enumerate() {
        let place = format!("attach[{i}]");
        let before = reader.diagnostics.len();
        let (mut picture, mut caption, mut exposure) = (None, String::new(), None);
        for field in reader.fields(item, &place, &["file", "caption", "exposure"]) {
            let place = join(&place, &field.key);
            match field.key.as_str() {
                "file" => {
                    let change = entry(&place, field.value.pos, &field.value);
                    picture = file(reader, &field.value, &place).map(|path| (path, change));
                }
                "exposure" => {
                    exposure = stops(&field.value);
                    if exposure.is_none() {
                        reader.expected(&field.value, &place, "a number of stops, -30 to 30");
                    }
                }
                _ => caption = reader.text(&field.value, &place).unwrap_or_default(),
            }
        }
        match picture {
            Some((path, change)) => attachments.push(Attachment {
                path,
                caption,
                exposure,
                change,
            }),
            None if reader.diagnostics.len() == before => {
                reader.error(item.pos, &place, "an attachment needs a `file`");
            }
            None => {}
        }
    }
    attachments
}
