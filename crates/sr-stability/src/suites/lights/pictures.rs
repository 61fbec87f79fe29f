//! Pictures under lights of any brightness, under one light beside a billion times brighter one, and beside lights that are none.

use crate::worst::{Worst, relative};
use crate::{Bench, Sweep};
use sr_pipeline::glam::DVec3;

pub(super) fn sweeps() -> Vec<Sweep> {
    vec![radiance(), sun_and_candle(), none()]
}

/// A floor under a lamp, from above; more entities before the camera.
fn scene(more: &str) -> String {
    format!(
        "(film: (width: 16, height: 16), entities: {{\
         \"white\": {{\"Lambert\": (reflectance: 0.8)}},\
         \"floor\": {{\"Quad\": (width: 4, height: 4), \"LocalTransform\": (rotate_deg: (-90, 0, 0)), \"MaterialRef\": \"white\"}},\
         {more}\
         \"camera\": {{\"PerspectiveCamera\": (vfov_deg: 40), \
         \"LookAt\": (from: (0, 3, 2), to: (0, 0, 0)), \"ActiveCamera\": ()}}}})"
    )
}

fn lamp(radiance: f64) -> String {
    format!(
        "\"glow\": {{\"Lambert\": (reflectance: 0.2), \"Emission\": (radiance: {radiance:e})}},\
         \"ball\": {{\"Sphere\": (radius: 0.3), \"LocalTransform\": (translate: (0.5, 1, 0)), \"MaterialRef\": \"glow\"}},\
         \"panel\": {{\"Quad\": (width: 0.5, height: 0.5), \"LocalTransform\": (translate: (-0.7, 1, 0), rotate_deg: (90, 0, 0)), \
         \"MaterialRef\": \"glow\"}},"
    )
}

fn mean(more: &str, set: &[(&str, &str)]) -> Result<f64, String> {
    let picture = Bench::new(0).picture(&scene(more), set)?;
    let sum: DVec3 = picture.iter().map(|p| p.as_dvec3()).sum();
    Ok(sum.y / picture.len() as f64)
}

const PATH: [(&str, &str); 2] = [
    ("integrator", "Path(max_depth: 4)"),
    ("budget.samples", "16"),
];

fn see(worst: &mut Worst, case: &str, found: Result<f64, String>, truth: Result<f64, String>) {
    match (found, truth) {
        (Ok(found), Ok(truth)) => worst.see(relative(found, truth), || {
            format!("{case}: {found:e}, truth {truth:e}")
        }),
        (Err(why), _) | (_, Err(why)) => worst.see(f64::INFINITY, || format!("{case}: {why}")),
    }
}

fn radiance() -> Sweep {
    let unit = mean(&lamp(1.0), &PATH);
    let points = (-36..=36).step_by(6).map(|k| {
        let radiance = f64::from(10f32.powi(k));
        let mut worst = Worst::default();
        let found = mean(&lamp(radiance), &PATH).map(|m| m / radiance);
        see(&mut worst, "both lamps", found, unit.clone());
        worst.at(radiance)
    });
    Sweep {
        name: "radiance".into(),
        about: "A picture under two lamps, over their radiance, against that of radiance 1: the same random numbers.".into(),
        parameter: "radiance".into(),
        error: "relative error of the picture's mean".into(),
        // Roulette and the choice of a light see the same ratios, but for their rounding.
        bound: 1e-5,
        holds: [0.9e-30, 1.1e30],
        points: points.collect(),
    }
}

/// The sun shines from below the floor: all that is seen is the candle's, and the sun must not drown it.
fn sun_and_candle() -> Sweep {
    let candle =
        "\"candle\": {\"PointLight\": (intensity: 1), \"LocalTransform\": (translate: (0, 1, 0))},";
    let alone = mean(candle, &PATH);
    let points = (0..=12).step_by(3).map(|k| {
        let sun = format!(
            "{candle} \"sun\": {{\"DirectionalLight\": (irradiance: 1e{k}), \"LocalTransform\": (rotate_deg: (80, 0, 0))}},"
        );
        let mut worst = Worst::default();
        for selection in ["All", "Uniform"] {
            let set = [PATH[0], ("budget.samples", "256"), ("compile.light_selection", selection)];
            see(&mut worst, selection, mean(&sun, &set), alone.clone());
        }
        worst.at(10f64.powi(k))
    });
    Sweep {
        name: "sun_and_candle".into(),
        about: "A floor lit by a candle, with a sun that shines on its other side: both lights are sampled, and the picture is \
                the candle's."
            .into(),
        parameter: "irradiance of the sun, of the candle's".into(),
        error: "relative error of the picture's mean".into(),
        // Where one of the lights is chosen its share of the samples is even.
        bound: 5e-3,
        holds: [1.0, 1.1e9],
        points: points.collect(),
    }
}

/// Without radiance or without area.
fn nothing(i: usize) -> String {
    let x = -1.0 + 0.01 * i as f64;
    format!(
        "\"dark{i}\": {{\"Lambert\": (reflectance: 0), \"Emission\": (radiance: 0)}},\
         \"dark_ball{i}\": {{\"Sphere\": (radius: 0.01), \"LocalTransform\": (translate: ({x}, -1, 0)), \"MaterialRef\": \"dark{i}\"}},\
         \"dark_point{i}\": {{\"PointLight\": (intensity: 0), \"LocalTransform\": (translate: ({x}, 1, 0))}},\
         \"dark_sun{i}\": {{\"DirectionalLight\": (irradiance: 0)}},\
         \"line{i}\": {{\"TriangleMesh\": (positions: [({x}, 1, 0), ({x}, 1, 1), ({x}, 1, 2), ({x}, 1, 1)], \
         indices: [(0, 1, 2), (1, 1, 3), (2, 2, 2)]), \"MaterialRef\": \"glow\"}},"
    )
}

fn none() -> Sweep {
    let selections = ["Spatial", "Power", "Uniform"];
    let of = |count: usize, selection| {
        let more: String = (0..count).map(nothing).collect();
        let set = [PATH[0], PATH[1], ("compile.light_selection", selection)];
        mean(&format!("{}{more}", lamp(1.0)), &set)
    };
    let alone = selections.map(|s| of(0, s));
    let points = [1, 10, 100].map(|count| {
        let mut worst = Worst::default();
        for (selection, alone) in selections.iter().zip(&alone) {
            see(&mut worst, selection, of(count, selection), alone.clone());
        }
        worst.at(count as f64)
    });
    Sweep {
        name: "lights_that_are_none".into(),
        about: "Lamps, points and suns of radiance 0 and glowing triangles without area beside two lamps, with each choice of one \
                light: they are left out, and the picture is the same."
            .into(),
        parameter: "of each kind".into(),
        error: "relative change of the picture's mean".into(),
        bound: 0.0,
        holds: [1.0, 100.0],
        points: points.into(),
    }
}
