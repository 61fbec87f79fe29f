//! Materials (§3.9): factors of the metallic-roughness model and of the extensions that are read.
//!
//! Glass is the one place where the model of the file and ours differ in kind: transmission with a
//! volume of non-zero thickness becomes a smooth [`Dielectric`], whose two interfaces bend light.
//! Without a volume, or with thickness 0 (which `KHR_materials_volume` defines as a thin wall),
//! light passes straight on.

use crate::model::{Lobe, Material};
use crate::report::Report;
use gltf::json::Root;
use gltf::json::extensions::material::Material as Extensions;
use gltf::json::material::{AlphaMode, Material as Json};
use gltf::json::validation::Checked;
use sr_scene::components::{Dielectric, Emission, MetallicRoughness, Rgb};
use sr_scene::diagnostics::{Diagnostic, Severity};

/// The material of primitives that name none (§5.19).
pub(super) fn default() -> Material {
    Material {
        name: "default".into(),
        lobe: Lobe::MetallicRoughness(MetallicRoughness::default()),
        emission: None,
    }
}

/// All materials, in the order of the file.
pub(super) fn read_all(root: &Root, report: &mut Report) -> Vec<Material> {
    let materials = root.materials.iter().enumerate();
    materials
        .map(|(i, json)| Reader::new(i, json, report).read())
        .collect()
}

/// Reads one material.
struct Reader<'a> {
    json: &'a Json,
    extensions: Extensions,
    /// Its field, and its name for notes.
    field: String,
    label: String,
    report: &'a mut Report,
}

impl<'a> Reader<'a> {
    fn new(i: usize, json: &'a Json, report: &'a mut Report) -> Self {
        let field = format!("materials[{i}]");
        Self {
            json,
            extensions: json.extensions.clone().unwrap_or_default(),
            label: json
                .name
                .as_ref()
                .map_or(field.clone(), |n| format!("material `{n}`")),
            field,
            report,
        }
    }

    fn read(mut self) -> Material {
        self.note_what_is_not_read();
        Material {
            name: self.json.name.clone().unwrap_or_default(),
            emission: self.emission(),
            lobe: self.lobe(),
        }
    }

    fn note(&mut self, severity: Severity, text: &str) {
        self.report.note(severity, text, &self.label);
    }

    fn error(&mut self, sub: &str, text: &str) {
        let field = format!("{}.{sub}", self.field);
        self.report.error(Diagnostic::error(text).field(field));
    }

    fn note_what_is_not_read(&mut self) {
        if self.json.alpha_mode != Checked::Valid(AlphaMode::Opaque) {
            self.note(
                Severity::Warning,
                "alpha modes are not read, materials are opaque",
            );
        }
        let specular = self.extensions.specular.as_ref().is_some_and(|s| {
            s.specular_factor.0 != 1.0
                || s.specular_color_factor.0 != [1.0; 3]
                || s.specular_texture.is_some()
                || s.specular_color_texture.is_some()
        });
        if specular {
            let text = "the extension `KHR_materials_specular` is not read, f0 follows from the \
                        index of refraction";
            self.note(Severity::Warning, text);
        }
    }

    fn lobe(&mut self) -> Lobe {
        let pbr = &self.json.pbr_metallic_roughness;
        let [r, g, b, _] = pbr.base_color_factor.0;
        let base_color = Rgb([
            self.unit("pbrMetallicRoughness.baseColorFactor", r),
            self.unit("pbrMetallicRoughness.baseColorFactor", g),
            self.unit("pbrMetallicRoughness.baseColorFactor", b),
        ]);
        let metallic = self.unit("pbrMetallicRoughness.metallicFactor", pbr.metallic_factor.0);
        let roughness = self.unit(
            "pbrMetallicRoughness.roughnessFactor",
            pbr.roughness_factor.0,
        );
        let ior = self.ior();
        let transmission = self.extensions.transmission.as_ref();
        let transmission = transmission.map_or(0.0, |t| t.transmission_factor.0);
        let transmission = self.unit(
            "extensions.KHR_materials_transmission.transmissionFactor",
            transmission,
        );
        let thickness = self
            .extensions
            .volume
            .as_ref()
            .map_or(0.0, |v| v.thickness_factor.0);
        // Metal lets nothing through, whatever its transmission (§3.9.2).
        if transmission > 0.0 && thickness > 0.0 && metallic < 1.0 {
            self.note_approximations_of_glass(transmission, metallic, roughness);
            return Lobe::Dielectric(Dielectric {
                ior,
                transmittance: base_color,
                ..Dielectric::default()
            });
        }
        Lobe::MetallicRoughness(MetallicRoughness {
            base_color,
            metallic,
            roughness,
            ior,
            transmission,
        })
    }

    fn note_approximations_of_glass(&mut self, transmission: f32, metallic: f32, roughness: f32) {
        if roughness > 0.0 {
            self.note(
                Severity::Warning,
                "glass with a volume is read as smooth; override its material with a `RoughDielectric`",
            );
        }
        if transmission < 1.0 || metallic > 0.0 {
            let text = "glass with a volume is read as glass only, without its diffuse or metallic \
                        share";
            self.note(Severity::Warning, text);
        }
        let volume = self.extensions.volume.as_ref();
        if volume.is_some_and(|v| v.attenuation_distance.0.is_finite()) {
            self.note(
                Severity::Warning,
                "attenuation inside of volumes is not read",
            );
        }
    }

    fn ior(&mut self) -> f32 {
        let default = MetallicRoughness::default().ior;
        let ior = self.extensions.ior.as_ref().map_or(default, |i| i.ior.0);
        if ior == 0.0 {
            let text = "an index of refraction of 0, which means that all is reflected, is not \
                        read; 1.5 is used";
            self.note(Severity::Warning, text);
            return default;
        }
        if !(1.0..=f32::MAX).contains(&ior) {
            self.error("extensions.KHR_materials_ior.ior", "must be at least 1");
            return default;
        }
        ior
    }

    /// A factor between 0 and 1; one outside is clamped with a warning, as exporters write them.
    fn unit(&mut self, field: &str, x: f32) -> f32 {
        if (0.0..=1.0).contains(&x) {
            return x;
        }
        if !x.is_finite() {
            self.error(field, "must be finite");
            return 0.0;
        }
        self.note(Severity::Warning, "factors outside of 0 to 1 are clamped");
        x.clamp(0.0, 1.0)
    }

    fn emission(&mut self) -> Option<Emission> {
        let factor = Rgb(self.json.emissive_factor.0);
        let strength = self.extensions.emissive_strength.as_ref();
        let strength = strength.map_or(1.0, |s| s.emissive_strength.0);
        if !factor.within(0.0, f32::MAX) {
            self.error(
                "emissiveFactor",
                "each channel must be finite and at least 0",
            );
            return None;
        }
        if !(0.0..=f32::MAX).contains(&strength) {
            let field = "extensions.KHR_materials_emissive_strength.emissiveStrength";
            self.error(field, "must be finite and at least 0");
            return None;
        }
        (factor != Rgb::default() && strength > 0.0).then_some(Emission {
            radiance: factor,
            strength,
            two_sided: self.json.double_sided,
        })
    }
}
