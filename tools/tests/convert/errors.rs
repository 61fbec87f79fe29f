//! What is wrong is told with its place, all at once, and leniency does what it says.

use super::support::*;
use sr_tools::convert::{Options, Problem, convert};

fn lenient() -> Options {
    Options {
        lenient: true,
        ..Default::default()
    }
}

/// The only problem that a change of a fixture makes.
fn problem(name: &str, from: &str, to: &str) -> Problem {
    let problems = convert_changed(name, &[(from, to)], &Options::default()).unwrap_err();
    assert_eq!(problems.len(), 1, "{problems:#?}");
    problems.into_iter().next().unwrap()
}

/// Line and column of a text in a fixture after a change.
fn place(name: &str, from: &str, to: &str, what: &str) -> (usize, usize) {
    let text = String::from_utf8(fixture(name))
        .unwrap()
        .replacen(from, to, 1);
    let at = text.find(what).unwrap();
    let line = text[..at].matches('\n').count() + 1;
    let column = text[..at].rsplit('\n').next().unwrap().chars().count() + 1;
    (line, column)
}

/// One change, one problem at `what` whose message contains `says`.
fn check(name: &str, from: &str, to: &str, what: &str, says: &str) {
    let p = problem(name, from, to);
    assert!(p.message.contains(says), "{p}");
    assert_eq!((p.line, p.column), place(name, from, to, what), "{p}");
    assert!(!p.hint.is_empty());
}

#[test]
fn errors_point_at_the_place() {
    check(
        "room.dae",
        "100 200 300",
        "100 2oo 300",
        "2oo",
        "not a number",
    );
    check(
        "room.dae",
        "url=\"#mesh\"",
        "url=\"#mash\"",
        "#mash",
        "nothing in the file",
    );
    check(
        "room.dae",
        "url=\"#mesh\"",
        "url=\"b.dae#mesh\"",
        "b.dae",
        "another file",
    );
    check(
        "room.dae",
        "url=\"#mesh\"",
        "url=\"#cam\"",
        "#cam",
        "is a <camera>",
    );
    check(
        "room.dae",
        "5 0 2 0</p>",
        "9 0 2 0</p>",
        "9 0 2 0",
        "position 9 of 6",
    );
    check(
        "room.dae",
        "5 0 2 0</p>",
        "-1 0 2 0</p>",
        "-1 0 2 0",
        "not an index",
    );
    check(
        "room.dae",
        "<scale>2 1 1",
        "<scale>2 1",
        "<scale>",
        "holds 2 numbers",
    );
    check(
        "room.dae",
        "<yfov>40",
        "<yfov>180",
        "<yfov>",
        "out of range",
    );
    check(
        "room.dae",
        "<scale>2 1 1</scale>",
        "<skew>1 0 0 0 1 0 0</skew>",
        "<skew>",
        "skew",
    );
    check(
        "course.dae",
        "<ior>1.45</ior>",
        "",
        "<glass>",
        "without <ior>",
    );
    check(
        "course.dae",
        "<radius>.5",
        "<radius>-1",
        "<radius>",
        "above 0",
    );
}

#[test]
fn a_wrong_reference_names_the_nearest() {
    let p = problem("room.dae", "url=\"#mesh\"", "url=\"#mash\"");
    assert_eq!(p.hint, "did you mean `#mesh`?");
}

#[test]
fn columns_count_characters() {
    let p = problem(
        "room.dae",
        "<translate>100 0 0",
        "<!-- ü --><translate>100 x 0",
    );
    let (line, column) = place(
        "room.dae",
        "<translate>100 0 0",
        "<!-- ü --><translate>100 x 0",
        "x 0</translate>",
    );
    assert_eq!((p.line, p.column), (line, column));
}

#[test]
fn all_problems_are_told_at_once() {
    let changes = [
        ("meter=\"0.01\"", "meter=\"-1\""),
        ("<scale>2 1 1", "<scale>2 1"),
        ("url=\"#bulb\"", "url=\"#blub\""),
        ("<color>2 2 2</color>", "<color>2 2</color>"),
    ];
    let problems = convert_changed("room.dae", &changes, &Options::default()).unwrap_err();
    assert_eq!(problems.len(), 4, "{problems:#?}");
    assert!(problems.is_sorted_by_key(|p| (p.line, p.column)));
}

/// A fault: an error by default that mentions `--lenient`, a warning otherwise.
fn check_fault(name: &str, from: &str, to: &str, says: &str) -> String {
    let p = problem(name, from, to);
    assert!(p.message.contains(says), "{p}");
    assert!(p.hint.contains("--lenient"), "{}", p.hint);
    let converted = convert_changed(name, &[(from, to)], &lenient()).unwrap();
    let warnings = &converted.report.warnings;
    assert_eq!(warnings.len(), 1, "{warnings:#?}");
    assert_eq!((warnings[0].line, warnings[0].column), (p.line, p.column));
    converted.ron
}

#[test]
fn faults_are_passed_over_when_lenient() {
    check_fault("room.dae", "Z_UP", "W_UP", "<up_axis>");
    check_fault("room.dae", "meter=\"0.01\"", "meter=\"zero\"", "`meter`");
    check_fault(
        "room.dae",
        "count=\"18\"",
        "count=\"21\"",
        "holds 18 numbers",
    );
    check_fault(
        "room.dae",
        "#posa\" count=\"6\"",
        "#posa\" count=\"7\"",
        "6 fit",
    );
    check_fault("room.dae", "<vcount>4", "<vcount>3", "do not come out even");
    check_fault(
        "room.dae",
        "material=\"right\" count=\"2\"",
        "material=\"right\" count=\"3\"",
        "holds 2",
    );
    check_fault(
        "room.dae",
        "<rotate>0 0 1 90",
        "<rotate>0 0 0 90",
        "length 0",
    );
    check_fault("room.dae", "<float4>0.8", "<float4>1.8", "above 1");
    check_fault("room.dae", "0.8 0.1", "-0.8 0.1", "below 0");
    check_fault(
        "room.dae",
        "<node name=\"lamp\">",
        "<node id=\"eye\">",
        "used twice",
    );
    check_fault(
        "course.dae",
        "<mirror><reflectance>1 0.8 0.4</reflectance></mirror>",
        "<velvet/>",
        "`velvet`",
    );
    let ron = check_fault(
        "course.dae",
        "0.6 0 0 0 0 0.8 0 0",
        "0.6 0.1 0 0 0 0.8 0 0",
        "no rectangle",
    );
    assert!(line(&ron, "Area").contains("width: 0.6"));
}

#[test]
fn a_matrix_of_fifteen_numbers_keeps_its_first_three_rows() {
    let ron = check_fault(
        "course.dae",
        "2 0 0 1 0 2 0 0 0 0 2 1 0 0 0 1",
        "2 0 0 1 0 2 0 0 0 0 2 1 0 0 0",
        "holds 15 numbers, 16 are needed",
    );
    assert!(line(&ron, "b1").contains("radius: 1.0"));
    assert!(line(&ron, "b1").contains("translate: (-1.0, 1.0, 0.0)"));
}

#[test]
fn files_that_are_no_collada_are_told_so() {
    let check = |bytes: &[u8], place: (usize, usize), says: &str| {
        let problems = convert(bytes, "x.dae", &lenient()).unwrap_err();
        let p = &problems[0];
        assert!(p.message.contains(says), "{p}");
        assert_eq!((p.line, p.column), place, "{p}");
    };
    check(b"", (1, 1), "");
    check(b"<svg/>", (1, 1), "<svg>");
    check(
        b"<COLLADA>\n  <asset></COLLADA>",
        (2, 10),
        "expected 'asset' tag",
    );
    check(b"<a>\n\xff</a>", (2, 1), "not UTF-8");
    check(b"\xEF\xBB\xBF<COLLADA/>", (1, 1), "no scene to show");
}
