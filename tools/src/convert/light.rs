//! `<light>`: the classic assignment's area light, and the four lights of COLLADA.

use super::xml::{Reader, Xml, child, course_technique, label, start, tag};

/// A light as the file has it; where it is and whither it shines is the node's business.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LightSource {
    /// A parallelogram of the node's edges −X and +Y that shines along the node's −Z.
    Area { radiance: [f64; 3] },
    /// W/sr.
    Point { intensity: [f64; 3] },
    /// W/sr; half angles.
    Spot {
        intensity: [f64; 3],
        inner_deg: f64,
        outer_deg: f64,
    },
    /// W/m².
    Directional { irradiance: [f64; 3] },
    /// Constant radiance from everywhere.
    Ambient { radiance: [f64; 3] },
}

impl<'a> Reader<'a> {
    /// Read a `<light>`.
    pub fn light(&mut self, light: Xml<'a>) -> Option<LightSource> {
        let element = |technique: Xml<'a>| technique.children().find(|c| c.is_element());
        if let Some(block) = course_technique(light).and_then(element) {
            if let Some(source) = self.light_of_kind(light, block)? {
                return Some(source);
            }
            let message = format!("`{}` is no light of the CGL profile", tag(block));
            let remedy = "the light of technique_common is used";
            self.diag.fault(start(block), message, remedy);
        }
        let Some(block) = child(light, "technique_common").and_then(element) else {
            let message = format!("light `{}` has no <technique_common>", label(light));
            let hint = "point, spot, directional, ambient or a CGL block is needed";
            self.diag.error(start(light), message, hint);
            return None;
        };
        let source = self.light_of_kind(light, block)?;
        if source.is_none() {
            let message = format!("`{}` is no light", tag(block));
            let hint = "point, spot, directional or ambient is needed";
            self.diag.error(start(block), message, hint);
        }
        source
    }

    /// `Some(None)` for a kind that is not known.
    fn light_of_kind(&mut self, light: Xml<'a>, block: Xml<'a>) -> Option<Option<LightSource>> {
        let kind = tag(block);
        if !["area", "point", "spot", "directional", "ambient"].contains(&kind) {
            return Some(None);
        }
        let Some(color) = child(block, "color") else {
            let message = format!("<{kind}> without a <color>");
            self.diag.error(start(block), message, "add it");
            return None;
        };
        let color = self.color(color)?;
        if matches!(kind, "point" | "spot") {
            self.attenuation(light, block)?;
        }
        Some(Some(match kind {
            "area" => LightSource::Area { radiance: color },
            "point" => LightSource::Point { intensity: color },
            "directional" => LightSource::Directional { irradiance: color },
            "ambient" => LightSource::Ambient { radiance: color },
            _ => self.spot(light, block, color)?,
        }))
    }

    /// Light falls off with the square of the distance and with nothing else.
    fn attenuation(&mut self, light: Xml<'a>, block: Xml<'a>) -> Option<()> {
        let mut physical = true;
        for (name, wanted) in [
            ("constant_attenuation", 0.0),
            ("linear_attenuation", 0.0),
            ("quadratic_attenuation", 1.0),
        ] {
            if let Some(node) = child(block, name) {
                physical &= self.number(node)? == wanted;
            }
        }
        if !physical {
            self.diag.note(format!(
                "dropped the attenuation of light `{}`: it falls off with the square of the distance",
                label(light)
            ));
        }
        Some(())
    }

    /// The angle is the whole cone's, as Blender writes it. The exponent is the power of the
    /// cosine in OpenGL and the soft share of the cone in Blender; both are hardly soft near 0.
    fn spot(&mut self, light: Xml<'a>, block: Xml<'a>, color: [f64; 3]) -> Option<LightSource> {
        let angle = match child(block, "falloff_angle") {
            Some(node) => self.number(node)?,
            None => 180.0,
        };
        let exponent = match child(block, "falloff_exponent") {
            Some(node) => self.number(node)?,
            None => 0.0,
        };
        if !(angle > 0.0 && angle <= 180.0) {
            let message = format!("a spot light with a cone of {angle} degrees");
            let remedy = "the cone is taken as a half space";
            self.diag.fault(start(block), message, remedy);
        }
        let outer_deg = if angle > 0.0 { angle.min(180.0) } else { 180.0 } / 2.0;
        let inner_deg = outer_deg * (1.0 - exponent.clamp(0.0, 1.0));
        let name = label(light);
        if exponent != 0.0 {
            self.diag.note(format!(
                "approximated the falloff of spot light `{name}`: exponent {exponent} became a \
                 soft edge from {inner_deg} to {outer_deg} degrees"
            ));
        }
        Some(LightSource::Spot {
            intensity: color,
            inner_deg,
            outer_deg,
        })
    }
}
