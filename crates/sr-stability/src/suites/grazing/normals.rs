//! Interpolated normals that face away: from who looks, or from where the light is.

use crate::worst::Worst;
use crate::{Bench, Effort, Sweep};
use sr_pipeline::glam::DVec3;

/// Degrees by which the normals lean outwards at both ends of a flat sheet.
const TILTS: [f64; 8] = [1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 80.0, 90.0];

const OPAQUE: [&str; 5] = [
    "\"Lambert\": (reflectance: 1)",
    "\"OrenNayar\": (reflectance: 1)",
    "\"Mirror\": ()",
    "\"Conductor\": (metal: \"Ag\", alpha: 0.3)",
    "\"MetallicRoughness\": (roughness: 0.5, metallic: 0.5)",
];

/// No gain is possible in these by their values or by their weights, whichever side is seen. Glass with an inside is not
/// among them: a sheet has none, and radiance in it is η² times that outside.
const WHITE: [&str; 4] = [OPAQUE[0], OPAQUE[2], OPAQUE[3], "\"ThinDielectric\": ()"];

/// From the front, and along the surface, from where half of the normals face away.
const EYES: [&str; 2] = ["(0, 0, 3)", "(-3, 0, 0.6)"];

/// Two triangles in z = 0 that fill the picture, and lights.
fn scene(material: &str, tilt: f64, eye: &str, lights: &str) -> String {
    let (sin, cos) = tilt.to_radians().sin_cos();
    let (left, right) = (
        format!("({}, 0, {cos})", -sin),
        format!("({sin}, 0, {cos})"),
    );
    format!(
        "(film: (width: 8, height: 8), entities: {{\
         \"m\": {{{material}}},\
         \"sheet\": {{\"TriangleMesh\": (positions: [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], \
         normals: [{left}, {right}, {right}, {left}], indices: [(0, 1, 2), (0, 2, 3)]), \"MaterialRef\": \"m\"}},\
         {lights}\
         \"camera\": {{\"PerspectiveCamera\": (vfov_deg: 4), \"LookAt\": (from: {eye}, to: (0, 0, 0)), \
         \"ActiveCamera\": ()}}}})"
    )
}

/// Behind the sheet, out to both sides.
const LAMPS: &str = "\"lamp\": {\"Lambert\": (reflectance: 0), \"Emission\": ()},\
    \"l\": {\"Sphere\": (radius: 0.9), \"LocalTransform\": (translate: (-3, 0, -1)), \"MaterialRef\": \"lamp\"},\
    \"r\": {\"Sphere\": (radius: 0.9), \"LocalTransform\": (translate: (3, 0, -1)), \"MaterialRef\": \"lamp\"},";
const SKY: &str = "\"sky\": {\"Environment\": ()},";

/// The largest component of the picture's mean.
fn mean(text: &str, integrator: &str, samples: &str) -> Result<f64, String> {
    let set = [("integrator", integrator), ("budget.samples", samples)];
    let picture = Bench::new(0).picture(text, &set)?;
    let sum: DVec3 = picture.iter().map(|p| p.as_dvec3()).sum();
    Ok(sum.max_element() / picture.len() as f64)
}

pub(super) fn sweeps(effort: &Effort) -> Vec<Sweep> {
    vec![leaks(effort), gain(effort)]
}

fn sweep(
    name: &str,
    about: &str,
    error: &str,
    bound: f64,
    at: impl Fn(f64) -> Vec<(String, Result<f64, String>)>,
) -> Sweep {
    let points = TILTS.map(|tilt| {
        let mut worst = Worst::default();
        for (case, found) in at(tilt) {
            match found {
                Ok(error) => worst.see(error, || case),
                Err(why) => worst.see(f64::INFINITY, || format!("{case}: {why}")),
            }
        }
        worst.at(tilt)
    });
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: "tilt of the normals, degrees".into(),
        error: error.into(),
        bound,
        holds: [1.0, 90.0],
        points: points.into(),
    }
}

fn cases(materials: &[&'static str]) -> impl Iterator<Item = (&'static str, &'static str, String)> {
    materials
        .iter()
        .copied()
        .flat_map(|m| EYES.map(|eye| (m, eye, format!("{m} from {eye}"))))
}

/// Light and scattered directions are on the far side by the geometry, on the near one by the normals.
fn leaks(effort: &Effort) -> Sweep {
    let samples = effort.choose("16", "256");
    let at = |tilt| {
        let one = |(material, eye, case)| {
            let text = scene(material, tilt, eye, LAMPS);
            (case, mean(&text, "Path(max_depth: 4)", samples))
        };
        cases(&OPAQUE).map(one).collect()
    };
    sweep(
        "normals_leak",
        "An opaque flat sheet whose interpolated normals lean outwards, with lights behind it only: what is seen of them. \
         Where normals are mapped it would be the same; Steradian has no normal maps.",
        "radiance that comes through, of 1",
        0.0,
        at,
    )
}

/// Every weight is at most 1, and so is the mean but for its rounding.
fn gain(effort: &Effort) -> Sweep {
    let samples = effort.choose("16", "256");
    let at = |tilt| {
        let one = |(material, eye, case)| {
            let text = scene(material, tilt, eye, SKY);
            let found = mean(&text, "PathBsdf(max_depth: 8)", samples);
            (case, found.map(|m| (m - 1.0).max(0.0)))
        };
        cases(&WHITE).map(one).collect()
    };
    sweep(
        "normals_gain",
        "White sheets with such normals under a white sky of radiance 1, and refused samples.",
        "radiance gained",
        1e-5,
        at,
    )
}
