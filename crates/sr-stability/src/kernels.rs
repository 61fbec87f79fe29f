//! What the suites examine.

use crate::warps::Warp;
use sr_film::{Film, FilmSpec, VarianceEstimator};
use sr_pipeline::accel::{Accel, Hit, Ray};
use sr_pipeline::bsdf::microfacet::Alpha;
use sr_pipeline::bsdf::{Bsdf, BsdfSample, Ndf, TransportMode, beckmann, fresnel, ggx, refract};
use sr_pipeline::glam::{Vec2, Vec3};
use sr_pipeline::light::{Light, LightSample};
use sr_pipeline::math::distribution::Distribution1D;
use sr_pipeline::math::hash;
use sr_pipeline::sampling::{Dim, Sampler, SamplerSpec};
use sr_pipeline::{Camera, SurfacePoint};

/// The kernels under examination, as hooks: each has the renderer's own kernel as its body.
///
/// The suites are compiled for [`Renderer`], where a hook is nothing but the call. Tests implement it for types that
/// break one kernel each, and see that a suite finds out.
pub trait Kernels: 'static {
    /// The value of a pixel that has got `samples` samples, of which the `i`-th is `sample(i)`.
    fn film_mean(samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
        film_mean(FilmSpec::of_size(1, 1), samples, sample)
    }

    /// Weight of a technique with density `a` where another has density `b`.
    fn mis_weight(a: f32, b: f32) -> f32 {
        sr_integrators::wave::power_heuristic(a, b)
    }

    /// The two Sobol numbers of a decision.
    fn random_numbers(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> Vec2 {
        spec.sobol(pixel, sample).d2(dim)
    }

    /// The one Sobol number of a decision that needs no more.
    fn random_number(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> f32 {
        spec.sobol(pixel, sample).d1(dim)
    }

    /// Bits to a number in `[0, 1)`.
    fn unit_f32(bits: u32) -> f32 {
        hash::unit_f32(bits)
    }

    /// A map from the unit square.
    fn warp(warp: Warp, u: [f32; 2]) -> [f32; 3] {
        warp.at(u)
    }

    /// [`Bsdf::sample`].
    fn bsdf_sample(
        bsdf: &Bsdf,
        wo: Vec3,
        uc: f32,
        u: Vec2,
        mode: TransportMode,
    ) -> Option<BsdfSample> {
        bsdf.sample(wo, uc, u, mode)
    }

    /// [`Bsdf::eval_pdf`].
    fn bsdf_eval_pdf(bsdf: &Bsdf, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Vec3, f32) {
        bsdf.eval_pdf(wo, wi, mode)
    }

    /// [`Distribution1D::sample`].
    fn choose(table: &Distribution1D, u: f32) -> (usize, f32, f32) {
        table.sample(u)
    }

    /// D(h), the density of normals.
    fn ndf_d(ndf: Ndf, h: [f32; 3], alpha: Alpha<f32>) -> f32 {
        match ndf {
            Ndf::Beckmann => beckmann::d(h, alpha),
            Ndf::Ggx => ggx::d(h, alpha),
        }
    }

    /// G₂, masking and shadowing.
    fn ndf_g2(ndf: Ndf, wo: [f32; 3], wi: [f32; 3], alpha: Alpha<f32>) -> f32 {
        match ndf {
            Ndf::Beckmann => beckmann::g2(wo, wi, alpha),
            Ndf::Ggx => ggx::g2(wo, wi, alpha),
        }
    }

    /// Reflectance of a dielectric.
    fn fresnel_dielectric(cos: f32, eta: f32) -> f32 {
        fresnel::fresnel_dielectric(cos, eta)
    }

    /// Reflectance of a metal.
    fn fresnel_conductor(cos: f32, eta: f32, k: f32) -> f32 {
        fresnel::fresnel_conductor(cos, eta, k)
    }

    /// The refracted direction.
    fn refract(wo: [f32; 3], n: [f32; 3], eta: f32) -> Option<[f32; 3]> {
        refract(wo, n, eta)
    }

    /// A direction from `p` to a light.
    fn sample_li(light: &Light, p: Vec3, u: Vec2) -> Option<LightSample> {
        light.sample_li(p, u)
    }

    /// The density of [`Kernels::sample_li`] at a point of the light.
    fn pdf_li(light: &Light, p: Vec3, wi: Vec3, dist: f32, ng_light: Vec3) -> f32 {
        light.pdf_li(p, wi, dist, ng_light)
    }

    /// The first hit of a ray.
    fn closest(accel: &Accel, ray: &Ray) -> Hit {
        accel.closest_one(ray)
    }

    /// Whether a ray hits anything.
    fn occluded(accel: &Accel, ray: &Ray) -> bool {
        accel.occluded_one(ray)
    }

    /// A ray that leaves a surface.
    fn spawn_ray(point: &SurfacePoint, w: Vec3) -> Ray {
        point.spawn_ray(w)
    }

    /// A ray from a surface to just before a point of another one, whose error and normal are given.
    fn spawn_ray_to(point: &SurfacePoint, w: Vec3, q: Vec3, q_err: Vec3, nq: Vec3) -> Ray {
        point.spawn_ray_to(w, q, q_err, nq)
    }

    /// The ray through a place on the film and a point of the lens.
    fn camera_ray(camera: &Camera, film: Vec2, lens: Vec2) -> Ray {
        camera.ray_through(film, lens)
    }
}

/// The renderer as it is.
#[derive(Clone, Copy, Debug)]
pub struct Renderer;

impl Kernels for Renderer {}

/// The first pixel of a film of `spec` after samples; NaN where there is no such film.
pub fn film_mean(spec: FilmSpec, samples: u64, sample: impl Fn(u64) -> Vec3) -> Vec3 {
    let Ok(mut film) = Film::new(spec) else {
        return Vec3::NAN;
    };
    let tile = &mut film.tiles_mut()[0];
    for i in 0..samples {
        if tile.add(0, i, sample(i)).is_err() {
            return Vec3::NAN;
        }
    }
    film.resolve(VarianceEstimator::Samples).rgb.pixels[0]
}
