//! How runs are measured: metrics, log points, what they are compared with.

use super::Experiment;
use crate::metric::Metric;
use sr_io::document::Reader;
use sr_io::ron::{Node, Value};
use sr_pipeline::diagnostics::suggest;

/// A list of names.
pub(super) fn metrics(reader: &mut Reader<'_>, node: &Node) -> Vec<Metric> {
    let Value::List(items) = &node.value else {
        reader.expected(node, "metrics", "a list such as `[RelMse, Mse]`");
        return Vec::new();
    };
    let mut metrics = Vec::new();
    for item in items {
        let Value::Name(name) = &item.value else {
            reader.expected(item, "metrics", "the name of a metric");
            continue;
        };
        let names = || Metric::ALL.into_iter().map(Metric::name);
        match Metric::ALL.into_iter().find(|m| m.name() == name) {
            Some(metric) if metrics.contains(&metric) => {
                reader.error(item.pos, "metrics", format!("`{name}` is there already"));
            }
            Some(metric) => metrics.push(metric),
            None => {
                let message = format!("there is no metric `{name}`");
                reader.error_with_hint(item.pos, "metrics", message, suggest(name, names()));
            }
        }
    }
    metrics
}

/// The label of a method, or of a value of the last axis.
pub(super) fn baseline(
    reader: &mut Reader<'_>,
    node: &Node,
    experiment: &Experiment,
) -> Option<usize> {
    let label = reader.text(node, "baseline")?;
    let contenders = experiment.contenders();
    let found = contenders.iter().position(|c| c.label == label);
    if found.is_none() {
        let what = match experiment.methods.is_empty() {
            true => "value of the last axis",
            false => "method",
        };
        let labels = contenders.iter().map(|c| c.label.as_str());
        let hint = suggest(&label, labels);
        let message = format!("there is no {what} `{label}`");
        reader.error_with_hint(node.pos, "baseline", message, hint);
    }
    found
}

/// An error above 0.
pub(super) fn target(reader: &mut Reader<'_>, node: &Node) -> Option<f64> {
    let target = positive(node);
    if target.is_none() {
        reader.expected(node, "target", "an error above 0, such as 0.01");
    }
    target
}

/// `(seconds: [1, 2, 4])`.
pub(super) fn log(reader: &mut Reader<'_>, node: &Node) -> Vec<f64> {
    let mut marks = Vec::new();
    for field in reader.fields(node, "log", &["seconds"]) {
        let what = "rising seconds above 0, such as `[1, 2, 4]`";
        let list = match &field.value.value {
            Value::List(items) => items.iter().map(positive).collect::<Option<Vec<f64>>>(),
            _ => None,
        };
        match list {
            Some(list) if !list.is_empty() && list.is_sorted_by(|a, b| a < b) => marks = list,
            _ => reader.expected(&field.value, "log.seconds", what),
        }
    }
    marks
}

fn positive(node: &Node) -> Option<f64> {
    match &node.value {
        Value::Number(n) => Some(n.to_f64()).filter(|x| x.is_finite() && *x > 0.0),
        _ => None,
    }
}
