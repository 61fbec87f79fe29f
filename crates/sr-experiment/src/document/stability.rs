//! `stability`: an experiment whose pictures have a mean that is known, or the same mean throughout.

use super::Experiment;
use sr_io::document::{Reader, join};
use sr_io::ron::{Node, Value};

/// What makes an experiment a check of numerical stability: one axis, whose labels are numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// What the axis is called in plots; its short name unless given.
    pub parameter: String,
    /// The axis' values as numbers, for plots and `holds`.
    pub at: Vec<f64>,
    /// What the mean of each picture should be.
    pub truth: Truth,
    /// The largest relative error of the mean that is promised.
    pub bound: f64,
    /// From which value of the parameter to which, ends included, it is promised.
    pub holds: [f64; 2],
    /// It takes too long to be run every time.
    pub long: bool,
}

/// The mean luminance that a picture should have.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// These, one a value of the axis.
    Mean(Vec<f64>),
    /// That of the first method at the same value; without methods that of the first value.
    First,
}

const FIELDS: [&str; 5] = ["parameter", "truth", "bound", "holds", "long"];

/// `(parameter: "albedo", truth: Mean([2, 10]), bound: 0.02, holds: (0.5, 0.9))`; `None` when something
/// is wrong, which has been told.
pub(super) fn read(
    reader: &mut Reader<'_>,
    node: &Node,
    experiment: &Experiment,
) -> Option<Stability> {
    let before = reader.diagnostics.len();
    let fields = reader.fields(node, "stability", &FIELDS);
    let at = axis_values(reader, node, experiment);
    let mut found = Stability {
        parameter: experiment.axes.first()?.short.clone(),
        truth: Truth::First,
        bound: f64::NAN,
        holds: [f64::NEG_INFINITY, f64::INFINITY],
        long: false,
        at,
    };
    for field in &fields {
        let (value, place) = (&field.value, join("stability", &field.key));
        match field.key.as_str() {
            "parameter" => found.parameter = reader.text(value, &place).unwrap_or_default(),
            "truth" => match truth(value, found.at.len()) {
                Some(truth) => found.truth = truth,
                None => {
                    let what = format!(
                        "`First`, or `Mean([…])` with {} numbers above 0, one a value of the axis",
                        found.at.len()
                    );
                    reader.expected(value, &place, &what);
                }
            },
            "bound" => match number(value).filter(|b| *b >= 0.0) {
                Some(bound) => found.bound = bound,
                None => reader.expected(value, &place, "a relative error such as 0.02"),
            },
            "holds" => match pair(value) {
                Some(holds) => found.holds = holds,
                None => reader.expected(value, &place, "two rising numbers such as `(0, 0.999)`"),
            },
            _ => match value.value {
                Value::Bool(long) => found.long = long,
                _ => reader.expected(value, &place, "`true` or `false`"),
            },
        }
    }
    for needed in ["truth", "bound"] {
        if fields.iter().all(|f| f.key != needed) && reader.diagnostics.len() == before {
            let place = join("stability", needed);
            let message = format!("a check of stability needs a `{needed}`");
            reader.error_with_hint(node.pos, &place, message, "see docs/stability.md");
        }
    }
    (reader.diagnostics.len() == before).then_some(found)
}

/// The labels of the one axis as numbers.
fn axis_values(reader: &mut Reader<'_>, node: &Node, experiment: &Experiment) -> Vec<f64> {
    let [axis] = experiment.axes.as_slice() else {
        let message = format!(
            "a check of stability has one axis, and this file has {}",
            experiment.axes.len()
        );
        reader.error(node.pos, "stability", message);
        return Vec::new();
    };
    let mut values = Vec::new();
    for setting in &axis.settings {
        match setting.label.parse::<f64>() {
            Ok(x) if x.is_finite() => values.push(x),
            _ => {
                let label = &setting.label;
                let message = format!("the value {label} of the axis is no number to plot at");
                let pos = setting.changes.first().map_or(node.pos, |c| c.value.pos);
                let hint = "give the values numbers as labels: `{\"0.5\": (0.5, 0.5, 0.5), …}`";
                reader.error_with_hint(pos, "stability", message, hint);
            }
        }
    }
    values
}

fn truth(node: &Node, values: usize) -> Option<Truth> {
    match &node.value {
        Value::Name(name) if name == "First" => Some(Truth::First),
        Value::Tuple {
            name: Some(name),
            items,
        } if name == "Mean" => {
            let [list] = items.as_slice() else {
                return None;
            };
            let Value::List(items) = &list.value else {
                return None;
            };
            let means: Option<Vec<f64>> = items.iter().map(number).collect();
            let means = means.filter(|m| m.len() == values && m.iter().all(|x| *x > 0.0));
            means.map(Truth::Mean)
        }
        _ => None,
    }
}

fn number(node: &Node) -> Option<f64> {
    match &node.value {
        Value::Number(n) => Some(n.to_f64()).filter(|x| x.is_finite()),
        _ => None,
    }
}

fn pair(node: &Node) -> Option<[f64; 2]> {
    let Value::Tuple { name: None, items } = &node.value else {
        return None;
    };
    match items.as_slice() {
        [a, b] => Some([number(a)?, number(b)?]).filter(|[a, b]| a <= b),
        _ => None,
    }
}
