//! Material libraries.

use super::*;
use crate::model::{Lobe, Material};
use sr_scene::components::{Dielectric, Emission, Lambert, MetallicRoughness, Mirror, Rgb};

/// The materials of a library, and the notes about it.
fn library(text: &str) -> (Vec<Material>, String) {
    let mut report = Report::new(Path::new("a.obj"));
    let materials = crate::obj::library::read_library(text, Path::new("a.mtl"), &mut report);
    let notes = report
        .finish(Model::default())
        .unwrap_or_else(|e| panic!("{}", lines(&e)))
        .notes;
    (materials, lines(&notes))
}

/// The only material of a library without notes.
fn material(statements: &str) -> Material {
    let (mut materials, notes) = library(&format!("newmtl m\n{statements}\n"));
    assert!(notes.is_empty(), "{notes}");
    assert_eq!(materials.len(), 1);
    materials.remove(0)
}

fn lambert(statements: &str) -> Rgb {
    match material(statements).lobe {
        Lobe::Lambert(Lambert { reflectance }) => reflectance,
        other => panic!("{statements}: {other:?}"),
    }
}

fn glossy(statements: &str) -> MetallicRoughness {
    match material(statements).lobe {
        Lobe::MetallicRoughness(m) => m,
        other => panic!("{statements}: {other:?}"),
    }
}

fn glass(statements: &str) -> Dielectric {
    match material(statements).lobe {
        Lobe::Dielectric(d) => d,
        other => panic!("{statements}: {other:?}"),
    }
}

#[test]
fn diffuse_materials() {
    assert_eq!(lambert("Kd 0.1 0.2 0.3\nKa 1 1 1"), Rgb([0.1, 0.2, 0.3]));
    assert_eq!(lambert("Kd 0.25"), Rgb::splat(0.25), "one number is a grey");
    assert_eq!(lambert(""), Rgb::splat(0.5));
    assert_eq!(
        lambert("Kd 0.2 0.2 0.2\nKs 0 0 0\nNs 100\nNi 1.45\nd 1\nillum 2"),
        Rgb::splat(0.2)
    );
    assert_eq!(
        lambert("Kd 0.2 0.2 0.2\nKs 1 1 1\nNs 100\nillum 1"),
        Rgb::splat(0.2),
        "no highlight"
    );
    assert_eq!(
        lambert("Kd 0.2 0.2 0.2\nKs 1 1 1"),
        Rgb::splat(0.2),
        "no exponent"
    );
}

#[test]
fn glossy_materials() {
    let m = glossy("Kd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 30\nNi 1.25\nillum 2");
    assert_eq!(
        (m.base_color, m.metallic, m.ior),
        (Rgb([0.1, 0.2, 0.3]), 0.0, 1.25)
    );
    // α = √(2/32) = 1/4, and roughness is its root.
    assert!((m.roughness - 0.5).abs() < 1e-6);
    assert_eq!(glossy("Ks 1 1 1\nNs 0").roughness, 1.0);
    assert_eq!(
        glossy("Ks 1 1 1\nNs 0\nNi 1").ior,
        1.5,
        "an index of 1 reflects nothing"
    );
}

#[test]
fn physically_based_materials() {
    let m = glossy("Kd 1 0.5 0\nPr 0.25\nPm 0.75\nKs 1 1 1\nNs 10\nillum 3");
    assert_eq!(
        (m.base_color, m.metallic, m.roughness),
        (Rgb([1.0, 0.5, 0.0]), 0.75, 0.25)
    );
    assert_eq!(glossy("Pm 1").roughness, 0.5);
    assert!((glossy("Pm 1\nNs 30").roughness - 0.5).abs() < 1e-6);
    assert_eq!(glossy("Pr 0").metallic, 0.0);
}

#[test]
fn mirrors() {
    for illum in [3, 5] {
        let m = material(&format!("Kd 0 0 0\nKs 0.9 0.8 0.7\nNs 1000\nillum {illum}"));
        let Lobe::Mirror(Mirror { reflectance }) = m.lobe else {
            panic!("{:?}", m.lobe)
        };
        assert_eq!(reflectance, Rgb([0.9, 0.8, 0.7]));
    }
    assert_eq!(
        lambert("Kd 0.2\nillum 5"),
        Rgb::splat(0.2),
        "black mirrors reflect nothing"
    );
    let (_, notes) = library("newmtl m\nKd 0.5\nKs 1\nillum 3\n");
    assert!(
        notes.contains("a.mtl: warning: mirrors (`illum` 3 and 5) are read without"),
        "{notes}"
    );
}

#[test]
fn glasses() {
    for illum in [4, 6, 7, 9] {
        assert_eq!(
            glass(&format!("Kd 0 0 0\nillum {illum}\nNi 1.25")).ior,
            1.25
        );
    }
    let g = glass("Kd 0.5 0.6 0.7\nd 0.1\nNi 1.5");
    assert_eq!(
        (g.transmittance, g.reflectance),
        (Rgb([0.5, 0.6, 0.7]), Rgb::splat(1.0))
    );
    assert_eq!(
        glass("Kd 0.5\nTf 0.9 0.8 0.7\nTr 0.9\nNi 1.5").transmittance,
        Rgb([0.9, 0.8, 0.7])
    );
    assert_eq!(glass("Kd 0 0 0\nillum 7").transmittance, Rgb::splat(1.0));
    assert_eq!(
        lambert("Kd 0.5\nTr 0.9\nd 1"),
        Rgb::splat(0.5),
        "`d` is the one to believe"
    );
    let (m, notes) = library("newmtl m\nKd 0.5\nd -halo 0.5\nNi 1\n");
    assert!(matches!(m[0].lobe, Lobe::Lambert(_)));
    assert!(
        notes.contains("transparency without an index of refraction"),
        "{notes}"
    );
}

#[test]
fn emission_is_on_both_sides() {
    let m = material("Kd 0.5\nKe 10 5 0");
    let wanted = Emission {
        radiance: Rgb([10.0, 5.0, 0.0]),
        strength: 1.0,
        two_sided: true,
    };
    assert_eq!(m.emission, Some(wanted));
    assert_eq!(material("Ke 0 0 0").emission, None);
}

#[test]
fn what_cannot_be_read_is_said_with_its_line() {
    let (m, notes) = library(
        "Kd 1 1 1\nnewmtl m\nKd 1 1\nNs many\nKs 0.5 nan 0\nillum x\nmap_Kd -s 1 1 1 a b.png\n\
         map_Ks\nPc 0.5\nKd spectral a.rfl\nnewmtl n\nKd 2 0 0\n",
    );
    assert_eq!(m.len(), 2);
    for wanted in [
        "a.mtl:1:1: warning: a statement before the first `newmtl` is ignored",
        "a.mtl:3:1: warning: a value that cannot be read is left at its default (`Kd 1 1` and 3 more)",
        "a.mtl:7:1: warning: textures are not read yet, factors are used (`map_Kd -s 1 1 1` and 1 more)",
        "a.mtl:9:1: warning: sheen, clear coat and anisotropy",
        "a.mtl:10:1: warning: colours by spectrum",
        "a.mtl: warning: colours outside of 0 to 1 are clamped (material `n`)",
    ] {
        assert!(notes.contains(wanted), "no `{wanted}` in:\n{notes}");
    }
    let Lobe::Lambert(l) = &m[1].lobe else {
        panic!("{:?}", m[1].lobe)
    };
    assert_eq!(l.reflectance, Rgb([1.0, 0.0, 0.0]));
}

#[test]
fn of_equal_names_the_last_counts() {
    let (m, notes) = library("newmtl a\nKd 0.1\nnewmtl b\nnewmtl a\nKd 0.2\n");
    let names: Vec<_> = m.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["a", "b"]);
    assert!(matches!(&m[0].lobe, Lobe::Lambert(l) if l.reflectance == Rgb::splat(0.2)));
    assert!(notes.contains("of the same name"));
}

/// Reads an OBJ of one triangle behind `head` from a folder with some libraries.
fn in_folder(head: &str, libraries: &[(&str, &str)]) -> Result<Model, String> {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in libraries {
        let path = dir.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let path = dir.path().join("my model.obj");
    let faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::fs::write(&path, format!("{head}{faces}usemtl red paint\nf 1 2 3\n")).unwrap();
    crate::obj::read(&path).map_err(|e| lines(&e))
}

#[test]
fn libraries_are_found_beside_the_file() {
    let text = "newmtl red paint\nKd 0.75 0 0\nnewmtl other\n";
    for (head, name) in [
        ("mtllib a.mtl\n", "a.mtl"),
        ("mtllib my colours.mtl\n", "my colours.mtl"),
        ("mtllib \"my colours.mtl\"\n", "my colours.mtl"),
        ("mtllib sub\\a.mtl\n", "sub/a.mtl"),
    ] {
        let model = in_folder(head, &[(name, text)]).unwrap();
        let i = model.nodes[0].parts[0].material.unwrap();
        assert_eq!(model.materials[i].name, "red paint", "{head}");
        assert!(
            matches!(&model.materials[i].lobe, Lobe::Lambert(l) if l.reflectance == Rgb([0.75, 0.0, 0.0]))
        );
        assert_eq!(model.materials.len(), 2);
    }
    let several = [("a.mtl", "newmtl other\n"), ("b.mtl", text)];
    assert_eq!(
        in_folder("mtllib a.mtl b.mtl\n", &several)
            .unwrap()
            .materials
            .len(),
        2
    );
}

#[test]
fn missing_libraries_and_materials_are_errors_with_a_line() {
    let errors = in_folder("#\nmtllib gone.mtl\n", &[]).unwrap_err();
    assert!(
        errors.contains("my model.obj:2:8: error: there is no material library"),
        "{errors}"
    );
    assert!(errors.contains("gone.mtl`"), "{errors}");
    assert_eq!(
        errors.lines().count(),
        1,
        "the materials in it are not to blame: {errors}"
    );
    let errors = in_folder("mtllib a.mtl\n", &[("a.mtl", "newmtl red pain\n")]).unwrap_err();
    assert!(
        errors.contains(":5:8: error: there is no material `red paint`; did you mean `red pain`?"),
        "{errors}"
    );
    let errors = in_folder(
        "mtllib a.mtl\n",
        &[("a.mtl", "newmtl red paint\nKd 1\nnewmtl\n")],
    )
    .unwrap_err();
    assert!(
        errors.contains("a.mtl:3:1: error: `newmtl` without a name"),
        "{errors}"
    );
}
