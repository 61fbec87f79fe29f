//! Rough surfaces: every way to sample them gives the same picture, and the better ones pay.

use glam::DVec3;
use sr_pipeline::SealedScene;
use sr_pipeline::bsdf::Bsdf;
use sr_pipeline::film_kernel::{Image, Layer, RELMSE_OFFSET, read_image};
use sr_tests::{
    Scene,
    agree::{assert_same, pictures},
};
use std::path::PathBuf;

/// Brushed metal, frosted glass and compensated metal, on the floor of a lit room without ceiling.
const ROOM: &str = r#"(
    film: (width: 48, height: 32),
    entities: {
        "grey": {"OrenNayar": (reflectance: 0.5, sigma_deg: 30)},
        "brushed": {"Conductor": (metal: "Au", alpha_x: 0.15, alpha_y: 0.5, ndf: Ggx, rotation_deg: 30)},
        "frosted": {"RoughDielectric": (ior: 1.5, alpha: 0.3, compensate: true)},
        "rough": {"Conductor": (metal: "silver", alpha: 0.5, compensate: true)},
        "lamp": {"Lambert": (reflectance: 0), "Emission": (radiance: 6)},
        "floor": {"Quad": (width: 8, height: 8), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "grey"},
        "light": {"Quad": (width: 3, height: 2), "LocalTransform": (translate: (0, 3, 0.5), rotate_deg: (90, 0, 0)), "MaterialRef": "lamp"},
        "left": {"Sphere": (radius: 0.7), "LocalTransform": (translate: (-1.6, 0.7, 0)), "MaterialRef": "brushed"},
        "middle": {"Sphere": (radius: 0.7), "LocalTransform": (translate: (0, 0.7, 0)), "MaterialRef": "frosted"},
        "right": {"Sphere": (radius: 0.7), "LocalTransform": (translate: (1.6, 0.7, 0)), "MaterialRef": "rough"},
        "sky": {"Environment": (radiance: 0.4)},
        "camera": {"PerspectiveCamera": (hfov_deg: 50), "LookAt": (from: (0, 1.6, 5), to: (0, 0.7, 0)), "ActiveCamera": ()},
    },
)"#;

/// Renders the room with all three surfaces sampled in one way.
fn room(sampling: &str, samples: u64, method: u64) -> Vec<Image> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("room.scene.ron");
    std::fs::write(&path, ROOM).expect("the scene is written");
    let mut scene = Scene::load(
        &path,
        &[
            ("integrator", "Path(max_depth: 4)"),
            ("sampler.replicas", "1"),
            ("entities.brushed.Conductor.sampling", sampling),
            ("entities.frosted.RoughDielectric.sampling", sampling),
            ("entities.rough.Conductor.sampling", sampling),
        ],
    );
    pictures(&mut scene, samples, method)
}

#[test]
fn all_samplings_converge_to_the_same_picture() {
    let visible = room("Visible", 64, 1);
    assert_same("visible and all normals", &visible, &room("Ndf", 128, 2));
    assert_same(
        "visible normals and cosine",
        &visible,
        &room("Cosine", 256, 3),
    );
}

/// Around the classic assignment's copper bunny, from x0, y0 to x1, y1.
const CROP: [u32; 4] = [160, 170, 280, 310];

/// relMSE of 64 samples over the pixels that show the bunny alone, against another renderer's converged picture.
fn copper_error(sampling: &str, integrator: &str) -> Option<f64> {
    let folder = |name| std::env::var_os(name).map(PathBuf::from);
    let (refs, scenes) = folder("STERADIAN_REFS").zip(folder("STERADIAN_CS184"))?;
    let reference = read_image(refs.join("CBbunny_microfacet_cu_d6.exr")).expect("a reference");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = sr_tests::convert(
        &scenes.join("CBbunny_microfacet_cu.dae"),
        folder.path(),
        None,
    );
    let crop = format!("{CROP:?}");
    let mut scene = Scene::load(
        &path,
        &[
            ("integrator", integrator),
            ("film.crop", &crop),
            ("film.layers", "[Ids]"),
            (
                "materials.CBbunny_microfacet_cu/Default.Conductor.sampling",
                sampling,
            ),
        ],
    );
    let materials = scene.world().resource::<SealedScene>().materials();
    let is_metal = |m: &sr_pipeline::sr_render::Material| matches!(m.bsdf, Bsdf::Conductor(_));
    let material = materials.iter().position(is_metal).expect("copper") as f32;
    let image = scene.render(64, 7).image;
    let ids = image.layers.iter().find(|l| l.layer == Layer::Ids);
    let ids = &ids.expect("the ids were asked for").planes[1];
    let (mut sum, mut pixels) = (0.0, 0u32);
    for (i, ours) in image.rgb.pixels.iter().enumerate() {
        if ids[i] != material {
            continue;
        }
        let (x, y) = (i as u32 % image.width, i as u32 / image.width);
        let theirs = reference.pixel(CROP[0] + x, CROP[1] + y).as_dvec3();
        let d = ours.as_dvec3() - theirs;
        sum += (d * d / (theirs * theirs + DVec3::splat(RELMSE_OFFSET))).element_sum() / 3.0;
        pixels += 1;
    }
    assert!(pixels > 4000, "the bunny is in the crop: {pixels} pixels");
    Some(sum / f64::from(pixels))
}

/// The classic assignment's comparison, 64 samples on copper of α = 0.05. Without light sampling at glossy
/// surfaces (`PathBsdf`) and with it, combined by multiple importance sampling (`Path`): light sampling finds the
/// lamp whichever way the lobe is sampled, but what the walls send back is found by the lobe alone.
///
/// The reference's own noise counts on both sides, so the factors are at least what is printed. One seed: over the
/// pixels of the bunny, some 10⁴, a factor is known to a few percent.
#[test]
fn importance_sampling_pays_on_copper() {
    for integrator in ["PathBsdf(max_depth: 5)", "Path(max_depth: 5)"] {
        let error = |sampling| copper_error(sampling, integrator);
        let Some(cosine) = error("Cosine") else {
            eprintln!("skipped: STERADIAN_REFS and STERADIAN_CS184 are not set");
            return;
        };
        for sampling in ["Visible", "Ndf"] {
            let better = error(sampling).expect("the folders are there");
            let factor = cosine / better;
            eprintln!(
                "{integrator}: relMSE Cosine {cosine:.4}, {sampling} {better:.4}: {factor:.1} times"
            );
            assert!(factor > 4.0, "{integrator} {sampling}: {factor}");
        }
    }
}
