//! The text of a `*.scene.ron`: materials, lights, analytic spheres, the camera.

use super::camera::{Framing, View};
use super::glb::mesh_materials;
use super::light::LightSource;
use super::material::{Lobe, Surface};
use super::names::Names;
use super::nodes::{PlacedLight, Scene};
use glam::DVec3;
use std::fmt::Write;

/// An environment map for the scene.
pub(crate) struct MapLight {
    /// As the scene file shall name it.
    pub path: String,
    pub rotation_deg: f64,
}

/// What the text is made of beside the scene.
pub(crate) struct Parts<'p> {
    /// File that was converted.
    pub source: &'p str,
    /// Name of the model, and of its file.
    pub model: (&'p str, &'p str),
    /// Names of the scene's materials.
    pub materials: &'p [String],
    pub camera: Option<&'p Framing>,
    pub environment: Option<&'p MapLight>,
}

/// The whole text.
pub(crate) fn write(scene: &Scene, parts: &Parts<'_>) -> String {
    let source: String = parts.source.chars().filter(|c| !c.is_control()).collect();
    let mut out = format!("// made by steradian-tools convert from {source}\n(\n");
    let in_meshes = mesh_materials(scene);
    let (model, file) = parts.model;
    if !scene.roots.is_empty() {
        let (model, file) = (quoted(model), quoted(file));
        line(
            &mut out,
            1,
            &format!("models: [(name: {model}, path: {file})],"),
        );
    }
    if let Some(Framing { film: (w, h), .. }) = parts.camera {
        line(&mut out, 1, &format!("film: (width: {w}, height: {h}),"));
    }
    line(&mut out, 1, "entities: {");
    for (name, components) in entities(scene, parts) {
        line(
            &mut out,
            2,
            &format!("{}: {{{components}}},", quoted(&name)),
        );
    }
    line(&mut out, 1, "},");
    if !in_meshes.is_empty() {
        line(&mut out, 1, "overrides: {");
        for index in in_meshes {
            let key = quoted(&format!("materials.{model}/{}", parts.materials[index]));
            let surface = surface(&scene.materials.list[index].surface);
            line(&mut out, 2, &format!("{key}: {{{surface}}},"));
        }
        line(&mut out, 1, "},");
    }
    out.push_str(")\n");
    out
}

fn line(out: &mut String, depth: usize, text: &str) {
    out.push_str(&"    ".repeat(depth));
    out.push_str(text);
    out.push('\n');
}

/// Name and components of every entity.
fn entities(scene: &Scene, parts: &Parts<'_>) -> Vec<(String, String)> {
    let mut names = Names::default();
    let mut out = Vec::new();
    // Materials of spheres; those of meshes come with the model.
    let mut entity_of = vec![String::new(); scene.materials.list.len()];
    for sphere in &scene.spheres {
        let index = sphere.material;
        if entity_of[index].is_empty() {
            entity_of[index] = names.claim(&parts.materials[index]);
            let body = surface(&scene.materials.list[index].surface);
            out.push((entity_of[index].clone(), body));
        }
    }
    for sphere in &scene.spheres {
        let body = format!(
            "\"Sphere\": (radius: {}), \"LocalTransform\": (translate: {}), \"MaterialRef\": {}",
            number(sphere.radius),
            vector(sphere.centre.into()),
            quoted(&entity_of[sphere.material]),
        );
        out.push((names.claim(&sphere.name), body));
    }
    for light in &scene.lights {
        add_light(light, &mut names, &mut out);
    }
    out.extend(environment(scene, parts).map(|e| (names.claim("environment"), e)));
    out.extend(parts.camera.map(|c| (names.claim("camera"), camera(c))));
    out
}

fn add_light(light: &PlacedLight, names: &mut Names, out: &mut Vec<(String, String)>) {
    let name = names.claim(&light.name);
    let place = placement(light.position, light.rotate_deg);
    let source = match light.source {
        LightSource::Area { radiance } => {
            let material = names.claim(&format!("{name}_emission"));
            let (w, h) = (number(light.size.0), number(light.size.1));
            let reference = quoted(&material);
            let quad = format!(
                "\"Quad\": (width: {w}, height: {h}), {place}, \"MaterialRef\": {reference}"
            );
            out.push((name, quad));
            let lobe = Lobe::Lambert {
                reflectance: [0.0; 3],
            };
            let emission = Some(radiance);
            out.push((material, surface(&Surface { lobe, emission })));
            return;
        }
        LightSource::Point { intensity } => {
            format!("\"PointLight\": (intensity: {})", vector(intensity))
        }
        LightSource::Spot {
            intensity,
            inner_deg,
            outer_deg,
        } => format!(
            "\"SpotLight\": (intensity: {}, inner_deg: {}, outer_deg: {})",
            vector(intensity),
            number(inner_deg),
            number(outer_deg),
        ),
        LightSource::Directional { irradiance } => {
            format!("\"DirectionalLight\": (irradiance: {})", vector(irradiance))
        }
        // Ambient lights are summed in the scene and have no place.
        LightSource::Ambient { .. } => return,
    };
    out.push((name, format!("{source}, {place}")));
}

fn environment(scene: &Scene, parts: &Parts<'_>) -> Option<String> {
    if let Some(map) = parts.environment {
        return Some(format!(
            "\"Environment\": (map: {}, flip_u: true, rotation_deg: {}, scale: 1.0)",
            quoted(&map.path),
            number(map.rotation_deg),
        ));
    }
    let lit = scene.ambient != [0.0; 3];
    lit.then(|| format!("\"Environment\": (radiance: {})", vector(scene.ambient)))
}

fn placement(position: DVec3, rotate_deg: [f64; 3]) -> String {
    let mut out = format!(
        "\"LocalTransform\": (translate: {}",
        vector(position.into())
    );
    // Digits count from a full turn: an angle of 10⁻¹⁵ degrees is noise.
    let rotate = vector_beside(rotate_deg, 360.0);
    if rotate != vector([0.0; 3]) {
        // Writing to a string cannot fail.
        let _ = write!(out, ", rotate_deg: {rotate}");
    }
    out.push(')');
    out
}

fn camera(framing: &Framing) -> String {
    let lens = match framing.view {
        View::Hfov(x) => format!("\"PerspectiveCamera\": (hfov_deg: {})", number(x)),
        View::Vfov(y) => format!("\"PerspectiveCamera\": (vfov_deg: {})", number(y)),
        View::Width(w) => format!("\"Orthographic\": (width: {})", number(w)),
        View::Height(h) => format!("\"Orthographic\": (height: {})", number(h)),
    };
    format!(
        "{lens}, \"LookAt\": (from: {}, to: {}, up: {}), \"ActiveCamera\": ()",
        vector(framing.from.into()),
        vector(framing.to.into()),
        vector(framing.up.into()),
    )
}

/// The components of a material.
fn surface(surface: &Surface) -> String {
    let lobe = match &surface.lobe {
        Lobe::Lambert { reflectance } => {
            format!("\"Lambert\": (reflectance: {})", vector(*reflectance))
        }
        Lobe::Mirror { reflectance } => {
            format!("\"Mirror\": (reflectance: {})", vector(*reflectance))
        }
        Lobe::Refraction { transmittance, ior } => format!(
            "\"Refraction\": (ior: {}, transmittance: {})",
            number(*ior),
            vector(*transmittance)
        ),
        Lobe::Dielectric {
            ior,
            reflectance,
            transmittance,
        } => format!(
            "\"Dielectric\": (ior: {}, reflectance: {}, transmittance: {}, fresnel: Exact)",
            number(*ior),
            vector(*reflectance),
            vector(*transmittance)
        ),
        Lobe::RoughDielectric {
            ior,
            reflectance,
            transmittance,
            alpha,
        } => format!(
            "\"RoughDielectric\": (ior: {}, reflectance: {}, transmittance: {}, alpha: {})",
            number(*ior),
            vector(*reflectance),
            vector(*transmittance),
            number(*alpha)
        ),
        Lobe::Conductor { eta, k, alpha } => format!(
            "\"Conductor\": (eta: {}, k: {}, alpha: {})",
            vector(*eta),
            vector(*k),
            number(*alpha)
        ),
    };
    match surface.emission {
        None => lobe,
        Some(radiance) => format!(
            "{lobe}, \"Emission\": (radiance: {}, two_sided: false)",
            vector(radiance)
        ),
    }
}

/// Significant digits that are written. Computed numbers are off by some 10⁻¹⁵ of themselves;
/// twelve digits hide that, and are five more than the single precision of what is rendered.
const DIGITS: i32 = 12;

/// A number in RON.
fn number(x: f64) -> String {
    shortest(rounded(x, x.abs()))
}

/// Three numbers in RON, rounded to the digits of the largest, beside which the noise of a
/// cancellation is nothing.
fn vector(v: [f64; 3]) -> String {
    vector_beside(v, v.iter().fold(0.0, |m: f64, x| m.max(x.abs())))
}

fn vector_beside(v: [f64; 3], scale: f64) -> String {
    let [x, y, z] = v.map(|x| shortest(rounded(x, scale)));
    format!("({x}, {y}, {z})")
}

/// `x` rounded to a decimal place that is [`DIGITS`] digits below the first of `scale`.
fn rounded(x: f64, scale: f64) -> f64 {
    if scale == 0.0 || !scale.is_finite() {
        return x;
    }
    let places = DIGITS - 1 - scale.log10().floor() as i32;
    if places <= 0 {
        return x;
    }
    // Through text, which rounds correctly where a product with a power of ten would not.
    let text = format!("{x:.*}", places as usize);
    text.parse().unwrap_or(x)
}

/// Shortest text that reads back as `x`, with a decimal point; no negative zero.
fn shortest(x: f64) -> String {
    let x = if x == 0.0 { 0.0 } else { x };
    format!("{x:?}")
}

/// A RON string.
fn quoted(s: &str) -> String {
    let mut out = String::from("\"");
    for c in s.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{{{:x}}}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_lose_only_noise() {
        assert_eq!(number(0.3), "0.3");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(3.0), "3.0");
        assert_eq!(number(30.676_393_434_123), "30.6763934341");
        assert_eq!(number(1e-9 / 3.0), "3.33333333333e-10");
        assert_eq!(number(1.5e18), "1.5e18");
        assert_eq!(vector([-0.0, 6e-17, 1.49]), "(0.0, 0.0, 1.49)");
        assert_eq!(vector([123_456.7, 1e-6, 0.0]), "(123456.7, 1e-6, 0.0)");
    }

    #[test]
    fn strings_are_escaped() {
        assert_eq!(quoted("a\"b\\c\n"), r#""a\"b\\c\u{a}""#);
    }
}
