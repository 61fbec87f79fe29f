//! Maps of environments.

use super::*;
use crate::load::resolved_config;
use glam::Vec3;
use sr_render::film::{Image, Precision, write_image_exr};
use sr_scene::components::{Environment, EnvironmentImage, EnvironmentSampling};
use std::sync::Arc;

/// An EXR of 4 × 2 texels of 1, some of them changed.
fn exr(changes: &[(usize, Vec3)]) -> Vec<u8> {
    let mut image = Image::filled(4, 2, Vec3::ONE);
    for (at, value) in changes {
        image.pixels[*at] = *value;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("map.exr");
    write_image_exr(&path, &image, Precision::Float, &[]).expect("written");
    std::fs::read(path).expect("read")
}

/// Two pixels of Radiance HDR without run lengths: (1, 0.5, 0.25) and black.
const HDR: &[u8] = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\0\0\0\0";

fn scene(environment: &str) -> String {
    format!("(entities: {{\"sky\": {{\"Environment\": ({environment})}}}})")
}

fn try_map(environment: &str, files: &[(&str, &[u8])]) -> Loaded {
    let text = scene(environment);
    let mut all: Vec<(&str, &[u8])> = vec![("a.scene.ron", text.as_bytes())];
    all.extend(files);
    load_bytes(&all, &[])
}

#[test]
fn all_fields_of_an_environment_can_be_written() {
    let text = "radiance: (1, 2, 3), map: \"m.exr\", flip_u: true, rotation_deg: -90, scale: 2.5, \
                sampling: Uniform";
    let mut got = try_map(text, &[("m.exr", &exr(&[]))]).clean();
    let environment: Environment = got.get("sky");
    assert!(environment.flip_u);
    assert_eq!(environment.rotation_deg, -90.0);
    assert_eq!(environment.scale, 2.5);
    assert_eq!(environment.sampling, EnvironmentSampling::Uniform);
    let map = got.get::<EnvironmentImage>("sky").0;
    assert_eq!([map.width(), map.height()], [4, 2]);
    assert_eq!(map.average(), Vec3::ONE);
}

#[test]
fn radiance_files_are_read_too() {
    let mut got = try_map("map: \"m.hdr\"", &[("m.hdr", HDR)]).clean();
    let map = got.get::<EnvironmentImage>("sky").0;
    assert_eq!(map.texels(), [Vec3::new(1.0, 0.5, 0.25), Vec3::ZERO]);
}

#[test]
fn a_map_is_sought_in_the_folder_of_the_file_that_names_it() {
    let (red, blue) = (exr(&[(0, Vec3::X)]), exr(&[(0, Vec3::Z)]));
    let scene = scene("map: \"maps/m.exr\"");
    let plain = r#"(scene: "s/a.scene.ron")"#;
    let other = r#"(scene: "s/a.scene.ron", overrides: {"entities.sky.Environment.map": "m.exr"})"#;
    for (config, colour) in [(plain, Vec3::X), (other, Vec3::Z)] {
        let files: [(&str, &[u8]); 4] = [
            ("c.ron", config.as_bytes()),
            ("s/a.scene.ron", scene.as_bytes()),
            ("s/maps/m.exr", &red),
            ("m.exr", &blue),
        ];
        let mut got = load_bytes(&files, &[]).clean();
        let map = got.get::<EnvironmentImage>("sky").0;
        assert_eq!(map.texels()[0], colour);
    }
    // The resolved configuration may be put into another folder than the command line's.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("m.exr");
    std::fs::write(&path, &blue).expect("written");
    let set = format!("entities.sky.Environment.map={}", path.display());
    let files: [(&str, &[u8]); 2] = [("a.scene.ron", scene.as_bytes()), ("maps/m.exr", &red)];
    let mut got = load_bytes(&files, &[&set]).clean();
    assert_eq!(got.get::<EnvironmentImage>("sky").0.texels()[0], Vec3::Z);
    let wanted = format!(
        "{{\"entities.sky.Environment.map\": {:?}}}",
        path.display().to_string()
    );
    let text = resolved_config(&got.world);
    assert!(text.contains(&wanted), "{text}");
}

#[test]
fn maps_of_the_command_line_are_resolved_to_whole_paths() {
    for set in [
        "entities.sky.Environment.map=no.exr",
        "entities.sky.Environment.map=Some(\"no.exr\")",
        "entities.sky.Environment=(map: \"no.exr\")",
        "entities.sky={\"Environment\": (map: \"no.exr\")}",
    ] {
        let got = load(&[("a.scene.ron", &scene("radiance: 1"))], &[set]);
        assert!(!got.ok);
        let text = resolved_config(&got.world);
        let whole = std::path::absolute("no.exr").expect("a folder to be in");
        assert!(text.contains(&whole.display().to_string()), "{text}");
    }
}

#[test]
fn a_map_that_two_environments_name_is_read_once() {
    let text = r#"(entities: {
        "a": {"Environment": (map: "m.exr")},
        "b": {"Environment": (map: "./m.exr", scale: 0.5)},
        "c": {"Environment": (radiance: 0.1)},
    })"#;
    let map = exr(&[(3, Vec3::new(-1.0, 0.0, 0.0))]);
    let mut got = load_bytes(&[("a.scene.ron", text.as_bytes()), ("m.exr", &map)], &[]);
    assert!(got.ok);
    // The warning comes once, too.
    let warning = "a.scene.ron:2:36: warning: entities.a.Environment.map: `m.exr`: the texel at \
                   (3, 0) is negative and taken for 0";
    assert_eq!(got.said, [warning]);
    let [a, b] = ["a", "b"].map(|e| got.get::<EnvironmentImage>(e).0);
    assert!(Arc::ptr_eq(&a, &b));
    assert!(!got.has::<EnvironmentImage>("c"));
}

#[test]
fn what_is_wrong_with_a_map_is_told_at_its_place() {
    let good = exr(&[]);
    let nan = exr(&[(5, Vec3::NAN), (6, Vec3::INFINITY)]);
    let bright = exr(&[(0, Vec3::splat(1e30))]);
    let cases: [(&str, &str, &[u8], &str); 7] = [
        (
            "map: ¦\"ma.exr\"",
            "map.exr",
            &good,
            "map: `ma.exr`: there is no such file; did you mean `map.exr`?",
        ),
        (
            "map: ¦\"m.exr\"",
            "m.exr",
            b"no picture",
            "map: `m.exr`: neither OpenEXR, PNG nor Radiance HDR",
        ),
        (
            "map: ¦\"m.exr\"",
            "m.exr/x",
            b"",
            "map: `m.exr`: not a regular file",
        ),
        (
            "map: ¦\"m.exr\"",
            "m.exr",
            &nan,
            "map: `m.exr`: 2 texels, the first at (1, 1), are not finite, or beyond the range",
        ),
        (
            "map: \"m.exr\", scale: ¦1e8",
            "m.exr",
            &bright,
            "scale: 100000000 times the map's brightest texel, 1000000000000000000000000000000, is \
             too large",
        ),
        (
            "map: \"m.exr\", rotation_deg: ¦inf",
            "m.exr",
            &good,
            "rotation_deg: the angle must be finite",
        ),
        (
            "scale: ¦-1",
            "m.exr",
            &good,
            "scale: -1 must be finite and at least 0",
        ),
    ];
    for (text, name, bytes, wanted) in cases {
        let whole = scene(text);
        let column = whole.chars().position(|c| c == '¦').expect("a mark") + 1;
        let got = try_map(&text.replace('¦', ""), &[(name, bytes)]);
        assert!(!got.ok);
        let wanted = format!("a.scene.ron:1:{column}: error: entities.sky.Environment.{wanted}");
        assert_eq!(got.said, [wanted]);
    }
}

/// A map cut short anywhere, and one with any byte turned over, is read or refused, and nothing else.
#[test]
fn broken_maps_end_in_a_message() {
    let good = exr(&[]);
    for at in (0..good.len()).step_by(7) {
        let mut turned = good.clone();
        turned[at] ^= 0xff;
        for bytes in [&good[..at], &turned[..]] {
            let got = try_map("map: \"m.exr\"", &[("m.exr", bytes)]);
            assert!(got.ok || got.said.iter().any(|s| s.contains("`m.exr`: ")));
        }
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_refused_without_waiting_for_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let pipe = folder.path().join("pipe.exr");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo is there").success());
    let got = try_map(&format!("map: {pipe:?}"), &[]);
    assert!(!got.ok);
    assert!(
        got.said[0].ends_with("not a regular file"),
        "{:?}",
        got.said
    );
}
