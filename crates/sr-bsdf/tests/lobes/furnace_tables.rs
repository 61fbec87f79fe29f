//! White furnaces, printed: roughness by angle for every rough lobe and index, before and after compensation.
//!
//! `cargo test -p sr-bsdf --test lobes furnace_tables -- --nocapture` shows the tables.

#![allow(clippy::print_stderr, reason = "the tables are the test's output")]

use crate::catalogue::{NDFS, direction, frosted, gltf, perfect_metal_with};
use crate::energy::integral;
use glam::Vec3;
use sr_bsdf::{Bsdf, Microsurface, Ndf, OrenNayar};

const ALPHAS: [f32; 5] = [0.01, 0.1, 0.3, 0.6, 1.0];
const COSINES: [f32; 9] = [1.0, 0.98, 0.95, 0.6, 0.3, 0.1, 0.03, 0.005, 0.001];
/// Accuracy of the quadrature.
const QUADRATURE: f64 = 1e-4;
/// What compensation may miss 1 by: 49 nodes of a table, each integrated with 2048 points.
const TABLE: f64 = 3e-3;

/// A row for each roughness: E from the axis to grazing.
fn table(name: &str, above: bool, rows: &[(f32, Bsdf)], check: impl Fn(f64)) {
    eprint!("{name}\n    cosθ ");
    COSINES.iter().for_each(|c| eprint!("  {c:6}"));
    eprintln!();
    for (parameter, bsdf) in rows {
        eprint!("  {parameter:6} ");
        for cos in COSINES {
            let wo = direction(cos, 0.4) * Vec3::new(1.0, 1.0, if above { 1.0 } else { -1.0 });
            let e = integral(bsdf, wo);
            eprint!("  {e:.4}");
            check(e);
        }
        eprintln!();
    }
}

fn rows(lobe: impl Fn(f32) -> Bsdf) -> Vec<(f32, Bsdf)> {
    ALPHAS.map(|a| (a, lobe(a))).to_vec()
}

fn loses(e: f64) {
    assert!(e < 1.0 + QUADRATURE, "gains: {e}");
}

fn keeps(e: f64) {
    assert!((e - 1.0).abs() < TABLE + QUADRATURE, "not 1: {e}");
}

fn surface(ndf: Ndf, alpha: f32) -> Microsurface {
    Microsurface::isotropic(ndf, alpha)
}

#[test]
fn white_metal_in_a_furnace() {
    for ndf in NDFS {
        let metal = |a| perfect_metal_with(surface(ndf, a));
        table(
            &format!("Conductor {ndf:?}"),
            true,
            &rows(|a| Bsdf::Conductor(metal(a))),
            loses,
        );
        let given_back = rows(|a| Bsdf::Conductor(metal(a).compensated()));
        table(
            &format!("Conductor {ndf:?}, compensated"),
            true,
            &given_back,
            keeps,
        );
    }
}

#[test]
fn brushed_white_metal_in_a_furnace() {
    let metal = |a: f32| perfect_metal_with(Microsurface::new(Ndf::Ggx, [a, 0.2]));
    table(
        "Conductor Ggx, alpha_y 0.2",
        true,
        &rows(|a| Bsdf::Conductor(metal(a))),
        loses,
    );
    let given_back = rows(|a| Bsdf::Conductor(metal(a).compensated()));
    table(
        "Conductor Ggx, alpha_y 0.2, compensated",
        true,
        &given_back,
        keeps,
    );
}

/// From both sides, energy counted without radiance's η².
#[test]
fn frosted_glass_in_a_furnace() {
    for (ndf, ior) in [
        (NDFS[0], 1.5),
        (NDFS[1], 1.5),
        (NDFS[0], 2.4),
        (NDFS[1], 1.1),
    ] {
        for above in [true, false] {
            let side = if above { "outside" } else { "inside" };
            let name = format!("RoughDielectric {ndf:?} ior {ior} from {side}");
            let glass = |a| frosted(ior, surface(ndf, a));
            table(
                &name,
                above,
                &rows(|a| Bsdf::RoughDielectric(glass(a))),
                loses,
            );
            let given_back = rows(|a| Bsdf::RoughDielectric(glass(a).compensated()));
            table(&format!("{name}, compensated"), above, &given_back, keeps);
        }
    }
}

/// The white surface returns everything at every roughness and angle: what its facets give each other is in closed
/// form.
#[test]
fn white_oren_nayar_in_a_furnace() {
    let rows = [5.0f32, 20.0, 45.0, 90.0].map(|degrees| {
        let lobe = OrenNayar {
            reflectance: Vec3::ONE,
            sigma: degrees.to_radians(),
        };
        (degrees, Bsdf::OrenNayar(lobe))
    });
    table("OrenNayar, by sigma_deg", true, &rows, |e| {
        assert!((e - 1.0).abs() < QUADRATURE, "{e}");
    });
}

/// glTF's metal scatters once. (Its diffuse layer, which gains by its specification, has a test of its own.)
#[test]
fn gltf_metal_in_a_furnace() {
    let metal = |alpha: f32| gltf(Vec3::ONE, 1.0, alpha.sqrt(), 0.0);
    table("MetallicRoughness, metallic 1", true, &rows(metal), loses);
    let clear = |alpha: f32| gltf(Vec3::ONE, 0.0, alpha.sqrt(), 1.0);
    table(
        "MetallicRoughness, transmission 1",
        true,
        &rows(clear),
        loses,
    );
}
