//! The program: exit status, and files that appear whole or not at all.

use std::path::Path;
use std::process::{Command, Output};

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_steradian-tools"))
        .current_dir(folder)
        .args(args)
        .output()
        .expect("the program starts")
}

fn files(folder: &Path) -> usize {
    std::fs::read_dir(folder).expect("a folder").count()
}

#[test]
fn a_sky_is_made_and_its_density_drawn() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = folder.path();
    let sky = run(
        at,
        &[
            "generate",
            "sky",
            "-o",
            "sky.exr",
            "--width",
            "64",
            "--sun-azimuth",
            "-30",
        ],
    );
    assert_eq!(
        sky.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&sky.stderr)
    );
    let said = String::from_utf8_lossy(&sky.stdout).into_owned();
    for wanted in ["sky: irradiance (", "sun: irradiance (", "wrote sky.exr"] {
        assert!(said.contains(wanted), "{said}");
    }
    let image = sr_film::read_image(at.join("sky.exr")).expect("an EXR");
    assert_eq!([image.width, image.height], [64, 32]);
    let attributes = sr_film::read_attributes(at.join("sky.exr")).expect("attributes");
    assert!(attributes.contains(&("steradian.turbidity".into(), "3".into())));
    let debug = run(
        at,
        &[
            "envmap-debug",
            "sky.exr",
            "-o",
            "p.png",
            "--samples",
            "50",
            "--width",
            "128",
        ],
    );
    assert_eq!(
        debug.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&debug.stderr)
    );
    let picture = sr_film::read_image(at.join("p.png")).expect("a PNG");
    assert_eq!([picture.width, picture.height], [128, 64]);
}

#[test]
fn bad_input_is_status_2_a_full_stop_in_writing_1_and_neither_leaves_a_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = folder.path();
    std::fs::write(at.join("no.exr"), "no picture").expect("written");
    let cases: [(&[&str], i32, &str); 6] = [
        (
            &["generate", "sky", "-o", "a.exr", "--turbidity", "0"],
            2,
            "--turbidity 0: it must be",
        ),
        (
            &["generate", "sky", "-o", "a.exr", "--width", "x"],
            2,
            "--width",
        ),
        (&["generate", "rain"], 2, "rain"),
        (
            &["generate", "sky", "-o", "none/a.exr", "--width", "16"],
            1,
            "none/a.exr: No such file",
        ),
        (
            &["envmap-debug", "missing.exr", "-o", "p.png"],
            2,
            "missing.exr: No such file",
        ),
        (
            &["envmap-debug", "no.exr", "-o", "p.png"],
            2,
            "no.exr: neither OpenEXR",
        ),
    ];
    for (args, status, wanted) in cases {
        let output = run(at, args);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(wanted), "{args:?}: {said}");
    }
    assert_eq!(files(at), 1);
}
