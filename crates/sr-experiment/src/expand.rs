//! From an experiment to its runs: which there are, in which order, and what each changes.
//!
//! A *point* is a value of each axis with a method. Points are numbered axis by axis, the first axis
//! outermost, methods innermost. Each point is run once a seed; runs go seed by seed and point by
//! point, so that methods take turns and a machine that slows down slows all of them.

use crate::document::{Experiment, ReferenceSpec, Setting};
use sr_io::Change;
use sr_io::document::OverrideEntry;
use sr_io::ron::{Node, Number, Pos, Value};

/// Parts of the budget of which any ends a render.
const STOPS: [&str; 3] = ["samples", "seconds", "target_error"];

/// The longest name of a run's files, without what makes it unique.
const LONGEST_ID: usize = 96;

/// A value of each axis, and a method.
#[derive(Clone, Debug)]
pub struct Point {
    /// The number of its value on each axis.
    pub settings: Vec<usize>,
    /// The number of its method, when there are methods.
    pub method: Option<usize>,
    /// Name for files: letters, digits, dots and hyphens; unique.
    pub id: String,
}

/// One picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Name of its files, without extension.
    pub id: String,
    /// The point, by number.
    pub point: usize,
    /// Seed of the sampler; `None` leaves the base's.
    pub seed: Option<u64>,
}

/// All points, in order.
pub fn points(experiment: &Experiment) -> Vec<Point> {
    let methods: Vec<Option<usize>> = match experiment.methods.len() {
        0 => vec![None],
        n => (0..n).map(Some).collect(),
    };
    let mut combinations: Vec<Vec<usize>> = vec![Vec::new()];
    for axis in &experiment.axes {
        let extended = |c: &Vec<usize>| {
            let values = 0..axis.settings.len();
            let longer = |v| c.iter().copied().chain([v]).collect();
            values.map(longer).collect::<Vec<Vec<usize>>>()
        };
        combinations = combinations.iter().flat_map(extended).collect();
    }
    let mut points = Vec::new();
    for settings in &combinations {
        for method in &methods {
            let mut point = Point {
                settings: settings.clone(),
                method: *method,
                id: String::new(),
            };
            point.id = unique(id(experiment, &point), &points);
            points.push(point);
        }
    }
    points
}

/// All runs, in the order in which they are made.
pub fn runs(experiment: &Experiment, points: &[Point]) -> Vec<Run> {
    let seeds: Vec<Option<u64>> = match experiment.seeds.as_slice() {
        [] => vec![None],
        seeds => seeds.iter().copied().map(Some).collect(),
    };
    let several = seeds.len() > 1;
    let of_seed = |seed: Option<u64>| {
        points.iter().enumerate().map(move |(number, point)| Run {
            id: match seed.filter(|_| several) {
                Some(seed) => format!("{}-seed-{seed}", point.id),
                None => point.id.clone(),
            },
            point: number,
            seed,
        })
    };
    seeds.iter().flat_map(|s| of_seed(*s)).collect()
}

impl Point {
    /// What it changes in its axes' order, and by its method last.
    fn settings<'e>(&self, experiment: &'e Experiment) -> impl Iterator<Item = &'e Setting> {
        let axes = experiment.axes.iter().zip(self.settings.clone());
        let method = self.method.map(|m| &experiment.methods[m]);
        axes.map(|(axis, v)| &axis.settings[v]).chain(method)
    }

    /// The changes of one of its runs to the base.
    pub fn changes(&self, experiment: &Experiment, seed: Option<u64>) -> Vec<Change> {
        let mut entries = common(experiment);
        entries.extend(self.settings(experiment).flat_map(|s| s.changes.clone()));
        entries.extend(seed.map(seed_entry));
        finish(experiment, entries)
    }

    /// The changes of its reference to the base: `None` when the experiment renders none.
    pub fn reference_changes(&self, experiment: &Experiment) -> Option<Vec<Change>> {
        let Some(ReferenceSpec::Render(own)) = &experiment.reference else {
            return None;
        };
        let mut entries = common(experiment);
        let axes = experiment.axes.iter().zip(&self.settings);
        entries.extend(axes.flat_map(|(axis, v)| axis.settings[*v].changes.clone()));
        // Its own budget alone counts, and its own samples: with those of a run it would share the
        // run's error and hide it.
        entries.retain(|e| stops(e).is_empty());
        entries.push(seed_entry(reference_seed(&experiment.seeds)));
        entries.extend(own.iter().cloned());
        Some(finish(experiment, entries))
    }
}

/// What all runs change.
fn common(experiment: &Experiment) -> Vec<OverrideEntry> {
    let budget = experiment.budget.iter();
    let all = experiment.set.iter().chain(budget);
    all.chain(&experiment.show.post).cloned().collect()
}

/// A budget of the experiment's replaces the base's: without this, the base's samples would end a
/// run that is given seconds.
fn finish(experiment: &Experiment, mut entries: Vec<OverrideEntry>) -> Vec<Change> {
    if entries.iter().any(|e| !stops(e).is_empty()) {
        let none = |field: &str| {
            let value = node(Value::None);
            entry(&format!("budget.{field}"), value)
        };
        entries.splice(0..0, STOPS.map(none));
    }
    entries.iter().map(|e| experiment.change(e)).collect()
}

/// The parts of the budget's end that a change sets.
fn stops(entry: &OverrideEntry) -> Vec<&'static str> {
    let of_field = |field: &str| STOPS.into_iter().filter(|s| *s == field).collect();
    match (entry.path.as_str(), &entry.value.value) {
        ("budget", Value::Struct { fields, .. }) => {
            fields.iter().flat_map(|f| of_field(&f.key)).collect()
        }
        (path, _) => path.strip_prefix("budget.").map_or(vec![], of_field),
    }
}

fn seed_entry(seed: u64) -> OverrideEntry {
    let number = Number::integer(false, seed.into());
    entry("sampler.seed", node(Value::Number(number)))
}

/// None of the runs' seeds.
fn reference_seed(seeds: &[u64]) -> u64 {
    // "reference" as far as eight letters go: nobody writes it by chance.
    let first = u64::from_be_bytes(*b"referenc");
    (first..).find(|s| !seeds.contains(s)).unwrap_or(first)
}

fn entry(path: &str, value: Node) -> OverrideEntry {
    OverrideEntry {
        path: path.into(),
        pos: value.pos,
        value,
    }
}

/// A value that nobody wrote.
fn node(value: Value) -> Node {
    let pos = Pos { line: 1, column: 1 };
    Node { value, pos }
}

/// `hemisphere-samples-64`.
fn id(experiment: &Experiment, point: &Point) -> String {
    let method = point.method.map(|m| experiment.methods[m].label.clone());
    let axes = experiment.axes.iter().zip(&point.settings);
    let axes = axes.map(|(axis, v)| format!("{}-{}", axis.short, axis.settings[*v].label));
    let parts: Vec<String> = method.into_iter().chain(axes).map(|p| slug(&p)).collect();
    let id: String = parts.join("-").chars().take(LONGEST_ID).collect();
    if id.is_empty() {
        slug(&experiment.stem())
    } else {
        id
    }
}

/// Letters, digits and dots; a hyphen for anything else. An underscore comes before what a run
/// writes beside its picture, so it stands in no name.
fn slug(text: &str) -> String {
    let mut slug = String::new();
    for c in text.chars() {
        if c.is_alphanumeric() || (c == '.' && !slug.is_empty()) {
            slug.push(c);
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
    }
    slug.trim_end_matches(['-', '.']).to_owned()
}

/// With a number when the name is taken; file systems may take upper and lower case for the same.
fn unique(id: String, points: &[Point]) -> String {
    let taken = |id: &str| {
        let id = id.to_lowercase();
        points.iter().any(|p| p.id.to_lowercase() == id)
    };
    let id = if id.is_empty() { "run".to_owned() } else { id };
    if !taken(&id) {
        return id;
    }
    let numbered = (2..).map(|n| format!("{id}-{n}"));
    numbered.into_iter().find(|id| !taken(id)).unwrap_or(id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::tests_support::experiment;

    fn ids(text: &str) -> Vec<String> {
        let e = experiment(text);
        let points = points(&e);
        runs(&e, &points).into_iter().map(|r| r.id).collect()
    }

    /// Path and value of each change, as RON.
    fn told(changes: &[Change]) -> Vec<String> {
        let text = |c: &Change| format!("{}={}", c.entry.path, c.entry.value);
        changes.iter().map(text).collect()
    }

    #[test]
    fn methods_take_turns_within_an_axis_and_axes_within_a_seed() {
        let text = r#"axes: {"a.x": [1, 2]}, methods: {"m": {}, "n": {}}, seeds: [0, 7]"#;
        assert_eq!(
            ids(text),
            [
                "m-x-1-seed-0",
                "n-x-1-seed-0",
                "m-x-2-seed-0",
                "n-x-2-seed-0",
                "m-x-1-seed-7",
                "n-x-1-seed-7",
                "m-x-2-seed-7",
                "n-x-2-seed-7",
            ]
        );
    }

    #[test]
    fn axes_are_crossed_and_zips_are_one_axis() {
        let text = r#"axes: {"a.x": [1, 2, 3], "a.y": [1, 2]},
            zip: {"z": {"p": {"b.u": 1, "b.v": 2}, "q": {"b.u": 3}}}"#;
        let ids = ids(text);
        assert_eq!(ids.len(), 12);
        assert_eq!(ids[..3], ["x-1-y-1-z-p", "x-1-y-1-z-q", "x-1-y-2-z-p"]);
        let e = experiment(text);
        let changes = told(&points(&e)[0].changes(&e, None));
        assert_eq!(changes, ["a.x=1", "a.y=1", "b.u=1", "b.v=2"]);
    }

    #[test]
    fn names_are_for_files_and_unique() {
        let text = r#"axes: {"a.m": ["../Ärger/x", "ärger x", "--", "a_b"]}"#;
        assert_eq!(ids(text), ["m-..-Ärger-x", "m-ärger-x", "m", "m-a-b"]);
        let twins = r#"axes: {"a.m": ["A/b", "a-B", "a b"]}"#;
        assert_eq!(ids(twins), ["m-A-b", "m-a-B-2", "m-a-b-3"]);
        assert_eq!(ids(""), ["alpha"]);
        let long = format!(r#"methods: {{"{}": {{}}}}"#, "long".repeat(99));
        assert_eq!(ids(&long)[0].len(), LONGEST_ID);
    }

    #[test]
    fn later_changes_win_seed_last() {
        let text = r#"set: {"film.width": 8}, show: (exposure: 1), axes: {"a.x": [1]},
            methods: {"m": {"a.x": 2}}, seeds: [5]"#;
        let e = experiment(text);
        assert_eq!(
            told(&points(&e)[0].changes(&e, Some(5))),
            [
                "film.width=8",
                "post.exposure=1",
                "a.x=1",
                "a.x=2",
                "sampler.seed=5"
            ]
        );
    }

    #[test]
    fn a_budget_replaces_the_bases() {
        let none = STOPS.map(|s| format!("budget.{s}=None"));
        for (text, own) in [
            ("budget: (seconds: 2)", "budget=(seconds: 2)"),
            (r#"axes: {"budget.samples": [4]}"#, "budget.samples=4"),
        ] {
            let e = experiment(text);
            let changes = told(&points(&e)[0].changes(&e, None));
            assert_eq!(changes[..3], none, "{text}");
            assert_eq!(changes[3..], [own]);
        }
        // The size of passes is no end.
        let e = experiment("budget: (pass_samples: 2)");
        assert_eq!(told(&points(&e)[0].changes(&e, None)).len(), 1);
    }

    #[test]
    fn a_reference_has_the_axes_but_neither_methods_nor_budgets_nor_seeds() {
        let text = r#"set: {"film.width": 8}, budget: (seconds: 1), seeds: [0, 1],
            axes: {"a.x": [1], "budget.samples": [4]}, methods: {"m": {"integrator": Aov()}},
            reference: (integrator: Path(), samples: 99)"#;
        let e = experiment(text);
        let changes = points(&e)[0].reference_changes(&e).unwrap();
        let changes = told(&changes);
        assert_eq!(changes[3..5], ["film.width=8", "a.x=1"]);
        assert!(changes[5].starts_with("sampler.seed="), "{changes:?}");
        assert_eq!(changes[6..], ["integrator=Path()", "budget.samples=99"]);
        assert!(experiment("").reference.is_none());
    }

    #[test]
    fn the_seed_of_a_reference_is_none_of_the_runs() {
        let own = reference_seed(&[]);
        assert_eq!(reference_seed(&[own, own + 1]), own + 2);
    }
}
