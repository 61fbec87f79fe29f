//! Materials, lights and cameras in the scene file.

use super::support::*;
use glam::DVec3;
use sr_tools::convert::{CameraMode, Options, View};

#[test]
fn course_materials_become_lobes() {
    let ron = convert_fixture("course.dae").ron;
    let check = |name: &str, wanted: &str| assert_eq!(line(&ron, name), wanted);
    check("mirror", r#"{"Mirror": (reflectance: (1.0, 0.8, 0.4))}"#);
    check(
        "glass",
        r#"{"RoughDielectric": (ior: 1.45, reflectance: (1.0, 1.0, 1.0), transmittance: (1.0, 0.75, 0.75), alpha: 0.1)}"#,
    );
    check(
        "refraction",
        r#"{"Refraction": (ior: 1.33, transmittance: (0.5, 1.0, 1.0))}"#,
    );
    check(
        "metal",
        r#"{"Conductor": (eta: (0.059193, 0.059881, 0.047366), k: (4.1283, 3.5892, 2.8132), alpha: 0.25)}"#,
    );
    check(
        "materials.course/diffuse",
        r#"{"Lambert": (reflectance: (0.6, 0.2, 0.2))}"#,
    );
    check(
        "materials.course/emission",
        r#"{"Lambert": (reflectance: (0.0, 0.0, 0.0)), "Emission": (radiance: (20.0, 10.0, 5.0), two_sided: false)}"#,
    );
    // And the whole is RON with these names in it.
    assert!(entry(&ron, "entities", "mirror").contains("Mirror"));
    assert!(entry(&ron, "overrides", "materials.course/emission").contains("Emission"));
}

#[test]
fn roughness_makes_glass_rough_and_zero_leaves_it_smooth() {
    let zero = [("<roughness>0.1<", "<roughness>0<")];
    let smooth = convert_changed("course.dae", &zero, &Options::default()).unwrap();
    assert_eq!(
        line(&smooth.ron, "glass"),
        r#"{"Dielectric": (ior: 1.45, reflectance: (1.0, 1.0, 1.0), transmittance: (1.0, 0.75, 0.75), fresnel: Exact)}"#
    );
    let rough = [("<roughness>0<", "<roughness>0.3<")];
    let rough = convert_changed("course.dae", &rough, &Options::default()).unwrap();
    assert_eq!(
        line(&rough.ron, "refraction"),
        r#"{"RoughDielectric": (ior: 1.33, reflectance: (0.0, 0.0, 0.0), transmittance: (0.5, 1.0, 1.0), alpha: 0.3)}"#
    );
    let notes = rough.report.notes;
    assert!(
        notes.iter().any(|n| n.contains("rough refraction")),
        "{notes:?}"
    );
    let beyond = [("<roughness>0.1<", "<roughness>1.1<")];
    let problems = convert_changed("course.dae", &beyond, &Options::default()).unwrap_err();
    assert!(
        problems[0]
            .message
            .contains("<roughness> must be between 0 and 1")
    );
}

#[test]
fn spheres_are_analytic_and_scaled_evenly() {
    let ron = convert_fixture("course.dae").ron;
    assert_eq!(
        line(&ron, "b1"),
        r#"{"Sphere": (radius: 1.0), "LocalTransform": (translate: (-1.0, 1.0, 0.0)), "MaterialRef": "mirror"}"#
    );
    let stretched = [("2 0 0 1 0 2 0 0 0 0 2 1", "2 0 0 1 0 2.01 0 0 0 0 2 1")];
    let problems = convert_changed("course.dae", &stretched, &Options::default()).unwrap_err();
    assert!(problems[0].message.contains("not scaled evenly"));
    let lenient = Options {
        lenient: true,
        ..Default::default()
    };
    let converted = convert_changed("course.dae", &stretched, &lenient).unwrap();
    assert!(line(&converted.ron, "b1").contains("radius: 1.0"));
}

#[test]
fn the_course_area_light_is_a_quad_that_shines_down() {
    let ron = convert_fixture("course.dae").ron;
    assert_eq!(
        line(&ron, "Area"),
        r#"{"Quad": (width: 0.6, height: 0.8), "LocalTransform": (translate: (0.0, 1.49, 0.0), rotate_deg: (90.0, 0.0, 0.0)), "MaterialRef": "Area_emission"}"#
    );
    assert_eq!(
        line(&ron, "Area_emission"),
        r#"{"Lambert": (reflectance: (0.0, 0.0, 0.0)), "Emission": (radiance: (7.0, 8.0, 9.0), two_sided: false)}"#
    );
}

#[test]
fn a_mirrored_area_light_shines_the_same_way() {
    // A negative determinant turns the edges' cross product over, not the light.
    let mirrored = [(
        "0.6 0 0 0 0 0.8 0 0 0 0 1 1.49",
        "-0.6 0 0 0 0 0.8 0 0 0 0 1 1.49",
    )];
    let ron = convert_changed("course.dae", &mirrored, &Options::default())
        .unwrap()
        .ron;
    assert!(
        line(&ron, "Area").contains("rotate_deg: (90.0, 0.0, 0.0)"),
        "{ron}"
    );
    let turned = [(
        "0.6 0 0 0 0 0.8 0 0 0 0 1 1.49",
        "0.6 0 0 0 0 0.8 0 0 0 0 -1 1.49",
    )];
    let ron = convert_changed("course.dae", &turned, &Options::default())
        .unwrap()
        .ron;
    // Now it shines along the world's +Y: Rx(90°) takes +Z to −Y, Rz(180°) that to +Y.
    assert!(
        line(&ron, "Area").contains("rotate_deg: (90.0, 0.0, 180.0)"),
        "{ron}"
    );
}

#[test]
fn course_framing_orbits_the_box_and_the_camera_position_leaks_in() {
    let converted = convert_fixture("course.dae");
    assert_eq!(converted.report.camera, CameraMode::Course);
    let framing = converted.report.course_framing.unwrap();
    // Box of quads and spheres in the world: x −2..2, y −0.5..4, z −2..2 (b3 reaches below).
    let target = DVec3::new(0.0, 1.75, 0.0);
    let extent = DVec3::new(4.0, 4.5, 4.0).length();
    assert!((framing.to - target).length() < 1e-12, "{}", framing.to);
    // M · (0, 0, −1, 1) = (0, 2, 0) in the file, (0, 0, 2) in the world.
    let wanted = target + DVec3::Z * 1.5 * extent;
    assert!((framing.from - wanted).length() < 1e-12, "{}", framing.from);
    // 90° over 800 pixels, 480 of them.
    let View::Hfov(hfov) = framing.view else {
        panic!("a horizontal field of view");
    };
    let wanted = 2.0 * (480f64 / 800.0).atan().to_degrees();
    assert!((hfov - wanted).abs() < 1e-9, "{hfov} {wanted}");
    let size = Options {
        course_size: (800, 600),
        ..Default::default()
    };
    let converted = convert_changed("course.dae", &[], &size).unwrap();
    let View::Hfov(hfov) = converted.report.course_framing.unwrap().view else {
        panic!("a horizontal field of view");
    };
    assert!((hfov - 90.0).abs() < 1e-9);
    assert!(converted.ron.contains("film: (width: 800, height: 600)"));
}

#[test]
fn the_course_file_can_be_framed_as_it_says() {
    let options = Options {
        camera: Some(CameraMode::File),
        ..Default::default()
    };
    let converted = convert_changed("course.dae", &[], &options).unwrap();
    // Standard axes: (x, y, z) ↦ (x, z, −y); the camera stands at y = 3 and looks along −y.
    assert_eq!(
        line(&converted.ron, "camera"),
        r#"{"PerspectiveCamera": (hfov_deg: 90.0), "LookAt": (from: (0.0, 0.0, -3.0), to: (0.0, 0.0, -2.0), up: (0.0, 1.0, 0.0)), "ActiveCamera": ()}"#
    );
    assert!(line(&converted.ron, "b1").contains("translate: (1.0, 1.0, 0.0)"));
    // Its normals are used too: the file's say +x.
    let parts = world_parts(&converted.glb);
    assert_eq!(parts[0].normals[0], DVec3::X);
}

#[test]
fn ordinary_files_keep_their_camera_and_lose_what_is_told() {
    let converted = convert_fixture("room.dae");
    assert_eq!(converted.report.camera, CameraMode::File);
    assert_eq!(
        line(&converted.ron, "camera"),
        r#"{"PerspectiveCamera": (vfov_deg: 40.0), "LookAt": (from: (0.0, 1.0, 3.0), to: (0.0, 1.0, 2.0), up: (0.0, 1.0, 0.0)), "ActiveCamera": ()}"#
    );
    assert!(converted.ron.contains("film: (width: 480, height: 320)"));
    for wanted in [
        "lens shift",
        "attenuation of light `bulb`",
        "spot light `lamp`",
        "ambient light `sky`",
        "specular part of material `Paint.red`",
        "texture of material `Wood`",
        "<lines>",
        "1 images",
        "cut 1 polygons",
    ] {
        let notes = &converted.report.notes;
        assert!(
            notes.iter().any(|n| n.contains(wanted)),
            "{wanted}: {notes:#?}"
        );
    }
}

#[test]
fn common_materials_become_lambert_and_emission() {
    let ron = convert_fixture("room.dae").ron;
    assert_eq!(
        line(&ron, "materials.room/Paint_red"),
        r#"{"Lambert": (reflectance: (0.8, 0.1, 0.1))}"#
    );
    assert_eq!(
        line(&ron, "materials.room/Glow"),
        r#"{"Lambert": (reflectance: (0.25, 0.25, 0.25)), "Emission": (radiance: (5.0, 6.0, 7.0), two_sided: false)}"#
    );
    assert_eq!(
        line(&ron, "materials.room/Wood"),
        r#"{"Lambert": (reflectance: (0.5, 0.5, 0.5))}"#
    );
}

#[test]
fn the_four_lights_of_collada() {
    let ron = convert_fixture("room.dae").ron;
    let check = |name: &str, wanted: &str| assert_eq!(line(&ron, name), wanted);
    check(
        "bulb",
        r#"{"PointLight": (intensity: (1.0, 2.0, 3.0)), "LocalTransform": (translate: (1.0, 3.0, -2.0), rotate_deg: (-90.0, 0.0, 0.0))}"#,
    );
    // Along the file's −z, which is the world's −y.
    check(
        "lamp",
        r#"{"SpotLight": (intensity: (4.0, 4.0, 4.0), inner_deg: 22.5, outer_deg: 30.0), "LocalTransform": (translate: (0.0, 0.0, 0.0), rotate_deg: (-90.0, 0.0, 0.0))}"#,
    );
    // Turned by 90° about x: along the file's +y, which is the world's −z.
    check(
        "sun",
        r#"{"DirectionalLight": (irradiance: (2.0, 2.0, 2.0)), "LocalTransform": (translate: (0.0, 0.0, 0.0))}"#,
    );
    check(
        "environment",
        r#"{"Environment": (radiance: (0.25, 0.5, 0.75))}"#,
    );
}

#[test]
fn orthographic_cameras_give_full_extents_in_metres() {
    let perspective = "<perspective><yfov>40</yfov><aspect_ratio>1.5</aspect_ratio><znear>1</znear><zfar>1000</zfar></perspective>";
    let orthographic = "<orthographic><xmag>150</xmag><ymag>100</ymag></orthographic>";
    let changes = [(perspective, orthographic)];
    let ron = convert_changed("room.dae", &changes, &Options::default())
        .unwrap()
        .ron;
    assert!(line(&ron, "camera").contains("\"Orthographic\": (width: 3.0)"));
    assert!(ron.contains("film: (width: 480, height: 320)"));
}

#[test]
fn an_environment_map_takes_the_place_of_ambient_light() {
    let options = Options {
        environment: Some("sky \"1\".exr".to_owned()),
        ..Default::default()
    };
    let converted = convert_changed("room.dae", &[], &options).unwrap();
    // The house's world is turned by half a turn against the course's.
    assert_eq!(
        line(&converted.ron, "environment"),
        r#"{"Environment": (map: "sky \"1\".exr", flip_u: true, rotation_deg: 90.0, scale: 1.0)}"#
    );
    let notes = &converted.report.notes;
    assert!(
        notes.iter().any(|n| n.contains("takes its place")),
        "{notes:?}"
    );
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for name in ["room.dae", "course.dae", "shapes.dae"] {
        let (a, b) = (convert_fixture(name), convert_fixture(name));
        assert_eq!(a.glb, b.glb);
        assert_eq!(a.ron, b.ron);
    }
}

#[test]
fn unbound_materials_are_told_and_stand_in() {
    // One binding and one symbol that differ: the only material is meant.
    let renamed = [("<polylist material=\"m\"", "<polylist material=\"n\"")];
    let converted = convert_changed("course.dae", &renamed, &Options::default()).unwrap();
    let parts = world_parts(&converted.glb);
    let materials: Vec<&str> = parts.iter().map(|p| p.material.as_str()).collect();
    assert_eq!(materials, ["diffuse", "emission"]);
    let notes = &converted.report.notes;
    assert!(notes.iter().any(|n| n.contains("symbol `n`")), "{notes:?}");
    // No symbol at all: the same, and nothing to tell.
    let nameless = [("<polylist material=\"m\"", "<polylist")];
    let converted = convert_changed("course.dae", &nameless, &Options::default()).unwrap();
    assert_eq!(world_parts(&converted.glb)[0].material, "diffuse");
    assert!(!converted.report.notes.iter().any(|n| n.contains("bound")));
    // No binding: grey.
    let converted = convert_fixture("shapes.dae");
    assert_eq!(
        line(&converted.ron, "materials.shapes/default"),
        r#"{"Lambert": (reflectance: (0.5, 0.5, 0.5))}"#
    );
    let notes = &converted.report.notes;
    assert!(
        notes.iter().any(|n| n.contains("without material")),
        "{notes:?}"
    );
}
