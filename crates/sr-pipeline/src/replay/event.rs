//! What can be seen of a path on its way.

use glam::{Vec2, Vec3};
use sr_render::accel::Ray;
use sr_render::bsdf::LobeFlags;
use sr_render::sampling::Dim;
use sr_render::{LightId, SurfacePoint};

/// Looks on while paths are traced.
///
/// Kernels are generic over it. With [`Nobody`] nothing is left of the calls; whoever watches must not be
/// able to change what is seen.
pub trait Witness {
    /// Something happened to a path; `slot` tells paths apart that advance together.
    fn see(&mut self, slot: u32, event: Event);
}

/// The witness of every normal render: sees nothing and costs nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Witness for Nobody {
    #[inline(always)]
    fn see(&mut self, _: u32, _: Event) {}
}

/// One thing that happened to a path. Positions and directions are in render space; `depth` is the
/// number of bounces so far: 0 at the first surface.
///
/// An integrator tells what it knows: the built-in ones everything, one that asks a
/// [`RayContext`](crate::RayContext) its rays, hits, numbers and where it says that it is.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A random number was looked up.
    Number(Number),
    /// A ray sets out to find the next surface.
    Ray(Ray),
    /// It found one.
    Surface {
        /// Distance along the ray.
        t: f32,
        /// The surface.
        point: SurfacePoint,
    },
    /// It found none, and left the scene.
    Miss,
    /// The integrator says where its path is ([`RayContext::at`](crate::RayContext::at)).
    At {
        /// Bounces so far.
        bounce: u32,
        /// Where.
        point: SurfacePoint,
    },
    /// The path met a light by chance.
    Emission(Emission),
    /// A point on a light was sampled.
    Connection(Connection),
    /// A shadow ray was traced.
    Shadow {
        /// The ray.
        ray: Ray,
        /// Something stands in its way.
        occluded: bool,
        /// What arrives at the camera if nothing does; unset where only the integrator knows.
        contribution: Option<Vec3>,
    },
    /// A direction was sampled, and the path goes that way.
    Scatter(Scatter),
    /// Roulette was played.
    Roulette {
        /// Bounces before it.
        depth: u32,
        /// The random number.
        u: f32,
        /// The path lives if `u` is below.
        survival: f32,
        /// Throughput after it, if the path lives.
        beta: Vec3,
    },
    /// The path, or this branch of it, is over.
    End {
        /// Why.
        why: PathEnd,
        /// Bounces so far.
        depth: u32,
        /// Throughput that it had still.
        beta: Vec3,
    },
}

/// One look-up of random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// The decision.
    pub dim: Dim,
    /// The numbers.
    pub u: Draw,
    /// Which of several decisions that share the dimension ([`Sampler::fork`](crate::prelude::Sampler::fork)).
    pub fork: u32,
    /// Sub-sample j of n ([`Sampler::split`](crate::prelude::Sampler::split)).
    pub split: [u32; 2],
}

/// The numbers of a decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Draw {
    /// One.
    D1(f32),
    /// Two.
    D2(Vec2),
}

/// Light that a path met by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Bounces so far.
    pub depth: u32,
    /// The light.
    pub light: LightId,
    /// What it sends back along the ray.
    pub le: Vec3,
    /// Density with which light sampling would have found it, per solid angle; unset where it does not
    /// compete.
    pub light_pdf: Option<f32>,
    /// Weight of having met it by chance.
    pub weight: f32,
    /// What arrives at the camera: throughput, `le` and `weight` multiplied.
    pub contribution: Vec3,
}

/// A sampled point on a light, seen from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Connection {
    /// Bounces so far.
    pub depth: u32,
    /// The light.
    pub light: LightId,
    /// Unit direction to it.
    pub wi: Vec3,
    /// Distance; infinite for lights at infinity.
    pub dist: f32,
    /// What it sends, as [`LightSample::radiance`](sr_render::light::LightSample::radiance).
    pub radiance: Vec3,
    /// Density of the direction by light sampling, the choice of the light included; 1 for points and
    /// directions.
    pub light_pdf: f32,
    /// The lobe's value.
    pub f: Vec3,
    /// Density of the direction by scattering.
    pub scatter_pdf: f32,
    /// Weight of having sampled the light.
    pub weight: f32,
    /// What arrives at the camera unless something is in the way; no ray is traced for nothing.
    pub contribution: Vec3,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Bounces before this one.
    pub depth: u32,
    /// Which of how many directions leave the surface.
    pub branch: [u32; 2],
    /// The lobe that was chosen.
    pub lobe: LobeFlags,
    /// Unit direction.
    pub wi: Vec3,
    /// What the throughput is multiplied with: f·|cosθ|/pdf.
    pub weight: Vec3,
    /// Density of the direction, or the probability of a delta lobe.
    pub pdf: f32,
    /// η_t/η_i of a refraction, else 1.
    pub eta: f32,
    /// Throughput after it.
    pub beta: Vec3,
}

/// Why a path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PathEnd {
    /// It left the scene.
    Left,
    /// The lobe gave no direction, or one that carries nothing.
    Absorbed,
    /// It has as many bounces as the settings allow.
    Depth,
    /// Its next ray would be the last, and could bring nothing: all light that counts at its end is
    /// sampled already.
    LastRay,
    /// Roulette.
    Roulette,
}

impl PathEnd {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Left,
        Self::Absorbed,
        Self::Depth,
        Self::LastRay,
        Self::Roulette,
    ];

    /// For messages: what the path did.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Left => "left the scene",
            Self::Absorbed => "absorbed: no direction that carries anything",
            Self::Depth => "at the largest number of bounces",
            Self::LastRay => {
                "one bounce before the largest number: a last ray could bring nothing more"
            }
            Self::Roulette => "ended by roulette",
        }
    }
}

impl Event {
    /// What is not finite, or is light below 0, in what a kernel computed here; `None` when all is well.
    ///
    /// The first event with a defect is where a rejected sample went wrong.
    pub fn defect(&self) -> Option<&'static str> {
        let bad = |v: Vec3| !v.is_finite();
        let dark = |v: Vec3| bad(v) || v.min_element() < 0.0;
        match self {
            Self::Number(_) | Self::Miss | Self::At { .. } => None,
            Self::Ray(ray) => (bad(ray.o) || bad(ray.d)).then_some("the ray"),
            Self::Surface { t, point } => {
                let bad = !t.is_finite() || bad(point.p) || bad(point.ng) || bad(point.frame.n);
                bad.then_some("the surface point")
            }
            Self::Emission(e) => [
                (dark(e.le), "the light's radiance"),
                (!e.weight.is_finite(), "the weight of the light"),
                (dark(e.contribution), "the light met by chance"),
            ]
            .into_iter()
            .find_map(|(bad, what)| bad.then_some(what)),
            Self::Connection(c) => [
                (dark(c.radiance), "the light's radiance"),
                (dark(c.f), "the lobe's value"),
                (!c.scatter_pdf.is_finite(), "the lobe's density"),
                (!c.weight.is_finite(), "the weight of the light"),
                (dark(c.contribution), "the sampled light"),
            ]
            .into_iter()
            .find_map(|(bad, what)| bad.then_some(what)),
            Self::Shadow {
                ray, contribution, ..
            } => {
                let bad = bad(ray.o) || bad(ray.d) || contribution.is_some_and(dark);
                bad.then_some("the shadow ray")
            }
            Self::Scatter(s) => [
                (bad(s.wi), "the sampled direction"),
                (dark(s.weight), "the weight of the direction"),
                (!s.pdf.is_finite(), "the density of the direction"),
                (dark(s.beta), "the throughput"),
            ]
            .into_iter()
            .find_map(|(bad, what)| bad.then_some(what)),
            Self::Roulette { survival, beta, .. } => {
                (!survival.is_finite() || dark(*beta)).then_some("roulette")
            }
            Self::End { beta, .. } => dark(*beta).then_some("the throughput"),
        }
    }
}
