//! Scattering lobes, Fresnel terms and microfacet distributions.
//!
//! [`Bsdf`] is the closed enum that a renderer shades with; every variant is a small struct in a file of
//! its own, with tables behind an `Arc` where it needs any. Directions are unit vectors of the local frame, away from the surface, with +Z
//! the shading normal; `wo` points to where the path comes from.
//!
//! All lobes, and the free functions below them ([`fresnel`], [`refract()`], [`beckmann`] and [`ggx`]), are generic over
//! [`sr_math::Real`]: the `f64` instances are the oracles of the `f32` ones. Parameters are `f32` in both, and what
//! kind of lobe they make is decided in `f32`, so both take the same branch. [`metals`] has measured constants.
//!
//! Two conventions hold for all lobes:
//! - What reflects is two-sided: for `wo` below the surface the frame is mirrored.
//! - A direction whose squared cosine is not a normal number (below about 10⁻¹⁹ in `f32`) counts as
//!   tangent: nothing is scattered into or out of it. So no quotient of cosines overflows.

pub mod beckmann;
mod bsdf;
mod color;
mod conductor;
mod dielectric;
#[cfg(test)]
mod distribution_tests;
pub mod erf;
pub mod fresnel;
pub mod ggx;
mod interface_loss;
mod lambert;
mod local;
mod metallic_roughness;
pub mod metals;
pub mod microfacet;
mod microsurface;
mod mirror;
mod missing_energy;
mod oren_nayar;
mod refract;
mod refraction;
mod rough_dielectric;
mod sample;
mod thin_dielectric;

pub use bsdf::Bsdf;
pub use conductor::{Conductor, ConductorFresnel};
pub use dielectric::{Dielectric, FresnelKind};
pub use lambert::Lambert;
pub use metallic_roughness::MetallicRoughness;
pub use microfacet::Sampling;
pub use microsurface::{Microsurface, Ndf};
pub use mirror::Mirror;
pub use oren_nayar::OrenNayar;
pub use refract::refract;
pub use refraction::Refraction;
pub use rough_dielectric::RoughDielectric;
pub use sample::{BsdfSample, BsdfSampleOf, LobeFlags, TransportMode};
pub use thin_dielectric::ThinDielectric;
