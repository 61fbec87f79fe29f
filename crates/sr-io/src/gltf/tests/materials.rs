//! Materials.

use super::builder::*;
use super::*;
use crate::model::{Lobe, Material};
use serde_json::{Value, json};
use sr_scene::components::{Emission, MetallicRoughness, Rgb};

/// A material and the notes of a file that holds it.
fn material(json: Value) -> (Material, String) {
    let mut b = Builder::square();
    let m = b.material(json);
    b.json["meshes"][0]["primitives"][0]["material"] = json!(m);
    let model = read(&b.embedded());
    assert_eq!(only_part(&model).material, Some(0));
    (model.materials[0].clone(), lines(&model.notes))
}

fn metallic_roughness(m: &Material) -> &MetallicRoughness {
    let Lobe::MetallicRoughness(lobe) = &m.lobe else {
        panic!("{:?}", m.lobe)
    };
    lobe
}

#[test]
fn factors_are_read_and_have_the_defaults_of_the_format() {
    let (m, notes) = material(json!({"name": "gold", "pbrMetallicRoughness": {
        "baseColorFactor": [1.0, 0.75, 0.25, 0.5], "metallicFactor": 0.5, "roughnessFactor": 0.125,
    }}));
    assert_eq!(m.name, "gold");
    let wanted = MetallicRoughness {
        base_color: Rgb([1.0, 0.75, 0.25]),
        metallic: 0.5,
        roughness: 0.125,
        ior: 1.5,
        transmission: 0.0,
    };
    assert_eq!(metallic_roughness(&m), &wanted);
    assert!(m.emission.is_none());
    assert!(notes.is_empty(), "{notes}");
    let (m, _) = material(json!({}));
    assert_eq!(metallic_roughness(&m), &MetallicRoughness::default());
}

#[test]
fn parts_without_material_share_a_default_behind_the_others() {
    let mut b = Builder::square();
    let model = read(&b.embedded());
    assert_eq!(
        (model.materials.len(), only_part(&model).material),
        (1, Some(0))
    );
    b.material(json!({"name": "unused"}));
    let model = read(&b.embedded());
    let names: Vec<_> = model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["unused", "default"]);
    assert_eq!(only_part(&model).material, Some(1));
    assert_eq!(
        metallic_roughness(&model.materials[1]),
        &MetallicRoughness::default()
    );
}

#[test]
fn emission_is_factor_times_strength_on_the_visible_sides() {
    let glow = |double_sided| {
        material(json!({
            "emissiveFactor": [1.0, 0.5, 0.0], "doubleSided": double_sided,
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 12.0}},
        }))
    };
    for two_sided in [true, false] {
        let wanted = Emission {
            radiance: Rgb([1.0, 0.5, 0.0]),
            strength: 12.0,
            two_sided,
        };
        assert_eq!(glow(two_sided).0.emission, Some(wanted));
    }
}

#[test]
fn transmission_is_a_thin_wall_unless_there_is_a_volume() {
    let glass = |thickness: Option<f32>, extra: Value| {
        let mut m = json!({
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.75, 1.0, 1.0], "metallicFactor": 0.0,
                                     "roughnessFactor": 0.0},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0},
                           "KHR_materials_ior": {"ior": 1.75}},
        });
        if let Some(t) = thickness {
            m["extensions"]["KHR_materials_volume"] = json!({"thicknessFactor": t});
        }
        for (k, v) in extra.as_object().unwrap() {
            *m.pointer_mut(k).unwrap() = v.clone();
        }
        material(m)
    };
    for thickness in [None, Some(0.0)] {
        let (m, notes) = glass(thickness, json!({}));
        let lobe = metallic_roughness(&m);
        assert_eq!((lobe.transmission, lobe.ior), (1.0, 1.75));
        assert!(notes.is_empty(), "{notes}");
    }
    let (m, notes) = glass(Some(0.1), json!({}));
    let Lobe::Dielectric(d) = &m.lobe else {
        panic!("{:?}", m.lobe)
    };
    assert_eq!(
        (d.ior, d.transmittance, d.reflectance),
        (1.75, Rgb([0.5, 0.75, 1.0]), Rgb::splat(1.0))
    );
    assert!(notes.is_empty(), "{notes}");
    let (_, notes) = glass(
        Some(0.1),
        json!({
            "/pbrMetallicRoughness/roughnessFactor": 0.5,
            "/extensions/KHR_materials_volume": {"thicknessFactor": 1.0, "attenuationDistance": 2.0},
            "/extensions/KHR_materials_transmission": {"transmissionFactor": 0.5},
        }),
    );
    for wanted in [
        "read as smooth; override its material with a `RoughDielectric`",
        "attenuation inside",
        "as glass only",
    ] {
        assert!(notes.contains(wanted), "{wanted} in {notes}");
    }
    let (m, _) = glass(
        Some(0.1),
        json!({"/pbrMetallicRoughness/metallicFactor": 1.0}),
    );
    assert_eq!(metallic_roughness(&m).metallic, 1.0, "metal is opaque");
}

#[test]
fn alpha_and_specular_are_warned_of_when_they_matter() {
    let specular = |factor: f32| {
        material(json!({
            "name": "cut", "alphaMode": "MASK",
            "extensions": {"KHR_materials_specular": {"specularFactor": factor}},
        }))
        .1
    };
    assert!(
        specular(1.0).contains("alpha modes are not read, materials are opaque (material `cut`)")
    );
    assert!(!specular(1.0).contains("KHR_materials_specular"));
    assert!(specular(0.5).contains("KHR_materials_specular"));
}

#[test]
fn factors_out_of_range_are_clamped_and_said() {
    let (m, notes) =
        material(json!({"pbrMetallicRoughness": {"roughnessFactor": 1.5, "metallicFactor": -1.0}}));
    let lobe = metallic_roughness(&m);
    assert_eq!((lobe.roughness, lobe.metallic), (1.0, 0.0));
    assert!(
        notes.contains("clamped (materials[0] and 1 more)"),
        "{notes}"
    );
}
