//! Files that mean harm end with an error, soon and without a panic.

use super::support::*;
use sr_tools::convert::{Options, convert};

fn document(nodes: &str, scene: &str) -> String {
    format!(
        "<COLLADA><library_nodes>{nodes}</library_nodes><library_visual_scenes>\
         <visual_scene id=\"s\">{scene}</visual_scene></library_visual_scenes>\
         <scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"
    )
}

fn first_problem(text: &str) -> String {
    let options = Options {
        lenient: true,
        ..Default::default()
    };
    let problems = convert(text.as_bytes(), "x.dae", &options).unwrap_err();
    problems[0].message.clone()
}

#[test]
fn a_node_that_contains_itself_is_an_error() {
    let nodes = "<node id=\"a\"><instance_node url=\"#b\"/></node>\
                 <node id=\"b\"><instance_node url=\"#a\"/></node>";
    let text = document(nodes, "<node><instance_node url=\"#a\"/></node>");
    assert!(first_problem(&text).contains("contains itself"));
}

#[test]
fn doubling_instances_end_with_an_error() {
    let doubles: String = (0..60)
        .map(|i| {
            let next = format!("<instance_node url=\"#n{}\"/>", i + 1);
            format!("<node id=\"n{i}\">{next}{next}</node>")
        })
        .collect();
    let nodes = format!("{doubles}<node id=\"n60\"/>");
    let text = document(&nodes, "<node><instance_node url=\"#n0\"/></node>");
    assert!(first_problem(&text).contains("more than"));
}

#[test]
fn deep_nesting_is_an_error_and_no_overflow() {
    let depth = 100_000;
    let scene = format!("{}{}", "<node>".repeat(depth), "</node>".repeat(depth));
    assert!(first_problem(&document("", &scene)).contains("nested deeper"));
}

#[test]
fn counts_in_the_file_are_not_believed() {
    let huge = u64::MAX.to_string();
    for (from, attribute) in [
        ("count=\"18\"", "count"),
        ("#posa\" count=\"6\"", "#posa\" count"),
        ("stride=\"3\"", "stride"),
        ("offset=\"3\"", "offset"),
        ("set=\"1\"", "set"),
    ] {
        let to = format!("{attribute}=\"{huge}\"");
        // Nothing but an answer is asked for: some of these can be passed over.
        let options = Options {
            lenient: true,
            ..Default::default()
        };
        let _ = convert_changed("room.dae", &[(from, &to)], &options);
    }
    for size in [
        "4000000000",
        "18446744073709551615",
        "99999999999999999999999",
    ] {
        let to = format!("<vcount>{size}");
        let problems = convert_changed("room.dae", &[("<vcount>4", &to)], &Options::default());
        assert!(problems.is_err());
    }
}

#[test]
fn numbers_beyond_single_precision_are_errors() {
    for (from, to) in [
        ("100 100 0 0", "1e300 100 0 0"),
        ("<scale>2 1 1", "<scale>1e300 1 1"),
    ] {
        let problems = convert_changed("room.dae", &[(from, to)], &Options::default());
        let message = &problems.unwrap_err()[0].message;
        assert!(message.contains("range of 32-bit floats"), "{message}");
    }
}

/// Damaged copies of the fixtures: bytes changed, pieces cut out and doubled. Every one of them
/// converts to a valid `.glb` and RON, or ends with problems that have a place in the file.
#[test]
fn damaged_files_never_panic_and_never_give_a_damaged_result() {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = move |below: usize| {
        // A linear congruential generator (Knuth's MMIX constants), its high bits.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut converted_count = 0;
    for name in ["room.dae", "course.dae", "shapes.dae"] {
        let original = fixture(name);
        for round in 0..1500 {
            let mut bytes = original.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                let end = (at + random(40)).min(bytes.len());
                match random(4) {
                    0 => bytes[at] = b"0123456789-.e <>\"#/"[random(19)],
                    1 => drop(bytes.drain(at..end)),
                    2 => {
                        let piece = bytes[at..end].to_vec();
                        let to = random(bytes.len());
                        bytes.splice(to..to, piece);
                    }
                    // A digit next to a digit: files that stay well-formed.
                    _ => {
                        let from = random(bytes.len());
                        if let Some(i) = bytes[from..].iter().position(u8::is_ascii_digit) {
                            bytes[from + i] = b"0123456789-."[random(12)];
                        }
                    }
                }
            }
            let options = Options {
                lenient: round % 2 == 0,
                ..Default::default()
            };
            match convert(&bytes, name, &options) {
                Ok(result) => {
                    converted_count += 1;
                    gltf::Gltf::from_slice(&result.glb).expect("the .glb validates");
                    let _: ron::Value = ron::from_str(&result.ron).expect("RON");
                }
                Err(problems) => {
                    assert!(!problems.is_empty());
                    assert!(problems.iter().all(|p| p.line > 0 && p.column > 0));
                }
            }
        }
    }
    // The damage is gentle enough to get past the XML reader.
    assert!(converted_count > 500, "only {converted_count} converted");
}
