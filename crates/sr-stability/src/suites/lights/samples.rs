//! Single samples of lights that are infinitely near or far: sound, of the density that is told, and those of f64.

use crate::suites::lobes::random;
use crate::worst::{Worst, relative};
use crate::{Kernels, Sweep};
use sr_pipeline::glam::{Vec2, Vec3};
use sr_pipeline::light::{Light, PointLight, QuadLight, SphereLight, SpotLight, TriangleLight};

const SAMPLES: u32 = 512;
/// Metres; the lights are 1 m in size.
const DISTANCES: [f32; 21] = [
    0.0, 1e-30, 1e-25, 1e-20, 1e-18, 1e-15, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1,
    1.0, 10.0, 1e3, 1e5, 1e7, 1e8,
];

pub(super) fn sweeps<K: Kernels>() -> Vec<Sweep> {
    vec![sound::<K>(), against_f64::<K>()]
}

/// Lights with a place, each with a point of it and the direction in which one goes away from there.
fn lights() -> Vec<(&'static str, Light, Vec3, Vec3)> {
    let (o, x, y, z, r) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE);
    let away = Vec3::new(0.36, 0.48, 0.8);
    let sphere = |two_sided| Light::Sphere(SphereLight::new(o, 1.0, r, two_sided));
    let spot = SpotLight {
        p: o,
        axis: z,
        intensity: r,
        cos_inner: 0.9,
        cos_outer: 0.5,
    };
    vec![
        ("a sphere", sphere(false), away, away),
        ("a sphere from inside", sphere(true), away, -away),
        (
            "a rectangle",
            Light::Quad(QuadLight::new(-0.5 * (x + y), x, y, r, false)),
            0.2 * x,
            away,
        ),
        (
            "a triangle",
            Light::Triangle(TriangleLight::new([o, x, y], r, false)),
            0.2 * (x + y),
            away,
        ),
        (
            "a point",
            Light::Point(PointLight { p: o, intensity: r }),
            o,
            away,
        ),
        ("a spot", Light::Spot(spot), o, away),
    ]
}

fn sweep(
    name: &str,
    about: &str,
    error: &str,
    bound: f64,
    holds: [f64; 2],
    see: impl Fn(&mut Worst, &str, &Light, Vec3, Vec2),
) -> Sweep {
    let points = DISTANCES.map(|distance| {
        let mut worst = Worst::default();
        for (name, light, on_light, away) in lights() {
            let p = on_light + distance * away;
            (0..SAMPLES).for_each(|i| see(&mut worst, name, &light, p, random(51, i).1));
        }
        worst.at(distance.into())
    });
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: "distance from the light, of its size".into(),
        error: error.into(),
        bound,
        holds,
        points: points.into(),
    }
}

/// What is wrong with a sample, if anything.
fn fault<K: Kernels>(light: &Light, p: Vec3, u: Vec2) -> Option<String> {
    let s = K::sample_li(light, p, u)?;
    let weight = s.radiance / s.pdf;
    let sound = (s.wi.length() - 1.0).abs() < 1e-6
        && s.pdf > 0.0
        && s.pdf.is_finite()
        && weight.is_finite()
        && weight.min_element() >= 0.0
        && s.dist >= 0.0
        && s.dist.is_finite();
    if !sound {
        return Some(format!("{s:?}"));
    }
    let pdf = K::pdf_li(light, p, s.wi, s.dist, s.ng);
    let same = s.is_delta || relative(pdf.into(), s.pdf.into()) < 1e-3;
    (!same).then(|| format!("density {}, then {pdf}", s.pdf))
}

fn sound<K: Kernels>() -> Sweep {
    sweep(
        "sound_samples",
        "Spheres, rectangles, triangles, points and spots from 0 to 10⁸ m: samples whose direction is not unit, whose weight is \
         not finite, or whose density is another when asked afterwards.",
        "samples that are not sound",
        0.0,
        [0.0, 1.1e8],
        |worst, name, light, p, u| {
            if let Some(fault) = fault::<K>(light, p, u) {
                worst.count(|| format!("{name} from {p:?}, u {u:?}: {fault}"));
            }
        },
    )
}

fn against_f64<K: Kernels>() -> Sweep {
    sweep(
        "against_f64",
        "Radiance over density of the same samples.",
        "relative error of the weight",
        // Heights and distances are differences of coordinates of 1, good to 6·10⁻⁸: of 10⁻³, 6·10⁻⁵.
        2e-4,
        [0.9e-3, 1.1e8],
        |worst, name, light, p, u| {
            let narrow = K::sample_li(light, p, u).map_or(0.0, |s| f64::from(s.radiance.x / s.pdf));
            let (p, v) = (p.as_dvec3().to_array(), u.as_dvec2().to_array());
            let wide = light
                .sample_li_real(p, v)
                .map_or(0.0, |s| s.radiance[0] / s.pdf);
            worst.see(relative(narrow, wide), || {
                format!("{name} from {p:?}, u {u:?}: {narrow:e}, truth {wide:e}")
            });
        },
    )
}
