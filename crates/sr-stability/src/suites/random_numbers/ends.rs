//! Numbers at the ends of their range, in each dimension, through everything that turns numbers into points and
//! directions.

use super::catalogue;
use crate::warps::{Shape, Warp};
use crate::{Kernels, Point, Sweep};
use sr_pipeline::bsdf::{BsdfSample, BsdfSampleOf, TransportMode};
use sr_pipeline::glam::{Vec2, Vec3};
use sr_pipeline::light::{Light, LightSample, LightSampleOf};

/// The step of the samplers' grid.
const STEP: f32 = 1.0 / 16_777_216.0;

/// The largest number below 1.
const LAST: f32 = 1.0 - STEP;

/// Where a number may sit: the ends, next to the places where warps change their branch, and in between. Smaller than
/// a step only another sampler could give; 1 is no number that the promise speaks of.
pub(super) const NUMBERS: [f32; 14] = [
    0.0,
    1e-45,
    2.328_306_4e-10,
    STEP,
    2.0 * STEP,
    1e-3,
    0.25,
    0.5 - STEP,
    0.5,
    0.5 + STEP,
    0.75,
    1.0 - 2.0 * STEP,
    LAST,
    1.0,
];

/// What the other dimensions hold meanwhile.
const OTHERS: [f32; 6] = [0.0, STEP, 0.5, 0.618_034, 1.0 - 2.0 * STEP, LAST];

/// Pairs with `u` in either place.
fn squares(u: f32) -> impl Iterator<Item = [f32; 2]> + Clone {
    OTHERS.into_iter().flat_map(move |v| [[u, v], [v, u]])
}

/// `uc` and pairs, with `u` in one of the three places.
fn cubes(u: f32) -> impl Iterator<Item = (f32, [f32; 2])> + Clone {
    let first = OTHERS
        .into_iter()
        .flat_map(move |a| OTHERS.map(|b| (u, [a, b])));
    let others = squares(u).flat_map(|pair| OTHERS.map(|uc| (uc, pair)));
    first.chain(others)
}

pub(super) fn sweep(name: &str, about: &str, error: &str, bound: f64, points: Vec<Point>) -> Sweep {
    Sweep {
        name: name.into(),
        about: about.into(),
        parameter: "u".into(),
        error: error.into(),
        bound,
        holds: [0.0, f64::from(LAST)],
        points,
    }
}

/// The number of cases that fail, and the first of them.
#[derive(Default)]
pub(super) struct Failures {
    count: usize,
    first: Option<String>,
}

impl Failures {
    pub fn add(&mut self, is_right: bool, what: impl FnOnce() -> String) {
        if !is_right {
            self.count += 1;
            self.first.get_or_insert_with(what);
        }
    }

    pub fn point(self, u: f32) -> Point {
        let first = self.first.unwrap_or_default();
        Point::new(f64::from(u), self.count as f64, first)
    }
}

/// φ = 2πu has two roundings and that of π, 2π · 1.5 · 2⁻²⁴ at most; sine, cosine and the radius before them have one
/// half each of 2⁻²³, and their product one more: 7·10⁻⁷ in all. The others have less.
const WARP_BOUND: f64 = 1.0 / 1_048_576.0;

/// The map to rectangles honours another `u` than it was given, by up to 2⁹ ulp
/// ([`sr_pipeline::math::warp::SphericalRectangle::is_well_conditioned`]), on sides of 2.
const RECTANGLE_BOUND: f64 = 2.0 / 32_768.0;

/// Some maps with every pair.
fn mapped<K: Kernels>(
    maps: impl Fn(&Warp) -> bool,
    u: f32,
) -> impl Iterator<Item = (Warp, [f32; 2], [f32; 3])> {
    let cases = Warp::ALL
        .into_iter()
        .filter(maps)
        .flat_map(move |warp| squares(u).map(move |pair| (warp, pair)));
    cases.map(|(warp, pair)| (warp, pair, K::warp(warp, pair)))
}

fn is_rectangle(warp: &Warp) -> bool {
    matches!(warp, Warp::Rectangle(_))
}

/// Each map against itself in `f64`.
pub(super) fn warps<K: Kernels>() -> Sweep {
    let about = "Every map from the unit square gives what it gives in f64, with a number at an end of its range in either \
                 dimension.";
    accuracy::<K>("warps", about, WARP_BOUND, |w| !is_rectangle(w))
}

/// The same of the map to rectangles seen from a point.
pub(super) fn rectangles<K: Kernels>() -> Sweep {
    let about = "The map to rectangles, uniform by solid angle, gives what it gives in f64.";
    accuracy::<K>("rectangles", about, RECTANGLE_BOUND, is_rectangle)
}

/// On the grid of the samplers, on which 2u − 1 is exact.
fn accuracy<K: Kernels>(name: &str, about: &str, bound: f64, maps: fn(&Warp) -> bool) -> Sweep {
    let grid = NUMBERS.into_iter().filter(|u| (u / STEP).fract() == 0.0);
    let points = grid.map(|u| {
        let errors = mapped::<K>(maps, u).map(|(warp, pair, narrow)| {
            let (wide, unit) = (warp.at(pair.map(f64::from)), warp.size());
            let distance = (0..3).map(|k| (f64::from(narrow[k]) - wide[k]).abs() / unit[k]);
            // What is no number is no distance.
            let distance = distance.map(|d| if d.is_nan() { f64::INFINITY } else { d });
            let what = format!("{warp:?} of {pair:?} is {narrow:?}, in f64 {wide:?}");
            (distance.fold(0.0, f64::max), what)
        });
        let worst = errors.max_by(|a, b| a.0.total_cmp(&b.0));
        let (error, what) = worst.unwrap_or((f64::INFINITY, "nothing was measured".into()));
        Point::new(f64::from(u), error, what)
    });
    let error = "largest distance from the f64 result, in units of the shape";
    sweep(name, about, error, bound, points.collect())
}

/// Whether every map stays in its shape, off the grid too.
pub(super) fn shapes<K: Kernels>() -> Sweep {
    let points = NUMBERS.map(|u| {
        let mut failures = Failures::default();
        for (warp, pair, p) in mapped::<K>(|_| true, u) {
            let is_right = is_inside(warp.shape(), p);
            failures.add(is_right, || format!("{warp:?} of {pair:?} is {p:?}"));
        }
        failures.point(u)
    });
    let about = "Every map from the unit square stays in its shape, with a number at an end of its range in either dimension.";
    sweep("shapes", about, "points outside", 0.0, points.into())
}

/// Inside of a shape, or beyond its edge by no more than the rounding of a coordinate.
fn is_inside(shape: Shape, p: [f32; 3]) -> bool {
    let p = p.map(f64::from);
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let rounding = 4.0 * f64::from(f32::EPSILON);
    let is_unit = (length - 1.0).abs() <= rounding;
    match shape {
        Shape::Sphere => is_unit,
        Shape::Hemisphere => is_unit && p[2] >= 0.0,
        Shape::Disk => length <= 1.0 + rounding,
        Shape::Triangle => p[0] >= 0.0 && p[1] >= 0.0 && p[0] + p[1] <= 1.0,
        Shape::Rectangle([x, y]) => {
            let within = |p: f64, [low, high]: [f64; 2]| (low..=high).contains(&p);
            within(p[0], x) && within(p[1], y)
        }
    }
}

fn harmless(x: [f64; 3]) -> bool {
    x.iter().all(|x| x.is_finite() && *x >= 0.0)
}

fn is_unit(w: [f64; 3]) -> bool {
    let length = w.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length - 1.0).abs() <= 16.0 * f64::from(f32::EPSILON)
}

fn wide(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn is_density(pdf: f64) -> bool {
    pdf > 0.0 && pdf.is_finite()
}

fn is_scattered(sample: &BsdfSampleOf<f64>) -> bool {
    is_density(sample.pdf) && harmless(sample.weight) && is_unit(sample.wi) && sample.eta > 0.0
}

fn widened(sample: BsdfSample) -> BsdfSampleOf<f64> {
    BsdfSampleOf {
        wi: wide(sample.wi),
        weight: wide(sample.weight),
        pdf: sample.pdf.into(),
        lobe: sample.lobe,
        eta: sample.eta.into(),
    }
}

/// Every lobe, in `f32` and in `f64`.
pub(super) fn lobes<K: Kernels>() -> Sweep {
    let (lobes, views) = (catalogue::lobes(), catalogue::views());
    let points = NUMBERS.map(|u| {
        let (mut narrow, mut oracle) = (Failures::default(), Failures::default());
        for (name, bsdf) in &lobes {
            for (&wo, (uc, pair)) in views.iter().flat_map(|wo| cubes(u).map(move |c| (wo, c))) {
                let mode = TransportMode::Radiance;
                let what = || format!("{name}, wo {wo}, uc {uc:e}, u {pair:?}");
                let sample = K::bsdf_sample(bsdf, wo, uc, pair.into(), mode);
                narrow.add(sample.is_none_or(|s| is_scattered(&widened(s))), what);
                let (wo, u) = (wo.to_array().map(f64::from), pair.map(f64::from));
                let sample = bsdf.sample_real(wo, f64::from(uc), u, mode);
                oracle.add(sample.is_none_or(|s| is_scattered(&s)), what);
            }
        }
        let oracle = oracle.count as f64;
        narrow.point(u).with_oracle(oracle)
    });
    let about = "Every lobe gives a unit direction with a finite weight and a density above 0, or none, with a number at an end \
                 of its range: the choice of the lobe, or either of the two for the direction.";
    sweep(
        "lobes",
        about,
        "samples that are not so",
        0.0,
        points.into(),
    )
}

fn is_lit(light: &Light, sample: &LightSampleOf<f64>) -> bool {
    let place = match light.is_infinite() {
        true => sample.dist == f64::INFINITY,
        false => {
            let is_finite = sample.p.iter().all(|x| x.is_finite());
            sample.dist > 0.0 && is_finite && harmless(sample.p_err)
        }
    };
    let is_right = is_density(sample.pdf) && harmless(sample.radiance);
    place && is_right && is_unit(sample.wi) && is_unit(sample.ng)
}

fn widened_light(sample: LightSample) -> LightSampleOf<f64> {
    LightSampleOf {
        wi: wide(sample.wi),
        dist: sample.dist.into(),
        radiance: wide(sample.radiance),
        pdf: sample.pdf.into(),
        p: wide(sample.p),
        p_err: wide(sample.p_err),
        ng: wide(sample.ng),
        is_delta: sample.is_delta,
    }
}

/// Every light from several places, in `f32` and in `f64`.
pub(super) fn lights<K: Kernels>() -> Sweep {
    let (lights, receivers) = (catalogue::lights(), catalogue::receivers());
    let points = NUMBERS.map(|u| {
        let (mut narrow, mut oracle) = (Failures::default(), Failures::default());
        for (name, light) in &lights {
            for (&p, pair) in receivers
                .iter()
                .flat_map(|p| squares(u).map(move |c| (p, c)))
            {
                let what = || format!("{name} seen from {p}, u {pair:?}");
                let sample = K::sample_li(light, p, pair.into());
                narrow.add(
                    sample.is_none_or(|s| is_lit(light, &widened_light(s))),
                    what,
                );
                let sample = light.sample_li_real(p.to_array().map(f64::from), pair.map(f64::from));
                oracle.add(sample.is_none_or(|s| is_lit(light, &s)), what);
            }
        }
        let oracle = oracle.count as f64;
        narrow.point(u).with_oracle(oracle)
    });
    let about = "Every light gives a unit direction with finite radiance and a density above 0, or none, with a number at an end \
                 of its range in either dimension.";
    sweep(
        "lights",
        about,
        "samples that are not so",
        0.0,
        points.into(),
    )
}

/// Places within a pixel's filter and on a lens.
pub(super) fn camera() -> Sweep {
    let (filters, lenses) = (catalogue::filters(), catalogue::lenses());
    let points = NUMBERS.map(|u| {
        let mut failures = Failures::default();
        for pair in squares(u).map(Vec2::from) {
            for (filter, sampler) in &filters {
                let p = sampler.sample(pair);
                let is_right = p.abs().max_element() <= filter.radius();
                failures.add(is_right, || format!("{filter:?} of {pair} is {p}"));
            }
            for lens in &lenses {
                let p = lens.sample(pair);
                let is_right = p.as_dvec2().length() <= 1.0 + 4.0 * f64::from(f32::EPSILON);
                failures.add(is_right, || {
                    format!("{:?} of {pair} is {p}", lens.aperture())
                });
            }
        }
        failures.point(u)
    });
    let about = "Every filter and aperture gives a place within itself, with a number at an end of its range in either dimension.";
    sweep("camera", about, "places outside", 0.0, points.into())
}
