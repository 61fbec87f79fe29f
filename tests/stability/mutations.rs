//! Broken kernels, each found by a suite that is named beforehand.

use super::sweeps;
use glam::{Vec2, Vec3};
use sr_pipeline::accel::{Accel, Hit, Ray, SimdLevel, SlabMargin};
use sr_pipeline::bsdf::{Bsdf, BsdfSample, TransportMode};
use sr_pipeline::film_kernel::FilmSpec;
use sr_pipeline::light::{Light, LightSample};
use sr_pipeline::{Camera, SurfacePoint};
use sr_stability::{Kernels, Verdict, film_mean};

/// The names of the sweeps of a suite that are broken with the kernels of `K`.
pub fn broken<K: Kernels>(suite: &str) -> Vec<String> {
    let bad = sweeps::<K>(suite).into_iter();
    let bad = bad.filter(|s| s.verdict() == Verdict::Broken);
    bad.map(|s| s.name).collect()
}

/// A film that adds in `f32`, as many renderers do.
struct SumInF32;

impl Kernels for SumInF32 {
    fn film_mean(samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
        (0..samples).map(sample).sum::<Vec3>() / samples as f32
    }
}

/// A clamp that nobody asked for.
struct Clamp;

impl Kernels for Clamp {
    fn film_mean(samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
        let spec = FilmSpec {
            clamp: Some(10.0),
            ..FilmSpec::of_size(1, 1)
        };
        film_mean(spec, samples, sample)
    }
}

/// The density of half vectors taken for that of reflected directions: 1/(4 |wo·h|) is missing.
struct WrongJacobian;

impl Kernels for WrongJacobian {
    fn bsdf_eval_pdf(bsdf: &Bsdf, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Vec3, f32) {
        let (f, pdf) = bsdf.eval_pdf(wo, wi, mode);
        let missing = match wo.z * wi.z > 0.0 {
            true => 4.0 * wo.dot((wo + wi).normalize()).abs(),
            false => 1.0,
        };
        (f, pdf * missing)
    }
}

/// Weights without the cosine.
struct DroppedCosine;

impl Kernels for DroppedCosine {
    fn bsdf_sample(
        bsdf: &Bsdf,
        wo: Vec3,
        uc: f32,
        u: Vec2,
        mode: TransportMode,
    ) -> Option<BsdfSample> {
        let sample = bsdf.sample(wo, uc, u, mode)?;
        Some(BsdfSample {
            weight: sample.weight / sample.wi.z.abs(),
            ..sample
        })
    }
}

/// r_s = (c − g)/(c + g) as textbooks have it: all rounding where the index is near 1.
struct TextbookFresnel;

impl Kernels for TextbookFresnel {
    fn fresnel_dielectric(c: f32, eta: f32) -> f32 {
        let g2 = eta * eta - 1.0 + c * c;
        if g2 <= 0.0 {
            return 1.0;
        }
        let (g, p) = (g2.sqrt(), eta * eta * c);
        0.5 * (((c - g) / (c + g)).powi(2) + ((p - g) / (p + g)).powi(2))
    }
}

/// cosθ_t from 1 − (1 − cos²θ_i)/η², which magnifies a rounding of the cosine by 1/η².
struct RefractByCosine;

impl Kernels for RefractByCosine {
    fn refract(wo: [f32; 3], n: [f32; 3], eta: f32) -> Option<[f32; 3]> {
        let cos = Vec3::from(wo).dot(n.into());
        let cos2 = 1.0 - (1.0 - cos * cos) / (eta * eta);
        let through = |c: f32| (-Vec3::from(wo) / eta + (cos / eta - c) * Vec3::from(n)).to_array();
        (cos2 > 0.0).then(|| through(cos2.sqrt()))
    }
}

/// A heuristic whose two weights are not taken of the same densities.
struct LopsidedWeights;

impl Kernels for LopsidedWeights {
    fn mis_weight(a: f32, b: f32) -> f32 {
        let ratio = 1.01 * b / a;
        1.0 / (1.0 + ratio * ratio)
    }
}

/// Rays that leave by a thousandth, as many renderers have it.
struct Epsilon;

impl Kernels for Epsilon {
    fn spawn_ray(point: &SurfacePoint, w: Vec3) -> Ray {
        Ray {
            o: point.p + 1e-3 * w,
            t_max: f32::INFINITY,
            d: w,
        }
    }

    fn spawn_ray_to(point: &SurfacePoint, w: Vec3, q: Vec3, _: Vec3, _: Vec3) -> Ray {
        Ray {
            o: point.p + 1e-3 * w,
            t_max: (q - point.p).length() - 2e-3,
            d: w,
        }
    }
}

/// Boxes as they are, without a margin for what rounds.
struct TightSlabs;

impl SlabMargin for TightSlabs {
    const FAR: f32 = 1.0;
    const CULL: f32 = 1.0;

    fn shift(_: Vec3, _: f32) -> Vec3 {
        Vec3::ZERO
    }
}

impl Kernels for TightSlabs {
    fn closest(accel: &Accel, ray: &Ray) -> Hit {
        let mut hits = [Hit::MISS];
        accel.closest_with::<Self>(SimdLevel::best(), &[*ray], &mut hits);
        hits[0]
    }
}

/// The density of a cone of sin²θ by 1 − cos θ, whose difference has no digits left where the cone is small.
struct CancellingCone;

impl Kernels for CancellingCone {
    fn sample_li(light: &Light, p: Vec3, u: Vec2) -> Option<LightSample> {
        let sample = light.sample_li(p, u)?;
        if !matches!(light, Light::Sphere(_)) {
            return Some(sample);
        }
        let cos = 1.0 - (std::f32::consts::TAU * sample.pdf).recip();
        let pdf = (std::f32::consts::TAU * (1.0 - cos)).recip();
        Some(LightSample { pdf, ..sample })
    }
}

/// Pixels whose middle is at their corner.
struct HalfPixel;

impl Kernels for HalfPixel {
    fn camera_ray(camera: &Camera, film: Vec2, lens: Vec2) -> Ray {
        camera.ray_through(film - 0.5, lens)
    }
}

#[test]
fn a_cone_by_its_cosine_is_found() {
    let found = broken::<CancellingCone>("lights");
    for sweep in ["sphere_above", "sphere_at_horizon", "against_f64"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn half_a_pixel_is_found() {
    let found = broken::<HalfPixel>("camera");
    for sweep in ["field_of_view", "field_of_view_in_pixels", "wide_pictures"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn an_epsilon_is_found() {
    let found = broken::<Epsilon>("scale");
    for sweep in ["mesh_at_scale", "quads_at_scale", "sphere_at_scale", "slab"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn slabs_without_margins_are_found() {
    assert_eq!(broken::<TightSlabs>("scale"), ["edges"]);
}

#[test]
fn a_film_sum_in_f32_is_found() {
    assert_eq!(broken::<SumInF32>("sums"), ["equal_samples"]);
}

#[test]
fn a_clamp_is_found() {
    assert_eq!(broken::<Clamp>("sums"), ["outlier"]);
}

#[test]
fn a_wrong_jacobian_is_found() {
    let found = broken::<WrongJacobian>("roughness");
    for sweep in ["chi2", "pdf_integral", "consistency"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn a_dropped_cosine_is_found() {
    let found = broken::<DroppedCosine>("roughness");
    for sweep in ["consistency", "energy"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn a_dropped_cosine_is_found_at_grazing() {
    let found = broken::<DroppedCosine>("grazing");
    for sweep in ["weight", "energy"] {
        assert!(
            found.iter().any(|f| f == sweep),
            "{sweep} is not in {found:?}"
        );
    }
}

#[test]
fn fresnel_by_the_textbook_is_found() {
    let found = broken::<TextbookFresnel>("grazing");
    assert_eq!(found, ["dielectric", "index", "critical_fresnel"]);
}

#[test]
fn refraction_by_the_cosine_is_found() {
    let found = broken::<RefractByCosine>("grazing");
    assert_eq!(found, ["critical_direction", "critical_snell"]);
}

#[test]
fn lopsided_weights_are_found() {
    assert_eq!(broken::<LopsidedWeights>("paths"), ["mis_weights"]);
}
