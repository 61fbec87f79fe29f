//! Environment maps: one hot texel among black rows, and any brightness.

use crate::suites::lobes::even;
use crate::worst::{Worst, relative};
use crate::{Effort, Kernels, Sweep};
use sr_pipeline::glam::{DVec3, Mat3, Vec3};
use sr_pipeline::light::{
    EnvironmentMap, EnvironmentSampling, ImageEnvironment, Light, direction_of,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

pub(super) fn sweeps<K: Kernels>(effort: &Effort) -> Vec<Sweep> {
    let n = effort.choose(4096, 65536);
    vec![hot_texel::<K>(n), brightness::<K>(n)]
}

/// Black but for one texel in the lower half.
fn map(width: u32, height: u32, hot: f32) -> Option<Light> {
    let mut texels = vec![Vec3::ZERO; (width * height) as usize];
    let (column, row) = (width / 3, height * 2 / 3);
    texels[(row * width + column) as usize] = Vec3::new(hot, 0.5 * hot, 0.0);
    Some(Light::ImageEnvironment(ImageEnvironment {
        map: Arc::new(EnvironmentMap::new(width, height, texels).ok()?),
        to_map: Mat3::IDENTITY,
        scale: Vec3::ONE,
        sampling: EnvironmentSampling::Importance,
    }))
}

/// ∫ L dω and ∫ L ω dω, first component, by samples of the light.
fn sampled<K: Kernels>(light: &Light, n: u32) -> (f64, DVec3) {
    let mut sum = (0.0, DVec3::ZERO);
    for i in 0..n {
        if let Some(s) = K::sample_li(light, Vec3::ZERO, even(i, n).1) {
            let weight = f64::from(s.radiance.x / s.pdf);
            sum = (sum.0 + weight, sum.1 + weight * s.wi.as_dvec3());
        }
    }
    (sum.0 / f64::from(n), sum.1 / f64::from(n))
}

/// The same by midpoints, eight by eight a texel and no fewer than 256 rows, in f64.
fn exact(light: &Light, height: u32) -> (f64, DVec3) {
    let rows = (8 * height).max(256);
    let columns = 2 * rows;
    let mut sum = (0.0, DVec3::ZERO);
    for row in 0..rows {
        let v = (f64::from(row) + 0.5) / f64::from(rows);
        let area = (PI * v).sin() * PI / f64::from(rows) * TAU / f64::from(columns);
        for column in 0..columns {
            let w = direction_of([(f64::from(column) + 0.5) / f64::from(columns), v]);
            let weight = light.le_environment_real(w)[0] * area;
            sum = (sum.0 + weight, sum.1 + weight * DVec3::from(w));
        }
    }
    sum
}

fn see<K: Kernels>(worst: &mut Worst, light: Option<&Light>, truth: (f64, DVec3), n: u32) {
    let Some(light) = light else {
        return worst.see(f64::INFINITY, || "there is no such map".into());
    };
    let (sum, vector) = sampled::<K>(light, n);
    // The vector as a fraction of the sum, since that of an even map is 0.
    let error = relative(sum, truth.0).max((vector - truth.1).length() / truth.0);
    worst.see(error, || {
        format!("{sum:e} {vector:?}, truth {:e} {:?}", truth.0, truth.1)
    });
}

/// Maps with a single texel, of two side by side, and ever larger ones of which all but one texel are black.
fn hot_texel<K: Kernels>(n: u32) -> Sweep {
    let sizes = [
        (1, 1),
        (2, 1),
        (4, 2),
        (16, 8),
        (64, 32),
        (256, 128),
        (1024, 512),
    ];
    let points = sizes.map(|(width, height)| {
        let mut worst = Worst::default();
        let light = map(width, height, 1e6);
        let truth = light
            .as_ref()
            .map_or((0.0, DVec3::ZERO), |l| exact(l, height.min(256)));
        see::<K>(&mut worst, light.as_ref(), truth, n);
        worst.at((width * height).into())
    });
    Sweep {
        name: "hot_texel".into(),
        about: "Light of maps with one bright texel among black ones, of 1×1 and 2×1 texels too: the sum over directions and its \
                vector, against midpoints in f64."
            .into(),
        parameter: "texels".into(),
        error: "error of the sum over directions, relative".into(),
        // Midpoints are good to 1/8² of a texel's gradient, evenly placed samples to some 10⁻³.
        bound: 5e-3,
        holds: [1.0, 524_288.0],
        points: points.into(),
    }
}

fn brightness<K: Kernels>(n: u32) -> Sweep {
    let truth = map(16, 8, 1.0).map_or((0.0, DVec3::ZERO), |l| exact(&l, 128));
    let points = (-36..=36).step_by(6).map(|k| {
        let hot = 10f32.powi(k);
        let mut worst = Worst::default();
        let light = map(16, 8, hot);
        let scaled = (truth.0 * f64::from(hot), truth.1 * f64::from(hot));
        see::<K>(&mut worst, light.as_ref(), scaled, n);
        worst.at(hot.into())
    });
    Sweep {
        name: "map_brightness".into(),
        about: "The same at any brightness of the texel.".into(),
        parameter: "radiance of the texel".into(),
        error: "error of the sum over directions, relative".into(),
        bound: 1e-3,
        holds: [0.9e-30, 1.1e36],
        points: points.collect(),
    }
}
