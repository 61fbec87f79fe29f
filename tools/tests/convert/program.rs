//! The program: exit status, and files that appear whole or not at all.

use super::support::*;
use std::path::Path;
use std::process::{Command, Output};

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_steradian-tools"))
        .args(args)
        .output()
        .expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(dir)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn both_files_are_written_and_both_framings_printed() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("new/folder");
    let input = fixture_path("course.dae");
    let output = run(&[
        "convert",
        input.to_str().unwrap(),
        "-o",
        out.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(names(&out), ["course.glb", "course.scene.ron"]);
    let said = text(&output.stdout);
    for wanted in [
        "camera course (used): from",
        "camera file: from",
        "(x, y, z) -> (-x, z, y)",
        "wrote",
    ] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

#[test]
fn bad_input_is_status_2_and_touches_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let input = dir.path().join("bad.dae");
    let broken = text(&fixture("course.dae")).replace("<ior>1.45</ior>", "<ior>x</ior>");
    std::fs::write(&input, broken).unwrap();
    let out = dir.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("bad.glb"), "old").unwrap();
    let args = [
        "convert",
        input.to_str().unwrap(),
        "-o",
        out.to_str().unwrap(),
    ];
    let output = run(&args);
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr);
    assert!(said.contains("bad.dae:15:170:"), "{said}");
    assert!(said.contains("hint: "), "{said}");
    assert_eq!(names(&out), ["bad.glb"]);
    assert_eq!(std::fs::read(out.join("bad.glb")).unwrap(), b"old");
}

#[cfg(unix)]
#[test]
fn an_endless_device_and_a_folder_are_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().to_str().unwrap();
    for (input, says) in [("/dev/zero", "no file"), (folder, "this is a folder")] {
        let out = dir.path().join("out");
        let output = run(&["convert", input, "-o", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{input}");
        let said = text(&output.stderr);
        assert!(said.contains(&format!("error: {input}: ")), "{said}");
        assert!(said.contains(says), "{said}");
        assert!(!out.exists());
    }
}

#[test]
fn usage_and_missing_files_are_status_2() {
    for args in [
        &["convert"][..],
        &["convert", "no/such/file.dae", "-o", "never"],
        &["convert", "x.dae", "-o", "y", "--course-size", "0", "3"],
        &["transmogrify"],
    ] {
        assert_eq!(run(args).status.code(), Some(2), "{args:?}");
    }
    assert!(!Path::new("never").exists());
}

#[test]
fn a_folder_that_cannot_be_made_is_status_1() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    std::fs::write(&file, "").unwrap();
    let input = fixture_path("course.dae");
    let inside = file.join("out");
    let output = run(&[
        "convert",
        input.to_str().unwrap(),
        "-o",
        inside.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
}

#[test]
fn environment_maps_are_named_from_the_folder_of_the_scene() {
    let dir = tempfile::tempdir().unwrap();
    let map = dir.path().join("maps/sky.exr");
    std::fs::create_dir(dir.path().join("maps")).unwrap();
    std::fs::write(&map, "").unwrap();
    let out = dir.path().join("a/b");
    let input = fixture_path("course.dae");
    let (input, out_arg) = (input.to_str().unwrap(), out.to_str().unwrap());
    let output = run(&[
        "convert",
        input,
        "-o",
        out_arg,
        "--environment",
        map.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let ron = std::fs::read_to_string(out.join("course.scene.ron")).unwrap();
    assert_eq!(
        line(&ron, "environment"),
        r#"{"Environment": (map: "../../maps/sky.exr", flip_u: true, rotation_deg: -90.0, scale: 1.0)}"#
    );
    let output = run(&[
        "convert",
        input,
        "-o",
        out_arg,
        "--environment",
        "no/such.exr",
    ]);
    assert_eq!(output.status.code(), Some(2));
}
