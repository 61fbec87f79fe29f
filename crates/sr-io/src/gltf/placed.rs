//! Cameras (§3.10) and punctual lights (`KHR_lights_punctual`).

use crate::model::{Camera, Light};
use crate::report::Report;
use gltf::json::camera::Type;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as LightJson, Type as LightType};
use gltf::json::validation::Checked;
use gltf::json::{Root, scene::Node as NodeJson};
use sr_scene::components::{
    DirectionalLight, Orthographic, PerspectiveCamera, PointLight, Rgb, SpotLight,
};
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::f32::consts::{FRAC_PI_2, PI};

/// Camera `c`. The vertical extent is kept, as in the specification; the horizontal one follows
/// from the picture.
pub(super) fn camera(root: &Root, c: usize, report: &mut Report) -> Option<Camera> {
    let json = &root.cameras[c];
    let (result, field) = match (json.type_, &json.perspective, &json.orthographic) {
        (Checked::Valid(Type::Perspective), Some(p), _) => {
            let fov = Some(p.yfov).filter(|f| *f > 0.0 && *f < PI);
            let camera = fov.map(|f| {
                Camera::Perspective(PerspectiveCamera {
                    hfov_deg: None,
                    vfov_deg: Some(f64::from(f).to_degrees()),
                })
            });
            let why = format!("{} must lie between 0 and π", p.yfov);
            (camera.ok_or(why), "perspective.yfov")
        }
        (Checked::Valid(Type::Orthographic), _, Some(o)) => {
            let half = Some(o.ymag).filter(|y| *y > 0.0 && y.is_finite());
            let camera = half.map(|y| {
                Camera::Orthographic(Orthographic {
                    width: None,
                    height: Some(2.0 * f64::from(y)),
                })
            });
            let why = format!("{} must be above 0", o.ymag);
            (camera.ok_or(why), "orthographic.ymag")
        }
        _ => (
            Err("its properties are not those of its type".into()),
            "type",
        ),
    };
    let error = |why| Diagnostic::error(why).field(format!("cameras[{c}].{field}"));
    result.map_err(|why| report.error(error(why))).ok()
}

/// The index of the light at a node.
fn light_index(node: &NodeJson) -> Option<usize> {
    let extension = node.extensions.as_ref()?.khr_lights_punctual.as_ref()?;
    Some(extension.light.value())
}

fn lights(root: &Root) -> &[LightJson] {
    root.as_ref()
}

/// The name of the light at a node.
pub(super) fn light_name(root: &Root, node: &NodeJson) -> Option<String> {
    lights(root).get(light_index(node)?)?.name.clone()
}

/// The light at a node.
pub(super) fn light(root: &Root, node: &NodeJson, report: &mut Report) -> Option<Light> {
    let l = light_index(node)?;
    let json = lights(root).get(l)?;
    let field = format!("extensions.KHR_lights_punctual.lights[{l}]");
    if json.range.is_some() {
        let text = "the range of lights is not read, they reach everywhere";
        report.note(Severity::Notice, text, &field);
    }
    convert(json)
        .map_err(|(sub, why)| report.error(Diagnostic::error(why).field(field + sub)))
        .ok()
}

fn convert(json: &LightJson) -> Result<Light, (&'static str, String)> {
    let power = Rgb(json.color.map(|c| c * json.intensity));
    if !power.within(0.0, f32::MAX) {
        let text = "colour times intensity must be finite and at least 0";
        return Err((".intensity", text.into()));
    }
    match json.type_ {
        Checked::Valid(LightType::Point) => Ok(Light::Point(PointLight { intensity: power })),
        Checked::Valid(LightType::Directional) => {
            Ok(Light::Directional(DirectionalLight { irradiance: power }))
        }
        Checked::Valid(LightType::Spot) => {
            let cone = json.spot.clone().unwrap_or_default();
            let (inner, outer) = (cone.inner_cone_angle, cone.outer_cone_angle);
            if !(0.0 <= inner && inner < outer && outer <= FRAC_PI_2) {
                let text = format!("angles {inner} and {outer} must rise from 0 to π/2 at most");
                return Err((".spot", text));
            }
            Ok(Light::Spot(SpotLight {
                intensity: power,
                inner_deg: inner.to_degrees(),
                // π/2 in degrees rounds above 90.
                outer_deg: outer.to_degrees().min(90.0),
            }))
        }
        Checked::Invalid => Err((".type", "the value is not valid here".into())),
    }
}
