//! Which picture stands where, in the sheet and on the page.

use crate::plan::Plan;
use crate::words;

/// Pictures that belong side by side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Group {
    /// What they have in common; empty when there is a single group.
    pub heading: String,
    /// What tells them apart, and their points.
    pub cells: Vec<(Vec<String>, usize)>,
}

/// Pictures side by side when nobody says: four are readable, and a row of five does not become
/// four and one.
const COLUMNS: usize = 5;

/// Groups, and how many pictures stand side by side.
///
/// The last axis runs from left to right, or the methods when there is no axis. Methods and the
/// other axes make groups.
pub(crate) fn groups(plan: &Plan) -> (Vec<Group>, usize) {
    let axes = plan.experiment.axes.len();
    let mut groups: Vec<Group> = Vec::new();
    // Methods are the outermost here, so that each has its row.
    let mut order: Vec<usize> = (0..plan.points.len()).collect();
    if axes > 0 {
        order.sort_by_key(|p| plan.points[*p].method);
    }
    for point in order {
        let (heading, labels) = split(plan, point);
        match groups.iter_mut().find(|g| g.heading == heading) {
            Some(group) => group.cells.push((labels, point)),
            None => groups.push(Group {
                heading,
                cells: vec![(labels, point)],
            }),
        }
    }
    let widest = groups.iter().map(|g| g.cells.len()).max().unwrap_or(1);
    let columns = match plan.experiment.show.columns {
        Some(columns) => columns as usize,
        None if widest <= COLUMNS + 1 => widest,
        // As even as can be: 7 as 4 and 3, 11 as 4, 4 and 3.
        None => widest.div_ceil(widest.div_ceil(COLUMNS)),
    };
    (groups, columns.clamp(1, widest))
}

/// The labels of a point's group, and its own.
fn split(plan: &Plan, point: usize) -> (String, Vec<String>) {
    let mut labels = words::labels(plan, point);
    let own = labels.pop().into_iter().collect();
    (labels.join(", "), own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::tests_support::experiment;

    fn plan_of(fields: &str) -> Plan {
        let experiment = experiment(fields);
        let points = crate::expand::points(&experiment);
        Plan {
            runs: crate::expand::runs(&experiment, &points),
            points,
            experiment,
            facts: Vec::new(),
            references: Vec::new(),
            reference_file: None,
        }
    }

    /// Headings, and the first label of each cell.
    fn shape(fields: &str) -> (Vec<(String, Vec<String>)>, usize) {
        let (groups, columns) = groups(&plan_of(fields));
        let cell = |(labels, _): &(Vec<String>, usize)| labels.join("|");
        let groups = groups
            .iter()
            .map(|g| (g.heading.clone(), g.cells.iter().map(cell).collect()));
        (groups.collect(), columns)
    }

    #[test]
    fn methods_are_rows_and_the_last_axis_runs_across() {
        let fields = r#"axes: {"a.x": [1, 2], "a.y": [3, 4, 5]}, methods: {"m": {}, "n": {}}"#;
        let (groups, columns) = shape(fields);
        let headings: Vec<&str> = groups.iter().map(|(h, _)| h.as_str()).collect();
        assert_eq!(headings, ["m, x = 1", "m, x = 2", "n, x = 1", "n, x = 2"]);
        assert_eq!(groups[3].1, ["y = 3", "y = 4", "y = 5"]);
        assert_eq!(columns, 3);
    }

    #[test]
    fn a_single_axis_is_broken_evenly_and_methods_alone_run_across() {
        let list: Vec<String> = (0..11).map(|n| n.to_string()).collect();
        let (groups, columns) = shape(&format!(r#"axes: {{"a.x": [{}]}}"#, list.join(",")));
        assert_eq!((groups.len(), groups[0].1.len(), columns), (1, 11, 4));
        assert_eq!(groups[0].0, "");
        assert_eq!(shape(r#"axes: {"a.x": [1, 2]}, show: (columns: 1)"#).1, 1);
        let (groups, columns) = shape(r#"methods: {"m": {}, "n": {}}"#);
        assert_eq!(
            (groups[0].1.clone(), columns),
            (vec!["m".into(), "n".into()], 2)
        );
        assert_eq!(shape("").0, [(String::new(), vec![String::new()])]);
    }
}
