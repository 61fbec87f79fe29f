//! Millions of rays a second over meshes and rays from files, so that other programs can answer the same.
//!
//! `STERADIAN_RAYS` names a folder with, for each scene, `<scene>.mesh` (numbers of vertices and triangles as
//! `u32`, vertices as three `f32`, triangles as three `u32`, little-endian) and rays as
//! `<scene>.prim.rays`, `<scene>.diff.rays` and `<scene>.shad.rays` (origin as three `f32`, the least `t`,
//! direction, the largest `t`), of which the last are asked for any hit. `cargo bench --bench files -- dragon`
//! takes the scenes whose names hold the word. Prints a table: the best of three rounds.

use glam::Vec3;
use sr_accel::{Accel, BuildSettings, Conservative, Geometry, Hit, Ray, SimdLevel};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Instant;

const ROUNDS: usize = 3;

/// The numbers of a file, four bytes each.
fn words(path: &Path) -> Vec<[u8; 4]> {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    bytes.as_chunks().0.to_vec()
}

fn vec3(words: &[[u8; 4]]) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|i| f32::from_le_bytes(words[i])))
}

fn mesh(path: &Path) -> Geometry {
    let words = words(path);
    let n = u32::from_le_bytes(words[0]) as usize;
    let (vertices, triangles) = words[2..].split_at(3 * n);
    Geometry {
        positions: vertices.chunks(3).map(vec3).collect(),
        triangles: triangles
            .chunks(3)
            .map(|t| [0, 1, 2].map(|i| u32::from_le_bytes(t[i])))
            .collect(),
        ..Geometry::default()
    }
}

fn rays(path: &Path) -> Vec<Ray> {
    let of = |r: &[[u8; 4]]| Ray {
        o: vec3(r),
        t_max: f32::from_le_bytes(r[7]),
        d: vec3(&r[4..]),
    };
    words(path).chunks(8).map(of).collect()
}

/// Millions a second, at best.
fn rate(count: usize, mut run: impl FnMut()) -> f64 {
    let seconds = (0..ROUNDS).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    });
    count as f64 / seconds.fold(f64::INFINITY, f64::min) * 1e-6
}

#[allow(clippy::print_stdout, reason = "the bench prints its table")]
fn report(path: &Path) {
    let scene = path.file_stem().unwrap_or_default().to_string_lossy();
    let accel = Accel::build(mesh(path), &BuildSettings::default());
    let built = accel.report();
    println!(
        "{scene:12} build {:.3} s, {:.1} bytes a triangle, depth {}",
        built.seconds,
        built.bytes as f64 / built.prims as f64,
        built.depth
    );
    for set in ["prim", "diff", "shad"] {
        let rays = rays(&path.with_file_name(format!("{scene}.{set}.rays")));
        let (mut hits, mut any) = (vec![Hit::MISS; rays.len()], vec![false; rays.len()]);
        for level in SimdLevel::available() {
            let rate = rate(rays.len(), || match set {
                "shad" => accel.occluded_with::<Conservative>(level, &rays, &mut any),
                _ => accel.closest_with::<Conservative>(level, &rays, &mut hits),
            });
            println!("{scene:12} {set} batch {level:9?} {rate:7.2}");
        }
        let rate = rate(rays.len(), || match set {
            "shad" => rays
                .iter()
                .zip(&mut any)
                .for_each(|(ray, any)| *any = accel.occluded_one(ray)),
            _ => rays
                .iter()
                .zip(&mut hits)
                .for_each(|(ray, hit)| *hit = accel.closest_one(ray)),
        });
        println!("{scene:12} {set} single          {rate:7.2}");
        black_box((&hits, &any));
    }
}

#[allow(clippy::print_stdout, reason = "the bench prints its table")]
fn main() {
    let Some(folder) = std::env::var_os("STERADIAN_RAYS") else {
        return println!("skipped: STERADIAN_RAYS names no folder of meshes and rays");
    };
    let wanted = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    let entries = std::fs::read_dir(&folder).expect("STERADIAN_RAYS is a folder");
    let mut meshes: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    meshes.retain(|p| p.extension().is_some_and(|e| e == "mesh"));
    meshes.retain(|p| {
        let name = p.file_stem().unwrap_or_default().to_string_lossy();
        wanted.as_ref().is_none_or(|w| name.contains(w))
    });
    meshes.sort();
    println!("Mrays/s, {} threads", rayon::current_num_threads());
    meshes.iter().for_each(|p| report(p));
}
