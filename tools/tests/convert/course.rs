//! The classic assignment's own files, where the environment variable `STERADIAN_CS184` names
//! the folder that holds them.

use super::support::*;
use glam::DVec3;
use sr_tools::convert::{Converted, Framing, Options, View, convert};
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("STERADIAN_CS184");
    if folder.is_none() {
        eprintln!("skipped: STERADIAN_CS184 is not set");
    }
    folder.map(PathBuf::from)
}

fn convert_course(folder: &std::path::Path, name: &str) -> Converted {
    let file = format!("{name}.dae");
    let bytes = std::fs::read(folder.join(&file)).unwrap();
    let options = Options {
        // One matrix of this file has 15 numbers.
        lenient: name == "CBgems",
        ..Default::default()
    };
    convert(&bytes, &file, &options).unwrap()
}

/// Is `x` what was printed, to the last digit printed? Zeros stand for anything below 5·10⁻⁷,
/// half a digit in the last place of the seven that the other numbers have.
fn matches(x: f64, printed: &str) -> bool {
    let decimals = printed.split_once('.').map_or(0, |(_, d)| d.len() as i32);
    let half = 0.5 * 10f64.powi(-decimals);
    let half = if printed == "0" { 5e-7 } else { half };
    (x - printed.parse::<f64>().unwrap()).abs() <= half
}

fn check(framing: &Framing, from: [&str; 3], to: [&str; 3], hfov: &str) {
    for (v, wanted) in [(framing.from, from), (framing.to, to)] {
        for (x, printed) in v.to_array().into_iter().zip(wanted) {
            assert!(matches(x, printed), "{x} is not {printed}");
        }
    }
    assert_eq!(framing.up, DVec3::Y);
    let View::Hfov(x) = framing.view else {
        panic!("a horizontal field of view");
    };
    assert!(matches(x, hfov), "{x} is not {hfov}");
    assert_eq!(framing.film, (480, 360));
}

#[test]
fn course_cameras_are_those_of_the_reference_pictures() {
    let Some(folder) = folder() else { return };
    // Name, origin, target, horizontal field of view of the reference pictures.
    let table = [
        (
            "CBbunny",
            ["0", "0.75", "-4.802344"],
            ["0", "0.75", "0"],
            "30.67639",
        ),
        (
            "CBbunny_microfacet_cu",
            ["0", "0.75", "-4.802344"],
            ["0", "0.75", "0"],
            "30.67639",
        ),
        (
            "CBdragon_au",
            ["0", "0.7499999", "-4.802343"],
            ["0", "0.7499999", "0"],
            "30.67639",
        ),
        (
            "CBgems",
            ["0", "0.75", "4.802344"],
            ["0", "0.75", "0"],
            "30.6764",
        ),
        (
            "CBspheres",
            ["0", "0.75", "4.802344"],
            ["0", "0.75", "0"],
            "30.6764",
        ),
        (
            "CBspheres_lambertian",
            ["0", "0.75", "4.802344"],
            ["0", "0.75", "0"],
            "30.6764",
        ),
        (
            "CBspheres_microfacet_al_ag",
            ["0", "0.75", "4.802344"],
            ["0", "0.75", "0"],
            "30.6764",
        ),
        (
            "bunny_unlit",
            ["0", "1.48774", "3.315914"],
            ["0", "0.3824354", "0"],
            "30.6764",
        ),
    ];
    for (name, from, to, hfov) in table {
        eprintln!("{name}");
        let report = convert_course(&folder, name).report;
        check(&report.course_framing.unwrap(), from, to, hfov);
    }
}

#[test]
fn course_boxes_are_lit_by_a_quad_under_the_ceiling() {
    let Some(folder) = folder() else { return };
    for name in ["CBspheres", "CBbunny", "CBdragon_au"] {
        let ron = convert_course(&folder, name).ron;
        assert_eq!(
            line(&ron, "Area"),
            r#"{"Quad": (width: 0.6, height: 0.8), "LocalTransform": (translate: (0.0, 1.49, 0.0), rotate_deg: (90.0, 0.0, 0.0)), "MaterialRef": "Area_emission"}"#
        );
        assert!(
            line(&ron, "Area_emission").contains("radiance: (10.0, 10.0, 10.0), two_sided: false")
        );
    }
}

#[test]
fn course_meshes_are_complete_and_in_their_place() {
    let Some(folder) = folder() else { return };
    let converted = convert_course(&folder, "CBspheres");
    let parts = world_parts(&converted.glb);
    assert_eq!(parts.len(), 5, "the commented-out light stays out");
    for part in &parts {
        let horizontal = matches!(part.node.as_str(), "floor" | "ceiling");
        let wanted = if horizontal { 4.0 } else { 3.0 };
        let vector = area(&part.triangles);
        assert!((vector.length() - wanted).abs() < 1e-5, "{}", part.node);
        for n in &part.normals {
            assert!((*n - vector.normalize()).length() < 1e-6, "{}", part.node);
        }
    }
    let left = parts.iter().find(|p| p.node == "leftWall").unwrap();
    assert!(
        left.triangles
            .iter()
            .flatten()
            .all(|p| (p.x + 1.0).abs() < 1e-6),
        "the camera looks along -z"
    );

    let bunny = world_parts(&convert_course(&folder, "CBbunny").glb);
    let triangles: usize = bunny.iter().map(|p| p.triangles.len()).sum();
    assert_eq!(triangles, 28_586);
}

#[test]
fn fifteen_numbers_are_an_error_that_names_the_way_out() {
    let Some(folder) = folder() else { return };
    let bytes = std::fs::read(folder.join("CBgems.dae")).unwrap();
    let problems = convert(&bytes, "CBgems.dae", &Options::default()).unwrap_err();
    assert_eq!(problems.len(), 1);
    assert_eq!((problems[0].line, problems[0].column), (712, 9));
    assert!(problems[0].hint.contains("--lenient"));
}
