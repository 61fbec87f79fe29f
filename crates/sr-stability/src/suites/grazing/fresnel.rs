//! Fresnel's equations against their textbook form in `f64`.

use super::{COSINES, EVERYWHERE, ULP};
use crate::worst::{Worst, relative};
use crate::{Kernels, Sweep};
use sr_pipeline::bsdf::fresnel;

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![
        dielectric::<K>(),
        index::<K>(),
        conductor::<K>(),
        absorption::<K>(),
    ]
}

/// Indices from 1 + 10⁻⁷ to 100, and what they are from inside.
const OFF_ONE: [f32; 12] = [
    1.2e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.5, 1.42, 9.0, 99.0,
];

fn both_sides(off_one: f32) -> [f32; 2] {
    [1.0 + off_one, 1.0 / (1.0 + off_one)]
}

/// r_s = (c − g)/(c + g), r_p = (η²c − g)/(η²c + g) with g = √(η² − 1 + c²) (Born and Wolf, section 1.5.2). The
/// differences cost 10⁻¹⁶/|η − 1|, so F is good to 10⁻⁸.
pub(super) fn textbook(c: f64, eta: f64) -> f64 {
    let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
    if g2 <= 0.0 {
        return 1.0;
    }
    let (g, p) = (g2.sqrt(), eta * eta * c);
    0.5 * (((c - g) / (c + g)).powi(2) + ((p - g) / (p + g)).powi(2))
}

/// Within 1 % of the critical angle's g = 0 the slope of F is what is seen: that has sweeps of its own.
fn is_critical(c: f64, eta: f64) -> bool {
    let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
    g2.abs() < 0.01 * c * c
}

fn see<K: Kernels>(worst: &mut Worst, c: f32, eta: f32) {
    let (wide_c, wide_eta) = (f64::from(c), f64::from(eta));
    if is_critical(wide_c, wide_eta) {
        return;
    }
    let exact = textbook(wide_c, wide_eta);
    let f = K::fresnel_dielectric(c, eta);
    worst.see(relative(f.into(), exact), || {
        format!("cos θ {c:e}, η {eta:.8}: {f:e}, truth {exact:e}")
    });
    let oracle = fresnel::fresnel_dielectric(wide_c, wide_eta);
    worst.see_oracle(relative(oracle, exact));
}

/// About twelve roundings, doubled by squares; g² next to c² adds as many again.
const ROUNDING: f64 = 64.0 * ULP;

fn dielectric<K: Kernels>() -> Sweep {
    let points = COSINES.map(|c| {
        let mut worst = Worst::default();
        for eta in OFF_ONE.into_iter().flat_map(both_sides) {
            see::<K>(&mut worst, c, eta);
        }
        worst.at(c.into())
    });
    Sweep {
        name: "dielectric".into(),
        about: "Reflectance of dielectrics of index 0.01 to 100, 1 ± 10⁻⁷ among them, against the textbook's in f64."
            .into(),
        parameter: "cos θ".into(),
        error: "relative error of F".into(),
        bound: ROUNDING,
        holds: EVERYWHERE,
        points: points.into(),
    }
}

fn index<K: Kernels>() -> Sweep {
    let points = OFF_ONE.map(|off_one| {
        let mut worst = Worst::default();
        for eta in both_sides(off_one) {
            for c in COSINES {
                see::<K>(&mut worst, c, eta);
            }
        }
        worst.at(f64::from(1.0 + off_one) - 1.0)
    });
    Sweep {
        name: "index".into(),
        about: "The same by the index: 1 + x, and 1/(1 + x) from the other side.".into(),
        parameter: "η − 1".into(),
        error: "relative error of F".into(),
        bound: ROUNDING,
        holds: [1e-7, 99.0],
        points: points.into(),
    }
}

/// r_s = (c − w)/(c + w), r_p = (n²c − w)/(n²c + w), w = √(n² − 1 + c²), in complex numbers as pairs.
fn complex_textbook(c: f64, eta: f64, k: f64) -> f64 {
    let n2 = ((eta - k) * (eta + k), 2.0 * eta * k);
    let z = ((eta - 1.0) * (eta + 1.0) - k * k + c * c, n2.1);
    let (root, half_angle) = (z.0.hypot(z.1).sqrt(), 0.5 * z.1.atan2(z.0));
    let w = (root * half_angle.cos(), root * half_angle.sin());
    let ratio = |a: (f64, f64)| {
        let quotient = (a.0 - w.0).hypot(a.1 - w.1) / (a.0 + w.0).hypot(a.1 + w.1);
        quotient * quotient
    };
    0.5 * (ratio((c, 0.0)) + ratio((n2.0 * c, n2.1 * c)))
}

fn see_metal<K: Kernels>(worst: &mut Worst, c: f32, eta: f32, k: f32) {
    let [wide_c, wide_eta, wide_k] = [c, eta, k].map(f64::from);
    let exact = complex_textbook(wide_c, wide_eta, wide_k);
    let f = K::fresnel_conductor(c, eta, k);
    worst.see((f64::from(f) - exact).abs(), || {
        format!("cos θ {c:e}, η {eta}, k {k:e}: {f:e}, truth {exact:e}")
    });
    let oracle = fresnel::fresnel_conductor(wide_c, wide_eta, wide_k);
    worst.see_oracle((oracle - exact).abs());
}

const ETAS: [f32; 6] = [1e-3, 0.2, 1.0, 1.5, 3.0, 100.0];

/// Down to the smallest cosines, and at the angles where metals differ most.
fn conductor<K: Kernels>() -> Sweep {
    let points = COSINES.map(|c| {
        let mut worst = Worst::default();
        for eta in ETAS {
            for k in [0.0, 1e-3, 0.1, 1.0, 4.0, 30.0, 1e3] {
                see_metal::<K>(&mut worst, c, eta, k);
            }
        }
        worst.at(c.into())
    });
    Sweep {
        name: "conductor".into(),
        about: "Reflectance of metals, k = 0 to 10³, against the complex textbook's in f64.".into(),
        parameter: "cos θ".into(),
        error: "error of R".into(),
        bound: 32.0 * ULP,
        holds: EVERYWHERE,
        points: points.into(),
    }
}

/// To where k² is not finite in f32.
fn absorption<K: Kernels>() -> Sweep {
    let ks = [
        1e-7, 1e-5, 1e-3, 0.03, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3, 1e5, 1e8, 1e12, 1e20, 1e30,
    ];
    let points = ks.map(|k: f32| {
        let mut worst = Worst::default();
        for eta in ETAS {
            for c in COSINES.into_iter().filter(|c| *c >= 1e-10) {
                see_metal::<K>(&mut worst, c, eta, k);
            }
        }
        worst.at(k.into())
    });
    Sweep {
        name: "absorption".into(),
        about: "The same by the imaginary part of the index.".into(),
        parameter: "k".into(),
        error: "error of R".into(),
        bound: 32.0 * ULP,
        holds: [1e-7, 1e3],
        points: points.into(),
    }
}
