//! A square at night under strings of coloured lamps: what a choice among many lights is for, since
//! each lamp matters near itself only.

use super::{Error, Made, save};
use clap::Args;
use glam::DVec3;
use std::fmt::Write;
use std::path::PathBuf;

/// Arguments of `generate festival`.
#[derive(Args, Clone, Debug)]
pub struct FestivalArgs {
    /// The scene.
    #[arg(short, long, value_name = "NAME.SCENE.RON")]
    pub output: PathBuf,
    /// Lamps on each of the 17 strings, from 1 to 10 000.
    #[arg(long, value_name = "N", default_value_t = 30)]
    pub lamps: u32,
}

/// Poles stand on a grid of so many, so far apart, in metres.
const POLES: (u32, u32) = (4, 3);
const SPACING: f64 = 4.0;
/// Where strings hang from, and how far they sag.
const HEIGHT: f64 = 3.0;
const SAG: f64 = 0.55;
/// Of a lamp, in metres.
const RADIUS: f64 = 0.06;

/// Name and radiance of the lamps; the first is between any two others.
const COLOURS: [(&str, [f64; 3]); 6] = [
    ("warm", [9.0, 4.0, 0.9]),
    ("red", [20.0, 0.3, 0.25]),
    ("amber", [17.0, 2.2, 0.12]),
    ("green", [0.5, 12.0, 0.6]),
    ("blue", [0.2, 0.9, 26.0]),
    ("violet", [7.0, 0.3, 22.0]),
];

/// Market stalls: middle, size and turn about the vertical in degrees.
const STALLS: [([f64; 2], [f64; 3], f64); 7] = [
    ([-4.2, -2.1], [1.6, 1.0, 0.8], 12.0),
    ([-1.9, 1.7], [1.2, 0.8, 0.8], -20.0),
    ([0.4, -2.4], [1.4, 1.1, 0.9], 4.0),
    ([2.2, 1.6], [0.8, 0.8, 0.8], 30.0),
    ([4.4, -1.6], [1.6, 1.0, 0.8], -14.0),
    ([4.9, 2.2], [1.0, 0.6, 1.0], 8.0),
    ([-5.0, 2.4], [0.9, 0.9, 0.9], 40.0),
];

/// Where pole `(i, j)` stands.
fn pole(i: u32, j: u32) -> DVec3 {
    let at = |k: u32, n: u32| (f64::from(k) - 0.5 * f64::from(n - 1)) * SPACING;
    DVec3::new(at(i, POLES.0), 0.0, at(j, POLES.1))
}

/// From pole to neighbouring pole, along x and then along z.
fn strings() -> Vec<(DVec3, DVec3)> {
    let (columns, rows) = POLES;
    let along_x =
        (0..rows).flat_map(|j| (0..columns - 1).map(move |i| (pole(i, j), pole(i + 1, j))));
    let along_z =
        (0..columns).flat_map(|i| (0..rows - 1).map(move |j| (pole(i, j), pole(i, j + 1))));
    along_x.chain(along_z).collect()
}

/// A number as short as it can be, of a tenth of a millimetre.
fn short(x: f64) -> f64 {
    (x * 1e4).round() / 1e4 + 0.0
}

fn vector(v: DVec3) -> String {
    format!("({}, {}, {})", short(v.x), short(v.y), short(v.z))
}

/// A box on the ground, as a mesh of its own.
fn solid(text: &mut String, name: &str, at: DVec3, size: [f64; 3], turn: f64, material: &str) {
    let [x, z] = [0.5 * size[0], 0.5 * size[2]];
    let corners = (0..8).map(|k| {
        let side = |bit: u32, half: f64| if k >> bit & 1 == 0 { -half } else { half };
        let y = if k >> 1 & 1 == 0 { 0.0 } else { size[1] };
        vector(DVec3::new(side(0, x), y, side(2, z)))
    });
    let corners: Vec<String> = corners.collect();
    let faces = "[(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 4, 6), (0, 6, 2), \
                 (1, 3, 7), (1, 7, 5), (2, 6, 7), (2, 7, 3), (0, 1, 5), (0, 5, 4)]";
    let mesh = format!("positions: [{}], indices: {faces}", corners.join(", "));
    let place = format!("translate: {}, rotate_deg: (0, {turn}, 0)", vector(at));
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "        \"{name}\": {{\"TriangleMesh\": ({mesh}), \"LocalTransform\": ({place}), \
         \"MaterialRef\": \"{material}\"}},"
    );
}

/// The scene's text.
fn scene(lamps: u32) -> String {
    let strings = strings();
    let total = strings.len() as u32 * lamps;
    let mut text = format!(
        "// A square at night under {total} coloured lamps on {} strings.\n\
         // Source: `steradian-tools generate festival --lamps {lamps}`, made for Steradian.\n\
         // Licence: MIT OR Apache-2.0.\n\
         // Stresses: the choice among many lights, each of which matters near itself only.\n\
         (\n    film: (width: 480, height: 270),\n    entities: {{\n",
        strings.len()
    );
    text += HEAD;
    for (name, [r, g, b]) in COLOURS {
        let glow = format!("\"Emission\": (radiance: ({r}, {g}, {b}))");
        let _ = writeln!(
            text,
            "        \"{name}\": {{\"Lambert\": (reflectance: 0), {glow}}},"
        );
    }
    text.push('\n');
    for j in 0..POLES.1 {
        for i in 0..POLES.0 {
            let size = [0.09, HEIGHT + 0.15, 0.09];
            solid(
                &mut text,
                &format!("pole {i} {j}"),
                pole(i, j),
                size,
                0.0,
                "wood",
            );
        }
    }
    for (k, ([x, z], size, turn)) in STALLS.into_iter().enumerate() {
        let at = DVec3::new(x, 0.0, z);
        solid(&mut text, &format!("stall {k}"), at, size, turn, "plaster");
    }
    text.push('\n');
    for (s, (from, to)) in strings.into_iter().enumerate() {
        for k in 0..lamps {
            let along = (f64::from(k) + 0.5) / f64::from(lamps);
            // A parabola, as near to a catenary as the eye can tell.
            let hang = HEIGHT - 4.0 * SAG * along * (1.0 - along);
            let at = from.lerp(to, along) + DVec3::Y * hang;
            let colour = if k % 2 == 0 {
                0
            } else {
                1 + s % (COLOURS.len() - 1)
            };
            let _ = writeln!(
                text,
                "        \"lamp {s} {k}\": {{\"Sphere\": (radius: {RADIUS}), \"LocalTransform\": \
                 (translate: {}), \"MaterialRef\": \"{}\"}},",
                vector(at),
                COLOURS[colour].0
            );
        }
    }
    text + "    },\n)\n"
}

/// Camera, ground and materials.
const HEAD: &str = r#"        "camera": {"PerspectiveCamera": (hfov_deg: 52), "LookAt": (from: (-5.2, 4.3, 9.3), to: (-0.2, 1.2, 0)), "ActiveCamera": ()},
        "sky": {"Environment": (radiance: (0.004, 0.006, 0.014))},

        "paving": {"MetallicRoughness": (base_color: (0.14, 0.13, 0.13), metallic: 0, roughness: 0.35)},
        "plaster": {"Lambert": (reflectance: (0.7, 0.66, 0.6))},
        "wood": {"Lambert": (reflectance: (0.2, 0.13, 0.08))},
        "ground": {"Quad": (width: 60, height: 60), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "paving"},
"#;

/// Makes the scene and writes it.
pub(super) fn write(args: &FestivalArgs) -> Result<Made, Error> {
    if !(1..=10_000).contains(&args.lamps) {
        let message = format!("--lamps: {} must be between 1 and 10000", args.lamps);
        return Err(Error::Usage(message));
    }
    save(&args.output, scene(args.lamps).as_bytes())?;
    Ok(Made {
        summary: vec![format!("{} lamps", strings().len() as u32 * args.lamps)],
        written: vec![args.output.clone()],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_of_the_repository_is_this() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../scenes/festival/festival.scene.ron"
        );
        let committed = std::fs::read_to_string(path).expect("a file of the repository");
        assert!(
            scene(30) == committed,
            "the scene is not what is made today"
        );
    }

    #[test]
    fn every_string_has_its_lamps() {
        for lamps in [1, 7] {
            let text = scene(lamps);
            let count = text.lines().filter(|l| l.contains("\"lamp ")).count();
            assert_eq!(count, 17 * lamps as usize);
        }
        let args = |lamps| FestivalArgs {
            output: "x.scene.ron".into(),
            lamps,
        };
        assert!(matches!(write(&args(0)), Err(Error::Usage(_))));
    }
}
