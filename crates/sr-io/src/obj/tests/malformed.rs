//! Files that must end with an error that names line and column.

use super::*;

fn check(text: &str, wanted: &str) {
    let errors = lines(&try_read(text.as_bytes()).expect_err(text));
    assert!(
        errors.contains(&format!("nowhere/test.obj{wanted}")),
        "no `{wanted}` in:\n{errors}"
    );
}

const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

#[test]
fn numbers_that_are_none() {
    check("v 0 zero 0\n", ":1:5: error: `zero` is not a number");
    check("v 0 0 0\nv nan 0 0\n", ":2:3: error: `nan` is not finite");
    check("v 0 0 1e39\n", ":1:7: error: `1e39` is not finite");
    check("v 0 0 -inf\n", ":1:7: error: `-inf` is not finite");
    check("v 1 1 1 0\n", ":1:1: error: divided by its weight 0");
    check("v 1 1 1 1 1\n", ":1:1: error: 5 numbers are neither");
    check("v 0 0\n", ":1:1: error: 2 numbers where 3 are needed");
    check("vn 0 1\n", ":1:1: error: 2 numbers where 3 are needed");
    check("vn 0 1 NaN\n", ":1:8: error: `NaN` is not finite");
    check("vt\n", ":1:1: error: 0 numbers where 1 are needed");
}

#[test]
fn faces_that_are_none() {
    let face = |f: &str, wanted: &str| check(&format!("{VERTICES}{f}\n"), &format!(":4:{wanted}"));
    face("f 1 2", "1: error: a face with 2 corners");
    face("f", "1: error: a face with 0 corners");
    face("f 1 2 0", "7: error: indices count from 1");
    face(
        "f 1 -4 2",
        "5: error: vertex -4 does not exist, there are 3",
    );
    face("f 1 2 4", "1: error: vertex 4 does not exist, there are 3");
    face(
        "f 1/1 2 3",
        "1: error: texture vertex 1 does not exist, there are 0",
    );
    face(
        "f 1//-1 2 3",
        "3: error: normal -1 does not exist, there are 0",
    );
    face("f 1 2 3x", "7: error: `3x` is not a corner");
    face("f 1 2 /3", "7: error: `/3` is not a corner");
    face("f 1/2/3/4 2 3", "3: error: `1/2/3/4` has more than three");
    for huge in [
        "9223372036854775807",
        "18446744073709551616",
        "-9223372036854775808",
    ] {
        face(&format!("f 1 2 {huge}"), "");
    }
}

#[test]
fn statements_without_a_name() {
    check("usemtl\n", ":1:1: error: `usemtl` without a name");
    check("mtllib  \n", ":1:1: error: `mtllib` without a name");
}

#[test]
fn files_without_faces() {
    check("", ": error: there are no faces");
    check("# nothing\nv 1 2 3\n", ": error: there are no faces");
    check("\u{0}\u{1}binary", ": error: there are no faces");
}

#[test]
fn concave_polygons_of_too_many_corners_have_their_line() {
    let n = crate::polygon::MAX_CONCAVE_CORNERS + 1;
    let mut text = String::new();
    for i in 0..n {
        let r = 1 + i % 2;
        let (s, c) = (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
        text += &format!("v {} {} 0\n", r as f64 * c, r as f64 * s);
    }
    let corners: Vec<String> = (1..=n).map(|i| i.to_string()).collect();
    text += &format!("f 1 2 3\nf {}\n", corners.join(" "));
    check(
        &text,
        &format!(
            ":{}:1: error: a polygon of {n} corners is not convex",
            n + 2
        ),
    );
}

#[test]
fn all_problems_come_in_one_go() {
    let text = "v 0 x 0\nv 1 2\nf 1 2 3\nf 1\nusemtl\n";
    assert_eq!(try_read(text.as_bytes()).unwrap_err().len(), 5);
}

#[test]
fn a_missing_file_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let errors = lines(&crate::obj::read(&dir.path().join("gone.obj")).unwrap_err());
    assert!(
        errors.contains("gone.obj: error: there is no such file"),
        "{errors}"
    );
}

#[test]
fn a_panic_would_become_an_error_that_names_the_file() {
    let e = crate::obj::guarded(Path::new("x.obj"), || panic!("as a test")).unwrap_err();
    assert!(
        lines(&e).starts_with("x.obj: error: this file makes the OBJ reader fail"),
        "{}",
        lines(&e)
    );
}

#[test]
fn long_lines_and_names_take_linear_time() {
    // Would take minutes if the column of each word, or the distance of two names, were computed.
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    for _ in 0..400_000 {
        text += " 1 2 3";
    }
    read(&text);
    let long = "x".repeat(400_000);
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("a.mtl"), format!("newmtl {long}y\n")).unwrap();
    let obj = format!("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {long}\nf 1 2 3\n");
    let path = dir.path().join("a.obj");
    std::fs::write(&path, obj).unwrap();
    assert_eq!(crate::obj::read(&path).unwrap_err().len(), 1);
}
