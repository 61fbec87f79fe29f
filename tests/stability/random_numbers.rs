//! Broken samplers and kernels that do not bear the ends of numbers, found by the suite `random_numbers`.

use super::mutations::broken;
use glam::{Vec2, Vec3};
use sr_pipeline::bsdf::{Bsdf, BsdfSample, TransportMode};
use sr_pipeline::light::{Light, LightSample};
use sr_pipeline::math::distribution::Distribution1D;
use sr_pipeline::sampling::{BounceDim, Dim, Sampler, SamplerSpec};
use sr_stability::{Kernels, Warp};

/// Decisions that repeat after 64 dimensions, as of a sampler with a table.
struct FewDimensions;

impl Kernels for FewDimensions {
    fn random_numbers(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> Vec2 {
        let slot = (dim.index() % 16).saturating_sub(5);
        let depth = dim.index() / 16 % 4;
        spec.sobol(pixel, sample)
            .d2(Dim::bounce(depth, BounceDim::User(slot)))
    }
}

/// A sample number of 32 bits.
struct ShortSequence;

impl Kernels for ShortSequence {
    fn random_numbers(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> Vec2 {
        spec.sobol(pixel, u64::from(sample as u32)).d2(dim)
    }
}

/// The same scramble in four pixels.
struct OneScramble;

impl Kernels for OneScramble {
    fn random_numbers(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> Vec2 {
        let pixel = pixel.map(|x| x / 2);
        spec.sobol(pixel, sample).d2(dim)
    }
}

/// Points without order.
struct NoNet;

impl Kernels for NoNet {
    fn random_numbers(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> Vec2 {
        spec.independent(pixel, sample).d2(dim)
    }
}

/// Several kernels that do not bear the ends of their numbers, each of which another sweep looks at.
struct BrittleEnds;

impl Kernels for BrittleEnds {
    /// Without order.
    fn random_number(spec: &SamplerSpec, pixel: [u32; 2], sample: u64, dim: Dim) -> f32 {
        spec.independent(pixel, sample).d1(dim)
    }

    /// A division, which rounds up to 1.
    fn unit_f32(bits: u32) -> f32 {
        bits as f32 / 4_294_967_296.0
    }

    /// A cone by its cosine, as in textbooks: 1 − u(1 − cosθ) has no digits left where the cone is small.
    fn warp(warp: Warp, u: [f32; 2]) -> [f32; 3] {
        let Warp::Cone(sin2) = warp else {
            return warp.at(u);
        };
        let z = 1.0 - u[0] * (1.0 - (1.0 - sin2).sqrt());
        let (sin_phi, cos_phi) = (std::f32::consts::TAU * u[1]).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos_phi, r * sin_phi, z]
    }

    /// The first sum that is not below the number: at 0 that is an entry without weight.
    fn choose(table: &Distribution1D, u: f32) -> (usize, f32, f32) {
        let mut sum = 0.0;
        for i in 0..table.len() {
            sum += table.pmf(i);
            if sum >= f64::from(u) {
                return (i, table.pmf(i) as f32, u);
            }
        }
        table.sample(u)
    }

    /// A density of 0 at the smallest number.
    fn bsdf_sample(
        bsdf: &Bsdf,
        wo: Vec3,
        uc: f32,
        u: Vec2,
        mode: TransportMode,
    ) -> Option<BsdfSample> {
        let sample = bsdf.sample(wo, uc, u, mode)?;
        let pdf = sample.pdf * u.x;
        Some(BsdfSample { pdf, ..sample })
    }

    /// An infinite density at the last number below 1.
    fn sample_li(light: &Light, p: Vec3, u: Vec2) -> Option<LightSample> {
        let sample = light.sample_li(p, u)?;
        let pdf = sample.pdf / (0.999_999_94 - u.y).max(0.0);
        Some(LightSample { pdf, ..sample })
    }
}

#[test]
fn random_numbers_that_repeat_or_lose_their_order_are_found() {
    let of = broken::<FewDimensions>("random_numbers");
    assert!(of.contains(&"bounces".into()), "{of:?}");
    let of = broken::<ShortSequence>("random_numbers");
    assert_eq!(of, ["long_sequences"]);
    let of = broken::<OneScramble>("random_numbers");
    assert_eq!(of, ["pixels"]);
    let of = broken::<NoNet>("random_numbers");
    assert!(of.contains(&"nets".into()), "{of:?}");
}

#[test]
fn ends_of_numbers_that_break_a_kernel_are_found() {
    assert_eq!(
        broken::<BrittleEnds>("random_numbers"),
        [
            "warps",
            "lobes",
            "lights",
            "choices",
            "strata",
            "end_of_range"
        ]
    );
}
