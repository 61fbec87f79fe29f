//! Statements of a material into a lobe; the table in the documentation of [`super`] says how.

use super::clean::finite;
use crate::model::{Lobe, Material};
use crate::report::Report;
use sr_scene::components::{
    Dielectric, Emission, Lambert, MetallicRoughness, Mirror, Rgb, SourceSpan,
};
use sr_scene::diagnostics::Severity;

/// What stands in for a material that nothing is known of.
pub(super) fn grey(name: &str) -> Material {
    Material {
        name: name.into(),
        lobe: Lobe::Lambert(Lambert::default()),
        emission: None,
    }
}

/// One material; the table of [`super`] says how.
pub(super) fn convert(m: &tobj::Material, span: &SourceSpan, report: &mut Report) -> Material {
    let mut warn = |text: &str| {
        let what = format!("material `{}`", m.name);
        report.note_at(Severity::Warning, text, what, Some(span.clone()));
    };
    let extra = |key: &str| m.unknown_param.get(key).and_then(|v| finite(v));
    let mut unit = |colour: [f32; 3]| {
        let clamped = colour.map(|c| c.clamp(0.0, 1.0));
        if clamped != colour {
            warn("colours outside of 0 to 1 are clamped");
        }
        Rgb(clamped)
    };
    let kd = m.diffuse.map(&mut unit);
    let ks = m.specular.map(&mut unit).unwrap_or_default();
    let tf = m.unknown_param.get("Tf").and_then(|t| {
        let numbers: Option<Vec<f32>> = t.split_ascii_whitespace().map(finite).collect();
        numbers?.try_into().ok().map(&mut unit)
    });
    let emission = m
        .emissive
        .map(|ke| ke.map(|c| c.max(0.0)))
        .filter(|ke| *ke != [0.0; 3]);
    let values = Values {
        kd,
        ks,
        tf,
        ior: m.optical_density.filter(|n| *n > 1.0),
        illum: m.illumination_model.unwrap_or(2),
        dissolve: m.dissolve.or(extra("Tr").map(|t| 1.0 - t)).unwrap_or(1.0),
        roughness: m.shininess.map(|ns| (2.0 / (ns.max(0.0) + 2.0)).powf(0.25)),
        pr: extra("Pr").map(|r| r.clamp(0.0, 1.0)),
        pm: extra("Pm").map(|m| m.clamp(0.0, 1.0)),
    };
    Material {
        name: m.name.clone(),
        lobe: values.lobe(&mut warn),
        emission: emission.map(|radiance| Emission {
            radiance: Rgb(radiance),
            strength: 1.0,
            two_sided: true,
        }),
    }
}

/// The statements of a material, within their ranges.
struct Values {
    kd: Option<Rgb>,
    ks: Rgb,
    tf: Option<Rgb>,
    /// `Ni`, when it bends light.
    ior: Option<f32>,
    illum: u8,
    dissolve: f32,
    /// From `Ns`.
    roughness: Option<f32>,
    pr: Option<f32>,
    pm: Option<f32>,
}

impl Values {
    fn lobe(&self, warn: &mut dyn FnMut(&str)) -> Lobe {
        let black = Rgb::default();
        let ior = self.ior.unwrap_or(MetallicRoughness::default().ior);
        let kd = self.kd.unwrap_or(Lambert::default().reflectance);
        let is_glass = matches!(self.illum, 4 | 6 | 7 | 9);
        if is_glass || self.dissolve < 1.0 && self.ior.is_some() {
            let of_kd = self.kd.filter(|c| *c != black);
            return Lobe::Dielectric(Dielectric {
                ior,
                transmittance: self.tf.or(of_kd).unwrap_or(Rgb::splat(1.0)),
                ..Dielectric::default()
            });
        }
        if self.dissolve < 1.0 {
            warn("transparency without an index of refraction is not read");
        }
        let glossy = |metallic: f32, roughness: f32| {
            Lobe::MetallicRoughness(MetallicRoughness {
                base_color: kd,
                metallic,
                roughness,
                ior,
                transmission: 0.0,
            })
        };
        if self.pr.is_some() || self.pm.is_some() {
            let roughness = self.pr.or(self.roughness).unwrap_or(0.5);
            return glossy(self.pm.unwrap_or(0.0), roughness);
        }
        if matches!(self.illum, 3 | 5) && self.ks != black {
            if self.kd.is_some_and(|c| c != black) {
                warn("mirrors (`illum` 3 and 5) are read without their diffuse part");
            }
            return Lobe::Mirror(Mirror {
                reflectance: self.ks,
            });
        }
        match self.roughness {
            Some(roughness) if self.ks != black && self.illum > 1 => glossy(0.0, roughness),
            _ => Lobe::Lambert(Lambert { reflectance: kd }),
        }
    }
}
